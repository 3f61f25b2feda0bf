// The nodes of a scene where they stand, kept from one description of it to the
// next. A description that is the same object as before, in the same place, is
// passed over with all that is below it: what changes costs as much as it concerns,
// and a look at its siblings and at those around it.

import { Matrix4, Vector3 } from "three";
import { deepEqual } from "../document/deepEqual.ts";
import type { GroupDescription, LightDescription, NodeDescription } from "../document/description.ts";
import { boxOfAllRotations, isDrawable, transformedBox } from "./bounds.ts";
import type { LightInstance } from "./instances.ts";
import { LightScope, sceneScope } from "./lightScope.ts";
import type { InheritedState, SubtreeSummary } from "./nodeInstance.ts";
import { emptySummary, NodeInstance } from "./nodeInstance.ts";
import { mergeSummaries } from "./subtreeSummary.ts";
import { matrixOf } from "./transforms.ts";

/** Hears of every node what happens to it; of a parent before its children. */
export interface InstanceTreeListener {
  onEnter(node: NodeInstance): void;
  /** It says something else, or stands elsewhere. */
  onChange(node: NodeInstance, hasMoved: boolean, before: NodeDescription): void;
  onLeave(node: NodeInstance): void;
}

export class InstanceTree {
  readonly root: NodeInstance;
  readonly #listener: InstanceTreeListener | undefined;

  constructor(listener?: InstanceTreeListener) {
    this.#listener = listener;
    this.root = new NodeInstance(
      { kind: "group", visible: true, box: undefined, transform: undefined, children: [] },
      undefined,
    );
  }

  /** Describes the scene from now on. */
  update(root: GroupDescription): this {
    this.#follow(this.root, root, {
      sceneFromNode: this.root.inherited?.sceneFromNode ?? new Matrix4(),
      isSeen: true,
      contributesToBounds: true,
      lightScope: sceneScope,
    });
    return this;
  }

  #follow(node: NodeInstance, description: NodeDescription, within: InheritedState): void {
    const { description: before, inherited: withinBefore } = node;
    if (before === description && withinBefore !== undefined && isSame(withinBefore, within)) return;
    const hasMoved =
      withinBefore?.sceneFromNode !== within.sceneFromNode || !deepEqual(transformOf(before), transformOf(description));
    node.description = description;
    node.inherited = within;
    if (hasMoved) node.sceneFromNode = placedIn(within.sceneFromNode, description);
    node.lightScope = scopeOf(node, within.lightScope);
    if (withinBefore === undefined) this.#listener?.onEnter(node);
    else this.#listener?.onChange(node, hasMoved, before);
    node.summary =
      description.kind === "group" ? this.#followChildren(node, description, within) : reachOf(node, within);
  }

  #followChildren(
    node: NodeInstance,
    group: GroupDescription,
    { isSeen, contributesToBounds: counts, lightScope: around }: InheritedState,
  ): SubtreeSummary {
    const { sceneFromNode } = node;
    const isGroupSeen = isSeen && group.visible;
    node.box = isGroupSeen && group.box ? transformedBox(sceneFromNode, group.box) : undefined;
    const inner: InheritedState = {
      sceneFromNode,
      isSeen: isGroupSeen,
      contributesToBounds: counts && node.box === undefined,
      lightScope: node.lightScope,
    };
    const { kept, gone } = matched(node, group.children);
    for (const child of gone) this.#leave(child);
    node.children = kept;
    kept.forEach((child, place) => {
      this.#follow(child, group.children[place] ?? child.description, inner);
    });
    const reach = mergeSummaries(kept, {
      box: counts && node.box && isDrawable(node.box) ? node.box : undefined,
      boundedGroups: node.box ? [node] : [],
      anchors: group.anchor && isGroupSeen ? [group.anchor] : [],
      billboards: group.billboardAxis ? [node] : [],
      lightScopes: node.lightScope === around ? [] : [node.lightScope],
      lods: group.lod && isGroupSeen ? [{ ...group.lod, sceneFromLod: sceneFromNode }] : [],
    });
    return group.billboardAxis ? reachOfTurns(reach, sceneFromNode) : reach;
  }

  #leave(node: NodeInstance): void {
    this.#listener?.onLeave(node);
    for (const child of node.children) this.#leave(child);
  }
}

function isSame(a: InheritedState, b: InheritedState): boolean {
  return (
    a.sceneFromNode === b.sceneFromNode &&
    a.isSeen === b.isSeen &&
    a.contributesToBounds === b.contributesToBounds &&
    a.lightScope === b.lightScope
  );
}

