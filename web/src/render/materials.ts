// Materials of X3D with the lighting of X3D (ISO/IEC 19775-1, 17.2.2): for each
// light, diffuse N.L + specular (N.H)^(128 shininess), plus its ambient share.
//
// Colours are not converted: a document's numbers are what the screen gets, and
// light adds up in those numbers, as X3D's equations are written and as X3DOM
// draws them. A grey of 0.5 that faces the headlight is 128 on the screen.
// (three.js by default lights in linear space and divides by pi; hence a chunk
// of our own, and `outputColorSpace` linear in the renderer.)

import type { Color, Vector2 } from "three";
import { DoubleSide, FrontSide, LinearSRGBColorSpace, MeshBasicMaterial, MeshPhongMaterial } from "three";
import type { MaterialDescription, Vec3 } from "../document/description.ts";
import type { VertexUniforms } from "./vertexChunk.ts";
import { imageNormalsDefine, imageVerticesDefine, readVerticesIn, replaceEach } from "./vertexChunk.ts";

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

// Points that stand for a surface to come cannot be lit yet; they are darker the
// farther they are, so that they show a shape and not just its outline.
const farnessDefine = "SHADE_BY_FARNESS";
const farnessVertex = /* glsl */ `
#ifdef ${farnessDefine}
  vFarness = clamp((-mvPosition.z - depthRange.x) / (depthRange.y - depthRange.x), 0.0, 1.0);
#endif
`;
const farnessFragment = /* glsl */ `
#ifdef ${farnessDefine}
  diffuseColor.rgb *= 1.0 - 0.75 * smoothstep(0.15, 0.85, vFarness);
#endif
`;
const farnessDeclarations = /* glsl */ `
#ifdef ${farnessDefine}
  uniform vec2 depthRange;
  varying float vFarness;
#endif
`;

/** Unlit for points and lines, by distance for points that stand in for a surface, flat where there are no normals (yet). */
export type Shading = "unlit" | "distance" | "flat" | "smooth";

/** Uniforms that everything in a scene shares. */
export interface SceneUniforms {
  readonly pointSize: { value: number };
  /** Distances along the view between which the scene lies. */
  readonly depthRange: { value: Vector2 };
}

/** What colours the vertices bring: those with alpha blend. */
export type VertexColors = "none" | "rgb" | "rgba";

export interface MaterialRequest {
  readonly shading: Shading;
  readonly colors: VertexColors;
  /** False: both sides are seen. */
  readonly solid: boolean;
  /** How vertices are found, as gridDefinesOf says it. */
  readonly vertexDefines: Readonly<Record<string, string>>;
  /** How normals are stored, as normalDefinesOf says it. */
  readonly normalDefines: Readonly<Record<string, string>>;
  /** Vertices come from images, not from buffers. */
  readonly areImages: boolean;
  readonly uniforms: VertexUniforms;
  readonly shared: SceneUniforms;
}

export type PatchMaterial = (MeshPhongMaterial | MeshBasicMaterial) & { userData: { ambientIntensity?: { value: number } } };

export function makeMaterial(request: MaterialRequest, description: MaterialDescription): PatchMaterial {
  const { shading, colors, solid, areImages, vertexDefines, normalDefines, uniforms, shared } = request;
  const ambientIntensity = { value: 0 };
  const material: PatchMaterial = shading === "unlit" || shading === "distance" ? new MeshBasicMaterial()
    : new MeshPhongMaterial({ flatShading: shading === "flat" });
  material.side = solid ? FrontSide : DoubleSide;
  material.vertexColors = colors !== "none";
  material.defines = {
    ...(areImages && { [imageVerticesDefine]: "" }),
    ...(areImages && shading === "smooth" && { [imageNormalsDefine]: "" }),
    ...vertexDefines,
    ...(shading === "smooth" && normalDefines),
    ...(shading === "distance" && { [farnessDefine]: "" }),
  };
  material.userData.ambientIntensity = ambientIntensity;
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, uniforms, { depthRange: shared.depthRange, ambientIntensity });
    readVerticesIn(shader);
    shader.vertexShader = farnessDeclarations + replaceEach(shader.vertexShader, [["#include <fog_vertex>", farnessVertex]]);
    shader.fragmentShader = farnessDeclarations + replaceEach(shader.fragmentShader, [
      ["#include <color_fragment>", `#include <color_fragment>\n${farnessFragment}`],
      ["#include <lights_phong_pars_fragment>", x3dLighting],
      ["#include <lights_phong_fragment>", materialFromUniforms],
    ]);
  };
  // The text of `onBeforeCompile` is the same for all, so programs are shared as they should be.
  material.customProgramCacheKey = () => "imgeo";
  applyMaterial(material, description, colors);
  return material;
}

/** Changes a material in place; colours of vertices stand in for the diffuse colour. */
export function applyMaterial(material: PatchMaterial, description: MaterialDescription, colors: VertexColors): void {
  const { diffuseColor, specularColor, emissiveColor, ambientIntensity, shininess, transparency } = description;
  const hasColors = colors !== "none";
  if (material instanceof MeshPhongMaterial) {
    setColor(material.color, hasColors ? [1, 1, 1] : diffuseColor);
    setColor(material.specular, specularColor);
    setColor(material.emissive, emissiveColor);
    material.shininess = shininess * 128;
  } else {
    // X3D shows unlit points in the emissive colour. Scans without one would be black on black.
    const isDark = emissiveColor.every((channel) => channel === 0);
    setColor(material.color, hasColors ? [1, 1, 1] : isDark ? diffuseColor : emissiveColor);
  }
  if (material.userData.ambientIntensity) material.userData.ambientIntensity.value = ambientIntensity;
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
