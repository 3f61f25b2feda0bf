// Delivery of BG: a typed array for each attribute of a patch, each in a file of its own or interleaved in one file.

import { hasNormalsInCoords } from "../../../document/geometry.ts";
import { byteSizeOf } from "../../../stage/elementType.ts";
import { attributeFilesOf } from "../../patchFiles.ts";
import type { EncodingDelivery } from "../encodingDelivery.ts";
import { bgStageBuilder, byteStrideOf, componentsOf, elementTypeOf } from "./bgStage.ts";

export const bgDelivery: EncodingDelivery = {
  patchFilesOf(geometry, patch) {
    const fileAttributes = hasNormalsInCoords(geometry, patch) ? { ...patch, normal: undefined } : patch;
    return attributeFilesOf(fileAttributes, { kind: "bytes" }, (role, reference, elementCount) => {
      const elementSize = byteSizeOf(elementTypeOf(geometry, role)) * componentsOf(geometry, role);
      const bytes = elementCount * (byteStrideOf(reference) || elementSize);
      return { expectedBytes: bytes, storedBytes: bytes };
    });
  },
  stageBuilder: (geometry, patch, _, tools) => bgStageBuilder(geometry, patch, tools),
  needsWorkers: () => false,
};
