// Textures of an appearance that have been loaded, by their role.

import type { Texture } from "three";
import type { AppearanceDescription, TextureRole } from "../../document/description.ts";
import { texCoordRoles } from "../../stage/attributeRows.ts";
import type { Stage } from "../../stage/stage.ts";

/** A texture that is applied to a surface. */
export interface SurfaceTexture {
  readonly texture: Texture;
  readonly hasAlpha: boolean;
}

/** `cubeMap`: that of the appearance. */
export type SurfaceTextureRole = TextureRole | "cubeMap";
export type SurfaceTextures = ReadonlyMap<SurfaceTextureRole, SurfaceTexture>;

/** The textures whose texture coordinates a stage has; the others cannot be applied yet. */
export function applicableTextures(
  { attributes }: Pick<Stage, "attributes">,
  { textures }: Pick<AppearanceDescription, "textures">,
  surfaceTextures: SurfaceTextures,
): SurfaceTextures {
  const missing = textures.filter(
    ({ texCoordSet }) => attributes[texCoordRoles[texCoordSet] ?? "texCoord"] === undefined,
  );
  if (missing.length === 0) return surfaceTextures;
  const rolesMissing: readonly SurfaceTextureRole[] = missing.map(({ role }) => role);
  return new Map(Array.from(surfaceTextures).filter(([role]) => !rolesMissing.includes(role)));
}
