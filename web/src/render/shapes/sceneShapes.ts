// Holds the drawn shapes of a scene by their elements, with their groups and bounds.

import type { Camera, Matrix4, Object3D, Sphere } from "three";
import { Box3, Material, Vector3 } from "three";
import type { Bounds } from "../../stage/vertexArray.ts";
import type { Stage } from "../../stage/stage.ts";
import type {
  AnchorDescription,
  CubeMapRole,
  GeometryDescription,
  SceneDescription,
  ShapeDescription,
  TextureRole,
} from "../../document/description.ts";
import type { SceneElement } from "../../document/element.ts";
import type {
  BackgroundInstance,
  EnvironmentLightInstance,
  LodInstance,
  ViewpointInstance,
} from "../../scene/instances.ts";
import type { PoseChange } from "../../scene/instanceTree.ts";
import type { NodeInstance } from "../../scene/nodeInstance.ts";
import { isDrawable, sphereAround } from "../../scene/bounds.ts";
import { BatchingPlan } from "../batches/batchingPlan.ts";
import type { LateBatches } from "../batches/lateBatches.ts";
import type { SurfaceTexture } from "../materials/surfaceTextures.ts";
import type { PickCandidate } from "../picking/picker.ts";
import { clipPlanesOf, setClipPlanes, setViewOfClipPlanes } from "../environment/clipPlanes.ts";
import { lateEnvironment } from "../environment/lateEnvironment.ts";
import { sceneEffectsKey } from "../environment/sceneEffects.ts";
import type { ShapeGroup } from "./shapeGroup.ts";
import { BindingStack } from "../../navigation/bindingStack.ts";
import { sceneScope } from "../../scene/effectScope.ts";
import type { BoundedGroup } from "./sceneGroups.ts";
import { SceneGroups } from "./sceneGroups.ts";
import type { SceneChanges } from "./shapeChanges.ts";
import { ShapeChangeRecorder } from "./shapeChanges.ts";
import type { ShapeContext } from "./shapeObject.ts";
import { ShapeObject } from "./shapeObject.ts";
import { isVisibleInScene } from "./visibility.ts";
import { frustumOf } from "../frames/viewFrustum.ts";

/** The content of a scene, in scene coordinates. */
export interface BuiltScene {
  /** The bounding sphere of all visible shapes. */
  readonly sphere: Sphere;
  /** In document order. */
  readonly viewpoints: readonly ViewpointInstance[];
  readonly backgrounds: readonly BackgroundInstance[];
  readonly environmentLights: readonly EnvironmentLightInstance[];
  readonly lods: readonly LodInstance[];
  /** Visible Anchors. */
  readonly anchors: readonly AnchorDescription[];
}

export interface ChangedScene extends BuiltScene {
  readonly changes: SceneChanges;
}

export class SceneShapes {
  readonly #context: ShapeContext;
  readonly #batches: LateBatches;
  readonly #graph: SceneGroups;
  readonly #shapes = new Map<SceneElement, ShapeObject>();
  readonly #plan = new BatchingPlan();
  readonly #boundFogs = new BindingStack<SceneElement>();
  #changes = new ShapeChangeRecorder();
  /** Each once. */
  #moved: NodeInstance[] = [];
  /** Shapes whose document does not state their bounds, so that their vertices determine them. */
  readonly #unbounded = new Set<ShapeObject>();
  #sphere = sphereAround(new Box3());
  #boundedGroups: readonly BoundedGroup[] = [];
  /** The bounds that the document states. */
  #documentBox = new Box3();
  /** The same bounds, extended by those of vertices. */
  #box = new Box3();
  /** Maximum width of lines in CSS pixels. */
  #maxLineWidth = 0;

