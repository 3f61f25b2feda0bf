// The tree of a scene's node instances, kept from one description of the scene to the next. A subtree is skipped where
// its description is the same object as before and its inherited state has not changed, so that an update costs as much
// as the changed nodes, their siblings and their ancestors.

import { Box3, Matrix4 } from "three";
import { deepEqual } from "../document/deepEqual.ts";
import type { GroupDescription, NodeDescription, TransformDescription, Vec3 } from "../document/description.ts";
import type { SceneElement } from "../document/element.ts";
import { setTransformedBox } from "./bounds.ts";
import type { FlatBox } from "./flatBox.ts";
import { flatBoxOf } from "./flatBox.ts";
import { EffectScope, sceneScope } from "./effectScope.ts";
import { matchChildren } from "./matchChildren.ts";
import type { InheritedState, MovingTransform, SubtreeSummary } from "./nodeInstance.ts";
import { emptySummary, NodeInstance } from "./nodeInstance.ts";
import { invalidateBounds, setBoundingChild } from "./subtreeBounds.ts";
import { dependsOnTransforms, groupSummary, leafSummary } from "./subtreeSummary.ts";
import { matrixOf, translate } from "./transforms.ts";

/** A field of a Transform has received a value of its type. */
export interface TransformChange {
  readonly element: SceneElement;
  readonly field: keyof TransformDescription;
  readonly value: readonly number[];
}

/** The weight of an HAnimDisplacer has received a value. */
export interface WeightChange {
  readonly element: SceneElement;
  readonly field: "weight";
  readonly value: number;
}

/** What is displayed without a description of the scene. */
export type PoseChange = TransformChange | WeightChange;

const noNodes: readonly NodeInstance[] = [];

/** Receives the events of each node; those of a parent come before those of its children. */
export interface InstanceTreeListener {
  onEnter(node: NodeInstance): void;
  /** The node's description or inherited state has changed. `hasMoved`: whether its transform has, too. */
  onChange(node: NodeInstance, hasMoved: boolean, previous: NodeDescription): void;
  /** `move` has changed the transform of the node or of one around it, and nothing else. */
  onMove(node: NodeInstance): void;
  onLeave(node: NodeInstance): void;
}

export class InstanceTree {
  readonly root: NodeInstance;
  readonly #listener: InstanceTreeListener | undefined;
  /** The instances of each Transform. */
  readonly #transforms = new Map<SceneElement, NodeInstance[]>();
  /**
   * The elements of earlier moves by the position of their changes, and the instances of each: a scene that moves sends
   * its changes in the same order in each frame. Emptied where the instances of a Transform change.
   */
  readonly #movedElements: SceneElement[] = [];
  readonly #movedInstances: (readonly NodeInstance[])[] = [];
  /** Used by `move`, and empty otherwise. */
  readonly #moved: NodeInstance[] = [];

  constructor(listener?: InstanceTreeListener) {
    this.#listener = listener;
    this.root = new NodeInstance(
      { kind: "group", visible: true, box: undefined, transform: undefined, children: [] },
      undefined,
    );
  }

