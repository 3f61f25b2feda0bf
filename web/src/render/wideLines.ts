// A stage whose lines are wide, and the geometry of such a draw: an instance for
// each line, which finds its two ends by their numbers in images, or as attributes.
// Buffers hold vertices once and lines in an index; an instance has no index, so of
// buffers the ends are laid out one after the other, which needs them here once.

import { BufferAttribute, InstancedBufferGeometry, InstancedInterleavedBuffer, InterleavedBufferAttribute } from "three";
import type { ElementArray } from "../decode/arrays.ts";
import { arrayTypeOf, byteSizeOf } from "../decode/elements.ts";
import type { BufferStage, DrawRange, Stage } from "../decode/stage.ts";
import { indicesOf } from "./batches/meshColumns.ts";
import type { Buffers } from "./buffers.ts";
import type { StoredAttribute } from "./storedAttributes.ts";
import { storedAttributesOf } from "./storedAttributes.ts";
import { outlineTriangles } from "./wideLineChunk.ts";

const bytesPerWord = 4;

/** By the stage that they are made of, so that all its shapes share what they draw. */
const made = new WeakMap<Stage, Stage>();

/** The same stage where it has no lines. */
export function withWideLines(stage: Stage): Stage {
  if (!stage.draws.some(isLine)) return stage;
  const known = made.get(stage) ?? { ...stage, draws: stage.draws.map((draw) => (isLine(draw) ? { ...draw, isWide: true } : draw)) };
  made.set(stage, known);
  return known;
}

export function isLine({ primitive }: Pick<DrawRange, "primitive">): boolean {
  return primitive === "lines" || primitive === "lineStrip";
}

/** How many vertices on the next line begins. */
export function lineStepOf({ primitive }: Pick<DrawRange, "primitive">): 1 | 2 {
  return primitive === "lineStrip" ? 1 : 2;
}

/** All of it is three.js' own, to be disposed of as such. */
export function wideLineGeometryOf(stage: Stage, range: DrawRange, buffers: Buffers): InstancedBufferGeometry {
  const lineCount = Math.max(0, Math.floor((range.count - 2) / lineStepOf(range)) + 1);
  const geometry = new InstancedBufferGeometry();
  geometry.instanceCount = lineCount;
  geometry.setIndex(new BufferAttribute(Uint16Array.from(outlineTriangles), 1));
  if (stage.kind === "textures") return geometry;
  const ends = endsOf(stage, range, lineCount, buffers);
  for (const attribute of storedAttributesOf(stage)) setEnds(geometry, attribute, ends, buffers);
  return geometry;
}

/** The numbers of the vertices at the begin and the end of each line. */
function endsOf(stage: BufferStage, range: DrawRange, lineCount: number, buffers: Buffers): Uint32Array {
  const numbers = indicesOf(stage, [range], buffers);
  const step = lineStepOf(range);
  return Uint32Array.from({ length: 2 * lineCount }, (_, end) => numbers[Math.floor(end / 2) * step + end % 2] ?? 0);
}

/** Its values at the begins of lines are the attribute, those at the ends another whose name has End behind. */
function setEnds(geometry: InstancedBufferGeometry, { name, vertices, isSpread }: StoredAttribute, ends: Uint32Array, buffers: Buffers): void {
  const { bytes, type, components, stride, offset } = vertices;
  const from = buffers.read(bytes, type, 0);
  const perWord = bytesPerWord / byteSizeOf(type);
  const perEnd = Math.ceil(components / perWord) * perWord;
  const to: ElementArray = new (arrayTypeOf(type))(ends.length * perEnd);
  ends.forEach((vertex, end) => {
    for (let c = 0; c < components; ++c) to[end * perEnd + c] = from[vertex * stride + offset + c] ?? 0;
  });
  const records = new InstancedInterleavedBuffer(to, 2 * perEnd);
  geometry.setAttribute(name, new InterleavedBufferAttribute(records, components, 0, isSpread));
  geometry.setAttribute(`${name}End`, new InterleavedBufferAttribute(records, components, perEnd, isSpread));
}
