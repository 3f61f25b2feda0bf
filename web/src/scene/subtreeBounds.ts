// The bounds of a scene's subtrees. They are computed when somebody asks for them, and then only for nodes that have
// changed since, in place: a scene may move a thousand shapes in every frame.

import { Vector3 } from "three";
import type { Box3 } from "three";
import { isDrawable, setTransformedBox, unionOfAllRotations } from "./bounds.ts";
import type { NodeInstance } from "./nodeInstance.ts";

const center = new Vector3();

/** The bounds of the visible shapes at and below a node, in scene coordinates; empty where there are none. */
export function boundsOf(node: NodeInstance): Box3 {
  const { bounds } = node;
  if (node.areBoundsCurrent) return bounds;
  node.areBoundsCurrent = true;
  setOwnBounds(node);
  if (!isDrawable(bounds)) bounds.makeEmpty();
  return bounds;
}

/** The node, or one below it, has moved. */
export function invalidateBounds(node: NodeInstance): void {
  for (let at: NodeInstance | undefined = node; at?.areBoundsCurrent === true; at = at.parent)
    at.areBoundsCurrent = false;
}

function setOwnBounds({ description, inherited, sceneFromNode, box, children, bounds }: NodeInstance): void {
  const isUnbounded = inherited?.isUnbounded === true;
  if (description.kind === "shape" && description.box && description.contributesToBounds && isUnbounded) {
    setTransformedBox(bounds, sceneFromNode, description.box);
    return;
  }
  bounds.makeEmpty();
  if (description.kind !== "group") return;
  if (isUnbounded && box && isDrawable(box)) bounds.copy(box);
  else for (const child of children) bounds.union(boundsOf(child));
  if (description.billboardAxis && !bounds.isEmpty())
    unionOfAllRotations(bounds, center.setFromMatrixPosition(sceneFromNode));
}