  /** Updates the tree to this description of the scene. */
  update(root: GroupDescription): this {
    this.#updateNode(this.root, root, {
      sceneFromNode: this.root.inherited?.sceneFromNode ?? new Matrix4(),
      isVisible: true,
      isUnbounded: true,
      effectScope: sceneScope,
    });
    return this;
  }

  /** An instance of a Transform; undefined where the scene has none. */
  transformOf(element: SceneElement): NodeInstance | undefined {
    return this.#transforms.get(element)?.[0];
  }

  /**
   * Gives Transforms other values, without a description of the whole scene, which `update` needs much longer for. The
   * next description that `update` gets must have these values. Allocates nothing for nodes that have moved before:
   * matrices change in place. Weights are not the tree's: changes of other elements than Transforms are passed over.
   */
  move(changes: Iterable<PoseChange>): void {
    const moved = this.#moved;
    const isSummaryOld = new Set<NodeInstance>();
    let position = 0;
    for (const { element, field, value } of changes)
      for (const node of this.#instancesOf(element, position++)) {
        if (node.movingTransform === undefined) this.#ignoreBoxesAround(node, isSummaryOld);
        // The type of the field has been checked where its value comes from.
        if (field === "translation") movingTransformOf(node).translation = value as Vec3;
        else {
          (movingTransformOf(node) as Record<string, PoseChange["value"]>)[field] = value;
          node.needsComposing = true;
        }
        if (node.isMoved) continue;
        node.isMoved = true;
        moved.push(node);
      }
    for (const node of moved) {
      if (!node.isMoved || isBelowMoved(node)) continue;
      invalidateBounds(node);
      this.#moveNode(node, (node.parent ?? this.root).sceneFromNode);
      if (dependsOnTransforms(node.summary)) addWithParents(node.parent, isSummaryOld);
    }
    moved.length = 0;
    if (isSummaryOld.size > 0) mergeAgain(this.root, isSummaryOld);
  }

  /** The instances of a Transform; none of another element. `position`: of its change among all. */
  #instancesOf(element: SceneElement, position: number): readonly NodeInstance[] {
    if (this.#movedElements[position] === element) return this.#movedInstances[position] ?? noNodes;
    const instances = this.#transforms.get(element) ?? noNodes;
    this.#movedElements[position] = element;
    this.#movedInstances[position] = instances;
    return instances;
  }

  /**
   * A box that the document states for a group is that of the scene at rest: from the first move inside on, the group's
   * content counts in its place. Adds nodes whose summaries are to be merged again.
   */
  #ignoreBoxesAround(node: NodeInstance, isSummaryOld: Set<NodeInstance>): void {
    for (let at = node.parent; at !== undefined; at = at.parent) {
      if (at.box === undefined || at.ignoresBox) continue;
      at.ignoresBox = true;
      at.box = undefined;
      setBoundingChild(at);
      invalidateBounds(at);
      if (at.inherited?.isUnbounded === true) setUnbounded(at);
      this.#listener?.onChange(at, false, at.description);
      addWithParents(at, isSummaryOld);
    }
  }

  /** The node's own transform or one around it has changed. */
  #moveNode(node: NodeInstance, sceneFromParent: Matrix4): void {
    const { parentFromNode, movingTransform } = node;
    if (parentFromNode) {
      if (node.isMoved && movingTransform) {
        if (node.needsComposing) matrixOf(movingTransform, parentFromNode);
        else translate(movingTransform, parentFromNode);
      }
      if (node.sceneFromNode !== parentFromNode) node.sceneFromNode.multiplyMatrices(sceneFromParent, parentFromNode);
    } else if (node.sceneFromNode !== sceneFromParent) node.sceneFromNode.copy(sceneFromParent);
    node.isMoved = false;
    node.needsComposing = false;
    node.areBoundsCurrent = false;
    if (node.box) moveBox(node, node.box);
    this.#listener?.onMove(node);
    // Both are asked first because most nodes have neither: a seventh of the time of 1,000 moving shapes.
    if (node.children.length > 0) for (const child of node.children) this.#moveNode(child, node.sceneFromNode);
    if (node.summary !== emptySummary && dependsOnTransforms(node.summary) && node.inherited)
      node.summary = summaryOf(node, node.inherited);
  }

  #updateNode(node: NodeInstance, description: NodeDescription, inherited: InheritedState): void {
    const { description: previous, inherited: previouslyInherited } = node;
    if (previous === description && previouslyInherited !== undefined && isSameState(previouslyInherited, inherited))
      return;
    const hasMoved =
      previouslyInherited?.sceneFromNode !== inherited.sceneFromNode ||
      !deepEqual(transformOf(previous), transformOf(description));
    node.description = description;
    node.ownBox = ownBoxOf(description);
    node.movingTransform = undefined;
    node.areBoundsCurrent = false;
    this.#indexTransform(node, previous, description);
    node.inherited = inherited;
    if (hasMoved) setFrame(node, inherited.sceneFromNode, inherited.sceneFromNode === this.root.sceneFromNode);
    node.effectScope = effectScopeOf(node, inherited.effectScope);
    if (previouslyInherited === undefined) this.#listener?.onEnter(node);
    else this.#listener?.onChange(node, hasMoved, previous);
    node.summary =
      description.kind === "group" ? this.#updateChildren(node, description, inherited) : leafSummary(node, inherited);
  }

  #updateChildren(node: NodeInstance, group: GroupDescription, inherited: InheritedState): SubtreeSummary {
    const childState = childStateOf(node, group, inherited);
    const { kept, removed } = matchChildren(node, group.children);
    for (const child of removed) this.#leave(child);
    node.children = kept;
    setBoundingChild(node);
    kept.forEach((child, index) => {
      this.#updateNode(child, group.children[index] ?? child.description, childState);
    });
    return groupSummary(node, group, inherited);
  }

  #indexTransform(node: NodeInstance, previous: NodeDescription, description: NodeDescription): void {
    const before = previous.kind === "group" && node.inherited ? previous.transformElement : undefined;
    const now = description.kind === "group" ? description.transformElement : undefined;
    if (before === now) return;
    if (before) this.#forgetTransform(before, node);
    if (!now) return;
    this.#forgetMoves();
    const instances = this.#transforms.get(now);
    if (instances) instances.push(node);
    else this.#transforms.set(now, [node]);
  }

  #forgetMoves(): void {
    this.#movedElements.length = 0;
    this.#movedInstances.length = 0;
  }

  #forgetTransform(element: SceneElement, node: NodeInstance): void {
    this.#forgetMoves();
    const others = this.#transforms.get(element)?.filter((other) => other !== node) ?? noNodes;
    if (others.length > 0) this.#transforms.set(element, Array.from(others));
    else this.#transforms.delete(element);
  }

  #leave(node: NodeInstance): void {
    this.#listener?.onLeave(node);
    if (node.description.kind === "group" && node.description.transformElement)
      this.#forgetTransform(node.description.transformElement, node);
    for (const child of node.children) this.#leave(child);
  }
}

