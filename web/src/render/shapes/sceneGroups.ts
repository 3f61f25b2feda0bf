// Mirrors a scene's instance tree (scene/) in three.js groups. Groups own nothing on the GPU; the
// listener adds drawn objects to the groups of shapes.

import type { Box3, Camera, Object3D } from "three";
import { Group, Matrix4, Vector3 } from "three";
import { deepEqual } from "../../document/deepEqual.ts";
import type {
  AnchorDescription,
  GroupDescription,
  NodeDescription,
  ShapeDescription,
  SkinDescription,
} from "../../document/description.ts";
import type { SceneElement } from "../../document/element.ts";
import type {
  BackgroundInstance,
  ClipPlaneInstance,
  EnvironmentLightInstance,
  FogInstance,
  LightInstance,
  LocalFogInstance,
  LodInstance,
  ViewpointInstance,
} from "../../scene/instances.ts";
import { bindableOf } from "../../scene/bindable.ts";
import { billboardRotation } from "../../scene/billboard.ts";
import { numberEffectScopes } from "../../scene/effectScope.ts";
import type { InstanceTreeListener, PoseChange } from "../../scene/instanceTree.ts";
import type { NodeInstance, SubtreeSummary } from "../../scene/nodeInstance.ts";
import { InstanceTree } from "../../scene/instanceTree.ts";
import { boundsOf } from "../../scene/subtreeBounds.ts";
import type { ShapeGroup } from "./shapeGroup.ts";
import { addUnvisited, removeVisited, VisitedGroup } from "./visitedGroup.ts";
import type { SceneLights, SceneLightUniforms } from "../lights/sceneLights.ts";
import { makeLights } from "../lights/sceneLights.ts";

/** Receives the shape instances of a scene. World matrices of the groups it gets are up to date. */
export interface ShapeInstanceListener {
  /** Called for a new instance of a shape. */
  onEnter(shape: ShapeDescription, instance: NodeInstance, group: ShapeGroup): void;
  /** Called when the description, the transform or the effect scope of an instance has changed. */
  onChange(shape: ShapeDescription, instance: NodeInstance, group: ShapeGroup, before: ShapeDescription): void;
  /** Called when only the transform of an instance has changed: see `SceneGroups.move`. Default: nothing is told. */
  onMove?(instance: NodeInstance, group: ShapeGroup): void;
  /** Called when an instance has been removed. */
  onLeave(shape: ShapeDescription, instance: NodeInstance, group: ShapeGroup): void;
  /** Whether the root is moved by nobody, so that matrices of the scene are world matrices. */
  readonly isWorld?: boolean;
  /** Makes the object for a group of the scene; if it returns undefined, a plain Group is made. */
  makeGroup?(description: GroupDescription): Object3D | undefined;
  /** Called when a billboard around the instance has rotated. */
  onRotate?(shape: ShapeDescription, group: ShapeGroup): void;
}

/** A visible group with a bounding box, in scene coordinates. */
export interface BoundedGroup {
  readonly group: Object3D;
  readonly box: Box3;
}

/** What moves the vertices of a shape now. */
export interface DeformedPose {
  /** The shape's. */
  readonly element: SceneElement;
  /** One of each joint of its skin, for points in the shape's coordinates. */
  readonly matrices: readonly Matrix4[];
  /** One of each displacer. */
  readonly weights: readonly number[];
}

export class SceneGroups implements InstanceTreeListener {
  readonly root = new Group();
  readonly #tree = new InstanceTree(this);
  readonly #anchors = new WeakMap<Object3D, AnchorDescription>();
  readonly #listener: ShapeInstanceListener;
  #lightInstances: readonly LightInstance[] = [];
  #lights: SceneLights = makeLights([]);
  #boundedGroups: readonly BoundedGroup[] = [];
  /** Instances of shapes whose vertices move. */
  readonly #deformed = new Set<NodeInstance>();
  /** Weights that displacers have received since the last description. */
  readonly #weights = new Map<SceneElement, number>();
  /** The summary that has been followed last. */
  #summary: SubtreeSummary | undefined;

