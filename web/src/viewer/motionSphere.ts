// The bounds of a scene at all moments of its animation, for views that show the whole motion.

import type { FieldChange } from "../animation/documentGraph.ts";
import type { SceneDescription } from "../document/description.ts";
import { sphereAround } from "../scene/bounds.ts";
import { InstanceTree } from "../scene/instanceTree.ts";
import { boundsOf } from "../scene/subtreeBounds.ts";
import { isOfPose } from "./drawnFields.ts";

/** Calls back with the values that fields receive at each moment. */
export type VisitMoments = (visit: (changes: readonly FieldChange[]) => void) => void;

/** The sphere around all visible shapes at rest and at all moments; undefined where no Transform moves. */
export function motionSphereOf(
  { root }: SceneDescription,
  visitMoments: VisitMoments,
): ReturnType<typeof sphereAround> | undefined {
  const tree = new InstanceTree().update(root);
  const box = boundsOf(tree.root);
  let moments = 0;
  visitMoments((changes) => {
    const poses = changes.filter(isOfPose);
    if (poses.length === 0) return;
    moments += 1;
    tree.move(poses);
    box.union(boundsOf(tree.root));
  });
  return moments > 0 && !box.isEmpty() ? sphereAround(box) : undefined;
}
