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
import { placeColors, placesDefine } from "./batches/placeChunk.ts";
import { farnessDefine, shadeByFarnessIn } from "./farness.ts";
import { lightsChunk } from "./lightFalloff.ts";
import type { Look, MaterialRequest, Shading, ShownPicture, VertexColors } from "./look.ts";
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

#ifdef ${placesDefine}
  #define ambientIntensity placeEmissive.a
#else
  uniform float ambientIntensity;
#endif

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

/** Defined where no light changes what is seen. */
const unlitDefine = "UNLIT";

const materialChunk = /* glsl */ `
#ifdef ${unlitDefine}
  totalEmissiveRadiance = diffuseColor.rgb;
  X3dMaterial material = X3dMaterial(vec3(0.0), vec3(0.0), 1.0);
#elif defined(${placesDefine})
  X3dMaterial material = X3dMaterial(diffuseColor.rgb, placeSpecular.rgb, placeSpecular.a);
#else
  X3dMaterial material = X3dMaterial(diffuseColor.rgb, specular, shininess);
#endif
`;

/** Uniforms of a lit material. */
interface LitUniforms {
  readonly ambientIntensity: { value: number };
  readonly metallic: { value: number };
  readonly roughness: { value: number };
}

type LitMaterial = MeshPhongMaterial & { userData: { lit?: LitUniforms } };
type PatchMaterial = LitMaterial | MeshBasicMaterial;

/** Pages look as X3D says. */
export const x3dLook: Look = { makeMaterial, applyAppearance, prepare: () => undefined, batching: { keyOf, numbersOf } };

function makeMaterial(request: MaterialRequest, appearance: AppearanceDescription, picture: ShownPicture | undefined): PatchMaterial {
  const { shading, colors, solid, uniforms, shared } = request;
  const lit: LitUniforms = { ambientIntensity: { value: 0 }, metallic: { value: 1 }, roughness: { value: 1 } };
  const material: PatchMaterial = isUnlit(shading) ? new MeshBasicMaterial()
    : new MeshPhongMaterial({ flatShading: shading === "flat" });
  material.side = solid ? FrontSide : DoubleSide;
  material.vertexColors = colors !== "none";
  material.defines = {
    ...vertexDefinesOf(request, shading === "smooth"), ...primitiveDefinesOf(request.primitive),
    ...request.valueDefines, ...(shading === "distance" && { [farnessDefine]: "" }),
  };
  material.userData.lit = lit;
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, uniforms, { depthRange: shared.depthRange, attenuations: shared.attenuations, ...lit });
    readVerticesIn(shader);
    shapePointsIn(shader);
    shadeByFarnessIn(shader);
    colorByValueIn(shader);
    shader.fragmentShader = replaceEach(shader.fragmentShader, [
      ["#include <lights_pars_begin>", lightsChunk],
      ["#include <lights_phong_pars_fragment>", x3dLighting],
      ["#include <lights_phong_fragment>", materialChunk],
      ["#include <colorspace_fragment>", physicalOutput],
      ["#include <map_fragment>", mapChunk],
      ...placeColors,
    ]);
  };
  // The text of `onBeforeCompile` is the same for all, so programs are shared as they should be.
  material.customProgramCacheKey = () => "imgeo";
  applyAppearance(material, appearance, colors, picture);
  return material;
}

/** A texture is multiplied by what is there (X3D 4). */
function applyAppearance(material: Material, appearance: AppearanceDescription, colors: VertexColors, picture: ShownPicture | undefined): void {
  const description = appearance.material;
  const shown = material as PatchMaterial;
  const isLit = shown instanceof MeshPhongMaterial;
  if (isLit) applyLit(shown, description, litNumbersOf(description, colors !== "none"));
  else setColor(shown.color, unlitColorOf(description, colors !== "none"));
  material.opacity = opacityOf(appearance);
  material.alphaTest = alphaTestOf(appearance);
  const blends = isBlended(appearance, colors, picture);
  const texture = picture?.texture ?? null;
  const isOther = material.transparent !== blends || (shown.map === null) !== (texture === null);
  material.transparent = blends;
  shown.map = texture;
  if (isOther) material.needsUpdate = true;
}

function isBlended({ alpha: { mode }, material: { transparency } }: AppearanceDescription, colors: VertexColors, picture: ShownPicture | undefined): boolean {
  return mode === "BLEND" || (mode === "AUTO" && (transparency > 0 || colors === "rgba" || picture?.hasAlpha === true));
}

function opacityOf({ alpha: { mode }, material: { transparency } }: AppearanceDescription): number {
  return mode === "OPAQUE" ? 1 : 1 - transparency;
}

