// Classic SIG on the CPU: files become arrays in workers, one job for each that
// comes. The stages are those of buffers.

import type { IndexArray } from "../../../stage/vertexArray.ts";
import type { ImageFile, RecordLayout } from "../../../decode/classic/classicArrays.ts";
import type { GridArrays } from "../../../decode/classic/classicGrid.ts";
import { DecodeError } from "../../../decode/decodeError.ts";
import { byteSizeOf } from "../../../stage/elementType.ts";
import type { PngHeader } from "../../../decode/png.ts";
import { checkPng } from "../../../decode/png.ts";
import type { BufferStage, DrawRange, StoredIndex, StoredVertices } from "../../../stage/stage.ts";
import { withoutStrips } from "../../../decode/strips.ts";
import type { GeometryDescription, PatchDescription } from "../../../document/description.ts";
import { maxStoredValueOf, missingBytesMidpoint, dequantizationOf } from "../../../document/dequantization.ts";
import { asDeliveryError } from "../../deliveryError.ts";
import { ArrayUploads } from "../../arrayUploads.ts";
import type { PatchFile } from "../../patchFiles.ts";
import { cornerCountOf } from "../../patchFiles.ts";
import { firstTexelOf, normalCodeOf } from "./classicFormat.ts";
import type { Content } from "../../resourcePool.ts";
import type { BuilderTools, StageBuilder } from "../../stageBuilder.ts";
import { attainedStageName, drawRangesOf } from "../../stageBuilder.ts";

interface Drawn {
  readonly index: StoredIndex | undefined;
  readonly draws: readonly DrawRange[];
}

/** Only grids have the others. */
type CoordArrays = Pick<GridArrays, "coord"> & Partial<GridArrays>;

/** What has come of a patch. */
class Parts {
  /** Packed, until all are here. */
  planes: (ImageFile | undefined)[] = [];
  waitingIndex: ImageFile | undefined;
  coordHeader: PngHeader | undefined;
  coord: StoredVertices | undefined;
  coordPlanes = 0;
  drawn: Drawn | undefined;
  normal: StoredVertices | undefined;
  /** Of a grid that has no other normals. */
  slope: StoredVertices | undefined;
  texCoord: StoredVertices | undefined;
  color: StoredVertices | undefined;
  /** Packed, until all are here. */
  valuePlanes: (ImageFile | undefined)[] = [];
  value: StoredVertices | undefined;
}

export function bufferStageBuilder(
  geometry: GeometryDescription,
  patch: PatchDescription,
  tools: BuilderTools,
): StageBuilder {
  return new BufferStageBuilder(geometry, patch, tools);
}

class BufferStageBuilder implements StageBuilder {
  readonly isDivisible = false;
  readonly #geometry: GeometryDescription;
  readonly #patch: PatchDescription;
  readonly #run: BuilderTools["runJob"];
  readonly #holdings: ArrayUploads;
  #here = new Parts();

  constructor(geometry: GeometryDescription, patch: PatchDescription, { runJob, storeBytes }: BuilderTools) {
    this.#geometry = geometry;
    this.#patch = patch;
    this.#run = runJob;
    this.#holdings = new ArrayUploads(storeBytes);
  }

