// Delivery of classic: an image for each attribute of a patch; of the coordinates, an image for each byte.

import type { GeometryDescription, PatchDescription } from "../../../document/description.ts";
import { isDrawnFromImages } from "../../../document/drawnFromImages.ts";
import { attributeRows, byVertexRole } from "../../../stage/attributeRows.ts";
import type { AttributeRole } from "../../patchFiles.ts";
import { cornerCountOf } from "../../../document/patchSizes.ts";
import { attributeFilesOf, bytesPerTexel } from "../../patchFiles.ts";
import type { ContentTarget } from "../../content.ts";
import type { EncodingDelivery } from "../encodingDelivery.ts";
import { classicStageBuilder } from "./classicStage.ts";

export const classicDelivery: EncodingDelivery = {
  patchFilesOf: (geometry, patch, maxTextureSize) =>
    attributeFilesOf(patch, targetOf(geometry, patch, maxTextureSize), (role, _, elementCount) => ({
      expectedBytes: elementCount * bytesPerElement[role],
      storedBytes: bytesPerTexel * texelCountOf(patch, role, elementCount),
    })),
  stageBuilder: (geometry, patch, _, tools) => classicStageBuilder(geometry, patch, tools),
  needsWorkers: (geometry) => !geometry.patches.every((patch) => isDrawnFromImages(geometry, patch)),
};

/**
 * Approximate bytes of an image file per vertex; of the index, per corner. Used by the progress bar until the server
 * states the size.
 */
const bytesPerElement: Readonly<Record<AttributeRole, number>> = {
  index: 0.7,
  coord: 2,
  ...byVertexRole((role) => attributeRows[role].classic.bytesPerVertex),
  value: 0.7,
  deformation: 2,
};

/** Texels of an image as `imgeo convert` writes it: records in rows of 256, whose number is a power of two. */
function texelCountOf({ implicitWidth }: PatchDescription, role: AttributeRole, elementCount: number): number {
  if (role === "index") return Math.ceil(elementCount / implicitWidth) * implicitWidth;
  return 256 * 2 ** Math.ceil(Math.log2(Math.max(1, elementCount / 256)));
}

/** Images become textures if the GPU decodes vertices, and stay files if workers do. */
function targetOf(geometry: GeometryDescription, patch: PatchDescription, maxTextureSize: number): ContentTarget {
  if (!isDrawnFromImages(geometry, patch)) return { kind: "imageBytes" };
  if (geometry.decode === "gpu") return { kind: "texture" };
  return { kind: imageEdgeOf(patch) > maxTextureSize ? "imageBytes" : "either" };
}

/** The longest edge of the images of a patch, in texels. */
export function imageEdgeOf(patch: PatchDescription): number {
  const texelCount = patch.grid ? patch.vertexCount : cornerCountOf(patch);
  return Math.max(patch.implicitWidth, Math.ceil(texelCount / patch.implicitWidth));
}