function alphaTestOf({ alpha: { mode, cutoff } }: AppearanceDescription): number {
  return mode === "MASK" ? cutoff : 0;
}

function keyOf({ primitive, colors }: Pick<MaterialRequest, "primitive" | "colors">, appearance: AppearanceDescription,
               picture: ShownPicture | undefined): string | undefined {
  if (isBlended(appearance, colors, picture)) return undefined;
  const { material, points, ...rest } = appearance;
  const others = Object.entries(material).filter(([name]) => !numbersOfPlaces.has(name));
  return JSON.stringify([rest, others, picture?.texture.uuid, primitive === "points" && points]);
}

/** What of a material `numbersOf` tells. */
const numbersOfPlaces = new Set(["diffuseColor", "baseColor", "specularColor", "shininess", "emissiveColor", "ambientIntensity", "metallic", "roughness", "transparency"]);

function numbersOf({ shading, colors }: { shading: Shading; colors: VertexColors }, appearance: AppearanceDescription): readonly number[] {
  const { material } = appearance;
  const opacity = opacityOf(appearance);
  if (isUnlit(shading)) return [...unlitColorOf(material, colors !== "none"), opacity, 0, 0, 0, 0, 0, 0, 0, 0];
  const { color, specular, shininess, ambientIntensity, metallic, roughness } = litNumbersOf(material, colors !== "none");
  const gloss = material.kind === "physical" ? [metallic, roughness, 0, 0] : [...specular, shininess];
  return [...color, opacity, ...gloss, ...material.emissiveColor, ambientIntensity];
}

function isUnlit(shading: Shading): boolean {
  return shading === "unlit" || shading === "distance";
}

/** X3D shows unlit points in the emissive colour. Scans without one would be black on black. Colours of vertices stand in for it. */
function unlitColorOf(description: MaterialDescription, hasColors: boolean): Vec3 {
  if (hasColors) return [1, 1, 1];
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

interface LitNumbers {
  readonly color: Vec3;
  readonly specular: Vec3;
  readonly shininess: number;
  readonly ambientIntensity: number;
  readonly metallic: number;
  readonly roughness: number;
}

/** Colours of vertices stand in for the diffuse colour; glTF multiplies them with its base colour. */
function litNumbersOf(description: MaterialDescription, hasColors: boolean): LitNumbers {
  switch (description.kind) {
    case "physical":
      return { ...noNumbers, color: description.baseColor, metallic: description.metallic, roughness: description.roughness };
    case "phong": {
      const { diffuseColor, specularColor, shininess, ambientIntensity } = description;
      return { color: hasColors ? [1, 1, 1] : diffuseColor, specular: specularColor, shininess: shininess * 128, ambientIntensity, metallic: 1, roughness: 1 };
    }
    case "unlit":
      return { ...noNumbers, color: unlitColorOf(description, hasColors) };
  }
}

const noNumbers: LitNumbers = { color: [0, 0, 0], specular: [0, 0, 0], shininess: 0, ambientIntensity: 0, metallic: 1, roughness: 1 };

function applyLit(material: LitMaterial, description: MaterialDescription, numbers: LitNumbers): void {
  setKind(material, description.kind);
  const { lit } = material.userData;
  setColor(material.color, numbers.color);
  setColor(material.specular, numbers.specular);
  material.shininess = numbers.shininess;
  setColor(material.emissive, description.emissiveColor);
  if (lit === undefined) return;
  lit.ambientIntensity.value = numbers.ambientIntensity;
  lit.metallic.value = numbers.metallic;
  lit.roughness.value = numbers.roughness;
}

/** What a material of a kind defines. */
const kindDefines: Readonly<Record<MaterialDescription["kind"], readonly string[]>> = {
  phong: [], physical: [physicalDefine, srgbColorsDefine], unlit: [unlitDefine],
};
const allKindDefines = Object.values(kindDefines).flat();

/** Another program where the kind has changed. */
function setKind(material: LitMaterial, kind: MaterialDescription["kind"]): void {
  const defines = material.defines ?? {};
  const wanted = kindDefines[kind];
  if (allKindDefines.every((name) => wanted.includes(name) === name in defines)) return;
  const others = Object.entries(defines).filter(([name]) => !allKindDefines.includes(name));
  material.defines = { ...Object.fromEntries(others), ...Object.fromEntries(wanted.map((name) => [name, ""])) };
  material.needsUpdate = true;
}

export function setColor(color: Color, [red, green, blue]: Vec3): void {
  // three's working space is linear, so this keeps the numbers as they are.
  color.setRGB(red, green, blue, LinearSRGBColorSpace);
}
