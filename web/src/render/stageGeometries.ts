// The three.js geometries of a stage, one per draw, shared by everything that
// shows the stage and freed with the last of it.

import { BufferGeometry, InterleavedBufferAttribute } from "three";
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
  const attributes = attributesOf(stage, buffers);
  const index = stage.index && buffers.indexOf(stage.index.bytes, stage.index.type);
  return stage.draws.map(({ first, count }) => {
    const geometry = new BufferGeometry();
    for (const [name, attribute] of Object.entries(attributes)) geometry.setAttribute(name, attribute);
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

function attributesOf({ coord, normal, normalCode, color, texCoord, value }: BufferStage, buffers: Buffers): Readonly<Record<string, InterleavedBufferAttribute>> {
  const attributeOf = ({ bytes, type, components, stride, offset }: StoredVertices, isSpread: boolean) =>
    new InterleavedBufferAttribute(buffers.recordsOf(bytes, type, stride), components, offset, isSpread && type !== "Float32");
  return {
    position: attributeOf(coord, false),
    ...(normal && { normal: attributeOf(normal, !isPairCode(normalCode)) }),
    ...(color && { color: attributeOf(color, true) }),
    ...(value && { vertexValue: attributeOf(value, false) }),
    ...(texCoord && { uv: attributeOf(texCoord, true) }),
  };
}
