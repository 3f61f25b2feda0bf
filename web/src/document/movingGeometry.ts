// Geometry whose vertices animation moves. The number of vertices, and which corners they have, stays the same: so only
// the numbers of arrays change, and who draws them writes them again where they are.

import type { CreasedNormals } from "../tessellate/creasedNormals.ts";
import type { Corner, VertexArrays } from "../tessellate/faces.ts";
import type { Bounds } from "../stage/vertexArray.ts";
import type { SceneElement } from "./element.ts";

/** The attributes that a child node of the geometry may hold, by the names of their arrays. */
const movingAttributes = ["positions", "normals", "texCoords", "colors"] as const;
export type MovingAttribute = (typeof movingAttributes)[number];

/** How the arrays follow from the numbers of child nodes. */
export interface VertexLayout {
  /** In the order of the vertices. */
  readonly corners: readonly Corner[];
  /** Where the document has no normals, but faces. */
  readonly creasedNormals: CreasedNormals | undefined;
  /** The child nodes. */
  readonly nodes: ReadonlyMap<SceneElement, MovingAttribute>;
}

interface ListIndices {
  readonly indices: Uint32Array;
  /** One more than the largest. */
  readonly end: number;
}

/** Bounds grow by this share of their size when vertices leave them, so that they do not grow in every frame. */
const growth = 0.25;

let count = 0;

export class MovingGeometry {
  /** Their numbers change, the arrays do not. */
  readonly arrays: VertexArrays;
  readonly #layout: VertexLayout | undefined;
  readonly #readAgain: () => VertexArrays | undefined;
  /** Which element of a list each vertex takes. */
  readonly #indices = new Map<MovingAttribute, ListIndices>();
  readonly #listeners = new Set<(attributes: ReadonlySet<MovingAttribute>) => void>();
  readonly #number = ++count;
  #bounds: Bounds;

  /**
   * `arrays`: at first. `readAgain` computes them from the present numbers, for fields that the layout does not tell the
   * effect of.
   */
  constructor(arrays: VertexArrays, layout: VertexLayout | undefined, readAgain: () => VertexArrays | undefined) {
    this.arrays = arrays;
    this.#layout = layout;
    this.#readAgain = readAgain;
    this.#bounds = boundsAround(arrays.positions);
  }

  /** Bounds of all vertices so far. Another object when they have grown. */
  get bounds(): Bounds {
    return this.#bounds;
  }

  /** Calls back whenever attributes have changed, until the returned function is called. */
  listen(listener: (attributes: ReadonlySet<MovingAttribute>) => void): () => void {
    this.#listeners.add(listener);
    return () => {
      this.#listeners.delete(listener);
    };
  }

  /** A field of a node has got numbers. Returns false where they make other vertices: the geometry is to be read again. */
  move(element: SceneElement, numbers: readonly number[]): boolean {
    const attribute = this.#layout?.nodes.get(element);
    if (attribute === undefined) {
      const arrays = this.#readAgain();
      return arrays !== undefined && this.#moveTo(arrays);
    }
    const changed = this.#moveAttribute(attribute, numbers);
    return changed !== undefined && this.#report(changed);
  }

  /**
   * The geometry has been read again. Returns false where it has another number of vertices or other corners; else it
   * moves to these vertices.
   */
  follow(arrays: VertexArrays, layout: VertexLayout | undefined): boolean {
    return isSameLayout(layout, this.#layout) && this.#moveTo(arrays);
  }

  /** Descriptions of geometry are compared by their text. */
  toJSON(): number {
    return this.#number;
  }

  #moveTo(arrays: VertexArrays): boolean {
    const attributes = movingAttributes.filter((attribute) => this.arrays[attribute] !== undefined);
    if (movingAttributes.some((attribute) => arrays[attribute]?.length !== this.arrays[attribute]?.length))
      return false;
    for (const attribute of attributes) this.arrays[attribute]?.set(arrays[attribute] ?? []);
    return this.#report(new Set(attributes));
  }

