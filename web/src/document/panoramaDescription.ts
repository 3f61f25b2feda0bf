// Pictures all around a point: the sides of a background, and cube maps.

import type { ImageDescription } from "./imageDescription.ts";

/** The sides of a panorama: -z, z, -x, x, y and -y of its node's coordinates. */
export const panoramaSides = ["front", "back", "left", "right", "top", "bottom"] as const;
export type PanoramaSide = (typeof panoramaSides)[number];

/** A picture that fills one side of a cube around the viewer. */
export interface PanoramaPicture extends ImageDescription {
  readonly role: PanoramaSide;
}

/** A side of a cube map, or all of them in one picture. */
export type CubeMapRole = PanoramaSide | "whole";

export function isCubeMapRole(role: string): role is CubeMapRole {
  return role === "whole" || (panoramaSides as readonly string[]).includes(role);
}

export interface CubeMapPicture extends ImageDescription {
  readonly role: CubeMapRole;
}

/** A cube map that shows the scene around its shape. */
export interface GeneratedCubeMap {
  /** Edge of a face in texels: a power of two. */
  readonly size: number;
  /** Whether it is drawn for each frame; else when something has been loaded. */
  readonly isUpdatedAlways: boolean;
}

/** The pictures of a cube map: at most one of each role; none of one that is generated. */
export interface CubeMapDescription {
  readonly pictures: readonly CubeMapPicture[];
  readonly generated?: GeneratedCubeMap;
}

/**
 * The direction in which a surface reads its cube map. `reflection`: the mirrored view, in the scene's axes. The others
 * are those of X3D's TextureCoordinateGenerator, in the camera's axes.
 */
export const cubeMapDirections = ["reflection", "cameraReflection", "cameraNormal", "cameraPosition"] as const;
export type CubeMapDirection = (typeof cubeMapDirections)[number];

/** The cube map of an appearance, which is multiplied by the material's main color. */
export interface AppearanceCubeMap extends CubeMapDescription {
  readonly direction: CubeMapDirection;
}
