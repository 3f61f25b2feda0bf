// The bounds of a scene's subtrees. They are computed when somebody asks for them, and then only for nodes that have
// changed since, in place: a scene may move a thousand shapes in every frame.

import { Box3, Vector3 } from "three";
import { unionOfAllRotations } from "./bounds.ts";
import type { FlatBox } from "./flatBox.ts";
import { extend, isDrawable, isEmpty, makeEmpty, setBox3, setFlatBox, setTransformed } from "./flatBox.ts";
import type { NodeInstance } from "./nodeInstance.ts";

const center = new Vector3();
const rotated = new Box3();

/** The bounds of the visible shapes at and below a node, in scene coordinates; empty where there are none. */
export function boundsOf(node: NodeInstance): Box3 {
  return setBox3(new Box3(), flatBoundsOf(node));
}

/** Not to be changed. */
function flatBoundsOf(around: NodeInstance): FlatBox {
  let node = around;
  while (node.boundingChild) {
    node.areBoundsCurrent = true;
    node = node.boundingChild;
  }
  const { bounds } = node;
  if (node.areBoundsCurrent) return bounds;
  node.areBoundsCurrent = true;
  setOwnBounds(node);
  if (!isDrawable(bounds)) makeEmpty(bounds);
  return bounds;
}

/**
 * Groups of one child, such as most Transforms, have no bounds of their own. Call when the group's children, its box or
 * its description have changed.
 */
export function setBoundingChild(group: NodeInstance): void {
  const { description, children, box } = group;
  const isPlainGroup = description.kind === "group" && !description.billboardAxis && box === undefined;
  group.boundingChild = isPlainGroup && children.length === 1 ? children[0] : undefined;
}

/** The node, or one below it, has moved. */
export function invalidateBounds(node: NodeInstance): void {
  for (let at: NodeInstance | undefined = node; at?.areBoundsCurrent === true; at = at.parent)
    at.areBoundsCurrent = false;
}

function setOwnBounds({ description, inherited, sceneFromNode, ownBox, box, children, bounds }: NodeInstance): void {
  const isUnbounded = inherited?.isUnbounded === true;
  if (ownBox && isUnbounded) {
    setTransformed(bounds, sceneFromNode, ownBox);
    return;
  }
  makeEmpty(bounds);
  if (description.kind !== "group") return;
  if (isUnbounded && box) setFlatBox(bounds, box);
  if (!isDrawable(bounds)) {
    makeEmpty(bounds);
    for (const child of children) extend(bounds, flatBoundsOf(child));
  }
  if (!description.billboardAxis || isEmpty(bounds)) return;
  unionOfAllRotations(setBox3(rotated, bounds), center.setFromMatrixPosition(sceneFromNode));
  setFlatBox(bounds, rotated);
}
