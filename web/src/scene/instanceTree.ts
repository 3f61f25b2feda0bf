// The tree of a scene's node instances, kept from one description of the scene to the next. A subtree is skipped where
// its description is the same object as before and its inherited state has not changed, so that an update costs as much
// as the changed nodes, their siblings and their ancestors.

import { Matrix4, Vector3, Vector4 } from "three";
import { deepEqual } from "../document/deepEqual.ts";
import type { GroupDescription, NodeDescription, TransformDescription, Vec4 } from "../document/description.ts";
import type { SceneElement } from "../document/element.ts";
import { boxOfAllRotations, isDrawable, transformedBox } from "./bounds.ts";
import { EffectScope, sceneScope } from "./effectScope.ts";
import type { InheritedState, SubtreeSummary } from "./nodeInstance.ts";
import { emptySummary, NodeInstance, summaryOfBox } from "./nodeInstance.ts";
import { mergeSummaries } from "./subtreeSummary.ts";
import { lengthScaleOf, matrixOf } from "./transforms.ts";

const none: readonly never[] = [];

/** Receives the events of each node; those of a parent come before those of its children. */
export interface InstanceTreeListener {
  onEnter(node: NodeInstance): void;
  /** The node's description or inherited state has changed. `hasMoved`: whether its transform has, too. */
  onChange(node: NodeInstance, hasMoved: boolean, previous: NodeDescription): void;
  onLeave(node: NodeInstance): void;
}

export class InstanceTree {
  readonly root: NodeInstance;
  readonly #listener: InstanceTreeListener | undefined;
  /** The instances of each Transform. */
  readonly #transforms = new Map<SceneElement, Set<NodeInstance>>();

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
    return this.#transforms.get(element)?.values().next().value;
  }

  /**
   * Gives Transforms other values, without a description of the whole scene, which `update` needs much longer for. The
   * next description that `update` gets must have these values.
   */
  move(transforms: ReadonlyMap<SceneElement, Partial<TransformDescription>>): void {
    const moved = new Set<NodeInstance>();
    const around = new Set<NodeInstance>();
    for (const [element, values] of transforms) {
      for (const node of this.#transforms.get(element) ?? []) {
        const { description } = node;
        if (description.kind !== "group" || !description.transform) continue;
        node.description = { ...description, transform: { ...description.transform, ...values } };
        moved.add(node);
        for (let at = node.parent; at !== undefined && !around.has(at); at = at.parent) around.add(at);
      }
    }
    this.#moveIn(this.root, moved, around);
  }

  /** Moves nodes at or below `node`. `around`: their ancestors. */
  #moveIn(node: NodeInstance, moved: ReadonlySet<NodeInstance>, around: ReadonlySet<NodeInstance>): void {
    if (moved.has(node)) {
      if (node.inherited) this.#moveNode(node, node.inherited);
      return;
    }
    if (!around.has(node)) return;
    for (const child of node.children) this.#moveIn(child, moved, around);
    if (node.description.kind === "group" && node.inherited)
      node.summary = groupSummary(node, node.description, node.inherited);
  }

  /** The node's own transform or one around it has changed. */
  #moveNode(node: NodeInstance, inherited: InheritedState): void {
    const { description } = node;
    node.inherited = inherited;
    setFrame(node, inherited.sceneFromNode);
    this.#listener?.onChange(node, true, description);
    if (description.kind !== "group") {
      node.summary = leafSummary(node, inherited);
      return;
    }
    const childState = childStateOf(node, description, inherited);
    for (const child of node.children) this.#moveNode(child, childState);
    node.summary = groupSummary(node, description, inherited);
  }

  #updateNode(node: NodeInstance, description: NodeDescription, inherited: InheritedState): void {
    const { description: previous, inherited: previouslyInherited } = node;
    if (previous === description && previouslyInherited !== undefined && isSameState(previouslyInherited, inherited))
      return;
    const hasMoved =
      previouslyInherited?.sceneFromNode !== inherited.sceneFromNode ||
      !deepEqual(transformOf(previous), transformOf(description));
    node.description = description;
    this.#indexTransform(node, previous, description);
    node.inherited = inherited;
    if (hasMoved) setFrame(node, inherited.sceneFromNode);
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
    const instances = this.#transforms.get(now);
    if (instances) instances.add(node);
    else this.#transforms.set(now, new Set([node]));
  }

  #forgetTransform(element: SceneElement, node: NodeInstance): void {
    const instances = this.#transforms.get(element);
    instances?.delete(node);
    if (instances?.size === 0) this.#transforms.delete(element);
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
  node.box = isGroupVisible && group.box ? transformedBox(sceneFromNode, group.box) : undefined;
  return {
    sceneFromNode,
    isVisible: isGroupVisible,
    isUnbounded: isUnbounded && node.box === undefined,
    effectScope: node.effectScope,
  };
}

