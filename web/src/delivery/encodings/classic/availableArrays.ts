// What is available of a patch whose images workers decode: its arrays, and images that wait for others.

import type { ImageFile } from "../../../decode/classic/classicArrays.ts";
import type { VertexRole } from "../../../stage/attributeRows.ts";
import type { DrawRange, GpuIndex, GpuVertices } from "../../../stage/stage.ts";
import type { LiveArrays } from "../../content.ts";
import type { ImageSize } from "./patchImages.ts";

export class AvailableArrays {
  /** Undecoded images of the coordinates, until all byte planes are available. */
  coordPlanes: (ImageFile | undefined)[] = [];
  /** The undecoded index image, until the first coordinate image is available. */
  waitingIndex: ImageFile | undefined;
  /** The size of the first image of the coordinates, or of the images that a live stream would have. */
  coordSize: ImageSize | undefined;
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

export interface IndexedDraws {
  readonly index: GpuIndex | undefined;
  readonly draws: readonly DrawRange[];
}