/** Sets the group's own box, and returns what its children inherit. */
function childStateOf(
  node: NodeInstance,
  group: GroupDescription,
  { isVisible, isUnbounded }: InheritedState,
): InheritedState {
  const { sceneFromNode } = node;
  const isGroupVisible = isVisible && group.visible;
  node.box =
    isGroupVisible && group.box && !node.ignoresBox
      ? setTransformedBox(new Box3(), sceneFromNode, group.box)
      : undefined;
  return {
    sceneFromNode,
    isVisible: isGroupVisible,
    isUnbounded: isUnbounded && node.box === undefined,
    effectScope: node.effectScope,
  };
}

/** The values of a Transform, to be changed in place. The description that the tree has got stays as it is. */
function movingTransformOf(node: NodeInstance): Partial<MovingTransform> {
  const { description } = node;
  if (node.movingTransform) return node.movingTransform;
  if (description.kind !== "group" || !description.transform) return {};
  const transform = (node.movingTransform = { ...description.transform });
  node.description = { ...description, transform };
  return transform;
}

function moveBox({ description, sceneFromNode }: NodeInstance, box: Box3): void {
  if (description.kind === "group" && description.box) setTransformedBox(box, sceneFromNode, description.box);
}

/** No box around the content of a group counts any more. */
function setUnbounded(group: NodeInstance): void {
  for (const child of group.children) {
    if (child.inherited) child.inherited = { ...child.inherited, isUnbounded: true };
    child.areBoundsCurrent = false;
    if (child.box === undefined) setUnbounded(child);
  }
}

function addWithParents(node: NodeInstance | undefined, nodes: Set<NodeInstance>): void {
  for (let at = node; at && !nodes.has(at); at = at.parent) nodes.add(at);
}

function isBelowMoved(node: NodeInstance): boolean {
  for (let at = node.parent; at !== undefined; at = at.parent) if (at.isMoved) return true;
  return false;
}

/** Merges summaries again, from the leaves up, at and below a node that is in `nodes` with all nodes around it. */
function mergeAgain(node: NodeInstance, nodes: ReadonlySet<NodeInstance>): void {
  if (!nodes.has(node) || !node.inherited) return;
  for (const child of node.children) mergeAgain(child, nodes);
  node.summary = summaryOf(node, node.inherited);
}

function summaryOf(node: NodeInstance, inherited: InheritedState): SubtreeSummary {
  const { description } = node;
  return description.kind === "group" ? groupSummary(node, description, inherited) : leafSummary(node, inherited);
}

function isSameState(a: InheritedState, b: InheritedState): boolean {
  return (
    a.sceneFromNode === b.sceneFromNode &&
    a.isVisible === b.isVisible &&
    a.isUnbounded === b.isUnbounded &&
    a.effectScope === b.effectScope
  );
}

/**
 * A group with lights that are not global, clip planes or local fogs has a scope of its own, kept while it has such
 * nodes. Those of the root have an effect on the whole scene.
 */
function effectScopeOf({ description, effectScope: previous, parent }: NodeInstance, around: EffectScope): EffectScope {
  if (parent === undefined || description.kind !== "group" || !description.children.some(isScoped)) return around;
  return previous.parent === around ? previous : new EffectScope(around);
}

/** The box of a shape that contributes to the scene's bounds. */
function ownBoxOf(description: NodeDescription): FlatBox | undefined {
  if (description.kind !== "shape" || !description.contributesToBounds) return undefined;
  return description.box && flatBoxOf(description.box);
}

/** The fields that a group's own transform depends on. */
function transformOf(description: NodeDescription): unknown {
  return description.kind === "group" ? (description.transform ?? description.billboardAxis) : undefined;
}

/** `isAtRoot`: the node's parent has the coordinates of the scene. */
function setFrame(node: NodeInstance, sceneFromParent: Matrix4, isAtRoot: boolean): void {
  const { description } = node;
  node.parentFromNode =
    description.kind === "group" && description.transform ? matrixOf(description.transform) : undefined;
  if (node.parentFromNode && isAtRoot) node.sceneFromNode = node.parentFromNode;
  else if (node.parentFromNode)
    node.sceneFromNode = new Matrix4().multiplyMatrices(sceneFromParent, node.parentFromNode);
  // The renderer rotates a billboard for each view. Its own matrix makes its descendants count as moved when it begins
  // or ceases to be one.
  else if (description.kind === "group" && description.billboardAxis) node.sceneFromNode = sceneFromParent.clone();
  else node.sceneFromNode = sceneFromParent;
}

/** Whether a node has an effect on its siblings and their descendants, and on nothing else. */
function isScoped(description: NodeDescription): boolean {
  switch (description.kind) {
    case "light":
      return !description.light.global;
    case "environmentLight":
      return !description.global;
    case "clipPlane":
    case "localFog":
      return description.enabled;
    default:
      return false;
  }
}
