// The geometry of wide lines: an instance for each, which finds its two ends by
// their numbers in images, or as attributes. Buffers hold vertices once and lines in
// an index; an instance has no index, so of buffers the ends are laid out one after
// the other, which needs them here once.

import {
  BufferAttribute,
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

/** All of it is three.js' own, to be disposed of as such. Of images it has no attributes. */
export function wideLineGeometryOf(stage: Stage, range: DrawRange, buffers: BufferProvider): InstancedBufferGeometry {
  const geometry = outlineGeometry(lineCountOf(range));
  if (stage.kind === "textures") return geometry;
  const records = new LineRecords(stage);
  records.add(stage, range, buffers);
  records.setOn(geometry);
  return geometry;
}

/** So many lines, of which it does not say where they are. */
export function outlineGeometry(lineCount: number): InstancedBufferGeometry {
  const geometry = new InstancedBufferGeometry();
  geometry.setIndex(new BufferAttribute(Uint16Array.from(outlineTriangles), 1));
  geometry.instanceCount = lineCount;
  return geometry;
}

/** The same lines again and again, so many times. */
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

/** A record for each line, with both its ends. */
export class LineRecords {
  readonly #columns: readonly Column[];

  /** For lines of stages that are like this one in all that `layoutOf` says. */
  constructor(stage: BufferStage) {
    this.#columns = columnsOf(stage);
  }

  /** Appends the lines of a draw. */
  add(stage: BufferStage, range: DrawRange, buffers: BufferProvider): void {
    const ends = endsOf(stage, range, buffers);
    for (const column of this.#columns) appendVertices(column, stage, ends, buffers);
  }

  clear(): void {
    for (const { data } of this.#columns) data.clear();
  }

  /** Attributes are those of the line's begin; of its end they have End behind their names. Valid until there are more lines: they share memory. */
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

/** The numbers of the vertices at the begin and the end of each line. */
function endsOf(stage: BufferStage, range: DrawRange, buffers: BufferProvider): Uint32Array {
  const numbers = indicesOf(stage, [range], buffers);
  const step = lineStepOf(range);
  return Uint32Array.from(
    { length: 2 * lineCountOf(range) },
    (_, end) => numbers[Math.floor(end / 2) * step + (end % 2)] ?? 0,
  );
}

function repeated(numbers: ElementArray, times: number): ElementArray {
  const all = new (arrayTypeOf(elementTypeOf(numbers)))(times * numbers.length);
  for (let time = 0; time < times; ++time) all.set(numbers, time * numbers.length);
  return all;
}
