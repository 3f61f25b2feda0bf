// How many pictures the material of a shape can have.

import type { AppearanceDescription } from "./description.ts";
import type { SceneElement } from "./element.ts";
import type { Warning } from "./nodes.ts";

/** Textures that a fragment shader of WebGL 2 can read on every GPU (MAX_TEXTURE_IMAGE_UNITS). */
const textureUnits = 16;
/** What is drawn behind a material with extensions, and the two cube maps of an EnvironmentLight. */
const unitsOfSurroundings = 3;
/** Pictures of an appearance, its cube map included. */
export const maxPictures = textureUnits - unitsOfSurroundings;

/** The appearance without the pictures beyond `maxPictures`, the last of its textures, with one warning. */
export function withinPictureLimit(
  appearance: AppearanceDescription,
  element: SceneElement | undefined,
  warnings: Warning[],
): AppearanceDescription {
  const { textures, cubeMap } = appearance;
  const count = maxPictures - (cubeMap ? 1 : 0);
  if (textures.length <= count) return appearance;
  const others = textures.slice(count).map(({ role }) => role);
  const limit = `more than ${maxPictures} textures, which GPUs need not be able to draw at once`;
  if (element) warnings.push({ element, message: `has ${limit}; left out: ${others.join(", ")}` });
  return { ...appearance, textures: textures.slice(0, count) };
}
