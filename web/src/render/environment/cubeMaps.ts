// The cube maps of a scene: one for each set of pictures, however many shapes and lights use it.

import type { CubeTexture, Texture, WebGLRenderer } from "three";
import type { CubeMapDescription, CubeMapRole } from "../../document/description.ts";
import { CubeFaceDrawing, CubeMap } from "./cubeMap.ts";

/** `texture`: undefined while no picture has been drawn. */
type TextureListener = (texture: CubeTexture | undefined) => void;

/** A cube map as one of its users has joined it. */
export interface JoinedCubeMap {
  /** Sets a picture that the user has loaded; undefined: the user has it no more. */
  setPicture(role: CubeMapRole, texture: Texture | undefined): void;
  /** Leaves the cube map: its texture must no longer be used. */
  leave(): void;
}

interface User {
  readonly pictures: Map<CubeMapRole, Texture>;
  readonly onTexture: TextureListener;
}

interface SharedCubeMap {
  readonly map: CubeMap;
  readonly users: Set<User>;
}

/** Cube maps of equal keys are one. */
export function cubeMapKeyOf({ pictures }: CubeMapDescription): string {
  return JSON.stringify(pictures);
}

export class CubeMaps {
  readonly #shared = new Map<string, SharedCubeMap>();
  #drawing: CubeFaceDrawing | undefined;

  /** `onTexture` is called in `update`, when the texture has been made or replaced. */
  join(description: CubeMapDescription, onTexture: TextureListener): JoinedCubeMap {
    const key = cubeMapKeyOf(description);
    const shared = this.#shared.get(key) ?? { map: new CubeMap(), users: new Set() };
    this.#shared.set(key, shared);
    const user: User = { pictures: new Map(), onTexture };
    shared.users.add(user);
    if (shared.map.texture) onTexture(shared.map.texture);
    return {
      setPicture(role, texture) {
        if (texture) user.pictures.set(role, texture);
        else user.pictures.delete(role);
        shared.map.setPicture(role, texture ?? pictureOf(shared, role));
      },
      leave: () => {
        shared.users.delete(user);
        if (shared.users.size > 0) return;
        shared.map.dispose();
        this.#shared.delete(key);
      },
    };
  }

  /** Call before a frame: draws the cube maps whose pictures have changed. */
  update(renderer: WebGLRenderer): void {
    for (const { map, users } of this.#shared.values()) {
      this.#drawing ??= new CubeFaceDrawing();
      if (map.update(renderer, this.#drawing)) for (const { onTexture } of users) onTexture(map.texture);
    }
  }

  dispose(): void {
    for (const { map } of this.#shared.values()) map.dispose();
    this.#shared.clear();
    this.#drawing?.dispose();
  }
}

/** The picture of any user. */
function pictureOf({ users }: SharedCubeMap, role: CubeMapRole): Texture | undefined {
  for (const { pictures } of users) if (pictures.has(role)) return pictures.get(role);
  return undefined;
}
