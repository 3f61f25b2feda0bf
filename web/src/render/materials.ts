// Materials of X3D with the lighting of X3D (ISO/IEC 19775-1, 17.2.2): for each
// light, diffuse N.L + specular (N.H)^(128 shininess), plus its ambient share.
//
// Colours are not converted: a document's numbers are what the screen gets, and
// light adds up in those numbers, as X3D's equations are written and as X3DOM
// draws them. A grey of 0.5 that faces the headlight is 128 on the screen.
// (three.js by default lights in linear space and divides by pi; hence a chunk
// of our own, and `outputColorSpace` linear in the renderer.) The colours of a
// PhysicalMaterial are linear, and so is its light: physicalLighting.ts.

import type { Color, Material } from "three";
import { DoubleSide, FrontSide, LinearSRGBColorSpace, MeshBasicMaterial, MeshPhongMaterial } from "three";
import type { AppearanceDescription, MaterialDescription, Vec3 } from "../document/description.ts";
import { farnessDefine, shadeByFarnessIn } from "./farness.ts";
import type { Look, MaterialRequest, ShownPicture, VertexColors } from "./look.ts";
import { displayedOf, physicalDefine, physicalLighting, physicalOutput } from "./physicalLighting.ts";
import { primitiveDefinesOf, shapePointsIn } from "./points.ts";
import { colorByValueIn } from "./valueColors.ts";
import { readVerticesIn, replaceEach, srgbColorsDefine, toLinearChunk, vertexDefinesOf } from "./vertexChunk.ts";

const x3dLighting = /* glsl */ `
varying vec3 vViewPosition;
struct X3dMaterial {
  vec3 diffuseColor;
  vec3 specularColor;
  float shininess;
};

#ifdef ${physicalDefine}
${physicalLighting}
#else

uniform float ambientIntensity;

void directX3d(const in IncidentLight light, const in vec3 position, const in vec3 normal, const in vec3 viewDirection,
               const in vec3 clearcoatNormal, const in X3dMaterial material, inout ReflectedLight reflected) {
  float facing = dot(normal, light.direction);
  if (facing <= 0.0) return;
  vec3 halfway = normalize(light.direction + viewDirection);
  reflected.directDiffuse += light.color * material.diffuseColor * facing;
  reflected.directSpecular += light.color * material.specularColor * pow(max(dot(normal, halfway), 1e-6), material.shininess);
}

void ambientX3d(const in vec3 light, const in vec3 position, const in vec3 normal, const in vec3 viewDirection,
                const in vec3 clearcoatNormal, const in X3dMaterial material, inout ReflectedLight reflected) {
  reflected.indirectDiffuse += light * material.diffuseColor * ambientIntensity;
}

#endif

#define RE_Direct directX3d
#define RE_IndirectDiffuse ambientX3d
`;

// Pictures have the numbers of the screen.
const mapChunk = /* glsl */ `
#ifdef USE_MAP
  vec4 texel = texture2D(map, vMapUv);
  #ifdef ${srgbColorsDefine}
    ${toLinearChunk("texel.rgb")}
  #endif
  diffuseColor *= texel;
#endif
`;

const materialFromUniforms = "X3dMaterial material = X3dMaterial(diffuseColor.rgb, specular, shininess);";

/** Uniforms of a lit material. */
interface LitUniforms {
  readonly ambientIntensity: { value: number };
  readonly metallic: { value: number };
  readonly roughness: { value: number };
}

type LitMaterial = MeshPhongMaterial & { userData: { lit?: LitUniforms } };
type PatchMaterial = LitMaterial | MeshBasicMaterial;

/** Pages look as X3D says. */
export const x3dLook: Look = { makeMaterial, applyAppearance, prepare: () => undefined };

function makeMaterial(request: MaterialRequest, appearance: AppearanceDescription, picture: ShownPicture | undefined): PatchMaterial {
  const { shading, colors, solid, uniforms, shared } = request;
  const lit: LitUniforms = { ambientIntensity: { value: 0 }, metallic: { value: 1 }, roughness: { value: 1 } };
  const material: PatchMaterial = shading === "unlit" || shading === "distance" ? new MeshBasicMaterial()
    : new MeshPhongMaterial({ flatShading: shading === "flat" });
  material.side = solid ? FrontSide : DoubleSide;
  material.vertexColors = colors !== "none";
  material.defines = {
    ...vertexDefinesOf(request, shading === "smooth"), ...primitiveDefinesOf(request.primitive),
    ...request.valueDefines, ...(shading === "distance" && { [farnessDefine]: "" }),
  };
  material.userData.lit = lit;
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, uniforms, { depthRange: shared.depthRange, ...lit });
    readVerticesIn(shader);
    shapePointsIn(shader);
    shadeByFarnessIn(shader);
    colorByValueIn(shader);
    shader.fragmentShader = replaceEach(shader.fragmentShader, [
      ["#include <lights_phong_pars_fragment>", x3dLighting],
      ["#include <lights_phong_fragment>", materialFromUniforms],
      ["#include <colorspace_fragment>", physicalOutput],
      ["#include <map_fragment>", mapChunk],
    ]);
  };
  // The text of `onBeforeCompile` is the same for all, so programs are shared as they should be.
  material.customProgramCacheKey = () => "imgeo";
  applyAppearance(material, appearance, colors, picture);
  return material;
}