  #report(changed: ReadonlySet<MovingAttribute>): true {
    if (changed.has("positions")) this.#extendBounds();
    for (const listener of this.#listeners) listener(changed);
    return true;
  }

  #moveAttribute(attribute: MovingAttribute, numbers: readonly number[]): ReadonlySet<MovingAttribute> | undefined {
    const { creasedNormals } = this.#layout ?? {};
    const array = this.arrays[attribute];
    if (array === undefined || !this.#take(array, attribute, numbers)) return undefined;
    if (attribute !== "positions" || !creasedNormals || !this.arrays.normals) return new Set([attribute]);
    this.#take(this.arrays.normals, "normals", creasedNormals.compute(numbers));
    return new Set(["positions", "normals"]);
  }

  /** Returns false where a corner names a number that there is not. */
  #take(array: Float32Array | Uint8Array, attribute: MovingAttribute, numbers: ArrayLike<number>): boolean {
    const { indices, end } = this.#indicesOf(attribute);
    const size = array.length / indices.length;
    if (size * end > numbers.length) return false;
    const scale = attribute === "colors" ? 255 : 1;
    for (let vertex = 0; vertex < indices.length; ++vertex) {
      const from = size * (indices[vertex] ?? 0);
      for (let c = 0; c < size; ++c) {
        const value = scale * (numbers[from + c] ?? 0);
        array[size * vertex + c] = scale === 1 ? value : Math.round(Math.min(Math.max(value, 0), scale));
      }
    }
    return true;
  }

  #indicesOf(attribute: MovingAttribute): ListIndices {
    const known = this.#indices.get(attribute);
    if (known) return known;
    const corner = { positions: "position", normals: "normal", texCoords: "texCoord", colors: "color" } as const;
    const indices = Uint32Array.from(this.#layout?.corners ?? [], (each) => each[corner[attribute]]);
    const found = { indices, end: indices.reduce((end, index) => Math.max(end, index + 1), 0) };
    this.#indices.set(attribute, found);
    return found;
  }

  #extendBounds(): void {
    const { min, max } = this.#bounds;
    const now = boundsAround(this.arrays.positions);
    const isInside = [0, 1, 2].every((c) => (now.min[c] ?? 0) >= (min[c] ?? 0) && (now.max[c] ?? 0) <= (max[c] ?? 0));
    if (isInside) return;
    const extended = (side: -1 | 1, c: 0 | 1 | 2): number => {
      const [low, high] = [Math.min(min[c], now.min[c]), Math.max(max[c], now.max[c])];
      const isOutside = side < 0 ? now.min[c] < min[c] : now.max[c] > max[c];
      return (side < 0 ? low : high) + (isOutside ? side * growth * (high - low) : 0);
    };
    this.#bounds = {
      min: [extended(-1, 0), extended(-1, 1), extended(-1, 2)],
      max: [extended(1, 0), extended(1, 1), extended(1, 2)],
    };
  }
}

function isSameLayout(a: VertexLayout | undefined, b: VertexLayout | undefined): boolean {
  if (a === undefined || b === undefined) return a === b;
  return (
    a.corners.length === b.corners.length &&
    a.creasedNormals?.creaseAngle === b.creasedNormals?.creaseAngle &&
    a.nodes.size === b.nodes.size &&
    Array.from(a.nodes).every(([node, attribute]) => b.nodes.get(node) === attribute) &&
    a.corners.every((corner, i) => {
      const { position, normal, texCoord, color } = b.corners[i] ?? corner;
      return (
        corner.position === position &&
        corner.normal === normal &&
        corner.texCoord === texCoord &&
        corner.color === color
      );
    })
  );
}

function boundsAround(positions: Float32Array): Bounds {
  const min: [number, number, number] = [Infinity, Infinity, Infinity];
  const max: [number, number, number] = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < positions.length; i += 3)
    for (const c of [0, 1, 2] as const) {
      const value = positions[i + c] ?? 0;
      if (value < min[c]) min[c] = value;
      if (value > max[c]) max[c] = value;
    }
  return { min, max };
}