  /** Adds its objects to `scene`. */
  constructor(scene: Object3D, context: ShapeContext & { readonly batches: LateBatches }) {
    this.#context = context;
    this.#batches = context.batches;
    this.#graph = new SceneGroups({
      isWorld: true,
      onEnter: (shape, instance, group) => {
        this.#objectOf(shape).addInstance(group, shape.host);
        if (shape.geometry) this.#plan.add(shape.geometry);
        this.#changes.recordPresent(shape, instance);
      },
      onChange: (shape, instance, group, before) => {
        this.#objectOf(shape).updateInstance(group);
        if (before.geometry !== shape.geometry) {
          if (before.geometry) this.#plan.remove(before.geometry);
          if (shape.geometry) this.#plan.add(shape.geometry);
        }
        this.#changes.recordPresent(shape, instance);
      },
      onMove: (instance, group) => {
        this.#batches.follow(group);
        if (instance.isAmongMoved) return;
        instance.isAmongMoved = true;
        this.#moved.push(instance);
      },
      onLeave: (shape, instance, group) => {
        this.#shapes.get(shape.element)?.removeInstance(group);
        if (shape.geometry) this.#plan.remove(shape.geometry);
        this.#changes.recordRemoved(shape, instance);
      },
      onRotate: (shape, group) => {
        this.#objectOf(shape).updateInstance(group);
      },
    });
    scene.add(this.#graph.root, this.#batches.root);
  }

  /** How the geometries of this scene are drawn. */
  get plan(): BatchingPlan {
    return this.#plan;
  }

  /** Whether no shape displays anything yet. */
  get isEmpty(): boolean {
    for (const { isEmpty } of this.#shapes.values()) if (!isEmpty) return false;
    return true;
  }

  /** The bounding sphere of all visible shapes, in scene coordinates. Grows when vertices arrive outside it. */
  get sphere(): Sphere {
    return this.#sphere;
  }

  /** Maximum width of points and lines in CSS pixels; 0 if no shape sets one. */
  get maxWidth(): number {
    return Array.from(this.#shapes.values()).reduce((widest, { maxWidth }) => Math.max(widest, maxWidth), 0);
  }

  /**
   * Replaces the scene. GPU resources of shapes that it no longer has, or that have another geometry, are freed.
   */
  setScene(description: SceneDescription): ChangedScene {
    const areEffectScopesRenumbered = this.#graph.follow(description.root);
    this.#boundFogs.follow(this.#graph.fogs);
    this.#setEffects();
    const changes = this.#applyChanges();
    return { ...this.#built(areEffectScopesRenumbered), changes };
  }

  /** Gives Transforms and displacers other values: see `SceneGroups.move`. */
  move(changes: Iterable<PoseChange>): BuiltScene {
    const areEffectScopesRenumbered = this.#graph.move(changes);
    if (areEffectScopesRenumbered || this.#graph.hasEffects) this.#setEffects();
    return this.#built(areEffectScopesRenumbered);
  }

  /** The instances of shapes that `move` has moved since the last call. */
  takeMoved(): readonly NodeInstance[] {
    const moved = this.#moved;
    this.#moved = [];
    for (const instance of moved) instance.isAmongMoved = false;
    return moved;
  }

  /** Transforms the coordinates of a Transform's children to the scene's; undefined if it is not in the scene. */
  sceneFromTransform(element: SceneElement): Matrix4 | undefined {
    return this.#graph.sceneFromTransform(element);
  }

  #built(areEffectScopesRenumbered: boolean): BuiltScene {
    if (areEffectScopesRenumbered) this.#batches.updateAllRecords();
    const { box, boundedGroups, viewpoints, backgrounds, environmentLights, lods, anchors } = this.#graph;
    this.#boundedGroups = boundedGroups;
    if (!box.equals(this.#documentBox)) {
      this.#documentBox = box;
      this.#box = box.clone();
      this.#sphere = sphereAround(box);
    }
    for (const object of this.#unbounded) for (const bounds of object.bounds()) this.#extendBounds(object, bounds);
    this.#batches.setBoundingSphere(this.#sphere);
    for (const { element, matrices, weights } of this.#graph.poses())
      this.#shapes.get(element)?.setPose(matrices, weights);
    return { sphere: this.#sphere, viewpoints, backgrounds, environmentLights, lods, anchors };
  }

  /** Binds or unbinds a Fog, as X3D's set_bind does. Returns false if the element is none of the scene's. */
  bindFog(element: SceneElement, isBound: boolean): boolean {
    if (!this.#graph.fogs.some((fog) => fog.element === element)) return false;
    if (isBound) this.#boundFogs.bind(element);
    else this.#boundFogs.unbind(element);
    this.#setEffects();
    return true;
  }

  /** Sets the uniforms of lights, clip planes and fogs. */
  #setEffects(): void {
    const { shared } = this.#context;
    const { lightUniforms, clipPlanes, fogs, localFogs } = this.#graph;
    const { attenuations, lightScopeRanges, scopedAmbients } = lightUniforms;
    const keyBefore = sceneEffectsKey(shared);
    shared.attenuations.value = attenuations.value;
    shared.lightScopeRanges.value = lightScopeRanges.value;
    shared.scopedAmbients.value = scopedAmbients.value;
    setClipPlanes(shared, clipPlanes);
    const environment = lateEnvironment.added;
    environment?.setEnvironmentLight(shared, this.#graph.environmentLights[0]);
    const bound = fogs.find(({ element, fog }) => element === this.#boundFogs.bound && fog.visibilityRange > 0);
    environment?.setFogs(shared, [...(bound ? [{ ...bound, scope: sceneScope }] : []), ...localFogs]);
    if (sceneEffectsKey(shared) === keyBefore) return;
    for (const root of [this.#graph.root, this.#batches.root]) root.traverse(recompile);
  }

  /** Applies the changes that the groups have reported since the last call. */
  #applyChanges(): SceneChanges {
    const changes = this.#changes;
    this.#changes = new ShapeChangeRecorder();
    const shapes = new Map<SceneElement, ShapeDescription>();
    const removed: SceneElement[] = [];
    for (const [element, shape] of changes.shapes) {
      const object = this.#objectOf(shape);
      if (!object.hasInstances) {
        object.dispose();
        this.#shapes.delete(element);
        this.#unbounded.delete(object);
        removed.push(element);
        continue;
      }
      object.setShape(shape);
      if (shape.geometry) object.setDrawModes(this.#plan.drawModesOf(shape.geometry));
      shapes.set(element, { ...shape, visible: object.isVisible });
    }
    const changedGeometries = this.#plan.takeChanged();
    if (changedGeometries.size > 0) {
      for (const object of this.#shapes.values())
        if (object.geometry && changedGeometries.has(object.geometry))
          object.setDrawModes(this.#plan.drawModesOf(object.geometry));
    }
    if (changes.shapes.size > 0)
      this.#maxLineWidth = Array.from(this.#shapes.values()).reduce(
        (maxWidth, { lineWidth }) => Math.max(maxWidth, lineWidth),
        0,
      );
    return { shapes, removed, instances: changes.instances };
  }

  /** Replaces the stage of a patch of a shape. */
  setStage(element: SceneElement, geometry: GeometryDescription, patch: number, stage: Stage | undefined): void {
    const object = this.#shapes.get(element);
    object?.setStage(geometry, patch, stage);
    if (object === undefined || stage?.bounds === undefined) return;
    this.#unbounded.add(object);
    this.#extendBounds(object, stage.bounds);
  }

  setTexture(element: SceneElement, role: TextureRole | CubeMapRole, texture: SurfaceTexture | undefined): void {
    this.#shapes.get(element)?.setTexture(role, texture);
  }

  /** `asPoints`: draws the vertices of surfaces as points, and no triangles. */
  drawAsPoints(asPoints: boolean): void {
    if (asPoints === this.#context.drawing.asPoints) return;
    this.#context.drawing.asPoints = asPoints;
    for (const object of this.#shapes.values()) object.redraw();
  }

  /** Removes everything that a shape displays. */
  clearShape(element: SceneElement): void {
    this.#shapes.get(element)?.clear();
  }

  /** The innermost Anchor around the group of a shape. */
  anchorAround(group: Object3D): AnchorDescription | undefined {
    return this.#graph.anchorAround(group);
  }

  /** The draws of visible, pickable shapes. */
  *pickCandidates(): Generator<PickCandidate> {
    for (const object of this.#shapes.values()) if (object.isPickable) yield* this.#visibleDraws(object);
  }

  /** All visible draws, including those that the last frame has culled. */
  candidatesIgnoringCulling(): PickCandidate[] {
    const culled = this.#boundedGroups.filter(({ group }) => !group.visible);
    for (const { group } of culled) group.visible = true;
    const draws = Array.from(this.#shapes.values()).flatMap((object) => Array.from(this.#visibleDraws(object)));
    for (const { group } of culled) group.visible = false;
    return draws;
  }

  /**
   * Call before a frame: turns billboards to the camera, and hides groups with bounds outside of the view.
   * `canvasSize` is in CSS pixels.
   */
  cull(camera: Camera, canvasSize: readonly [width: number, height: number]): void {
    camera.updateMatrixWorld();
    setViewOfClipPlanes(this.#context.shared, this.#graph.clipPlanes, camera);
    this.#graph.rotateBillboards(camera);
    const margin = canvasSize.map((pixels) => this.#maxLineWidth / pixels) as [number, number];
    this.#batches.update(camera, margin);
    if (this.#boundedGroups.length === 0) return;
    const frustum = frustumOf(camera.projectionMatrix, camera.matrixWorldInverse, margin);
    for (const { group, box } of this.#boundedGroups) group.visible = frustum.intersectsBox(box);
  }

  dispose(): void {
    for (const object of this.#shapes.values()) object.dispose();
    this.#shapes.clear();
    this.#batches.dispose();
  }

  *#visibleDraws(object: ShapeObject): Generator<PickCandidate> {
    const { clipPlanes } = this.#graph;
    for (const drawn of object.pickCandidates()) {
      if (!isVisibleInScene(drawn.group)) continue;
      const { effectScope = sceneScope } = drawn.group as ShapeGroup;
      yield clipPlanes.length > 0 ? { ...drawn, clipPlanes: clipPlanesOf(effectScope, clipPlanes) } : drawn;
    }
  }

  #extendBounds(object: ShapeObject, { min, max }: Bounds): void {
    for (const group of object.groups) {
      const box = new Box3(new Vector3(...min), new Vector3(...max)).applyMatrix4(group.matrixWorld);
      if (isDrawable(box) && !this.#box.containsBox(box)) this.#sphere = sphereAround(this.#box.union(box));
    }
  }

  #objectOf(shape: ShapeDescription): ShapeObject {
    const known = this.#shapes.get(shape.element);
    if (known !== undefined) return known;
    const object = new ShapeObject(this.#context, shape);
    this.#shapes.set(shape.element, object);
    return object;
  }
}

function recompile(object: Object3D): void {
  if ("material" in object && object.material instanceof Material) object.material.needsUpdate = true;
}
