// Classic's row: an image for each attribute of a patch, one for each byte of its coordinates.

import type { GeometryDescription, PatchDescription } from "../../../document/description.ts";
import { attributeRows, byVertexRole } from "../../../stage/attributeRows.ts";
import type { AttributeRole } from "../../patchFiles.ts";
import { attributeFilesOf, bytesPerTexel, cornerCountOf } from "../../patchFiles.ts";
import type { ContentTarget } from "../../resourcePool.ts";
import type { EncodingDelivery } from "../encodingDelivery.ts";
import { classicStageBuilder } from "./classicStage.ts";

export const classicDelivery: EncodingDelivery = {
  patchFilesOf: (geometry, patch, maxTextureSize) =>
    attributeFilesOf(patch, targetOf(geometry, patch, maxTextureSize), (role, _, elementCount) => ({
      expectedBytes: elementCount * bytesPerElement[role],
      storedBytes: bytesPerTexel * texelCountOf(patch, role, elementCount),
    })),
  stageBuilder: (geometry, patch, _, tools) => classicStageBuilder(geometry, patch, tools),
  needsWorkers: ({ decode }) => decode === "cpu",
};

/**
 * Bytes in an image for a vertex (a corner, for the index), roughly: only for the progress bar before servers tell
 * sizes.
 */
const bytesPerElement: Readonly<Record<AttributeRole, number>> = {
  index: 0.7,
  coord: 2,
  ...byVertexRole((role) => attributeRows[role].classic.bytesPerVertex),
  value: 0.7,
};

/** Texels of an image as our writer lays it out: records in a power of two of rows of 256. */
function texelCountOf({ implicitWidth }: PatchDescription, role: AttributeRole, elementCount: number): number {
  if (role === "index") return Math.ceil(elementCount / implicitWidth) * implicitWidth;
  return 256 * 2 ** Math.ceil(Math.log2(Math.max(1, elementCount / 256)));
}

/** Images become textures where the GPU decodes vertices, and stay files where workers do. */
function targetOf({ decode }: GeometryDescription, patch: PatchDescription, maxTextureSize: number): ContentTarget {
  if (decode === "cpu") return { kind: "bytes" };
  if (decode === "gpu") return { kind: "texture" };
  const texelCount = patch.grid ? patch.vertexCount : cornerCountOf(patch);
  const edge = Math.max(patch.implicitWidth, Math.ceil(texelCount / patch.implicitWidth));
  return { kind: edge > maxTextureSize ? "bytes" : "either" };
}
