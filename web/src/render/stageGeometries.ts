// The three.js geometries of a stage, one per draw, shared by everything that
// shows the stage and freed with the last of it.

import type { TypedArray } from "three";
import { BufferAttribute, BufferGeometry, InterleavedBuffer, InterleavedBufferAttribute } from "three";
import type { BufferStage, DrawRange, Stage, VertexArray } from "../decode/stage.ts";
import { isPairCode } from "../decode/stage.ts";

interface Entry {
  readonly geometries: readonly BufferGeometry[];
  users: number;
}

export class GeometryPool {
  readonly #entries = new Map<Stage, Entry>();

  /** One for each draw, in order. */
  acquire(stage: Stage): readonly BufferGeometry[] {
    const entry = this.#entries.get(stage) ?? { geometries: geometriesOf(stage), users: 0 };
    entry.users += 1;
    this.#entries.set(stage, entry);
    return entry.geometries;
  }

  release(stage: Stage): void {
    const entry = this.#entries.get(stage);
    if (entry === undefined) return;
    entry.users -= 1;
    if (entry.users > 0) return;
    for (const geometry of entry.geometries) geometry.dispose();
    this.#entries.delete(stage);
  }
}

function geometriesOf(stage: Stage): BufferGeometry[] {
  if (stage.kind === "textures") return stage.draws.map(emptyGeometryOf);
  const attributes = attributesOf(stage);
  const indices = stage.index && new BufferAttribute(stage.index, 1);
  return stage.draws.map(({ first, count }) => {
    const geometry = new BufferGeometry();
    for (const [name, attribute] of Object.entries(attributes)) geometry.setAttribute(name, attribute);
    geometry.setIndex(indices ?? null);
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

/** Attributes of one type in the records of one file share its buffer. */
function attributesOf({ coord, normal, normalCode, color }: BufferStage): Readonly<Record<string, InterleavedBufferAttribute>> {
  const buffers: InterleavedBuffer[] = [];
  const bufferOf = ({ array, stride }: VertexArray): InterleavedBuffer => {
    const shared = buffers.find((other) => other.stride === stride && isSameView(other.array, array));
    if (shared !== undefined) return shared;
    const buffer = new InterleavedBuffer(array, stride);
    buffers.push(buffer);
    return buffer;
  };
  const attributeOf = (vertices: VertexArray, isSpread: boolean) => new InterleavedBufferAttribute(
    bufferOf(vertices), vertices.components, vertices.offset, isSpread && !(vertices.array instanceof Float32Array));
  return {
    position: attributeOf(coord, false),
    ...(normal && { normal: attributeOf(normal, !isPairCode(normalCode)) }),
    ...(color && { color: attributeOf(color, true) }),
  };
}

function isSameView(a: TypedArray, b: TypedArray): boolean {
  return a.constructor === b.constructor && a.buffer === b.buffer && a.byteOffset === b.byteOffset && a.length === b.length;
}
