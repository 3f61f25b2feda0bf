// Classic SIG on the CPU: files become arrays in workers, one job for each that
// comes. The stages are those of buffers.

import type { ImageFile, RecordLayout } from "../decode/classicArrays.ts";
import { DecodeError } from "../decode/decodeError.ts";
import type { RunJob } from "../decode/jobs.ts";
import type { PngHeader } from "../decode/png.ts";
import { checkPng } from "../decode/png.ts";
import type { BufferStage, DrawRange, IndexArray, VertexArray } from "../decode/stage.ts";
import { withoutStrips } from "../decode/strips.ts";
import type { GeometryDescription, PatchDescription } from "../document/description.ts";
import { largestStoredOf, middleOfMissing, storedFrameOf } from "../document/storedFrame.ts";
import { asDeliveryError } from "./deliveryError.ts";
import type { StageBuilder } from "./stageBuilder.ts";
import { drawRangesOf, normalCodeOf, stageNameOf } from "./stageBuilder.ts";

interface Drawn {
  readonly index: IndexArray | undefined;
  readonly draws: readonly DrawRange[];
}

export function sigCpuBuilder(geometry: GeometryDescription, patch: PatchDescription, run: RunJob, signal: AbortSignal): StageBuilder {
  return new SigCpuBuilder(geometry, patch, run, signal);
}

class SigCpuBuilder implements StageBuilder {
  readonly #geometry: GeometryDescription;
  readonly #patch: PatchDescription;
  readonly #run: RunJob;
  readonly #signal: AbortSignal;
  /** Packed, until all are here. */
  #planes: (ImageFile | undefined)[] = [];
  #waitingIndex: ImageFile | undefined;
  #coordHeader: PngHeader | undefined;
  #coord: VertexArray | undefined;
  #coordPlanes = 0;
  #drawn: Drawn | undefined;
  #normal: VertexArray | undefined;
  /** Of a grid that has no other normals. */
  #slope: VertexArray | undefined;
  #color: VertexArray | undefined;

  constructor(geometry: GeometryDescription, patch: PatchDescription, run: RunJob, signal: AbortSignal) {
    this.#geometry = geometry;
    this.#patch = patch;
    this.#run = run;
    this.#signal = signal;
  }

  async accept(part: Parameters<StageBuilder["accept"]>[0], content: Parameters<StageBuilder["accept"]>[1]): Promise<void> {
    if (content.kind !== "bytes") throw new DecodeError("malformed", "is on the GPU already");
    const file = { png: content.bytes, first: part.reference.first };
    const header = checkPng(file.png);
    switch (part.role) {
      case "coord":
        this.#planes[part.plane] = file;
        if (part.plane === 0) this.#coordHeader = header;
        await Promise.all([this.#decodeCoords(), this.#decodeIndex()]);
        return;
      case "index":
        this.#waitingIndex = file;
        await this.#decodeIndex();
        return;
      case "normal":
        this.#normal = await this.#run("classicNormals", { file, code: normalCodeOf(this.#geometry), ...this.#layout(header) }, this.#signal);
        return;
      case "color":
        this.#color = await this.#run("classicColors",
          { file, components: this.#geometry.colorComponents, ...this.#layout(header) }, this.#signal);
    }
  }

  stage(): BufferStage | undefined {
    const coord = this.#coord;
    if (coord === undefined) return undefined;
    const normal = this.#normal ?? this.#slope;
    const normalCode = this.#normal ? normalCodeOf(this.#geometry) : { kind: "vector" } as const;
    const color = this.#color;
    const name = stageNameOf(this.#patch, {
      index: this.#drawn, normal: this.#normal, color, coord: Array.from({ length: this.#coordPlanes }),
    });
    const points = { index: undefined, draws: [{ primitive: "points", first: 0, count: coord.array.length / coord.stride } as const] };
    if (this.#patch.index === undefined && this.#patch.grid === undefined) this.#drawn ??= withoutStrips(undefined, drawRangesOf(this.#patch));
    const { index, draws } = (name === "points" ? undefined : this.#drawn) ?? points;
    return { kind: "buffers", name, index, draws, coord, normal, normalCode, color };
  }

  /** A plane is of use only when all above it are here. */
  async #decodeCoords(): Promise<void> {
    const header = this.#coordHeader;
    const missing = Array.from({ length: this.#patch.coord.length }, (_, plane) => this.#planes[plane]).indexOf(undefined);
    const planes = this.#planes.slice(0, missing < 0 ? undefined : missing).filter((plane) => plane !== undefined);
    if (header === undefined || planes.length <= this.#coordPlanes) return;
    const planeCount = this.#patch.coord.length;
    const job = {
      planes, planeCount, middleOfMissing: middleOfMissing(this.#geometry, planeCount, planes.length), ...this.#layout(header, planes[0]),
    };
    const grid = this.#patch.grid;
    const arrays = grid === undefined ? { coord: await this.#run("classicCoords", job, this.#signal) }
      : await this.#run("classicGrid", {
          ...job, grid, largestStored: largestStoredOf(this.#geometry, this.#patch), step: storedFrameOf(this.#geometry, this.#patch).step,
        }, this.#signal);
    if (planes.length <= this.#coordPlanes) return; // a later one was faster
    this.#coord = arrays.coord;
    this.#coordPlanes = planes.length;
    if ("index" in arrays) {
      this.#drawn = { index: arrays.index, draws: drawRangesOf(this.#patch) };
      this.#slope = arrays.normal;
    }
    if (planes.length === planeCount) this.#planes = [];
  }

  /** The size of a coordinate image says what the index's columns and rows are. */
  async #decodeIndex(): Promise<void> {
    const file = this.#waitingIndex;
    const header = this.#coordHeader;
    if (file === undefined || header === undefined) return;
    this.#waitingIndex = undefined;
    const { index } = this.#patch;
    try {
      this.#drawn = await this.#run("classicIndex", {
        file, rowLength: this.#patch.implicitWidth, draws: drawRangesOf(this.#patch),
        isWide: this.#geometry.indexType === "Uint32",
        coordWidth: header.width, coordHeight: header.height, recordCount: this.#layout(header).count,
      }, this.#signal);
    } catch (error) {
      // It may be the coordinates' coming that has led here.
      throw index ? asDeliveryError(error, index.url) : error;
    }
  }

  #layout({ width, height }: PngHeader, { first }: { first: number } = { first: 0 }): RecordLayout {
    const { index, grid, vertexCount, implicitWidth, draws } = this.#patch;
    if (grid !== undefined) return { count: vertexCount, rowLength: implicitWidth };
    if (index === undefined) return { count: draws.reduce((sum, draw) => sum + draw.count, 0), rowLength: implicitWidth };
    return { count: vertexCount || width * height - first, rowLength: 0 };
  }
}
