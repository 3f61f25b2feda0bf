// The three.js geometries of a stage, one per draw, shared by everything that
// shows the stage and freed with the last of it.

import { BufferGeometry, InterleavedBufferAttribute, Sphere } from "three";
import type { BufferStage, DrawRange, Stage, StoredVertices } from "../decode/stage.ts";
import { isPairCode } from "../decode/stage.ts";
import type { Buffers } from "./buffers.ts";

interface Entry {
  readonly geometries: readonly BufferGeometry[];
  users: number;
}

export class GeometryPool {
  readonly #buffers: Buffers;
  readonly #entries = new Map<Stage, Entry>();

  constructor(buffers: Buffers) {
    this.#buffers = buffers;
  }

  /** One for each draw, in order. */
  acquire(stage: Stage): readonly BufferGeometry[] {
    const entry = this.#entries.get(stage) ?? { geometries: geometriesOf(stage, this.#buffers), users: 0 };
    // Else three.js makes one, of stored numbers that are not here.
    for (const geometry of entry.geometries) geometry.boundingSphere ??= new Sphere();
    entry.users += 1;
    this.#entries.set(stage, entry);
    return entry.geometries;
  }

  release(stage: Stage): void {
    const entry = this.#entries.get(stage);
    if (entry === undefined) return;
    entry.users -= 1;
    if (entry.users > 0) return;
    for (const geometry of entry.geometries) this.#buffers.dispose(geometry);
    this.#entries.delete(stage);
  }
}

function geometriesOf(stage: Stage, buffers: Buffers): BufferGeometry[] {
  if (stage.kind === "textures") return stage.draws.map(emptyGeometryOf);
  const attributes = storedAttributesOf(stage).map(({ name, vertices: { bytes, type, components, stride, offset }, isSpread }) =>
    ({ name, attribute: new InterleavedBufferAttribute(buffers.recordsOf(bytes, type, stride), components, offset, isSpread) }));
  const index = stage.index && buffers.indexOf(stage.index.bytes, stage.index.type);
  return stage.draws.map(({ first, count }) => {
    const geometry = new BufferGeometry();
    for (const { name, attribute } of attributes) geometry.setAttribute(name, attribute);
    geometry.setIndex(index ?? null);
    geometry.setDrawRange(first, count);
    return geometry;
  });
}

/** No buffers at all: the shader finds its vertices by their number. */
function emptyGeometryOf({ primitive, count }: DrawRange): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setDrawRange(0, primitive === "triangleStrip" ? Math.max(0, count - 2) * 3 : count);
  return geometry;
}

/** An attribute of a stage's vertices, by three.js' name for it. */
export interface StoredAttribute {
  readonly name: string;
  readonly vertices: StoredVertices;
  /** Integers are spread over 0 … 1 or -1 … 1. */
  readonly isSpread: boolean;
}

export function storedAttributesOf({ coord, normal, normalCode, color, texCoord, value }: BufferStage): StoredAttribute[] {
  const attribute = (name: string, vertices: StoredVertices | undefined, isSpread: boolean): StoredAttribute[] =>
    vertices ? [{ name, vertices, isSpread: isSpread && vertices.type !== "Float32" }] : [];
  return [
    ...attribute("position", coord, false),
    ...attribute("normal", normal, !isPairCode(normalCode)),
    ...attribute("color", color, true),
    ...attribute("vertexValue", value, false),
    ...attribute("uv", texCoord, true),
  ];
}
