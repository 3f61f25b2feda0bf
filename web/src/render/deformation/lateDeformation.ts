// What moves vertices by joints and displacers, in a module of its own (document/parts.ts).

import type { GeometryDescription, PatchDescription } from "../../document/description.ts";
import { LateModule } from "../../document/lateModule.ts";
import type { Deformation } from "../../stage/deformation.ts";
import type { ShapePose } from "./shapePose.ts";
import type { StageDeformation } from "./stageDeformation.ts";

/** What the module adds. */
export interface DeformationMakers {
  /** GLSL that defines `deform`, for materials with DEFORMED and others. */
  readonly vertexChunk: string;
  readonly pose: (jointCount: number, displacerCount: number) => ShapePose;
  readonly ofStage: (
    deformation: Deformation,
    pose: ShapePose,
    geometry: GeometryDescription,
    patch: PatchDescription,
  ) => StageDeformation;
}

export const lateDeformation = new LateModule<DeformationMakers>("joints and displacers");

/** GLSL that defines `deform`, which vertex shaders call. */
export function deformVertexChunk(): string {
  return lateDeformation.added?.vertexChunk ?? "void deform(inout vec3 position, inout vec3 normal) {}\n";
}
