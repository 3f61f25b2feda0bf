// Textures of an appearance that have been loaded, by their role.

import type { Texture } from "three";
import type { TextureRole } from "../../document/description.ts";

/** A texture that is applied to a surface. */
export interface SurfaceTexture {
  readonly texture: Texture;
  readonly hasAlpha: boolean;
}

export type SurfaceTextures = ReadonlyMap<TextureRole, SurfaceTexture>;
export const noSurfaceTextures: SurfaceTextures = new Map();
