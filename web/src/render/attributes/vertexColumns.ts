// Copies vertex attributes of small meshes into one array (column) per attribute of a merged mesh.
// Columns are tightly packed, whatever the stride of the source; each vertex is padded to words of
// four bytes, as GPUs prefer.

import { InterleavedBuffer, InterleavedBufferAttribute } from "three";
import type { ElementArray } from "../../stage/vertexArray.ts";
import { arrayTypeOf, byteSizeOf } from "../../stage/elementType.ts";
import type { BufferStage, DrawRange } from "../../stage/stage.ts";
import type { BufferProvider } from "../uploads/bufferProvider.ts";
import { vertexAttributesOf } from "./vertexAttributes.ts";
import { GrowingArray } from "./growingArray.ts";

const bytesPerWord = 4;

export interface Column {
  /** three.js' name of the attribute. */
  readonly name: string;
  readonly components: number;
  readonly isNormalized: boolean;
  readonly elementsPerVertex: number;
  readonly data: GrowingArray<ElementArray>;
}

/** A key that is equal for stages whose vertices fit into the same columns. */
export function layoutOf(stage: BufferStage): string {
  return vertexAttributesOf(stage)
    .map(({ name, vertices: { type, components }, isNormalized }) => `${name} ${type} ${components} ${isNormalized}`)
    .join();
}

export function columnsOf(stage: BufferStage): Column[] {
  return vertexAttributesOf(stage).map(({ name, vertices: { type, components }, isNormalized }) => {
    const elementsPerWord = bytesPerWord / byteSizeOf(type);
    const elementsPerVertex = Math.ceil(components / elementsPerWord) * elementsPerWord;
    return {
      name,
      components,
      isNormalized,
      elementsPerVertex,
      data: new GrowingArray<ElementArray>(arrayTypeOf(type)),
    };
  });
}

/** Appends vertices of the stage to one column: the first `vertices` of them, or those with the given indices. */
export function appendVertices(
  { name, components, elementsPerVertex, data }: Column,
  stage: BufferStage,
  vertices: number | Uint32Array,
  buffers: BufferProvider,
): void {
  const attribute = vertexAttributesOf(stage).find((candidate) => candidate.name === name);
  if (attribute === undefined) throw new RangeError(`the stage has no ${name}`);
  const { bytes, type, stride, offset } = attribute.vertices;
  const from = buffers.read(bytes, type, 0);
  const areFirst = typeof vertices === "number";
  const count = areFirst ? vertices : vertices.length;
  const to = data.extend(count * elementsPerVertex);
  if (areFirst && stride === elementsPerVertex && offset === 0) {
    to.set(from.subarray(0, to.length));
    return;
  }
  for (let n = 0; n < count; ++n) {
    const first = (areFirst ? n : (vertices[n] ?? 0)) * stride + offset;
    for (let c = 0; c < components; ++c) to[n * elementsPerVertex + c] = from[first + c] ?? 0;
  }
}

/** The vertex indices of some draws of a stage, one draw after the other. */
export function indicesOf(
  { index }: BufferStage,
  ranges: readonly DrawRange[],
  buffers: BufferProvider,
): ArrayLike<number> {
  const all = index && buffers.read(index.bytes, index.type, 0);
  const of = ({ first, count }: DrawRange) =>
    all ? Array.from(all.subarray(first, first + count)) : Array.from({ length: count }, (_, i) => first + i);
  const [only, ...others] = ranges;
  if (all && only && others.length === 0) return all.subarray(only.first, only.first + only.count);
  return ranges.flatMap(of);
}

/** A three.js attribute that shares the column's memory. */
export function attributeOf({ components, isNormalized, elementsPerVertex, data }: Column): InterleavedBufferAttribute {
  return new InterleavedBufferAttribute(
    new InterleavedBuffer(data.used, elementsPerVertex),
    components,
    0,
    isNormalized,
  );
}
