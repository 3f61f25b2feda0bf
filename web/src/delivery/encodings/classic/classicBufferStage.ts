// Builds stages of SIG classic without the GPU's texture units: workers decode each image to an array, and the stages
// read buffers. Coordinates may come from a live stream, which fills buffers of its own.

import type { CoordJob } from "../../../decode/classic/classicArrays.ts";
import type { GridArrays } from "../../../decode/classic/classicGrid.ts";
import { DecodeError } from "../../../decode/decodeError.ts";
import { drawnPrimitives } from "../../../decode/drawnPrimitives.ts";
import { checkImage } from "../../../decode/imageFile.ts";
import { dequantizationOf, maxStoredValueOf, missingBytesMidpoint } from "../../../document/dequantization.ts";
import type { GeometryDescription, PatchDescription } from "../../../document/description.ts";
import type { VertexRole } from "../../../stage/attributeRows.ts";
import type { BufferStage, DrawRange } from "../../../stage/stage.ts";
import type { IndexArray } from "../../../stage/vertexArray.ts";
import { ArrayUploads } from "../../arrayUploads.ts";
import type { Content, LiveVertices } from "../../content.ts";
import { DeformationCollector } from "../../deformationCollector.ts";
import { asDeliveryError } from "../../deliveryError.ts";
import type { PatchFile } from "../../patchFiles.ts";
import type { BuilderTools, StageBuilder } from "../../stageBuilder.ts";
import { drawRangesOf } from "../../stageBuilder.ts";
import { arraysStageOf } from "./arraysStage.ts";
import type { IndexedDraws } from "./availableArrays.ts";
import { AvailableArrays } from "./availableArrays.ts";
import { attributeDecoders } from "./classicAttributes.ts";
import { firstTexelOf, leadingPlanes } from "./classicFormat.ts";
import { drawnTriangles } from "./drawnTriangles.ts";
import type { ImageSize } from "./patchImages.ts";
import { planeCountOf, recordLayoutOf } from "./patchImages.ts";

