// The EnvironmentLight of a scene: the first that is on.

import type { CubeTexture, Texture } from "three";
import type { CubeMapDescription, CubeMapRole, ImageDescription } from "../../document/description.ts";
import type { SceneElement } from "../../document/element.ts";
import type { EnvironmentLightInstance } from "../../scene/instances.ts";
import type { CubeMaps, JoinedCubeMap } from "./cubeMaps.ts";
import { cubeMapKeyOf } from "./cubeMaps.ts";
import type { EnvironmentUniforms } from "./effectUniforms.ts";

const uses = ["specular", "diffuse"] as const;
type Use = (typeof uses)[number];

/** A picture of one of its cube maps. */
export type EnvironmentRole = `${Use}.${CubeMapRole}`;

export interface EnvironmentPicture extends ImageDescription {
  readonly role: EnvironmentRole;
}

interface UsedCubeMap {
  readonly key: string;
  readonly joined: JoinedCubeMap;
}

export class SceneEnvironment {
  readonly #cubeMaps: CubeMaps;
  readonly #uniforms: EnvironmentUniforms;
  readonly #used = new Map<Use, UsedCubeMap>();
  readonly #loaded = new Map<EnvironmentRole, Texture>();
  #element: SceneElement | undefined;
  #pictures: readonly EnvironmentPicture[] = [];

  constructor(cubeMaps: CubeMaps, uniforms: EnvironmentUniforms) {
    this.#cubeMaps = cubeMaps;
    this.#uniforms = uniforms;
  }

  /** The pictures to be loaded; the same list while they stay the same. */
  get pictures(): readonly EnvironmentPicture[] {
    return this.#pictures;
  }

  get element(): SceneElement | undefined {
    return this.#element;
  }

  /** The EnvironmentLights of a scene. */
  follow([instance]: readonly EnvironmentLightInstance[]): void {
    this.#element = instance?.light.element;
    const changed = uses.filter((use) => this.#followUse(use, instance?.light[use]));
    if (changed.length === 0) return;
    this.#pictures = uses.flatMap((use) =>
      (instance?.light[use]?.pictures ?? []).map((each) => ({ ...each, role: `${use}.${each.role}` as const })),
    );
  }

  setPicture(role: EnvironmentRole, texture: Texture | undefined): void {
    if (texture) this.#loaded.set(role, texture);
    else this.#loaded.delete(role);
    const [use, side] = role.split(".") as [Use, CubeMapRole];
    this.#used.get(use)?.joined.setPicture(side, texture);
  }

  /** Whether another cube map is used. */
  #followUse(use: Use, cubeMap: CubeMapDescription | undefined): boolean {
    const before = this.#used.get(use);
    const key = cubeMap && cubeMapKeyOf(cubeMap);
    if (before?.key === key) return false;
    before?.joined.leave();
    this.#used.delete(use);
    this.#setTexture(use, undefined);
    if (cubeMap && key !== undefined) {
      const joined = this.#cubeMaps.join(cubeMap, (texture) => {
        this.#setTexture(use, texture);
      });
      this.#used.set(use, { key, joined });
      for (const { role } of cubeMap.pictures) joined.setPicture(role, this.#loaded.get(`${use}.${role}`));
    }
    return true;
  }

  #setTexture(use: Use, texture: CubeTexture | undefined): void {
    const { environmentSpecular, environmentDiffuse, environmentLevels } = this.#uniforms;
    (use === "specular" ? environmentSpecular : environmentDiffuse).value = texture ?? null;
    const { width = 0 } = (texture?.images as readonly { width: number }[] | undefined)?.[0] ?? {};
    environmentLevels.value[use === "specular" ? "x" : "y"] = texture ? Math.floor(Math.log2(width)) : -1;
  }
}
