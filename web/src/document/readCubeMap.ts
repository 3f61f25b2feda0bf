// Reads the nodes of cube maps, and EnvironmentLight.

import type {
  AppearanceDescription,
  CubeMapDescription,
  CubeMapDirection,
  CubeMapPicture,
  EnvironmentLightDescription,
} from "./description.ts";
import { panoramaSides } from "./description.ts";
import type { SceneElement } from "./element.ts";
import { lowerNameOf } from "./element.ts";
import type { Warning } from "./nodes.ts";
import { nodeFields, readFields } from "./nodes.ts";
import type { ChildrenOf } from "./readImage.ts";
import { edgeToEdge, fieldOf, isTexture, readImageOf } from "./readImage.ts";
import { entryOf } from "./tables.ts";

/** The number of spherical harmonics times that of color channels. */
const coefficientCount = 27;

export function isCubeMap(child: SceneElement): boolean {
  return ["imagecubemaptexture", "composedcubemaptexture", "generatedcubemaptexture"].includes(lowerNameOf(child));
}

/** Undefined for a cube map without pictures, unless it is generated. */
export function readCubeMap(
  element: SceneElement,
  childrenOf: ChildrenOf,
  warnings: Warning[],
): CubeMapDescription | undefined {
  if (lowerNameOf(element) === "generatedcubemaptexture") return readGenerated(element, warnings);
  const pictures =
    lowerNameOf(element) === "imagecubemaptexture"
      ? wholePicture(element, childrenOf, warnings)
      : sidesOf(element, childrenOf, warnings);
  return pictures.length > 0 ? { pictures } : undefined;
}

/** Faces are at most this wide, in texels. */
const maxGeneratedSize = 1024;

/** Undefined for one that is never to be drawn. */
function readGenerated(element: SceneElement, warnings: Warning[]): CubeMapDescription | undefined {
  const { size, update } = readFields(element, nodeFields.GeneratedCubeMapTexture, warnings);
  const mode = update.trim().toUpperCase();
  if (mode !== "ALWAYS" && mode !== "NEXT_FRAME_ONLY") return undefined;
  const exponent = Math.round(Math.log2(Math.min(Math.max(size, 1), maxGeneratedSize)));
  return { pictures: [], generated: { size: 2 ** exponent, isUpdatedAlways: mode === "ALWAYS" } };
}

function wholePicture(element: SceneElement, childrenOf: ChildrenOf, warnings: Warning[]): CubeMapPicture[] {
  const image = readImageOf(element, childrenOf, warnings);
  // Coarser levels are made of the sides of the cube.
  return image ? [{ ...image, role: "whole", sampling: { ...image.sampling, ...edgeToEdge, hasMipmaps: false } }] : [];
}

/** The pictures of a ComposedCubeMapTexture, whose containerField says the side. */
function sidesOf(element: SceneElement, childrenOf: ChildrenOf, warnings: Warning[]): CubeMapPicture[] {
  const textures = childrenOf(element).filter(isTexture);
  const pictures = panoramaSides.flatMap((role) => {
    const texture = textures.find((each) => [role, `${role}texture`].includes(fieldOf(each)));
    const image = texture && readImageOf(texture, childrenOf, warnings);
    return image ? [{ ...image, role, sampling: { ...image.sampling, ...edgeToEdge } }] : [];
  });
  const missing = panoramaSides.filter((side) => !pictures.some(({ role }) => role === side));
  if (missing.length > 0)
    warnings.push({ element, message: `has no picture for ${missing.join(", ")}, which stays black` });
  return pictures;
}

const directionOfMode: Readonly<Record<string, CubeMapDirection>> = {
  CAMERASPACEREFLECTIONVECTOR: "cameraReflection",
  CAMERASPACENORMAL: "cameraNormal",
  CAMERASPACEPOSITION: "cameraPosition",
};

/**
 * The appearance with the direction in which a TextureCoordinateGenerator of the geometry, `generator`, has its cube
 * map read.
 */
export function withCubeMapDirection(
  appearance: AppearanceDescription,
  generator: SceneElement | undefined,
  warnings: Warning[],
): AppearanceDescription {
  if (generator === undefined) return appearance;
  const { mode } = readFields(generator, nodeFields.TextureCoordinateGenerator, []);
  const direction = entryOf(directionOfMode, mode);
  const { cubeMap } = appearance;
  if (cubeMap === undefined || direction === undefined) {
    if (direction !== undefined && appearance.textures.length > 0)
      warnings.push({
        element: generator,
        message: `mode="${mode}" is approximated for textures that are no cube maps`,
      });
    return appearance;
  }
  return { ...appearance, cubeMap: { ...cubeMap, direction } };
}

/** `element`: the node's identity; `node`: the element with its fields. */
export function readEnvironmentLight(
  element: SceneElement,
  node: SceneElement,
  childrenOf: ChildrenOf,
  warnings: Warning[],
): EnvironmentLightDescription {
  const fields = readFields(node, nodeFields.EnvironmentLight, warnings);
  const cubeMapIn = (field: string) => {
    const element = childrenOf(node).find((child) => isCubeMap(child) && fieldOf(child) === field);
    if (element === undefined) return undefined;
    const cubeMap = readCubeMap(element, childrenOf, warnings);
    if (cubeMap?.generated === undefined) return cubeMap;
    warnings.push({ element, message: "shows its surroundings on shapes only, not in an EnvironmentLight" });
    return undefined;
  };
  const { diffuseCoefficients } = fields;
  const { length } = diffuseCoefficients;
  const hasCoefficients = length >= coefficientCount;
  if (!hasCoefficients && length > 0)
    warnings.push({
      element: node,
      message: `diffuseCoefficients has ${length} numbers of ${coefficientCount}; they are not used`,
    });
  const [specular, diffuse] = [cubeMapIn("speculartexture"), cubeMapIn("diffusetexture")];
  return {
    kind: "environmentLight",
    element,
    ...fields,
    specular: specular ?? diffuse,
    diffuse,
    diffuseCoefficients: hasCoefficients ? diffuseCoefficients.slice(0, coefficientCount) : [],
  };
}