/** `index` and `normal` only for grids. */
type CoordArrays = Pick<GridArrays, "coord"> & Partial<GridArrays>;

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
  readonly #uploads: ArrayUploads;
  readonly #collector: DeformationCollector;
  #available = new AvailableArrays();

  constructor(geometry: GeometryDescription, patch: PatchDescription, { runJob, storeBytes }: BuilderTools) {
    this.#geometry = geometry;
    this.#patch = patch;
    this.#run = runJob;
    this.#uploads = new ArrayUploads(storeBytes);
    this.#collector = new DeformationCollector(geometry);
  }

  async accept(file: PatchFile, content: Content, signal: AbortSignal): Promise<void> {
    if (content.kind === "live") {
      await this.#acceptStream(content.vertices, signal);
      return;
    }
    if (content.kind !== "bytes") throw new DecodeError("malformed", "is on the GPU already");
    const available = this.#available;
    const image = { bytes: content.bytes, firstTexel: firstTexelOf(file.reference) };
    const imageSize = checkImage(image.bytes);
    switch (file.role) {
      case "coord":
        available.coordPlanes[file.plane] = image;
        if (file.plane === 0) available.coordSize = imageSize;
        await Promise.all([this.#decodeCoords(available, signal), this.#decodeIndex(available, signal)]);
        return;
      case "index":
        available.waitingIndex = image;
        await this.#decodeIndex(available, signal);
        return;
      case "value":
        available.valuePlanes[file.plane] = image;
        await this.#decodeValues(available, imageSize, signal);
        return;
      case "deformation":
        available.deformationPlanes[file.plane] = image;
        await this.#decodeDeformation(available, file.plane, imageSize, signal);
        return;
      case "patch":
      case "base":
        return;
      default:
        (available.attributePlanes[file.role] ??= [])[file.plane] = image;
        await this.#decodeAttribute(available, file.role, imageSize, signal);
    }
  }

  get storedBytes(): number {
    return this.#uploads.byteLength + this.#collector.byteLength + (this.#available.streamed?.byteLength ?? 0);
  }

  drop(): void {
    // Arrays that are decoded from several planes cannot be dropped plane by plane.
  }

  clear(): void {
    const { indexedDraws, coord, attributes, slopeNormals, value } = this.#available;
    this.#uploads.retire(indexedDraws?.index, coord, ...Object.values(attributes), slopeNormals, value);
    this.#available = new AvailableArrays();
    this.#collector.clear();
  }

  sweep(): void {
    this.#uploads.sweep();
  }

  stage(): BufferStage | undefined {
    if (!this.#collector.isWhole) return undefined;
    return arraysStageOf(this.#geometry, this.#patch, this.#available, this.#collector.deformation);
  }

  /** The first frame of a live stream has arrived. */
  async #acceptStream(vertices: LiveVertices, signal: AbortSignal): Promise<void> {
    if (vertices.kind !== "arrays") throw new DecodeError("malformed", "is in images");
    const available = this.#available;
    const { grid } = this.#patch;
    const gridIndex = grid && (await this.#run("gridIndex", grid, signal));
    available.indexedDraws ??= await this.#drawsWithoutFile(available, gridIndex, signal);
    available.streamed = vertices;
    available.coordPlaneCount = this.#patch.coord.length;
    available.coordSize = vertices;
    await this.#decodeIndex(available, signal);
  }

  /** Decodes the coordinates' byte planes from the most significant on, as far as they are available. */
  async #decodeCoords(available: AvailableArrays, signal: AbortSignal): Promise<void> {
    const { coordSize } = available;
    const planes = leadingPlanes(available.coordPlanes);
    if (coordSize === undefined || planes.length <= available.coordPlaneCount) return;
    const planeCount = this.#patch.coord.length;
    const arrays = await this.#coordArraysOf(
      {
        planes,
        planeCount,
        missingBytesMidpoint: missingBytesMidpoint(this.#geometry, planeCount, planes.length),
        ...recordLayoutOf(this.#patch, coordSize, planes[0]?.firstTexel),
      },
      signal,
    );
    const indexedDraws = await this.#drawsWithoutFile(available, arrays.index, signal);
    const slopeNormals = arrays.normal && (await this.#uploads.storeVertices(arrays.normal, signal));
    const coord = await this.#uploads.storeVertices(arrays.coord, signal);
    // Jobs of fewer and of more planes may end in any order. Coordinates and the normals computed from them are
    // replaced together.
    if (available.indexedDraws === undefined) available.indexedDraws = indexedDraws;
    else this.#uploads.retire(indexedDraws?.index);
    if (planes.length <= available.coordPlaneCount) {
      this.#uploads.retire(coord, slopeNormals);
      return;
    }
    this.#uploads.retire(available.coord, available.slopeNormals);
    available.coord = coord;
    available.slopeNormals = slopeNormals;
    available.coordPlaneCount = planes.length;
    if (planes.length === planeCount) available.coordPlanes = [];
  }

  async #coordArraysOf(job: CoordJob, signal: AbortSignal): Promise<CoordArrays> {
    const { grid } = this.#patch;
    if (grid === undefined) return { coord: await this.#run("classicCoords", job, signal) };
    const gridJob = {
      ...job,
      grid,
      ccw: this.#geometry.ccw,
      maxStored: maxStoredValueOf(this.#geometry, this.#patch),
      step: dequantizationOf(this.#geometry, this.#patch).step,
    };
    return this.#run("classicGrid", gridJob, signal);
  }

  /** Decodes the byte planes of an attribute from the most significant on, as far as they are available. */
  async #decodeAttribute(
    available: AvailableArrays,
    role: VertexRole,
    imageSize: ImageSize,
    signal: AbortSignal,
  ): Promise<void> {
    const [first, ...others] = leadingPlanes(available.attributePlanes[role] ?? []);
    if (first === undefined) return;
    const planes = [first, ...others] as const;
    const planeCount = planeCountOf(this.#patch, role);
    const isDecoded = () => planes.length <= (available.attributePlaneCounts[role] ?? 0);
    if (isDecoded()) return;
    const images = { planes, planeCount, layout: recordLayoutOf(this.#patch, imageSize, first.firstTexel) };
    const vertices = await attributeDecoders[role](this.#run, images, this.#geometry, signal);
    const decoded = await this.#uploads.storeVertices(vertices, signal);
    // Jobs of fewer and of more planes may end in any order.
    if (isDecoded()) {
      this.#uploads.retire(decoded);
      return;
    }
    this.#uploads.retire(available.attributes[role]);
    available.attributes[role] = decoded;
    available.attributePlaneCounts[role] = planes.length;
    if (planes.length === planeCount) available.attributePlanes[role] = [];
  }

  /**
   * Decodes an attribute that moves vertices once all its planes are available. `plane`: the one that has arrived,
   * among those of all these attributes; `imageSize`: of its image.
   */
  async #decodeDeformation(
    { deformationPlanes }: AvailableArrays,
    plane: number,
    imageSize: ImageSize,
    signal: AbortSignal,
  ): Promise<void> {
    const { attributes = [] } = this.#geometry.deformation ?? {};
    let first = 0;
    for (const [n, { components, min, size, fileCount }] of attributes.entries()) {
      const isOfFile = plane >= first && plane < first + fileCount;
      const planes = deformationPlanes.slice(first, first + fileCount).flatMap((file) => file ?? []);
      first += fileCount;
      if (!isOfFile || planes.length < fileCount) continue;
      const layout = recordLayoutOf(this.#patch, imageSize, deformationPlanes[plane]?.firstTexel);
      const vertices = await this.#run("classicValues", { planes, components, min, size, ...layout }, signal);
      this.#collector.add(n, { vertices, min: [], step: [] }, layout.count);
    }
  }

  /** Decodes the values once all their planes are available. */
  async #decodeValues(available: AvailableArrays, imageSize: ImageSize, signal: AbortSignal): Promise<void> {
    const { value: attribute } = this.#geometry;
    const planes = available.valuePlanes.filter((plane) => plane !== undefined);
    if (attribute === undefined || planes.length < this.#patch.value.length) return;
    available.valuePlanes = [];
    const { components, min, size } = attribute;
    const values = await this.#run(
      "classicValues",
      { planes, components, min, size, ...recordLayoutOf(this.#patch, imageSize, planes[0]?.firstTexel) },
      signal,
    );
    available.value = await this.#uploads.storeVertices(values, signal);
  }

  /**
   * The draws of a patch without an index file: a grid, or records in their order. Undefined if there is an index file,
   * or if the draws have been found before.
   */
  async #drawsWithoutFile(
    available: AvailableArrays,
    gridIndex: IndexArray | undefined,
    signal: AbortSignal,
  ): Promise<IndexedDraws | undefined> {
    if (available.indexedDraws !== undefined || this.#patch.index !== undefined) return undefined;
    const { index, draws } = drawnPrimitives(gridIndex, drawRangesOf(this.#patch), this.#geometry.ccw);
    return { index: index && (await this.#uploads.storeIndex(index, signal)), draws };
  }

  /** Decodes the index once the first coordinate image is available, whose columns and rows it names. */
  async #decodeIndex(available: AvailableArrays, signal: AbortSignal): Promise<void> {
    const file = available.waitingIndex;
    const { coordSize } = available;
    if (file === undefined || coordSize === undefined) return;
    available.waitingIndex = undefined;
    const { index } = this.#patch;
    try {
      const drawn = await this.#run(
        "classicIndex",
        {
          file,
          rowLength: this.#patch.implicitWidth,
          draws: drawRangesOf(this.#patch),
          ccw: this.#geometry.ccw,
          isWide: this.#geometry.indexType === "Uint32",
          coordWidth: coordSize.width,
          coordHeight: coordSize.height,
          recordCount: recordLayoutOf(this.#patch, coordSize).count,
        },
        signal,
      );
      const indexedDraws = { index: await this.#uploads.storeIndex(drawn.index, signal), draws: drawn.draws };
      await this.#deriveNormals(available, drawn.index, drawn.draws);
      available.indexedDraws = indexedDraws;
    } catch (error) {
      if (signal.aborted) {
        available.waitingIndex = file; // the coordinates were aborted, not the index
        throw error;
      }
      // The file that arrived last may be the coordinates; the error is the index's.
      throw index ? asDeliveryError(error, index.url) : error;
    }
  }

  /** Makes the normals of a live surface, where it has none, follow from its triangles. */
  async #deriveNormals({ streamed }: AvailableArrays, index: IndexArray, draws: readonly DrawRange[]): Promise<void> {
    if (streamed === undefined || streamed.normal || this.#patch.normal) return;
    const triangles = drawnTriangles(index, draws);
    if (triangles) await streamed.deriveNormals(triangles);
  }
}
