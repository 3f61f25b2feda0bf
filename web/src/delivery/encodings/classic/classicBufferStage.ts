// Stages of SIG classic without the GPU's texture units: workers decode each image to an array, and the stages read
// buffers. Coordinates may come from a live stream, which fills buffers of its own.

import type { VertexRole } from "../../../stage/attributeRows.ts";
import { vertexRoles, withTexCoordRoles } from "../../../stage/attributeRows.ts";
import type { IndexArray, VertexArray } from "../../../stage/vertexArray.ts";
import type { ImageFile, RecordLayout } from "../../../decode/classic/classicArrays.ts";
import type { GridArrays } from "../../../decode/classic/classicGrid.ts";
import { DecodeError } from "../../../decode/decodeError.ts";
import { byteSizeOf } from "../../../stage/elementType.ts";
import type { ImageHeader } from "../../../decode/imageFile.ts";
import { checkImage } from "../../../decode/imageFile.ts";
import type { BufferStage, DrawRange, GpuIndex, GpuVertices } from "../../../stage/stage.ts";
import { drawnPrimitives } from "../../../decode/drawnPrimitives.ts";
import type { GeometryDescription, PatchDescription } from "../../../document/description.ts";
import { maxStoredValueOf, missingBytesMidpoint, dequantizationOf } from "../../../document/dequantization.ts";
import { asDeliveryError } from "../../deliveryError.ts";
import { ArrayUploads } from "../../arrayUploads.ts";
import type { PatchFile } from "../../patchFiles.ts";
import { cornerCountOf } from "../../../document/patchSizes.ts";
import { firstTexelOf, leadingPlanes, normalFormatOf } from "./classicFormat.ts";
import type { Content, LiveArrays, LiveVertices } from "../../content.ts";
import { DeformationCollector } from "../../deformationCollector.ts";
import type { BuilderTools, StageBuilder } from "../../stageBuilder.ts";
import { attainedStageName, drawRangesOf } from "../../stageBuilder.ts";

/** The available byte planes of an attribute, of `planeCount`. */
interface AttributeImages {
  readonly planes: readonly [ImageFile, ...ImageFile[]];
  readonly planeCount: number;
  readonly layout: RecordLayout;
}

/** Decodes an attribute in a worker. */
type AttributeDecoder = (
  run: BuilderTools["runJob"],
  images: AttributeImages,
  geometry: GeometryDescription,
  signal: AbortSignal,
) => Promise<VertexArray>;

const attributeDecoders: Readonly<Record<VertexRole, AttributeDecoder>> = {
  normal: (run, { planes, planeCount, layout }, geometry, signal) =>
    planeCount > 1
      ? run("classicWords", { planes, components: 3, isSigned: true, ...layout }, signal)
      : run("classicNormals", { file: planes[0], format: normalFormatOf(geometry), ...layout }, signal),
  ...withTexCoordRoles(
    (): AttributeDecoder =>
      (run, { planes, layout }, { texCoordImageBits }, signal) =>
        run("classicTexCoords", { planes, firstBits: texCoordImageBits, ...layout }, signal),
  ),
  color: (run, { planes, planeCount, layout }, { colorComponents: components }, signal) =>
    planeCount > 1
      ? run("classicWords", { planes, components, isSigned: false, ...layout }, signal)
      : run("classicColors", { file: planes[0], components, ...layout }, signal),
};

interface IndexedDraws {
  readonly index: GpuIndex | undefined;
  readonly draws: readonly DrawRange[];
}

/** `index` and `normal` only for grids. */
type CoordArrays = Pick<GridArrays, "coord"> & Partial<GridArrays>;

