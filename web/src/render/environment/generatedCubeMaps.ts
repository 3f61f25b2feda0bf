// Cube maps that are drawn from the scene around a shape (GeneratedCubeMapTexture, ISO/IEC 19775-1, 34.4.3).

import type { CubeTexture, Object3D, Scene, Sphere, Vector3, WebGLRenderer } from "three";
import { Camera, CubeCamera, LinearMipmapLinearFilter, LinearSRGBColorSpace, WebGLCubeRenderTarget } from "three";
import type { GeneratedCubeMap } from "../../document/description.ts";

/** A shape that shows its surroundings. */
export interface GeneratedCubeMapUser {
  /** In scene coordinates; undefined while the shape is not in the scene. */
  center(): Vector3 | undefined;
  /** What is not seen in it: the shape's own surface. */
  objects(): Iterable<Object3D>;
  /** Called before the texture is drawn for the first time. */
  onTexture(texture: CubeTexture): void;
}

interface Generated {
  readonly description: GeneratedCubeMap;
  readonly user: GeneratedCubeMapUser;
  target: WebGLCubeRenderTarget | undefined;
  isStale: boolean;
}

/** The nearest plane of the cameras, as a share of the farthest. */
const nearShare = 1e-3;

export class GeneratedCubeMaps {
  readonly #all = new Set<Generated>();

  /** Returns the function that removes the cube map; its texture must no longer be used then. */
  add(description: GeneratedCubeMap, user: GeneratedCubeMapUser): () => void {
    const generated: Generated = { description, user, target: undefined, isStale: true };
    this.#all.add(generated);
    return () => {
      this.#all.delete(generated);
      generated.target?.dispose();
    };
  }

  /** Call when a part of the scene has been loaded: all cube maps are to be drawn again. */
  invalidate(): void {
    for (const each of this.#all) each.isStale = true;
  }

  /** Call before a frame. `cull` is called for each camera that draws `scene`, which fills `sphere`. */
  update(renderer: WebGLRenderer, scene: Scene, sphere: Sphere, cull: (camera: Camera, size: number) => void): void {
    for (const generated of this.#all) {
      const { description, user } = generated;
      const center = user.center();
      if (center === undefined || !(generated.isStale || description.isUpdatedAlways)) continue;
      generated.isStale = false;
      if (generated.target === undefined) {
        generated.target = makeTarget(Math.min(description.size, renderer.capabilities.maxCubemapSize));
        user.onTexture(generated.target.texture);
      }
      const hidden = Array.from(user.objects()).filter(({ visible }) => visible);
      for (const object of hidden) object.visible = false;
      draw(renderer, scene, generated.target, center, sphere, cull);
      for (const object of hidden) object.visible = true;
    }
  }

  dispose(): void {
    for (const { target } of this.#all) target?.dispose();
    this.#all.clear();
  }
}

function makeTarget(size: number): WebGLCubeRenderTarget {
  return new WebGLCubeRenderTarget(size, {
    generateMipmaps: true,
    minFilter: LinearMipmapLinearFilter,
    colorSpace: LinearSRGBColorSpace, // as the canvas, so that both are drawn by the same programs
  });
}

function draw(
  renderer: WebGLRenderer,
  scene: Scene,
  target: WebGLCubeRenderTarget,
  center: Vector3,
  sphere: Sphere,
  cull: (camera: Camera, size: number) => void,
): void {
  const far = center.distanceTo(sphere.center) + sphere.radius;
  const cubeCamera = new CubeCamera(nearShare * far, far, target);
  cubeCamera.coordinateSystem = renderer.coordinateSystem;
  cubeCamera.updateCoordinateSystem();
  cubeCamera.position.copy(center);
  cubeCamera.updateMatrixWorld(true);
  const cameras = cubeCamera.children.filter((child) => child instanceof Camera);
  cameras.forEach((camera, face) => {
    // Each rendering into a texture with mipmaps makes them.
    target.texture.generateMipmaps = face === cameras.length - 1;
    cull(camera, target.width);
    renderer.setRenderTarget(target, face);
    renderer.render(scene, camera);
  });
  renderer.setRenderTarget(null);
}
