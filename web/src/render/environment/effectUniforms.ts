// The uniforms of a scene's effects, which all its materials share. Those of fogs and of the EnvironmentLight stay as
// they are made where a scene has neither.

import type { CubeTexture } from "three";
import { Matrix3, Vector2, Vector3 } from "three";
import type { SceneLightUniforms } from "../lights/sceneLights.ts";
import type { ClipPlaneUniforms } from "./clipPlanes.ts";

/** The last of the fogs that apply to a draw counts. */
export interface FogUniforms {
  readonly fogColors: { value: Vector3[] };
  /** The visibility range, in scene units, and 1 for exponential or 0 for linear fog. */
  readonly fogRanges: { value: Vector2[] };
  /** For each fog, the first and the last scope that it applies to. */
  readonly fogScopes: { value: Vector2[] };
}

export function makeFogUniforms(): FogUniforms {
  return { fogColors: { value: [] }, fogRanges: { value: [] }, fogScopes: { value: [] } };
}

/** Where the light that falls on a surface comes from. */
export type DiffuseSource = "none" | "specular" | "texture" | "coefficients";

export interface EnvironmentUniforms {
  /** `none`: the scene has no EnvironmentLight. Not a uniform: programs differ by it. */
  readonly environmentDiffuseSource: { value: DiffuseSource };
  readonly environmentSpecular: { value: CubeTexture | null };
  readonly environmentDiffuse: { value: CubeTexture | null };
  readonly environmentCoefficients: { value: Vector3[] };
  /** The coarsest level of the specular texture, and of the diffuse one; -1 where it has not been loaded. */
  readonly environmentLevels: { value: Vector2 };
  /** The first and the last scope that the light reaches. */
  readonly environmentScope: { value: Vector2 };
  readonly environmentColor: { value: Vector3 };
  readonly environmentAmbient: { value: Vector3 };
  /** From the scene's axes to those of the cube maps. */
  readonly environmentRotation: { value: Matrix3 };
}

export function makeEnvironmentUniforms(): EnvironmentUniforms {
  return {
    environmentDiffuseSource: { value: "none" },
    environmentSpecular: { value: null },
    environmentDiffuse: { value: null },
    environmentCoefficients: { value: [] },
    environmentLevels: { value: new Vector2(-1, -1) },
    environmentScope: { value: new Vector2() },
    environmentColor: { value: new Vector3() },
    environmentAmbient: { value: new Vector3() },
    environmentRotation: { value: new Matrix3() },
  };
}

export type SceneEffectUniforms = SceneLightUniforms & ClipPlaneUniforms & FogUniforms & EnvironmentUniforms;

export function hasLightScopes({ lightScopeRanges }: SceneLightUniforms): boolean {
  return lightScopeRanges.value.length > 0;
}
