import type { Object3D } from "three";

/** It and all that it stands in are visible. */
export function isVisibleInScene(object: Object3D | null): boolean {
  return object === null || (object.visible && isVisibleInScene(object.parent));
}
