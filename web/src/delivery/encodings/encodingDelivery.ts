import type { GeometryDescription, PatchDescription } from "../../document/description.ts";
import type { PatchFile } from "../patchFiles.ts";
import type { BuilderTools, StageBuilder } from "../stageBuilder.ts";

/**
 * Delivery of one encoding: lists the files of a patch and builds stages from them. document/encodings.ts reads the
 * encoding's elements.
 */
export interface EncodingDelivery {
  /** The files that a patch needs. `maxTextureSize`: the longest edge of a texture, in texels. */
  patchFilesOf(geometry: GeometryDescription, patch: PatchDescription, maxTextureSize: number): PatchFile[];
  stageBuilder(
    geometry: GeometryDescription,
    patch: PatchDescription,
    patchIndex: number,
    tools: BuilderTools,
  ): StageBuilder;
  /** Whether workers decode the patches on every GPU. */
  needsWorkers(geometry: GeometryDescription): boolean;
}
