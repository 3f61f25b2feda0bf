import type { Camera } from "three";
import { Object3D } from "three";

/**
 * Hears of each camera before a renderer looks at what stands after it in the scene.
 * three.js asks LODs so, and nothing else that has nothing to draw.
 */
export class CameraObserver extends Object3D {
  readonly autoUpdate = true;
  readonly isLOD = true;
  readonly update: (camera: Camera) => void;

  constructor(onCamera: (camera: Camera) => void) {
    super();
    this.update = onCamera;
  }
}
