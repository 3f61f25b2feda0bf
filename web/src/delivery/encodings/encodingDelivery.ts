import type { GeometryDescription, PatchDescription } from "../../document/description.ts";
import type { PatchFile } from "../patchFiles.ts";
import type { BuilderTools, StageBuilder } from "../stageBuilder.ts";

/** How the files of an encoding become stages. What documents say of it is in document/encodings.ts. */
export interface EncodingDelivery {
  /** The files that a patch needs. `maxTextureSize`: the longest edge of a texture, in texels. */
  patchFilesOf(geometry: GeometryDescription, patch: PatchDescription, maxTextureSize: number): PatchFile[];
  stageBuilder(
    geometry: GeometryDescription,
    patch: PatchDescription,
    patchIndex: number,
    tools: BuilderTools,
  ): StageBuilder;
  /** Whether workers decode the patches whatever the GPU can do. */
  needsWorkers(geometry: GeometryDescription): boolean;
}
