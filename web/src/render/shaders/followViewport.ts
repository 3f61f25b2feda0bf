// Keeps the uniform `viewport` of materials, which wide lines and spaced points read.

import type { BufferGeometry, Camera, Material, Scene, Vector4, WebGLRenderer } from "three";

/** Updates the viewport uniform before a material is drawn. */
export function followViewport(material: Material, viewport: { readonly value: Vector4 }): void {
  const originalCallback = material.onBeforeRender.bind(material);
  material.onBeforeRender = (
    renderer: WebGLRenderer,
    scene: Scene,
    camera: Camera,
    geometry: BufferGeometry,
    object,
    group,
  ) => {
    originalCallback(renderer, scene, camera, geometry, object, group);
    renderer.getCurrentViewport(viewport.value);
  };
}