/** A group with lights of its own has a scope of its own, the same as long as it has any. What is outermost in a scene is in it all. */
function scopeOf({ description, lightScope: before, parent }: NodeInstance, around: LightScope): LightScope {
  if (parent === undefined || description.kind !== "group" || !description.children.some(isScopedLight)) return around;
  return before.parent === around ? before : new LightScope(around);
}

/** What tells how a group stands in that around it. */
function transformOf(description: NodeDescription): unknown {
  return description.kind === "group" ? (description.transform ?? description.billboardAxis) : undefined;
}

function placedIn(sceneFromParent: Matrix4, description: NodeDescription): Matrix4 {
  if (description.kind !== "group") return sceneFromParent;
  if (description.transform) return sceneFromParent.clone().multiply(matrixOf(description.transform));
  return description.billboardAxis ? sceneFromParent.clone() : sceneFromParent; // who draws it turns it further
}

function reachOf(
  { description, sceneFromNode }: NodeInstance,
  { isSeen, contributesToBounds: counts, lightScope }: InheritedState,
): SubtreeSummary {
  switch (description.kind) {
    case "shape": {
      const box =
        description.box && description.contributesToBounds && counts
          ? transformedBox(sceneFromNode, description.box)
          : undefined;
      return box && isDrawable(box) ? { ...emptySummary, box } : emptySummary;
    }
    case "viewpoint":
      return {
        ...emptySummary,
        viewpoints: [
          { element: description.element, viewpoint: description.viewpoint, sceneFromViewpoint: sceneFromNode },
        ],
      };
    case "light":
      return description.light.on && isSeen
        ? { ...emptySummary, lights: [placedLight(description.light, sceneFromNode, lightScope)] }
        : emptySummary;
    case "group":
      return emptySummary;
  }
}

/** Of what turns about its origin: no box in it stays where it is. */
function reachOfTurns(reach: SubtreeSummary, sceneFromNode: Matrix4): SubtreeSummary {
  return {
    ...reach,
    box: reach.box && boxOfAllRotations(reach.box, new Vector3().setFromMatrixPosition(sceneFromNode)),
    boundedGroups: [],
  };
}

function isScopedLight(description: NodeDescription): boolean {
  return description.kind === "light" && !description.light.global;
}

function placedLight(light: LightDescription, sceneFromLight: Matrix4, around: LightScope): LightInstance {
  return { light, sceneFromLight, scope: light.global ? sceneScope : around };
}

/** For each description the child that was it before: the same object, the shape of its element, or a group that stood there. */
function matched(
  parent: NodeInstance,
  descriptions: readonly NodeDescription[],
): { kept: NodeInstance[]; gone: readonly NodeInstance[] } {
  const { children } = parent;
  let begin = 0;
  while (begin < children.length && children[begin]?.description === descriptions[begin]) begin += 1;
  let end = 0;
  const most = Math.min(children.length, descriptions.length) - begin;
  while (end < most && children.at(-1 - end)?.description === descriptions.at(-1 - end)) end += 1;
  const others = new Others(children.slice(begin, children.length - end));
  const middle = descriptions.slice(begin, descriptions.length - end);
  const same = middle.map((description) => others.takeSame(description));
  const between = middle.map(
    (description, place) => same[place] ?? others.takeKin(description) ?? new NodeInstance(description, parent),
  );
  return {
    kept: [...children.slice(0, begin), ...between, ...children.slice(children.length - end)],
    gone: others.rest,
  };
}

/** Nodes that wait for what has become of them. */
class Others {
  readonly #waiting: Set<NodeInstance>;
  readonly #byDescription: ReadonlyMap<NodeDescription, NodeInstance>;
  readonly #byKin = new Map<unknown, NodeInstance[]>();

  constructor(nodes: readonly NodeInstance[]) {
    this.#waiting = new Set(nodes);
    this.#byDescription = new Map(nodes.map((node) => [node.description, node]));
    for (const node of nodes.toReversed()) {
      const kin = kinOf(node.description);
      const known = this.#byKin.get(kin);
      if (known === undefined) this.#byKin.set(kin, [node]);
      else known.push(node);
    }
  }

  get rest(): readonly NodeInstance[] {
    return Array.from(this.#waiting);
  }

  takeSame(description: NodeDescription): NodeInstance | undefined {
    const node = this.#byDescription.get(description);
    return node !== undefined && this.#waiting.delete(node) ? node : undefined;
  }

  takeKin(description: NodeDescription): NodeInstance | undefined {
    const kin = this.#byKin.get(kinOf(description));
    for (let node = kin?.pop(); node !== undefined; node = kin?.pop()) if (this.#waiting.delete(node)) return node;
    return undefined;
  }
}

/** The same for nodes one of which may become the other. */
function kinOf(description: NodeDescription): unknown {
  return description.kind === "shape" ? description.element : description.kind;
}
