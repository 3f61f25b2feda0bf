// The nodes of a scene where they stand, kept from one description of it to the
// next. A description that is the same object as before, in the same place, is
// passed over with all that is below it: what changes costs as much as it concerns,
// and a look at its siblings and at those around it.

import type { Box3 } from "three";
import { Matrix4, Vector3 } from "three";
import { areAlike } from "../document/alike.ts";
import type { GroupDescription, LightDescription, NodeDescription } from "../document/description.ts";
import { boxOfTurns } from "./billboard.ts";
import { everywhere, LightScope } from "./lightScope.ts";
import { boxIn, isDrawable, matrixOf } from "./matrices.ts";
import type { PlacedLight } from "./placement.ts";
import type { Reach } from "./reach.ts";
import { noReach, reachOfAll } from "./reach.ts";

/** What a node is told by those around it. */
interface Within {
  readonly sceneFromNode: Matrix4;
  readonly isSeen: boolean;
  /** No group around it has told its box. */
  readonly counts: boolean;
  /** The innermost that it stands in. */
  readonly lightScope: LightScope;
}

/** A node in one of its places. */
export class PlacedNode {
  readonly parent: PlacedNode | undefined;
  /** As it was described last. */
  description: NodeDescription;
  /** Of a group, that of its children. Another object where it has become another. */
  sceneFromNode = new Matrix4();
  children: readonly PlacedNode[] = [];
  /** Of a group that is seen and tells it, in the scene's coordinates. */
  box: Box3 | undefined;
  /** The innermost that it stands in. Of a group, that of its children. */
  lightScope = everywhere;
  reach: Reach = noReach;
  /** Undefined where nothing has been told yet. */
  within: Within | undefined;

  constructor(description: NodeDescription, parent: PlacedNode | undefined) {
    this.description = description;
    this.parent = parent;
  }
}

/** Hears of every node what happens to it; of a parent before its children. */
export interface PlacedTreeListener {
  onEnter(node: PlacedNode): void;
  /** It says something else, or stands elsewhere. */
  onChange(node: PlacedNode, hasMoved: boolean, before: NodeDescription): void;
  onLeave(node: PlacedNode): void;
}

export class PlacedTree {
  readonly root: PlacedNode;
  readonly #listener: PlacedTreeListener | undefined;

  constructor(listener?: PlacedTreeListener) {
    this.#listener = listener;
    this.root = new PlacedNode(
      { kind: "group", visible: true, box: undefined, transform: undefined, children: [] },
      undefined,
    );
  }

  /** Describes the scene from now on. */
  follow(root: GroupDescription): this {
    this.#follow(this.root, root, {
      sceneFromNode: this.root.within?.sceneFromNode ?? new Matrix4(),
      isSeen: true,
      counts: true,
      lightScope: everywhere,
    });
    return this;
  }

  #follow(node: PlacedNode, description: NodeDescription, within: Within): void {
    const { description: before, within: withinBefore } = node;
    if (before === description && withinBefore !== undefined && isSame(withinBefore, within)) return;
    const hasMoved =
      withinBefore?.sceneFromNode !== within.sceneFromNode || !areAlike(transformOf(before), transformOf(description));
    node.description = description;
    node.within = within;
    if (hasMoved) node.sceneFromNode = placedIn(within.sceneFromNode, description);
    node.lightScope = scopeOf(node, within.lightScope);
    if (withinBefore === undefined) this.#listener?.onEnter(node);
    else this.#listener?.onChange(node, hasMoved, before);
    node.reach = description.kind === "group" ? this.#followChildren(node, description, within) : reachOf(node, within);
  }

  #followChildren(node: PlacedNode, group: GroupDescription, { isSeen, counts, lightScope: around }: Within): Reach {
    const { sceneFromNode } = node;
    const isGroupSeen = isSeen && group.visible;
    node.box = isGroupSeen && group.box ? boxIn(sceneFromNode, group.box) : undefined;
    const inner: Within = {
      sceneFromNode,
      isSeen: isGroupSeen,
      counts: counts && node.box === undefined,
      lightScope: node.lightScope,
    };
    const { kept, gone } = matched(node, group.children);
    for (const child of gone) this.#leave(child);
    node.children = kept;
    kept.forEach((child, place) => {
      this.#follow(child, group.children[place] ?? child.description, inner);
    });
    const reach = reachOfAll(kept, {
      box: counts && node.box && isDrawable(node.box) ? node.box : undefined,
      bounded: node.box ? [node] : [],
      anchors: group.anchor && isGroupSeen ? [group.anchor] : [],
      billboards: group.billboardAxis ? [node] : [],
      scopes: node.lightScope === around ? [] : [node.lightScope],
      levels: group.levels && isGroupSeen ? [{ ...group.levels, sceneFromLevels: sceneFromNode }] : [],
    });
    return group.billboardAxis ? reachOfTurns(reach, sceneFromNode) : reach;
  }

  #leave(node: PlacedNode): void {
    this.#listener?.onLeave(node);
    for (const child of node.children) this.#leave(child);
  }
}