  constructor(listener: ShapeInstanceListener) {
    this.#listener = listener;
    this.root.matrixAutoUpdate = false;
    this.root.add(this.#lights.root);
  }

  /** Bounds of all visible shapes, in scene coordinates. */
  get box(): Box3 {
    return boundsOf(this.#tree.root);
  }

  /** Groups that can be culled as a whole. */
  get boundedGroups(): readonly BoundedGroup[] {
    return this.#boundedGroups;
  }

  /** In document order. */
  get viewpoints(): readonly ViewpointInstance[] {
    return this.#tree.root.summary.viewpoints;
  }

  /** Those that can be bound, in document order. */
  get backgrounds(): readonly BackgroundInstance[] {
    return bindableOf(this.#tree.root.summary.backgrounds);
  }

  /** Those that can be bound, in document order. */
  get fogs(): readonly FogInstance[] {
    return bindableOf(this.#tree.root.summary.fogs);
  }

  get localFogs(): readonly LocalFogInstance[] {
    return this.#tree.root.summary.localFogs;
  }

  get clipPlanes(): readonly ClipPlaneInstance[] {
    return this.#tree.root.summary.clipPlanes;
  }

  /** Those that are on, in document order. */
  get environmentLights(): readonly EnvironmentLightInstance[] {
    return this.#tree.root.summary.environmentLights;
  }

  get lods(): readonly LodInstance[] {
    return this.#tree.root.summary.lods;
  }

  /** Visible Anchors. */
  get anchors(): readonly AnchorDescription[] {
    return this.#tree.root.summary.anchors;
  }

  /** Whether the scene has lights, clip planes, fogs or EnvironmentLights, whose uniforms depend on transforms. */
  get hasEffects(): boolean {
    const { lights, clipPlanes, fogs, localFogs, environmentLights } = this.#tree.root.summary;
    return [lights, clipPlanes, fogs, localFogs, environmentLights].some((list) => list.length > 0);
  }

  /** The innermost Anchor around the group of a shape. */
  anchorAround(group: Object3D): AnchorDescription | undefined {
    for (let at: Object3D | null = group; at !== null; at = at.parent) {
      const anchor = this.#anchors.get(at);
      if (anchor !== undefined) return anchor;
    }
    return undefined;
  }

  get lightUniforms(): SceneLightUniforms {
    return this.#lights.uniforms;
  }

  /**
   * Follows a new description of the scene. Returns whether effect scopes have been renumbered. The listener is not
   * called for an instance whose scope just has another number.
   */
  follow(root: GroupDescription): boolean {
    this.#weights.clear();
    this.#tree.update(root);
    return this.#followSummary();
  }

  /**
   * Gives Transforms other values, see `InstanceTree.move`, and displacers other weights. Returns whether effect scopes
   * have been renumbered.
   */
  move(changes: Iterable<PoseChange>): boolean {
    for (const change of changes) if (change.field === "weight") this.#weights.set(change.element, change.value);
    this.#tree.move(changes);
    return this.#followSummary();
  }

  /** Transforms the coordinates of a Transform's children to the scene's; undefined if it is not in the scene. */
  sceneFromTransform(element: SceneElement): Matrix4 | undefined {
    return this.#tree.transformOf(element)?.sceneFromNode;
  }

  /** The poses of all shapes whose vertices move. Of several instances of a shape the first counts. */
  *poses(): Generator<DeformedPose> {
    const seen = new Set<SceneElement>();
    for (const { description, sceneFromNode } of this.#deformed) {
      if (description.kind !== "shape" || !description.deformer || seen.has(description.element)) continue;
      seen.add(description.element);
      const { skin, displacers } = description.deformer;
      yield {
        element: description.element,
        matrices: skin ? jointMatrices(skin, sceneFromNode, (joint) => this.sceneFromTransform(joint)) : [],
        weights: displacers.map(({ element, weight }) => this.#weights.get(element) ?? weight),
      };
    }
  }

  #followSummary(): boolean {
    const { summary } = this.#tree.root;
    if (summary === this.#summary) return false;
    this.#summary = summary;
    this.#boundedGroups = summary.boundedGroups.flatMap((node) => {
      const { object: group } = node;
      return group && node.box ? [{ group, box: node.box }] : [];
    });
    const areEffectScopesRenumbered = numberEffectScopes(summary.effectScopes);
    if (!areEffectScopesRenumbered && deepEqual(summary.lights, this.#lightInstances)) return false;
    this.#lightInstances = summary.lights;
    this.#lights.root.removeFromParent();
    this.#lights = makeLights(summary.lights);
    this.root.add(this.#lights.root);
    return areEffectScopesRenumbered;
  }

  /** Whether all groups share the matrices of their nodes: see shareMatrices. */
  get #sharesAll(): boolean {
    return this.#listener.isWorld === true && !this.hasBillboards;
  }

  /** Whether the scene has billboards. */
  get hasBillboards(): boolean {
    return this.#tree.root.summary.billboards.length > 0;
  }

  /** Call before a frame: turns billboards to the camera, whose matrix must be up to date. */
  rotateBillboards({ matrixWorld }: Camera): void {
    for (const node of this.#tree.root.summary.billboards) {
      const { object: group } = node;
      if (!group?.parent || node.description.kind !== "group") continue;
      const parentFromScene = group.parent.matrixWorld.clone().invert();
      const eye = new Vector3().setFromMatrixPosition(matrixWorld).applyMatrix4(parentFromScene);
      const up = new Vector3().setFromMatrixColumn(matrixWorld, 1).transformDirection(parentFromScene);
      const rotation = billboardRotation(node.description.billboardAxis ?? [0, 1, 0], eye, up);
      if (rotation.equals(group.matrix)) continue;
      group.matrix.copy(rotation);
      this.#updateMatrices(node);
    }
  }

  /** Updates world matrices of a node and its descendants, after a billboard around it has rotated. */
  #updateMatrices(node: NodeInstance): void {
    const { object: group } = node;
    const shapeGroup = shapeGroupOf(node);
    if (shapeGroup && node.description.kind === "shape") {
      shapeGroup.updateMatrixWorld(true);
      this.#listener.onRotate?.(node.description, shapeGroup);
      return;
    }
    if (group?.parent) group.matrixWorld.multiplyMatrices(group.parent.matrixWorld, group.matrix);
    for (const child of node.children) this.#updateMatrices(child);
  }

  onEnter(node: NodeInstance): void {
    const { description } = node;
    if (description.kind === "group")
      this.#addGroup(node, description, this.#listener.makeGroup?.(description) ?? this.#makeGroup());
    if (description.kind !== "shape") return;
    const group: ShapeGroup = this.#makeGroup();
    group.effectScope = node.effectScope;
    if (description.deformer) this.#deformed.add(node);
    this.#addGroup(node, description, group);
    this.#listener.onEnter(description, node, group);
  }

  onChange(node: NodeInstance, hasMoved: boolean, before: NodeDescription): void {
    const { description } = node;
    const { object: group } = node;
    if (group === undefined || (description.kind !== "group" && description.kind !== "shape")) return;
    this.#applyDescription(node, description, group, hasMoved);
    const shapeGroup = shapeGroupOf(node);
    if (shapeGroup) shapeGroup.effectScope = node.effectScope;
    if (description.kind === "shape" && description.deformer) this.#deformed.add(node);
    else this.#deformed.delete(node);
    if (shapeGroup && description.kind === "shape" && before.kind === "shape")
      this.#listener.onChange(description, node, shapeGroup, before);
  }

  onMove(node: NodeInstance): void {
    const shapeGroup = shapeGroupOf(node);
    // Groups that share the matrices of their nodes have moved.
    const group = shapeGroup ?? (this.#sharesAll ? undefined : node.object);
    if (group === undefined) return;
    if (group.matrixWorld !== node.sceneFromNode) applyTransform(node, group);
    else if (group.children.length > 0 && shapeGroup) group.updateMatrixWorld(true);
    if (shapeGroup) this.#listener.onMove?.(node, shapeGroup);
  }

  onLeave(node: NodeInstance): void {
    const shapeGroup = shapeGroupOf(node);
    if (shapeGroup && node.description.kind === "shape") this.#listener.onLeave(node.description, node, shapeGroup);
    if (node.object) removeVisited(node.object);
    node.object = undefined;
    this.#deformed.delete(node);
  }

  /** Applications may visit the groups of theirs. */
  #makeGroup(): Group {
    return this.#listener.isWorld === true ? new VisitedGroup() : new Group();
  }

  #addGroup(node: NodeInstance, description: GroupDescription | ShapeDescription, group: Object3D): void {
    group.matrixAutoUpdate = false;
    node.object = group;
    const parent = node.parent === undefined ? this.root : node.parent.object;
    if (parent) addUnvisited(group, parent);
    this.#applyDescription(node, description, group, true);
  }

  #applyDescription(
    node: NodeInstance,
    description: GroupDescription | ShapeDescription,
    group: Object3D,
    hasMoved: boolean,
  ): void {
    if (description.kind === "group" && description.anchor) this.#anchors.set(group, description.anchor);
    else this.#anchors.delete(group);
    group.visible = description.visible;
    if (!hasMoved) return;
    if (this.#listener.isWorld === true) shareMatrices(node, group);
    applyTransform(node, group);
  }
}

/** The group of an instance of a shape. */
function shapeGroupOf({ isShape, object }: NodeInstance): ShapeGroup | undefined {
  return isShape ? (object as ShapeGroup | undefined) : undefined;
}

/** A joint that is not in the scene stays where the shape was modelled. */
function jointMatrices(
  { joints, inverseBindMatrices }: SkinDescription,
  sceneFromShape: Matrix4,
  sceneFromJoint: (joint: SceneElement) => Matrix4 | undefined,
): Matrix4[] {
  const shapeFromScene = sceneFromShape.clone().invert();
  return joints.map((joint, index) => {
    const sceneFrom = sceneFromJoint(joint);
    if (sceneFrom === undefined) return new Matrix4();
    const jointFromModel = new Matrix4().fromArray(inverseBindMatrices, 16 * index);
    return jointFromModel.premultiply(sceneFrom).premultiply(shapeFromScene);
  });
}

/**
 * Makes a group use the matrices of its node, which moves change in place. Not below billboards, which turn for each
 * view.
 */
function shareMatrices({ parent, parentFromNode, sceneFromNode, description }: NodeInstance, group: Object3D): void {
  const isFixed = parent === undefined || group.parent?.matrixWorld === parent.sceneFromNode;
  const isBillboard = description.kind === "group" && description.billboardAxis !== undefined;
  group.matrixWorld = isFixed && !isBillboard ? sceneFromNode : new Matrix4();
  if (description.kind === "group") group.matrix = parentFromNode ?? new Matrix4();
}

function applyTransform({ parentFromNode, description }: NodeInstance, group: Object3D): void {
  if (description.kind === "shape") {
    // Its own matrix is the identity, and what batches draw has no objects in it.
    if (group.parent && group.children.length === 0) group.matrixWorld.copy(group.parent.matrixWorld);
    else group.updateMatrixWorld(true);
    return;
  }
  if (parentFromNode && parentFromNode !== group.matrix) group.matrix.copy(parentFromNode);
  else if (!parentFromNode) group.matrix.identity();
  // Groups below this one are visited next, so only its own world matrix is updated.
  if (group.parent) group.matrixWorld.multiplyMatrices(group.parent.matrixWorld, group.matrix);
}
