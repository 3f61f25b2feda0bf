// three.js visits all children of visible groups before every frame, also where nothing is drawn below them, as in the
// thousands of groups of a scene whose shapes are drawn by batches. Groups of a page's scene therefore know their
// parents, but are among the parents' children only while there is something to visit.

import type { Object3D } from "three";
import { Group } from "three";

/** A group that three.js visits while it has children. */
export class VisitedGroup extends Group {}

/** Puts a group without children below a parent. */
export function addUnvisited(group: Object3D, parent: Object3D): void {
  if (group instanceof VisitedGroup) group.parent = parent;
  else parent.add(group);
}

/** Adds objects to a group, which three.js visits from now on. */
export function addVisited(group: Object3D, objects: readonly Object3D[]): void {
  if (objects.length === 0) return;
  const hadChildren = group.children.length > 0;
  group.add(...objects);
  if (!hadChildren && group instanceof VisitedGroup && group.parent) addVisited(group.parent, [group]);
}

/** Removes an object from its parent. Groups that have no children then are not visited any more. */
export function removeVisited(object: Object3D): void {
  const { parent: group } = object;
  object.removeFromParent();
  if (!(group instanceof VisitedGroup) || group.children.length > 0 || !group.parent) return;
  const { parent } = group;
  removeVisited(group);
  group.parent = parent;
}
