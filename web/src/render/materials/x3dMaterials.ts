// The materials of pages: X3D's lighting model in three.js. three.js lights in linear space and
// divides by pi; X3D's lighting (lighting/x3dLighting.ts) does neither, so it replaces three.js'
// chunk, and the renderer's `outputColorSpace` is linear.

import type { Material } from "three";
import { MeshBasicMaterial, MeshPhongMaterial } from "three";
import type { AppearanceDescription, MaterialDescription } from "../../document/description.ts";
import type { LitParameters } from "../../lighting/materialParameters.ts";
import { litParametersOf, opacityOf, unlitColorOf } from "../../lighting/materialParameters.ts";
import { physicalDefine, physicalOutput } from "../../lighting/physicalLighting.ts";
import { materialStruct, x3dLighting } from "../../lighting/x3dLighting.ts";
import { instanceColorChunks } from "../shaders/instanceRecord.ts";
import { addSceneEffects, sceneEffectsKey, sceneEffectUniformsOf } from "../environment/sceneEffects.ts";
import { depthShadingDefine, addDepthShading } from "./depthShading.ts";
import { lightsChunk } from "../lights/lightFalloff.ts";
import { addGlyphField, setGlyphDefine } from "./glyphField.ts";
import type { Backdrop, ExtensionShaders, ExtensionUniforms } from "./extendedMaterials.ts";
import { applyExtensions, extensionShadersFor, makeExtensionUniforms } from "./extendedMaterials.ts";
import { minAlpha, sideOf } from "./materialFactory.ts";
import type { MaterialFactory, MaterialRequest, VertexColors } from "./materialFactory.ts";
import type { SurfaceTextures } from "./surfaceTextures.ts";
import { primitiveDefinesOf, addPrimitiveChunks } from "../points/roundPoints.ts";
import { lateValues } from "./lateValues.ts";
import { addVertexReading, readVertexKey } from "../shaders/vertexChunk.ts";
import { needsViewport, srgbColorsDefine, vertexDefinesOf } from "../shaders/vertexFormat.ts";
import type { ShaderTexts } from "../shaders/editShaders.ts";
import { editShaders } from "../shaders/editShaders.ts";
import { replaceChunks } from "../shaders/replaceChunks.ts";
import { extraMapDeclarations } from "../shaders/texCoords.ts";
import { followViewport } from "../shaders/followViewport.ts";
import type { ExtraMapUniforms } from "./x3dMaps.ts";
import {
  cubeMapDeclarations,
  setTextureMaps,
  makeExtraMapUniforms,
  textureMapChunks,
  x3dMaterialChunk,
  unlitDefine,
} from "./x3dMaps.ts";
import { setColor } from "../lights/linearColor.ts";
import { instanceNumbersOf, isDrawBlended, isUnlit, materialKeyOf } from "./x3dBatching.ts";

/** `functions`: GLSL of directX3d and ambientX3d. */
const lightingChunkOf = (functions: string) => /* glsl */ `
varying vec3 vViewPosition;
uniform float ambientIntensity;
uniform float metallic;
uniform float roughness;
${functions}
#define RE_Direct directX3d
#define RE_IndirectDiffuse ambientX3d
`;
const x3dLightingChunk = lightingChunkOf(x3dLighting);
const extendedLightingChunkOf = (functions: string) => lightingChunkOf(materialStruct + functions);

/** Uniforms of lit materials. */
interface LitUniforms extends ExtraMapUniforms, ExtensionUniforms {
  readonly ambientIntensity: { value: number };
  readonly metallic: { value: number };
  readonly roughness: { value: number };
}

type LitMaterial = MeshPhongMaterial & { userData: { lit?: LitUniforms; backdrop?: Backdrop } };
type PatchMaterial = LitMaterial | MeshBasicMaterial;

/** The MaterialFactory of pages. */
export const x3dMaterials: MaterialFactory = {
  makeMaterial,
  applyAppearance,
  prepareObject: () => undefined,
  batching: {
    materialKeyOf,
    instanceNumbersOf,
    isBlended: ({ colors }, appearance, surfaceTextures) => isDrawBlended(appearance, colors, surfaceTextures),
  },
};

