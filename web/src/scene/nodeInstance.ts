// A node instance, which is one occurrence of a node in the scene, and the summary of its subtree.

import type { Box3, Object3D } from "three";
import { Matrix4 } from "three";
import type { AnchorDescription, NodeDescription, TransformDescription } from "../document/description.ts";
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
import type { FlatBox } from "./flatBox.ts";
import { makeFlatBox } from "./flatBox.ts";

/** What a subtree adds to its scene, shapes aside; in document order. Its matrices are copies. */
export interface SubtreeSummary {
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

/** Also tells that a subtree adds nothing that depends on its transform, except shapes. */
export const emptySummary: SubtreeSummary = {
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

/** What a node inherits from the groups around it. */
export interface InheritedState {
  readonly sceneFromNode: Matrix4;
  readonly isVisible: boolean;
  /** Whether no group around the node has a box, so that the node's own bounds count. */
  readonly isUnbounded: boolean;
  /** The innermost scope around the node. */
  readonly effectScope: EffectScope;
}

/** The values of a Transform that moves. */
export type MovingTransform = { -readonly [Key in keyof TransformDescription]: TransformDescription[Key] };

/** One occurrence of a node in the scene. */
export class NodeInstance {
  readonly parent: NodeInstance | undefined;
  /** Whether it is an instance of a shape: a move asks this of a thousand nodes, whose descriptions lie apart. */
  readonly isShape: boolean;
  /** The latest description of the node. */
  description: NodeDescription;
  /**
   * Transforms the node's coordinates, for a group those of its children, to the scene's. Nodes share the object with the
   * node around them unless they have a transform; that of a Transform at the root is its own matrix. An update of the
   * tree replaces it, a move changes it in place.
   */
  sceneFromNode = new Matrix4();
  /** The matrix of a Transform; undefined for other nodes. Changed in place by a move. */
  parentFromNode: Matrix4 | undefined;
  /** The values of a Transform that moves, which `description` has too; undefined before its first move. */
  movingTransform: MovingTransform | undefined;
  /** Whether a move has given the node other values, and has not moved it yet. */
  isMoved = false;
  /** Whether another field than the translation is among these values, so that its matrix is composed again. */
  needsComposing = false;
  children: readonly NodeInstance[] = [];
  /** The child whose bounds are the group's: see setBoundingChild. */
  boundingChild: NodeInstance | undefined;
  /** Whether something has moved inside the group, so that the box of its description does not count. */
  ignoresBox = false;
  /** Bounds in scene coordinates, for visible groups whose description has a box that counts. */
  box: Box3 | undefined;
  /** The innermost scope around the node; for a group: around its children. */
  effectScope = sceneScope;
  summary: SubtreeSummary = emptySummary;
  /** Whether it is among the moved instances of shapes that nobody has taken yet: see SceneShapes.takeMoved. */
  isAmongMoved = false;
  /** Bounds of the visible shapes at and below the node, unless `boundingChild` has them: see boundsOf. */
  readonly bounds = makeFlatBox();
  /** The box of a shape that contributes to the scene's bounds, in the shape's coordinates. */
  ownBox: FlatBox | undefined;
  /** Whether nothing has changed since `bounds` were computed. */
  areBoundsCurrent = false;
  /** Undefined before the first update. */
  inherited: InheritedState | undefined;
  /** What the listener of the tree displays a group or a shape with; undefined for others. */
  object: Object3D | undefined;

  constructor(description: NodeDescription, parent: NodeInstance | undefined) {
    this.description = description;
    this.isShape = description.kind === "shape";
    this.parent = parent;
  }
}
