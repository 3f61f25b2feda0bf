import type { Object3D } from "three";

/** Whether the object and all its parents are visible. */
export function isVisibleInScene(object: Object3D | null): boolean {
  return object === null || (object.visible && isVisibleInScene(object.parent));
}