/** The decoded arrays of a patch, and images that wait for others. */
class AvailableArrays {
  /** Undecoded images of the coordinates, until all byte planes are available. */
  coordPlanes: (ImageFile | undefined)[] = [];
  /** The undecoded index image, until the first coordinate image is available. */
  waitingIndex: ImageFile | undefined;
  coordHeader: Pick<ImageHeader, "width" | "height"> | undefined;
  coord: GpuVertices | undefined;
  coordPlaneCount = 0;
  indexedDraws: IndexedDraws | undefined;
  attributes: Partial<Record<VertexRole, GpuVertices>> = {};
  /** Normals computed from the slope of a grid without stored normals. */
  slopeNormals: GpuVertices | undefined;
  /** Undecoded images of attributes, until all planes of an attribute are available. */
  attributePlanes: Partial<Record<VertexRole, (ImageFile | undefined)[]>> = {};
  /** Byte planes of attributes that have been decoded. */
  attributePlaneCounts: Partial<Record<VertexRole, number>> = {};
  /** Undecoded images of the values, until all byte planes are available. */
  valuePlanes: (ImageFile | undefined)[] = [];
  /** Undecoded images of the attributes that move vertices, until all planes of an attribute are available. */
  deformationPlanes: (ImageFile | undefined)[] = [];
  value: GpuVertices | undefined;
  /** Vertices of a live stream. Where it has a role, they replace the decoded ones above. The stream frees them. */
  streamed: LiveArrays | undefined;
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
    const header = checkImage(image.bytes);
    switch (file.role) {
      case "coord":
        available.coordPlanes[file.plane] = image;
        if (file.plane === 0) available.coordHeader = header;
        await Promise.all([this.#decodeCoords(available, signal), this.#decodeIndex(available, signal)]);
        return;
      case "index":
        available.waitingIndex = image;
        await this.#decodeIndex(available, signal);
        return;
      case "value":
        available.valuePlanes[file.plane] = image;
        await this.#decodeValues(available, header, signal);
        return;
      case "deformation":
        await this.#decodeDeformation(available, file.plane, image, header, signal);
        return;
      case "patch":
      case "base":
        return;
      default:
        await this.#decodeAttribute(available, file.role, file.plane, image, header, signal);
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
    const available = this.#available;
    const { attributes, streamed } = available;
    const coord = streamed?.coord ?? available.coord;
    if (coord === undefined || !this.#collector.isWhole) return undefined;
    const storedFormat =
      attributes.normal && this.#patch.lowBytes.normal === undefined
        ? normalFormatOf(this.#geometry)
        : ({ kind: "vector" } as const);
    const value =
      this.#geometry.value?.streamedRange === undefined
        ? available.value && { ...available.value, maxStored: undefined }
        : streamed?.value;
    const attained = attainedStageName(this.#patch, {
      index: available.indexedDraws,
      attributes,
      coord: Array.from({ length: available.coordPlaneCount }),
      value: value ? this.#patch.value : [],
    });
    const isWhole = vertexRoles.every(
      (role) => attributes[role] === undefined || available.attributePlaneCounts[role] === this.#planeCountOf(role),
    );
    const name = attained === "full" && !isWhole ? "shaded" : attained;
    const count = coord.bytes.byteLength / byteSizeOf(coord.type) / coord.stride;
    const points = { index: undefined, draws: [{ primitive: "points", first: 0, count } as const] };
    const { index, draws } = (name === "points" ? undefined : available.indexedDraws) ?? points;
    return {
      kind: "buffers",
      vertexCount: count,
      name,
      index,
      draws,
      coord,
      coordImage: streamed ? undefined : { columns: this.#columnsOf(available.coordHeader), grid: this.#patch.grid },
      attributes: {
        ...attributes,
        normal: streamed?.normal ?? attributes.normal ?? available.slopeNormals,
        color: streamed?.color ?? attributes.color,
      },
      normalFormat: streamed?.normal ? streamed.normalFormat : storedFormat,
      value,
      deformation: this.#collector.deformation,
      ...(streamed && { bounds: this.#patch.box }),
    };
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
    available.coordHeader = vertices;
    await this.#decodeIndex(available, signal);
  }

  /** Decodes the byte planes from the most significant on, as far as they are available. */
  async #decodeCoords(available: AvailableArrays, signal: AbortSignal): Promise<void> {
    const header = available.coordHeader;
    const planes = leadingPlanes(available.coordPlanes);
    if (header === undefined || planes.length <= available.coordPlaneCount) return;
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
              ccw: this.#geometry.ccw,
              maxStored: maxStoredValueOf(this.#geometry, this.#patch),
              step: dequantizationOf(this.#geometry, this.#patch).step,
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

  #planeCountOf(role: VertexRole): number {
    return 1 + (this.#patch.lowBytes[role]?.length ?? 0);
  }

  /** Decodes the byte planes of an attribute from the most significant on, as far as they are available. */
  async #decodeAttribute(
    available: AvailableArrays,
    role: VertexRole,
    plane: number,
    image: ImageFile,
    header: ImageHeader,
    signal: AbortSignal,
  ): Promise<void> {
    const stored = (available.attributePlanes[role] ??= []);
    stored[plane] = image;
    const [first, ...others] = leadingPlanes(stored);
    if (first === undefined) return;
    const planes = [first, ...others] as const;
    const planeCount = this.#planeCountOf(role);
    const isDecoded = () => planes.length <= (available.attributePlaneCounts[role] ?? 0);
    if (isDecoded()) return;
    const images = { planes, planeCount, layout: this.#layout(header, first) };
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

  /** Decodes an attribute that moves vertices once all its planes are available. `plane`: among those of all of them. */
  async #decodeDeformation(
    { deformationPlanes }: AvailableArrays,
    plane: number,
    image: ImageFile,
    header: ImageHeader,
    signal: AbortSignal,
  ): Promise<void> {
    deformationPlanes[plane] = image;
    const { attributes = [] } = this.#geometry.deformation ?? {};
    let first = 0;
    for (const [n, { components, min, size, fileCount }] of attributes.entries()) {
      const isOfFile = plane >= first && plane < first + fileCount;
      const planes = deformationPlanes.slice(first, first + fileCount).flatMap((file) => file ?? []);
      first += fileCount;
      if (!isOfFile || planes.length < fileCount) continue;
      const layout = this.#layout(header, image);
      const vertices = await this.#run("classicValues", { planes, components, min, size, ...layout }, signal);
      this.#collector.add(n, { vertices, min: [], step: [] }, layout.count);
    }
  }

  /** Decodes the values once all their planes are available. */
  async #decodeValues(available: AvailableArrays, header: ImageHeader, signal: AbortSignal): Promise<void> {
    const { value: attribute } = this.#geometry;
    const planes = available.valuePlanes.filter((plane) => plane !== undefined);
    if (attribute === undefined || planes.length < this.#patch.value.length) return;
    available.valuePlanes = [];
    const { components, min, size } = attribute;
    const values = await this.#run(
      "classicValues",
      { planes, components, min, size, ...this.#layout(header, planes[0]) },
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
    const header = available.coordHeader;
    if (file === undefined || header === undefined) return;
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
          coordWidth: header.width,
          coordHeight: header.height,
          recordCount: this.#layout(header).count,
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

  /** Vertices in a row of their images. */
  #columnsOf(header: Pick<ImageHeader, "width"> | undefined): number {
    const { index, grid, implicitWidth } = this.#patch;
    return grid === undefined && index !== undefined ? (header?.width ?? 1) : implicitWidth;
  }

  /** Makes the normals of a live surface, where it has none, follow from its triangles. */
  async #deriveNormals({ streamed }: AvailableArrays, index: IndexArray, draws: readonly DrawRange[]): Promise<void> {
    const isSurface = draws.every(({ primitive }) => primitive === "triangles");
    if (streamed === undefined || streamed.normal || this.#patch.normal || !isSurface) return;
    await streamed.deriveNormals(trianglesOf(index, draws));
  }

  #layout(
    { width, height }: Pick<ImageHeader, "width" | "height">,
    { firstTexel }: { firstTexel: number } = { firstTexel: 0 },
  ): RecordLayout {
    const { index, grid, vertexCount, implicitWidth } = this.#patch;
    if (grid !== undefined) return { count: vertexCount, rowLength: implicitWidth };
    if (index === undefined) return { count: cornerCountOf(this.#patch), rowLength: implicitWidth };
    return { count: vertexCount || width * height - firstTexel, rowLength: 0 };
  }
}

/** The triangles of all draws one after the other, without corners that complete none. */
function trianglesOf(index: IndexArray, draws: readonly DrawRange[]): IndexArray {
  if (draws.every(({ count }) => count % 3 === 0)) return index;
  const triangles = draws.map(({ first, count }) => index.subarray(first, first + count - (count % 3)));
  const all = new Uint32Array(triangles.reduce((sum, { length }) => sum + length, 0));
  let at = 0;
  for (const corners of triangles) {
    all.set(corners, at);
    at += corners.length;
  }
  return all;
}
