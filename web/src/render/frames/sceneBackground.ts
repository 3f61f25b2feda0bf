// The bound background of a scene: sky, ground and panorama. It turns with the groups around its node, and neither
// moves nor scales with them. A single opaque colour clears the canvas; meshes are those of the part "environment".

import type { Scene, Texture } from "three";
import { Color, Group, Matrix4 } from "three";
import type { BackgroundDescription, PanoramaSide } from "../../document/description.ts";
import type { SceneElement } from "../../document/element.ts";
import { BindingStack } from "../../navigation/bindingStack.ts";
import type { BackgroundInstance } from "../../scene/instances.ts";
import { rotationIn } from "../../scene/transforms.ts";
import { hasPlainSky } from "../../scene/environmentIn.ts";
import type { BackgroundMesh } from "../environment/lateEnvironment.ts";
import { lateEnvironment } from "../environment/lateEnvironment.ts";
import { setColor } from "../lights/linearColor.ts";

export class SceneBackground {
  readonly #scene: Scene;
  readonly #stack = new BindingStack<SceneElement>();
  readonly #root = new Group();
  readonly #pictures = new Map<PanoramaSide, BackgroundMesh>();
  #instances: readonly BackgroundInstance[] = [];
  #sky: BackgroundMesh | undefined;
  #drawn: BackgroundDescription | undefined;

  constructor(scene: Scene) {
    this.#scene = scene;
    this.#root.matrixAutoUpdate = false;
    scene.add(this.#root);
  }

  /** Undefined where the scene has none: the page shows through. */
  get bound(): BackgroundInstance | undefined {
    return this.#instances.find(({ element }) => element === this.#stack.bound);
  }

  /** `instances`: the backgrounds of the scene, in document order. */
  follow(instances: readonly BackgroundInstance[]): void {
    this.#instances = instances;
    this.#stack.follow(instances);
    this.#update();
  }

  /** X3D's set_bind. Returns false if the element is no background of the scene. */
  bind(element: SceneElement, isBound: boolean): boolean {
    if (!this.#instances.some((instance) => instance.element === element)) return false;
    if (isBound) this.#stack.bind(element);
    else this.#stack.unbind(element);
    this.#update();
    return true;
  }

  /** Sets a picture of the bound background; undefined: sky and ground are visible in its place. */
  setPicture(side: PanoramaSide, texture: Texture | undefined): void {
    dispose(this.#pictures.get(side));
    this.#pictures.delete(side);
    const mesh = texture && lateEnvironment.added?.picture(side, texture);
    if (mesh === undefined) return;
    this.#pictures.set(side, mesh);
    this.#root.add(mesh);
    this.#root.updateMatrixWorld(true);
  }

  dispose(): void {
    dispose(this.#sky);
    for (const mesh of this.#pictures.values()) dispose(mesh);
    this.#pictures.clear();
  }

  #update(): void {
    const { bound } = this;
    this.#root.matrix.copy(bound ? rotationIn(bound.sceneFromBackground) : new Matrix4());
    if (bound?.background !== this.#drawn) {
      this.#drawn = bound?.background;
      dispose(this.#sky);
      const isPlain = this.#drawn !== undefined && hasPlainSky(this.#drawn);
      this.#sky = this.#drawn && !isPlain ? lateEnvironment.added?.sky(this.#drawn) : undefined;
      if (this.#sky) this.#root.add(this.#sky);
      // scene.background survives a lost context; the renderer's clear colour does not.
      this.#scene.background = isPlain ? colorOf(this.#drawn) : null;
    }
    this.#root.updateMatrixWorld(true);
  }
}

function colorOf(background: BackgroundDescription | undefined): Color {
  const color = new Color();
  setColor(color, background?.sky[0]?.color ?? [0, 0, 0]);
  return color;
}

function dispose(mesh: BackgroundMesh | undefined): void {
  mesh?.removeFromParent();
  mesh?.geometry.dispose();
  mesh?.material.dispose();
}
