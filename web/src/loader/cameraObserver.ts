import type { Camera } from "three";
import { Object3D } from "three";

/**
 * Calls back with each camera before a renderer visits the objects that follow this one in the scene. It has the
 * interface of a three.js LOD: the renderer calls no other object that draws nothing.
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