/** The summary of a group whose children are up to date. */
function groupSummary(
  node: NodeInstance,
  group: GroupDescription,
  { isVisible, isUnbounded, effectScope: scopeAround }: InheritedState,
): SubtreeSummary {
  const { sceneFromNode, box } = node;
  const isGroupVisible = isVisible && group.visible;
  const summary = mergeSummaries(node.children, {
    box: isUnbounded && box && isDrawable(box) ? box : undefined,
    boundedGroups: box ? [node] : none,
    anchors: group.anchor && isGroupVisible ? [group.anchor] : none,
    billboards: group.billboardAxis ? [node] : none,
    effectScopes: node.effectScope === scopeAround ? none : [node.effectScope],
    lods: group.lod && isGroupVisible ? [{ ...group.lod, sceneFromLod: sceneFromNode }] : none,
  });
  return group.billboardAxis ? rotatingSummary(summary, sceneFromNode) : summary;
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

/** The fields that a group's own transform depends on. */
function transformOf(description: NodeDescription): unknown {
  return description.kind === "group" ? (description.transform ?? description.billboardAxis) : undefined;
}

function setFrame(node: NodeInstance, sceneFromParent: Matrix4): void {
  const { description } = node;
  node.parentFromNode =
    description.kind === "group" && description.transform ? matrixOf(description.transform) : undefined;
  if (node.parentFromNode) node.sceneFromNode = new Matrix4().multiplyMatrices(sceneFromParent, node.parentFromNode);
  // The renderer rotates a billboard for each view. Its own matrix makes its descendants count as moved when it begins
  // or ceases to be one.
  else if (description.kind === "group" && description.billboardAxis) node.sceneFromNode = sceneFromParent.clone();
  else node.sceneFromNode = sceneFromParent;
}

function leafSummary(
  { description, sceneFromNode }: NodeInstance,
  { isVisible, isUnbounded, effectScope }: InheritedState,
): SubtreeSummary {
  switch (description.kind) {
    case "shape": {
      const box =
        description.box && description.contributesToBounds && isUnbounded
          ? transformedBox(sceneFromNode, description.box)
          : undefined;
      return box && isDrawable(box) ? summaryOfBox(box) : emptySummary;
    }
    case "viewpoint":
      return {
        ...emptySummary,
        viewpoints: [
          { element: description.element, viewpoint: description.viewpoint, sceneFromViewpoint: sceneFromNode },
        ],
      };
    case "background":
      return { ...emptySummary, backgrounds: [{ ...description, sceneFromBackground: sceneFromNode }] };
    case "fog":
      return { ...emptySummary, fogs: [{ ...description, scale: lengthScaleOf(sceneFromNode) }] };
    case "localFog":
      return description.enabled && isVisible
        ? {
            ...emptySummary,
            localFogs: [{ fog: description.fog, scale: lengthScaleOf(sceneFromNode), scope: effectScope }],
          }
        : emptySummary;
    case "clipPlane": {
      const plane = description.enabled && isVisible ? scenePlaneOf(description.plane, sceneFromNode) : undefined;
      return plane ? { ...emptySummary, clipPlanes: [{ plane, scope: effectScope }] } : emptySummary;
    }
    case "light":
      return description.light.on && isVisible
        ? { ...emptySummary, lights: [lightInstance(description.light, sceneFromNode, effectScope)] }
        : emptySummary;
    case "environmentLight":
      return description.on && isVisible
        ? {
            ...emptySummary,
            environmentLights: [lightInstance(description, sceneFromNode, effectScope)],
          }
        : emptySummary;
    case "group":
      return emptySummary;
  }
}

/**
 * The summary of a billboard, whose bounds cover every rotation about its origin; boxes inside it have no fixed
 * position.
 */
function rotatingSummary(summary: SubtreeSummary, sceneFromNode: Matrix4): SubtreeSummary {
  return {
    ...summary,
    box: summary.box && boxOfAllRotations(summary.box, new Vector3().setFromMatrixPosition(sceneFromNode)),
    boundedGroups: [],
  };
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

/** A plane of a node in scene coordinates; undefined where the node has no volume or the plane no direction. */
function scenePlaneOf(plane: Vec4, sceneFromNode: Matrix4): Vector4 | undefined {
  if (sceneFromNode.determinant() === 0) return undefined;
  const scenePlane = new Vector4(...plane).applyMatrix4(sceneFromNode.clone().invert().transpose());
  const length = Math.hypot(scenePlane.x, scenePlane.y, scenePlane.z);
  return length > 0 ? scenePlane.divideScalar(length) : undefined;
}

function lightInstance<Light extends { readonly global: boolean }>(
  light: Light,
  sceneFromLight: Matrix4,
  around: EffectScope,
): { light: Light; sceneFromLight: Matrix4; scope: EffectScope } {
  return { light, sceneFromLight, scope: light.global ? sceneScope : around };
}

/**
 * Finds for each description the child that had it before: one with the same description object, else a shape of the
 * same element or another node of the same kind, else a new one.
 */
function matchChildren(
  parent: NodeInstance,
  descriptions: readonly NodeDescription[],
): { kept: NodeInstance[]; removed: readonly NodeInstance[] } {
  const { children } = parent;
  let begin = 0;
  while (begin < children.length && children[begin]?.description === descriptions[begin]) begin += 1;
  let end = 0;
  const maxEnd = Math.min(children.length, descriptions.length) - begin;
  while (end < maxEnd && children.at(-1 - end)?.description === descriptions.at(-1 - end)) end += 1;
  const unmatched = new UnmatchedChildren(children.slice(begin, children.length - end));
  const middle = descriptions.slice(begin, descriptions.length - end);
  const same = middle.map((description) => unmatched.takeSame(description));
  const between = middle.map(
    (description, index) => same[index] ?? unmatched.takeSimilar(description) ?? new NodeInstance(description, parent),
  );
  return {
    kept: [...children.slice(0, begin), ...between, ...children.slice(children.length - end)],
    removed: unmatched.rest,
  };
}

/** Children for which no new description has been found yet. */
class UnmatchedChildren {
  readonly #remaining: Set<NodeInstance>;
  readonly #byDescription: ReadonlyMap<NodeDescription, NodeInstance>;
  readonly #byIdentity = new Map<unknown, NodeInstance[]>();

  constructor(nodes: readonly NodeInstance[]) {
    this.#remaining = new Set(nodes);
    this.#byDescription = new Map(nodes.map((node) => [node.description, node]));
    for (const node of nodes.toReversed()) {
      const identity = identityOf(node.description);
      const known = this.#byIdentity.get(identity);
      if (known === undefined) this.#byIdentity.set(identity, [node]);
      else known.push(node);
    }
  }

  get rest(): readonly NodeInstance[] {
    return Array.from(this.#remaining);
  }

  takeSame(description: NodeDescription): NodeInstance | undefined {
    const node = this.#byDescription.get(description);
    return node !== undefined && this.#remaining.delete(node) ? node : undefined;
  }

  takeSimilar(description: NodeDescription): NodeInstance | undefined {
    const similar = this.#byIdentity.get(identityOf(description));
    for (let node = similar?.pop(); node !== undefined; node = similar?.pop())
      if (this.#remaining.delete(node)) return node;
    return undefined;
  }
}

/** Equal for nodes whose instances may be reused for one another. */
function identityOf(description: NodeDescription): unknown {
  return description.kind === "shape" ? description.element : description.kind;
}
