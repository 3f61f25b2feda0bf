// A node instance, which is one occurrence of a node in the scene, and the summary of its subtree.

import type { Box3 } from "three";
import { Matrix4 } from "three";
import type { AnchorDescription, NodeDescription } from "../document/description.ts";
import type {
  BackgroundInstance,
  ClipPlaneInstance,
  EnvironmentLightInstance,
  FogInstance,
  LightInstance,
  LocalFogInstance,
  LodInstance,
  ViewpointInstance,
} from "./instances.ts";
import type { EffectScope } from "./effectScope.ts";
import { sceneScope } from "./effectScope.ts";

/** What a subtree adds to its scene; lists are in document order. */
export interface SubtreeSummary {
  /** Bounds of visible shapes, in scene coordinates; undefined where there are none. */
  readonly box: Box3 | undefined;
  /** Lights that are on and visible. */
  readonly lights: readonly LightInstance[];
  /** Those that are on and visible. */
  readonly environmentLights: readonly EnvironmentLightInstance[];
  readonly viewpoints: readonly ViewpointInstance[];
  readonly backgrounds: readonly BackgroundInstance[];
  readonly fogs: readonly FogInstance[];
  /** Visible and enabled LocalFogs, each before those inside its group. */
  readonly localFogs: readonly LocalFogInstance[];
  /** Visible and enabled ones. */
  readonly clipPlanes: readonly ClipPlaneInstance[];
  /** Visible LODs. */
  readonly lods: readonly LodInstance[];
  /** Visible groups that have a box. */
  readonly boundedGroups: readonly NodeInstance[];
  /** Anchors of visible groups. */
  readonly anchors: readonly AnchorDescription[];
  /** Each before the billboards inside it. */
  readonly billboards: readonly NodeInstance[];
  /** Scopes of lights that are not global, of clip planes and of local fogs; each before the scopes inside it. */
  readonly effectScopes: readonly EffectScope[];
}

const none: readonly never[] = [];
/** The summary of a shape with these bounds. A literal, because a scene that moves makes thousands in each frame. */
export function summaryOfBox(box: Box3 | undefined): SubtreeSummary {
  return {
    box,
    lights: none,
    environmentLights: none,
    viewpoints: none,
    backgrounds: none,
    fogs: none,
    localFogs: none,
    clipPlanes: none,
    lods: none,
    boundedGroups: none,
    anchors: none,
    billboards: none,
    effectScopes: none,
  };
}

export const emptySummary = summaryOfBox(undefined);

/** What a node inherits from the groups around it. */
export interface InheritedState {
  readonly sceneFromNode: Matrix4;
  readonly isVisible: boolean;
  /** Whether no group around the node has a box, so that the node's own bounds count. */
  readonly isUnbounded: boolean;
  /** The innermost scope around the node. */
  readonly effectScope: EffectScope;
}

/** One occurrence of a node in the scene. */
export class NodeInstance {
  readonly parent: NodeInstance | undefined;
  /** The latest description of the node. */
  description: NodeDescription;
  /**
   * Transforms the node's coordinates, for a group those of its children, to the scene's. Replaced, never changed in
   * place.
   */
  sceneFromNode = new Matrix4();
  /** The matrix of a Transform; undefined for other nodes. */
  parentFromNode: Matrix4 | undefined;
  children: readonly NodeInstance[] = [];
  /** Bounds in scene coordinates, for visible groups whose description has a box. */
  box: Box3 | undefined;
  /** The innermost scope around the node; for a group: around its children. */
  effectScope = sceneScope;
  summary: SubtreeSummary = emptySummary;
  /** Undefined before the first update. */
  inherited: InheritedState | undefined;

  constructor(description: NodeDescription, parent: NodeInstance | undefined) {
    this.description = description;
    this.parent = parent;
  }
}