  async accept(part: PatchFile, content: Content, signal: AbortSignal): Promise<void> {
    if (content.kind !== "bytes") throw new DecodeError("malformed", "is on the GPU already");
    const here = this.#here;
    const file = { png: content.bytes, firstTexel: firstTexelOf(part.reference) };
    const header = checkPng(file.png);
    switch (part.role) {
      case "coord":
        here.planes[part.plane] = file;
        if (part.plane === 0) here.coordHeader = header;
        await Promise.all([this.#decodeCoords(here, signal), this.#decodeIndex(here, signal)]);
        return;
      case "index":
        here.waitingIndex = file;
        await this.#decodeIndex(here, signal);
        return;
      case "normal": {
        const normals = await this.#run(
          "classicNormals",
          { file, code: normalCodeOf(this.#geometry), ...this.#layout(header) },
          signal,
        );
        here.normal = await this.#holdings.storeVertices(normals, signal);
        return;
      }
      case "texCoord": {
        const texCoords = await this.#run("classicTexCoords", { file, ...this.#layout(header) }, signal);
        here.texCoord = await this.#holdings.storeVertices(texCoords, signal);
        return;
      }
      case "color": {
        const colors = await this.#run(
          "classicColors",
          { file, components: this.#geometry.colorComponents, ...this.#layout(header) },
          signal,
        );
        here.color = await this.#holdings.storeVertices(colors, signal);
        return;
      }
      case "value":
        here.valuePlanes[part.plane] = file;
        await this.#decodeValues(here, header, signal);
    }
  }

  get storedBytes(): number {
    return this.#holdings.byteLength;
  }

  drop(): void {
    // What is decoded of several planes together cannot be given up one by one.
  }

  clear(): void {
    const { drawn, coord, normal, slope, texCoord, color, value } = this.#here;
    this.#holdings.retire(drawn?.index, coord, normal, slope, texCoord, color, value);
    this.#here = new Parts();
  }

  sweep(): void {
    this.#holdings.sweep();
  }

  stage(): BufferStage | undefined {
    const here = this.#here;
    const { coord, texCoord, color, value } = here;
    if (coord === undefined) return undefined;
    const normal = here.normal ?? here.slope;
    const normalCode = here.normal ? normalCodeOf(this.#geometry) : ({ kind: "vector" } as const);
    const name = attainedStageName(this.#patch, {
      index: here.drawn,
      normal: here.normal,
      color,
      coord: Array.from({ length: here.coordPlanes }),
      value: value ? this.#patch.value : [],
    });
    const count = coord.bytes.byteLength / byteSizeOf(coord.type) / coord.stride;
    const points = { index: undefined, draws: [{ primitive: "points", first: 0, count } as const] };
    const { index, draws } = (name === "points" ? undefined : here.drawn) ?? points;
    return {
      kind: "buffers",
      vertexCount: count,
      name,
      index,
      draws,
      coord,
      normal,
      normalCode,
      color,
      texCoord,
      value: value && { ...value, maxStored: undefined },
    };
  }

  /** A plane is of use only when all above it are here. */
  async #decodeCoords(here: Parts, signal: AbortSignal): Promise<void> {
    const header = here.coordHeader;
    const missing = Array.from({ length: this.#patch.coord.length }, (_, plane) => here.planes[plane]).indexOf(
      undefined,
    );
    const planes = here.planes.slice(0, missing < 0 ? undefined : missing).filter((plane) => plane !== undefined);
    if (header === undefined || planes.length <= here.coordPlanes) return;
    const planeCount = this.#patch.coord.length;
    const job = {
      planes,
      planeCount,
      missingBytesMidpoint: missingBytesMidpoint(this.#geometry, planeCount, planes.length),
      ...this.#layout(header, planes[0]),
    };
    const grid = this.#patch.grid;
    const arrays: CoordArrays =
      grid === undefined
        ? { coord: await this.#run("classicCoords", job, signal) }
        : await this.#run(
            "classicGrid",
            {
              ...job,
              grid,
              maxStored: maxStoredValueOf(this.#geometry, this.#patch),
              step: dequantizationOf(this.#geometry, this.#patch).step,
            },
            signal,
          );
    const drawn = await this.#drawnWithoutFile(here, arrays.index, signal);
    const slope = arrays.normal && (await this.#holdings.storeVertices(arrays.normal, signal));
    const coord = await this.#holdings.storeVertices(arrays.coord, signal);
    // Jobs of fewer and of more planes may end in any order. What was stored
    // meanwhile is taken all at once, so that slopes are those of the positions.
    if (here.drawn === undefined) here.drawn = drawn;
    else this.#holdings.retire(drawn?.index);
    if (planes.length <= here.coordPlanes) {
      this.#holdings.retire(coord, slope);
      return;
    }
    this.#holdings.retire(here.coord, here.slope);
    here.coord = coord;
    here.slope = slope;
    here.coordPlanes = planes.length;
    if (planes.length === planeCount) here.planes = [];
  }

  /** When all planes are here. */
  async #decodeValues(here: Parts, header: PngHeader, signal: AbortSignal): Promise<void> {
    const { value: attribute } = this.#geometry;
    const planes = here.valuePlanes.filter((plane) => plane !== undefined);
    if (attribute === undefined || planes.length < this.#patch.value.length) return;
    here.valuePlanes = [];
    const { components, min, size } = attribute;
    const values = await this.#run(
      "classicValues",
      { planes, components, min, size, ...this.#layout(header, planes[0]) },
      signal,
    );
    here.value = await this.#holdings.storeVertices(values, signal);
  }

  /** What is drawn where no file says it: a grid, or records in their order. Undefined where one does, or it is known. */
  async #drawnWithoutFile(
    here: Parts,
    gridIndex: IndexArray | undefined,
    signal: AbortSignal,
  ): Promise<Drawn | undefined> {
    if (here.drawn !== undefined || this.#patch.index !== undefined) return undefined;
    const { index, draws } = gridIndex
      ? { index: gridIndex, draws: drawRangesOf(this.#patch) }
      : withoutStrips(undefined, drawRangesOf(this.#patch));
    return { index: index && (await this.#holdings.storeIndex(index, signal)), draws };
  }

  /** The size of a coordinate image says what the index's columns and rows are. */
  async #decodeIndex(here: Parts, signal: AbortSignal): Promise<void> {
    const file = here.waitingIndex;
    const header = here.coordHeader;
    if (file === undefined || header === undefined) return;
    here.waitingIndex = undefined;
    const { index } = this.#patch;
    try {
      const drawn = await this.#run(
        "classicIndex",
        {
          file,
          rowLength: this.#patch.implicitWidth,
          draws: drawRangesOf(this.#patch),
          isWide: this.#geometry.indexType === "Uint32",
          coordWidth: header.width,
          coordHeight: header.height,
          recordCount: this.#layout(header).count,
        },
        signal,
      );
      here.drawn = { index: await this.#holdings.storeIndex(drawn.index, signal), draws: drawn.draws };
    } catch (error) {
      if (signal.aborted) {
        here.waitingIndex = file; // the coordinates were given up, not the index
        throw error;
      }
      // It may be the coordinates' coming that has led here.
      throw index ? asDeliveryError(error, index.url) : error;
    }
  }

  #layout({ width, height }: PngHeader, { firstTexel }: { firstTexel: number } = { firstTexel: 0 }): RecordLayout {
    const { index, grid, vertexCount, implicitWidth } = this.#patch;
    if (grid !== undefined) return { count: vertexCount, rowLength: implicitWidth };
    if (index === undefined) return { count: cornerCountOf(this.#patch), rowLength: implicitWidth };
    return { count: vertexCount || width * height - firstTexel, rowLength: 0 };
  }
}
