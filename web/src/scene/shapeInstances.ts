// Counts the instances of shapes in a scene.

import type { GroupDescription } from "../document/description.ts";

const counts = new WeakMap<GroupDescription, number>();

/** The number of instances of shapes in a group, hidden ones included. Counts a group anew only if it has changed. */
export function shapeInstancesIn(group: GroupDescription): number {
  const known = counts.get(group);
  if (known !== undefined) return known;
  let count = 0;
  for (const child of group.children) {
    if (child.kind === "shape") count += 1;
    else if (child.kind === "group") count += shapeInstancesIn(child);
  }
  counts.set(group, count);
  return count;
}
