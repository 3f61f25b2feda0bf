// The bounds of a scene's subtrees. They are computed when somebody asks for them, and then only for nodes that have
// changed since, in place: a scene may move a thousand shapes in every frame.

import { Vector3 } from "three";
import type { Box3 } from "three";
import { isDrawable, setTransformedBox, unionOfAllRotations } from "./bounds.ts";
import type { NodeInstance } from "./nodeInstance.ts";

const center = new Vector3();

/**
 * The bounds of the visible shapes at and below a node, in scene coordinates; empty where there are none. Not to be
 * changed.
 */
export function boundsOf(around: NodeInstance): Readonly<Box3> {
  const node = innermostOf(around);
  const { bounds } = node;
  if (node.areBoundsCurrent) return bounds;
  node.areBoundsCurrent = true;
  setOwnBounds(node);
  if (!isDrawable(bounds)) bounds.makeEmpty();
  return bounds;
}

/** The node whose bounds are those of a node: groups of one child, such as most Transforms, have no bounds of their own. */
function innermostOf(around: NodeInstance): NodeInstance {
  let node = around;
  for (;;) {
    const { description, children, box } = node;
    const [child] = children;
    if (description.kind !== "group" || child === undefined || children.length > 1 || box || description.billboardAxis)
      return node;
    node.areBoundsCurrent = true;
    node = child;
  }
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
