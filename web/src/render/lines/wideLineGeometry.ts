// Makes the geometry of wide lines: one instance per line. In image stages the shader finds both ends
// by their index. In buffer stages both ends are attributes of the instance: the vertices are read
// back once and written out line by line, because instanced attributes cannot be indexed.

import {
  BufferAttribute,
  InstancedBufferAttribute,
  InstancedBufferGeometry,
  InstancedInterleavedBuffer,
  InterleavedBufferAttribute,
} from "three";
import type { ElementArray } from "../../stage/vertexArray.ts";
import { arrayTypeOf, elementTypeOf } from "../../stage/elementType.ts";
import type { BufferStage, DrawRange, Stage } from "../../stage/stage.ts";
import type { Column } from "../attributes/vertexColumns.ts";
import { appendVertices, columnsOf, indicesOf } from "../attributes/vertexColumns.ts";
import type { BufferProvider } from "../uploads/bufferProvider.ts";
import { outlineTriangles } from "../shaders/wideLineChunk.ts";
import { lineCountOf, lineStepOf } from "./wideLines.ts";

/** The caller disposes of the geometry; it shares no stage buffers. For image stages it has no attributes. */
export function wideLineGeometryOf(stage: Stage, range: DrawRange, buffers: BufferProvider): InstancedBufferGeometry {
  const geometry = outlineGeometry(lineCountOf(range));
  if (stage.kind === "textures") return geometry;
  const records = new LineRecords(stage);
  const ends = records.add(stage, range, buffers);
  records.setOn(geometry);
  // With the operator blur, shaders read vertices by their indices (stages/blurredVertices.ts).
  if (stage.coordImage !== undefined)
    geometry.setAttribute("vertexIndices", new InstancedBufferAttribute(Float32Array.from(ends), 2));
  return geometry;
}

/** The outline of a line in `lineCount` instances, without the attributes that say where the lines are. */
export function outlineGeometry(lineCount: number): InstancedBufferGeometry {
  const geometry = new InstancedBufferGeometry();
  geometry.setIndex(new BufferAttribute(Uint16Array.from(outlineTriangles), 1));
  geometry.instanceCount = lineCount;
  return geometry;
}

/** The same lines repeated `times` times. */
export function repeatedLines(lines: InstancedBufferGeometry, times: number): InstancedBufferGeometry {
  const geometry = outlineGeometry(times * lines.instanceCount);
  const copies = new Map<unknown, InstancedInterleavedBuffer>();
  for (const [name, attribute] of Object.entries(lines.attributes)) {
    if (!(attribute instanceof InterleavedBufferAttribute)) throw new RangeError(`${name} is not in records of lines`);
    const { data, itemSize, offset, normalized } = attribute;
    const copy =
      copies.get(data) ?? new InstancedInterleavedBuffer(repeated(data.array as ElementArray, times), data.stride);
    copies.set(data, copy);
    geometry.setAttribute(name, new InterleavedBufferAttribute(copy, itemSize, offset, normalized));
  }
  return geometry;
}

/** One record per line, with the attributes of both ends. */
export class LineRecords {
  readonly #columns: readonly Column[];

  /** `stage`: any of the stages that will be added, which all have the same `layoutOf` key. */
  constructor(stage: BufferStage) {
    this.#columns = columnsOf(stage);
  }

  /** Appends the lines of one draw. Returns the vertex indices of their begins and ends, alternately. */
  add(stage: BufferStage, range: DrawRange, buffers: BufferProvider): Uint32Array {
    const ends = endsOf(stage, range, buffers);
    for (const column of this.#columns) appendVertices(column, stage, ends, buffers);
    return ends;
  }

  clear(): void {
    for (const { data } of this.#columns) data.clear();
  }

  /**
   * Attributes of the line's begin have their usual names; those of its end have the suffix `End`. They share memory
   * with the records, and are valid until the next `add`.
   */
  setOn(geometry: InstancedBufferGeometry): void {
    for (const { name, components, isNormalized, elementsPerVertex, data } of this.#columns) {
      const records = new InstancedInterleavedBuffer(data.used, 2 * elementsPerVertex);
      geometry.setAttribute(name, new InterleavedBufferAttribute(records, components, 0, isNormalized));
      geometry.setAttribute(
        `${name}End`,
        new InterleavedBufferAttribute(records, components, elementsPerVertex, isNormalized),
      );
    }
  }
}

/** The vertex indices of the begin and the end of each line, alternately. */
function endsOf(stage: BufferStage, range: DrawRange, buffers: BufferProvider): Uint32Array {
  const indices = indicesOf(stage, [range], buffers);
  const step = lineStepOf(range);
  return Uint32Array.from(
    { length: 2 * lineCountOf(range) },
    (_, end) => indices[Math.floor(end / 2) * step + (end % 2)] ?? 0,
  );
}

function repeated(numbers: ElementArray, times: number): ElementArray {
  const all = new (arrayTypeOf(elementTypeOf(numbers)))(times * numbers.length);
  for (let time = 0; time < times; ++time) all.set(numbers, time * numbers.length);
  return all;
}