/** Colours of vertices stand in for the diffuse colour; glTF multiplies them with its base colour. A texture is multiplied by what is there (X3D 4). */
function applyAppearance(material: Material, appearance: AppearanceDescription, colors: VertexColors, picture: ShownPicture | undefined): void {
  const description = appearance.material;
  const hasColors = colors !== "none";
  if (material instanceof MeshPhongMaterial) applyLit(material, description, hasColors);
  else if (material instanceof MeshBasicMaterial) setColor(material.color, hasColors ? [1, 1, 1] : unlitColorOf(description));
  applyAlpha(material, appearance, colors === "rgba" || picture?.hasAlpha === true);
  const texture = picture?.texture ?? null;
  const shown = material as PatchMaterial;
  if ((shown.map === null) !== (texture === null)) material.needsUpdate = true;
  shown.map = texture;
  if (!(shown instanceof MeshPhongMaterial)) return;
  const emissiveMap = description.kind === "unlit" ? texture : null;
  if ((shown.emissiveMap === null) !== (emissiveMap === null)) material.needsUpdate = true;
  shown.emissiveMap = emissiveMap;
}

function applyAlpha(material: Material, { alpha: { mode, cutoff }, material: { transparency } }: AppearanceDescription, hasAlpha: boolean): void {
  const blends = mode === "BLEND" || (mode === "AUTO" && (transparency > 0 || hasAlpha));
  material.opacity = mode === "OPAQUE" ? 1 : 1 - transparency;
  material.alphaTest = mode === "MASK" ? cutoff : 0;
  if (material.transparent === blends) return;
  material.transparent = blends;
  material.needsUpdate = true;
}

/** X3D shows unlit points in the emissive colour. Scans without one would be black on black. */
function unlitColorOf(description: MaterialDescription): Vec3 {
  const { emissiveColor } = description;
  const isDark = emissiveColor.every((channel) => channel === 0);
  switch (description.kind) {
    case "phong":
      return isDark ? description.diffuseColor : emissiveColor;
    case "physical":
      return displayedOf(isDark ? description.baseColor : emissiveColor);
    case "unlit":
      return emissiveColor;
  }
}

function applyLit(material: LitMaterial, description: MaterialDescription, hasColors: boolean): void {
  setPhysical(material, description.kind === "physical");
  const { lit } = material.userData;
  if (description.kind === "physical") {
    setColor(material.color, description.baseColor);
    if (lit) lit.metallic.value = description.metallic;
    if (lit) lit.roughness.value = description.roughness;
  } else {
    const phong = description.kind === "phong" ? description : unlitAsPhong;
    setColor(material.color, hasColors && description.kind === "phong" ? [1, 1, 1] : phong.diffuseColor);
    setColor(material.specular, phong.specularColor);
    material.shininess = phong.shininess * 128;
    if (lit) lit.ambientIntensity.value = phong.ambientIntensity;
  }
  setColor(material.emissive, description.emissiveColor);
}

/** What no light changes reflects none. */
const unlitAsPhong = { diffuseColor: [0, 0, 0], specularColor: [0, 0, 0], shininess: 0, ambientIntensity: 0 } as const;

/** Another program where the kind has changed. */
function setPhysical(material: LitMaterial, isPhysical: boolean): void {
  const defines = material.defines ?? {};
  if (isPhysical === (physicalDefine in defines)) return;
  const others = Object.entries(defines).filter(([name]) => name !== physicalDefine && name !== srgbColorsDefine);
  material.defines = { ...Object.fromEntries(others), ...(isPhysical && { [physicalDefine]: "", [srgbColorsDefine]: "" }) };
  material.needsUpdate = true;
}

export function setColor(color: Color, [red, green, blue]: Vec3): void {
  // three's working space is linear, so this keeps the numbers as they are.
  color.setRGB(red, green, blue, LinearSRGBColorSpace);
}
