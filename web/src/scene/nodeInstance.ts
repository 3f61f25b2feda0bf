// One occurrence of a node in the scene, and the summary of the subtree below it.

import type { Box3 } from "three";
import { Matrix4 } from "three";
import type { AnchorDescription, NodeDescription } from "../document/description.ts";
import type { LightInstance, LodInstance, ViewpointInstance } from "./instances.ts";
import type { LightScope } from "./lightScope.ts";
import { sceneScope } from "./lightScope.ts";

/** Lists are in document order. */
export interface SubtreeSummary {
  /** Around what is seen of it, in the scene's coordinates; undefined where nothing is. */
  readonly box: Box3 | undefined;
  /** Those that shine. */
  readonly lights: readonly LightInstance[];
  readonly viewpoints: readonly ViewpointInstance[];
  /** Those that are seen. */
  readonly lods: readonly LodInstance[];
  /** Groups that are seen and tell their boxes. */
  readonly boundedGroups: readonly NodeInstance[];
  /** Those that are seen. */
  readonly anchors: readonly AnchorDescription[];
  /** Each before those in it. */
  readonly billboards: readonly NodeInstance[];
  /** Groups that lights shine in, and nowhere else; each before those in it. */
  readonly lightScopes: readonly LightScope[];
}

const none: readonly never[] = [];
export const emptySummary: SubtreeSummary = {
  box: undefined,
  lights: none,
  viewpoints: none,
  lods: none,
  boundedGroups: none,
  anchors: none,
  billboards: none,
  lightScopes: none,
};

/** What a node is told by those around it. */
export interface InheritedState {
  readonly sceneFromNode: Matrix4;
  readonly isSeen: boolean;
  /** No group around it has told its box. */
  readonly contributesToBounds: boolean;
  /** The innermost that it stands in. */
  readonly lightScope: LightScope;
}

/** A node in one of its places. */
export class NodeInstance {
  readonly parent: NodeInstance | undefined;
  /** As it was described last. */
  description: NodeDescription;
  /** Of a group, that of its children. Another object where it has become another. */
  sceneFromNode = new Matrix4();
  children: readonly NodeInstance[] = [];
  /** Of a group that is seen and tells it, in the scene's coordinates. */
  box: Box3 | undefined;
  /** The innermost that it stands in. Of a group, that of its children. */
  lightScope = sceneScope;
  summary: SubtreeSummary = emptySummary;
  /** Undefined where nothing has been told yet. */
  inherited: InheritedState | undefined;

  constructor(description: NodeDescription, parent: NodeInstance | undefined) {
    this.description = description;
    this.parent = parent;
  }
}
