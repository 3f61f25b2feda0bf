// What is around the shapes of a scene, and what of it changes how they look, in a module of its own
// (document/parts.ts): cube maps, skies and pictures of backgrounds, EnvironmentLights, clip planes, fogs and scopes of
// lights.

import type { BufferGeometry, IUniform, Mesh, ShaderMaterial, Texture } from "three";
import type { BackgroundDescription, PanoramaSide } from "../../document/description.ts";
import { LateModule } from "../../document/lateModule.ts";
import type { DecodedImage } from "../../stage/decodedImage.ts";
import type { EnvironmentLightInstance } from "../../scene/instances.ts";
import type { EnvironmentUniforms, FogUniforms, SceneEffectUniforms } from "./effectUniforms.ts";
import type { ShaderTexts } from "../shaders/editShaders.ts";
import type { ScopedFog } from "./fogs.ts";
import type { SceneSurroundings } from "./sceneSurroundings.ts";

/** A mesh of a background. */
export type BackgroundMesh = Mesh<BufferGeometry, ShaderMaterial>;

/** What the module adds. */
export interface Environment {
  readonly surroundings: (uniforms: EnvironmentUniforms) => SceneSurroundings;
  readonly sky: (background: BackgroundDescription) => BackgroundMesh;
  readonly picture: (side: PanoramaSide, picture: Texture) => BackgroundMesh;
  readonly setFogs: (uniforms: FogUniforms, fogs: readonly ScopedFog[]) => void;
  readonly setEnvironmentLight: (uniforms: EnvironmentUniforms, instance: EnvironmentLightInstance | undefined) => void;
  readonly effectUniformsOf: (shared: SceneEffectUniforms) => Record<string, IUniform>;
  readonly addEffects: (shader: ShaderTexts, shared: SceneEffectUniforms) => void;
  /** What a warning says of a cube map's picture of a wrong shape (cubeLayout.ts). */
  readonly cubeMapProblemOf: (role: string, image: DecodedImage) => string | undefined;
}

export const lateEnvironment = new LateModule<Environment>("environments");
