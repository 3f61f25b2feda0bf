// What moves vertices by joints and displacers, in a module of its own (document/parts.ts).

import type { GeometryDescription, PatchDescription } from "../../document/description.ts";
import type { Deformation } from "../../stage/deformation.ts";
import type { ShapePose } from "./shapePose.ts";
import type { StageDeformation } from "./stageDeformation.ts";

/** What the module adds. */
export interface LateDeformation {
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

let deformation: LateDeformation | undefined;

export function addDeformation(added: LateDeformation): void {
  deformation = added;
}

/** Undefined until the module has been loaded, which happens before a scene that needs it is displayed. */
export function lateDeformation(): LateDeformation | undefined {
  return deformation;
}

/** GLSL that defines `deform`, which vertex shaders call. */
export function deformVertexChunk(): string {
  return deformation?.vertexChunk ?? "void deform(inout vec3 position, inout vec3 normal) {}\n";
}
