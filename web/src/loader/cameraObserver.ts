import type { Camera } from "three";
import { Object3D } from "three";

/**
 * Is called with each camera before a renderer visits the objects after it in the scene.
 * It passes for a LOD: three.js updates nothing else that draws nothing.
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
