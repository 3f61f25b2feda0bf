// The three.js geometries of stages, one per draw, shared by all shapes that show the stage and
// reference counted.

import { BufferGeometry, InstancedBufferGeometry, InterleavedBufferAttribute, Sphere } from "three";
import type { BufferStage, DrawRange, Stage } from "../../stage/stage.ts";
import type { BufferProvider } from "../uploads/bufferProvider.ts";
import { vertexAttributesOf } from "../attributes/vertexAttributes.ts";
import { lateWideLines } from "../lines/lateWideLines.ts";

interface Entry {
  readonly geometries: readonly BufferGeometry[];
  users: number;
}

export class GeometryPool {
  readonly #buffers: BufferProvider;
  readonly #entries = new Map<Stage, Entry>();

  constructor(buffers: BufferProvider) {
    this.#buffers = buffers;
  }

  /** One geometry per draw, in order. Each call needs a `release`. */
  acquire(stage: Stage): readonly BufferGeometry[] {
    const entry = this.#entries.get(stage) ?? { geometries: geometriesOf(stage, this.#buffers), users: 0 };
    // Otherwise three.js would compute bounds from positions, which are not in JavaScript.
    for (const geometry of entry.geometries) geometry.boundingSphere ??= new Sphere();
    entry.users += 1;
    this.#entries.set(stage, entry);
    return entry.geometries;
  }

  /**
   * Makes the geometries of a stage those of another stage of the same layout. False, and without effect, where several
   * shapes have acquired the stage, or where three.js would keep the buffers of the one before.
   */
  replace(before: Stage, after: Stage): boolean {
    const entry = this.#entries.get(before);
    if (entry?.users !== 1 || this.#entries.has(after) || after.draws.some(isWide)) return false;
    if (after.kind === "buffers") {
      if (!this.#buffers.ownsBuffers) return false;
      const setVertices = vertexSetter(after, this.#buffers);
      for (const geometry of entry.geometries) setVertices(geometry);
    }
    this.#entries.delete(before);
    this.#entries.set(after, entry);
    return true;
  }

  release(stage: Stage): void {
    const entry = this.#entries.get(stage);
    if (entry === undefined) return;
    entry.users -= 1;
    if (entry.users > 0) return;
    for (const geometry of entry.geometries) {
      if (geometry instanceof InstancedBufferGeometry)
        geometry.dispose(); // it has no buffers of the stage
      else this.#buffers.dispose(geometry);
    }
    this.#entries.delete(stage);
  }
}

function geometriesOf(stage: Stage, buffers: BufferProvider): BufferGeometry[] {
  const geometryOf =
    stage.kind === "textures" || stage.draws.every(isWide) ? emptyGeometryOf : inBuffers(stage, buffers);
  return stage.draws.map((range) =>
    isWide(range) ? lateWideLines.required.geometryOf(stage, range, buffers) : geometryOf(range),
  );
}

function isWide({ isWide = false }: DrawRange): boolean {
  return isWide;
}

function inBuffers(stage: BufferStage, buffers: BufferProvider): (range: DrawRange) => BufferGeometry {
  const setVertices = vertexSetter(stage, buffers);
  return ({ first, count }) => {
    const geometry = new BufferGeometry();
    setVertices(geometry);
    geometry.setDrawRange(first, count);
    return geometry;
  };
}

/** The function that sets attributes and index of a geometry, which all geometries of the stage share. */
function vertexSetter(stage: BufferStage, buffers: BufferProvider): (geometry: BufferGeometry) => void {
  const attributes = vertexAttributesOf(stage).map(
    ({ name, vertices: { bytes, type, components, stride, offset }, isNormalized }) => ({
      name,
      attribute: new InterleavedBufferAttribute(
        buffers.recordsOf(bytes, type, stride),
        components,
        offset,
        isNormalized,
      ),
    }),
  );
  const index = stage.index && buffers.indexAttributeOf(stage.index.bytes, stage.index.type);
  return (geometry) => {
    for (const { name, attribute } of attributes) geometry.setAttribute(name, attribute);
    geometry.setIndex(index ?? null);
  };
}

/** A geometry without attributes: the shader finds vertices by gl_VertexID. */
function emptyGeometryOf({ primitive, count }: DrawRange): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setDrawRange(0, primitive === "triangleStrip" ? Math.max(0, count - 2) * 3 : count);
  return geometry;
}