function isSame(a: Within, b: Within): boolean {
  return (
    a.sceneFromNode === b.sceneFromNode &&
    a.isSeen === b.isSeen &&
    a.counts === b.counts &&
    a.lightScope === b.lightScope
  );
}

/** A group with lights of its own has a scope of its own, the same as long as it has any. What is outermost in a scene is in it all. */
function scopeOf({ description, lightScope: before, parent }: PlacedNode, around: LightScope): LightScope {
  if (parent === undefined || description.kind !== "group" || !description.children.some(isScopedLight)) return around;
  return before.around === around ? before : new LightScope(around);
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

function reachOf({ description, sceneFromNode }: PlacedNode, { isSeen, counts, lightScope }: Within): Reach {
  switch (description.kind) {
    case "shape": {
      const box = description.box && description.reaches && counts ? boxIn(sceneFromNode, description.box) : undefined;
      return box && isDrawable(box) ? { ...noReach, box } : noReach;
    }
    case "viewpoint":
      return {
        ...noReach,
        viewpoints: [
          { element: description.element, viewpoint: description.viewpoint, sceneFromViewpoint: sceneFromNode },
        ],
      };
    case "light":
      return description.light.on && isSeen
        ? { ...noReach, lights: [placedLight(description.light, sceneFromNode, lightScope)] }
        : noReach;
    case "group":
      return noReach;
  }
}

/** Of what turns about its origin: no box in it stays where it is. */
function reachOfTurns(reach: Reach, sceneFromNode: Matrix4): Reach {
  return {
    ...reach,
    box: reach.box && boxOfTurns(reach.box, new Vector3().setFromMatrixPosition(sceneFromNode)),
    bounded: [],
  };
}

function isScopedLight(description: NodeDescription): boolean {
  return description.kind === "light" && !description.light.global;
}

function placedLight(light: LightDescription, sceneFromLight: Matrix4, around: LightScope): PlacedLight {
  return { light, sceneFromLight, scope: light.global ? everywhere : around };
}

/** For each description the child that was it before: the same object, the shape of its element, or a group that stood there. */
function matched(
  parent: PlacedNode,
  descriptions: readonly NodeDescription[],
): { kept: PlacedNode[]; gone: readonly PlacedNode[] } {
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
    (description, place) => same[place] ?? others.takeKin(description) ?? new PlacedNode(description, parent),
  );
  return {
    kept: [...children.slice(0, begin), ...between, ...children.slice(children.length - end)],
    gone: others.rest,
  };
}

/** Nodes that wait for what has become of them. */
class Others {
  readonly #waiting: Set<PlacedNode>;
  readonly #byDescription: ReadonlyMap<NodeDescription, PlacedNode>;
  readonly #byKin = new Map<unknown, PlacedNode[]>();

  constructor(nodes: readonly PlacedNode[]) {
    this.#waiting = new Set(nodes);
    this.#byDescription = new Map(nodes.map((node) => [node.description, node]));
    for (const node of nodes.toReversed()) {
      const kin = kinOf(node.description);
      const known = this.#byKin.get(kin);
      if (known === undefined) this.#byKin.set(kin, [node]);
      else known.push(node);
    }
  }

  get rest(): readonly PlacedNode[] {
    return Array.from(this.#waiting);
  }

  takeSame(description: NodeDescription): PlacedNode | undefined {
    const node = this.#byDescription.get(description);
    return node !== undefined && this.#waiting.delete(node) ? node : undefined;
  }

  takeKin(description: NodeDescription): PlacedNode | undefined {
    const kin = this.#byKin.get(kinOf(description));
    for (let node = kin?.pop(); node !== undefined; node = kin?.pop()) if (this.#waiting.delete(node)) return node;
    return undefined;
  }
}

/** The same for nodes one of which may become the other. */
function kinOf(description: NodeDescription): unknown {
  return description.kind === "shape" ? description.element : description.kind;
}
