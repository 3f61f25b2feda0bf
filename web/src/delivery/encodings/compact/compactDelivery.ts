// Delivery of compact: one file holds all of a patch, and another the base mesh of all patches.

import type { PatchDescription } from "../../../document/description.ts";
import type { PatchFile } from "../../patchFiles.ts";
import { compactBytesOf, cornerCountOf } from "../../../document/patchSizes.ts";
import type { EncodingDelivery } from "../encodingDelivery.ts";
import { compactStageBuilder } from "./compactStage.ts";

/** Approximate bytes of a base mesh's segment per byte of its patch. */
const baseShare = 0.03;

export const compactDelivery: EncodingDelivery = {
  patchFilesOf({ base }, patch) {
    const { expectedBytes, storedBytes } = sizesOf(patch);
    const files: PatchFile[] = [];
    if (base !== undefined) {
      files.push({
        role: "base",
        plane: 0,
        reference: base,
        target: { kind: "bases", job: "compactBases" },
        chunk: { type: "base", plane: 0 },
        expectedBytes: baseShare * expectedBytes,
        storedBytes: baseShare * storedBytes,
      });
    }
    if (patch.data !== undefined) {
      files.push({
        role: "patch",
        plane: 0,
        reference: patch.data,
        target: { kind: "patches", job: "compactPatches" },
        chunk: { type: "patch", plane: 0 },
        expectedBytes,
        storedBytes,
      });
    }
    return files;
  },
  stageBuilder: compactStageBuilder,
  needsWorkers: () => true,
};

/** Estimates by typical patches. */
function sizesOf(patch: PatchDescription): Pick<PatchFile, "expectedBytes" | "storedBytes"> {
  return {
    expectedBytes: compactBytesOf(patch),
    storedBytes: 12 * patch.vertexCount + 2 * cornerCountOf(patch), // 8 of coordinates and 4 of the normal, and 16-bit indices
  };
}
