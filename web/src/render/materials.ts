// Materials of X3D with the lighting of X3D (ISO/IEC 19775-1, 17.2.2): for each
// light, diffuse N.L + specular (N.H)^(128 shininess), plus its ambient share.
//
// Colours are not converted: a document's numbers are what the screen gets, and
// light adds up in those numbers, as X3D's equations are written and as X3DOM
// draws them. A grey of 0.5 that faces the headlight is 128 on the screen.
// (three.js by default lights in linear space and divides by pi; hence a chunk
// of our own, and `outputColorSpace` linear in the renderer.)

import type { Color, Material } from "three";
import { DoubleSide, FrontSide, LinearSRGBColorSpace, MeshBasicMaterial, MeshPhongMaterial } from "three";
import type { MaterialDescription, Vec3 } from "../document/description.ts";
import { farnessDefine, shadeByFarnessIn } from "./farness.ts";
import type { Look, MaterialRequest, VertexColors } from "./look.ts";
import { readVerticesIn, replaceEach, vertexDefinesOf } from "./vertexChunk.ts";

const x3dLighting = /* glsl */ `
varying vec3 vViewPosition;
uniform float ambientIntensity;

struct X3dMaterial {
  vec3 diffuseColor;
  vec3 specularColor;
  float shininess;
};

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

#define RE_Direct directX3d
#define RE_IndirectDiffuse ambientX3d
`;

const materialFromUniforms = "X3dMaterial material = X3dMaterial(diffuseColor.rgb, specular, shininess);";

type PatchMaterial = (MeshPhongMaterial | MeshBasicMaterial) & { userData: { ambientIntensity?: { value: number } } };

/** Pages look as X3D says. */
export const x3dLook: Look = { makeMaterial, applyMaterial, prepare: () => undefined };

function makeMaterial(request: MaterialRequest, description: MaterialDescription): PatchMaterial {
  const { shading, colors, solid, uniforms, shared } = request;
  const ambientIntensity = { value: 0 };
  const material: PatchMaterial = shading === "unlit" || shading === "distance" ? new MeshBasicMaterial()
    : new MeshPhongMaterial({ flatShading: shading === "flat" });
  material.side = solid ? FrontSide : DoubleSide;
  material.vertexColors = colors !== "none";
  material.defines = { ...vertexDefinesOf(request, shading === "smooth"), ...(shading === "distance" && { [farnessDefine]: "" }) };
  material.userData.ambientIntensity = ambientIntensity;
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, uniforms, { depthRange: shared.depthRange, ambientIntensity });
    readVerticesIn(shader);
    shadeByFarnessIn(shader);
    shader.fragmentShader = replaceEach(shader.fragmentShader, [
      ["#include <lights_phong_pars_fragment>", x3dLighting],
      ["#include <lights_phong_fragment>", materialFromUniforms],
    ]);
  };
  // The text of `onBeforeCompile` is the same for all, so programs are shared as they should be.
  material.customProgramCacheKey = () => "imgeo";
  applyMaterial(material, description, colors);
  return material;
}

/** Colours of vertices stand in for the diffuse colour. */
function applyMaterial(material: Material, description: MaterialDescription, colors: VertexColors): void {
  const { diffuseColor, specularColor, emissiveColor, ambientIntensity, shininess, transparency } = description;
  const hasColors = colors !== "none";
  if (material instanceof MeshPhongMaterial) {
    setColor(material.color, hasColors ? [1, 1, 1] : diffuseColor);
    setColor(material.specular, specularColor);
    setColor(material.emissive, emissiveColor);
    material.shininess = shininess * 128;
  } else if (material instanceof MeshBasicMaterial) {
    // X3D shows unlit points in the emissive colour. Scans without one would be black on black.
    const isDark = emissiveColor.every((channel) => channel === 0);
    setColor(material.color, hasColors ? [1, 1, 1] : isDark ? diffuseColor : emissiveColor);
  }
  const ambient = (material as PatchMaterial).userData.ambientIntensity;
  if (ambient) ambient.value = ambientIntensity;
  material.opacity = 1 - transparency;
  const isTransparent = transparency > 0 || colors === "rgba";
  if (material.transparent !== isTransparent) {
    material.transparent = isTransparent;
    material.needsUpdate = true;
  }
}

export function setColor(color: Color, [red, green, blue]: Vec3): void {
  // three's working space is linear, so this keeps the numbers as they are.
  color.setRGB(red, green, blue, LinearSRGBColorSpace);
}