function makeMaterial(
  request: MaterialRequest,
  appearance: AppearanceDescription,
  surfaceTextures: SurfaceTextures,
): PatchMaterial {
  const { shading, colors, uniforms, shared } = request;
  const lit: LitUniforms = {
    ambientIntensity: { value: 0 },
    metallic: { value: 1 },
    roughness: { value: 1 },
    ...makeExtraMapUniforms(),
    ...makeExtensionUniforms(),
  };
  const material: PatchMaterial = isUnlit(shading)
    ? new MeshBasicMaterial()
    : new MeshPhongMaterial({ flatShading: shading === "flat" });
  material.side = sideOf(request);
  if (needsViewport(request)) followViewport(material, shared.viewport);
  material.vertexColors = colors !== "none";
  material.defines = {
    ...vertexDefinesOf(request, shading === "smooth"),
    ...primitiveDefinesOf(request.primitive),
    ...request.valueDefines,
    ...(shading === "distance" && { [depthShadingDefine]: "" }),
  };
  material.userData.lit = lit;
  if (shared.backdrop) material.userData.backdrop = shared.backdrop;
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, uniforms, { depthRange: shared.depthRange, ...lit });
    Object.assign(shader.uniforms, sceneEffectUniformsOf(shared));
    if (shared.backdrop) shader.uniforms.backdrop = shared.backdrop.uniform;
    const extensions = extensionShadersFor(material.defines ?? {});
    const added = [extensions, lateValues.added].map((module) => module !== undefined);
    const key = [sceneEffectsKey(shared), ...added, readVertexKey()].join(" ");
    editShaders(shader, key, (texts) => {
      editMaterialShaders(texts, extensions);
      addSceneEffects(texts, shared);
    });
  };
  // `onBeforeCompile` edits the shaders of all materials alike, so equal keys let three.js share programs.
  material.customProgramCacheKey = () => `imgeo ${sceneEffectsKey(shared)}`;
  applyAppearance(material, appearance, colors, surfaceTextures);
  return material;
}

function editMaterialShaders(shader: ShaderTexts, extensions: ExtensionShaders | undefined): void {
  addVertexReading(shader);
  addPrimitiveChunks(shader);
  addDepthShading(shader);
  lateValues.added?.addColors(shader);
  addGlyphField(shader);
  shader.fragmentShader =
    extraMapDeclarations +
    cubeMapDeclarations +
    replaceChunks(shader.fragmentShader, [
      ["#include <lights_pars_begin>", lightsChunk],
      ...(extensions?.lightingChunks(extendedLightingChunkOf) ??
        ([["#include <lights_phong_pars_fragment>", x3dLightingChunk]] as const)),
      ["#include <lights_phong_fragment>", x3dMaterialChunk],
      ["#include <colorspace_fragment>", physicalOutput],
      ...textureMapChunks,
      ...instanceColorChunks,
    ]);
  if (extensions) shader.vertexShader = extensions.vertexShader(shader.vertexShader);
}

/** Textures are multiplied by the material's colours (X3D 4). */
function applyAppearance(
  material: Material,
  appearance: AppearanceDescription,
  colors: VertexColors,
  surfaceTextures: SurfaceTextures,
): void {
  const description = appearance.material;
  const x3dMaterial = material as PatchMaterial;
  const isLit = x3dMaterial instanceof MeshPhongMaterial;
  if (isLit) applyLit(x3dMaterial, description, litParametersOf(description, colors !== "none"));
  else setColor(x3dMaterial.color, unlitColorOf(description, colors !== "none"));
  material.opacity = opacityOf(appearance);
  setTextureMaps(x3dMaterial, appearance, surfaceTextures, isLit ? x3dMaterial.userData.lit : undefined);
  setGlyphDefine(material, appearance);
  const isTransparent = isDrawBlended(appearance, colors, surfaceTextures);
  if (material.transparent !== isTransparent) material.needsUpdate = true;
  material.transparent = isTransparent;
  material.alphaTest = isTransparent ? minAlpha : alphaTestOf(appearance);
}

function alphaTestOf({ alpha: { mode, cutoff } }: AppearanceDescription): number {
  return mode === "MASK" ? cutoff : 0;
}

function applyLit(material: LitMaterial, description: MaterialDescription, parameters: LitParameters): void {
  setKind(material, description.kind);
  const { lit, backdrop } = material.userData;
  setColor(material.color, parameters.color);
  setColor(material.specular, parameters.specular);
  material.shininess = parameters.shininess;
  setColor(material.emissive, description.emissiveColor);
  if (lit === undefined) return;
  lit.ambientIntensity.value = parameters.ambientIntensity;
  lit.metallic.value = parameters.metallic;
  lit.roughness.value = parameters.roughness;
  if (backdrop) applyExtensions(material, description, lit, backdrop);
}

/** The #defines of each kind of material. */
const kindDefines: Readonly<Record<MaterialDescription["kind"], readonly string[]>> = {
  phong: [],
  physical: [physicalDefine, srgbColorsDefine],
  unlit: [unlitDefine],
};
const allKindDefines = Object.values(kindDefines).flat();

/** Updates the #defines; three.js compiles another program if the kind has changed. */
function setKind(material: LitMaterial, kind: MaterialDescription["kind"]): void {
  const defines = material.defines ?? {};
  const kindNames = kindDefines[kind];
  if (allKindDefines.every((name) => kindNames.includes(name) === name in defines)) return;
  const others = Object.entries(defines).filter(([name]) => !allKindDefines.includes(name));
  material.defines = { ...Object.fromEntries(others), ...Object.fromEntries(kindNames.map((name) => [name, ""])) };
  material.needsUpdate = true;
}
