// The shapes of a scene in an app's own three.js scene. Each shape's object holds the stages loaded so far and draws
// them in a group for each instance of the shape.

import type { Group } from "three";
import type { DeliveryError } from "../delivery/deliveryError.ts";
import type { SceneDeliveries } from "../delivery/requestWithinBudget.ts";
import type { TextureImage } from "../delivery/content.ts";
import type { ShapeDescription, TextureRole } from "../document/description.ts";
import type { SceneElement } from "../document/element.ts";
import { attributeOf } from "../document/element.ts";
import type { PickCandidate } from "../render/picking/picker.ts";
import type { DeformedPose, ShapeInstanceListener } from "../render/shapes/sceneGroups.ts";
import type { SceneChanges } from "../render/shapes/shapeChanges.ts";
import { ShapeChangeRecorder } from "../render/shapes/shapeChanges.ts";
import type { ShapeContext } from "../render/shapes/shapeObject.ts";
import { ShapeObject } from "../render/shapes/shapeObject.ts";
import { isVisibleInScene } from "../render/shapes/visibility.ts";
import type { NodeInstance } from "../scene/nodeInstance.ts";
import type { StageChange } from "../viewer/geometryExchange.ts";
import { LoadingShape } from "../viewer/loadingShape.ts";
import { LoadingShapes } from "../viewer/loadingShapes.ts";
import type { LoadState } from "./sceneLod.ts";

export interface AppShapesListener {
  /** The picture has changed. */
  onChange(): void;
  /** A file could not be fetched or decoded. */
  onError(error: DeliveryError): void;
  /** A patch displays a new stage, or no further file of a shape is being loaded. */
  onAdvance(): void;
}

/** A shape's object, made for the shape's first instance. */
interface InstancedObject {
  readonly object: ShapeObject;
  /** The shape's description by instance: each has its own visibility and effect scope. */
  readonly instances: Map<NodeInstance, ShapeDescription>;
}

export class AppShape extends LoadingShape {
  readonly object: ShapeObject;
  /** Indices of patches that display nothing yet and whose files may still load. */
  missingPatches: Set<number>;
  readonly #context: ShapeContext;
  readonly #listener: AppShapesListener;

  constructor(
    context: ShapeContext,
    deliveries: SceneDeliveries,
    described: ShapeDescription,
    object: ShapeObject,
    listener: AppShapesListener,
  ) {
    super(deliveries, described);
    this.#context = context;
    this.#listener = listener;
    this.object = object;
    this.missingPatches = new Set(described.geometry?.patches.keys());
  }

  override onStage({ geometry, patch, stage, drawn }: StageChange): void {
    this.object.setStage(drawn, patch, stage);
    if (geometry === this.geometry) this.missingPatches.delete(patch);
    this.#listener.onChange();
    this.#listener.onAdvance();
  }

  override onFrame(): void {
    this.#listener.onChange();
  }

  override onGeometryReplaced(): void {
    this.missingPatches = new Set(this.geometry?.patches.keys());
  }

  override onReplacing(): void {
    // An app's renderer allocates memory, and frees it, as for its other objects.
  }

  override onSwap(): void {
    // as above
  }

  override onTextureImage(role: TextureRole, image: TextureImage | undefined): void {
    this.object.setTexture(
      role,
      image && { texture: this.#context.textures.textureOf(image.image), hasAlpha: image.hasAlpha },
    );
    this.#listener.onChange();
  }

  override onError(error: DeliveryError): void {
    this.#listener.onError(error);
  }

  override onSettled(): void {
    this.forgetMissing();
    this.#listener.onAdvance();
  }

  override onRemoved(): void {
    this.object.clear();
  }

  /**
   * Empties `missingPatches` if the shape is visible and has no file left to load. Files of a hidden shape may still be
   * requested.
   */
  forgetMissing(): void {
    if (this.isVisible && this.isGeometrySettled) this.missingPatches.clear();
  }
}

export class AppShapes extends LoadingShapes<AppShape> implements ShapeInstanceListener {
  readonly #context: ShapeContext;
  readonly #deliveries: SceneDeliveries;
  readonly #listener: AppShapesListener;
  readonly #objects = new Map<SceneElement, InstancedObject>();
  readonly #elementOf = new WeakMap<object, SceneElement>();
  #changes = new ShapeChangeRecorder();

  constructor(context: ShapeContext, deliveries: SceneDeliveries, listener: AppShapesListener) {
    super();
    this.#context = context;
    this.#deliveries = deliveries;
    this.#listener = listener;
  }

  onEnter(shape: ShapeDescription, instance: NodeInstance, group: Group): void {
    const { object } = this.#objectOf(shape);
    this.#elementOf.set(group, shape.element);
    group.name = attributeOf(shape.element, "DEF") ?? "";
    object.addInstance(group, shape.host);
    this.onChange(shape, instance, group);
  }

  /**
   * The renderer of a LOD chooses its level, so a group in it is hidden only where the document hides its shape in
   * every level.
   */
  onChange(shape: ShapeDescription, instance: NodeInstance, group: Group): void {
    group.visible = shape.contributesToBounds;
    this.#objectOf(shape).instances.set(instance, shape);
    this.#changes.recordPresent(shape, instance);
  }

  /** Never called: an app's document does not change, and loaded Inlines only add nodes to it. */
  readonly onLeave = (): void => undefined;

  /** Returns the changes since the last call. */
  takeChanges(): SceneChanges {
    const { shapes, instances } = this.#changes;
    this.#changes = new ShapeChangeRecorder();
    const mergedShapes = Array.from(shapes.values(), (shape) => ({ ...shape, visible: this.#isVisible(shape) }));
    return { shapes: new Map(mergedShapes.map((shape) => [shape.element, shape])), removed: [], instances };
  }

  /** Moves the vertices of a shape. */
  setPose({ element, matrices, weights }: DeformedPose): void {
    this.#objects.get(element)?.object.setPose(matrices, weights);
  }

  /** Whether any patch displays something. */
  get hasPicture(): boolean {
    return Array.from(this).some(({ object }) => !object.isEmpty);
  }

  /** Whether each patch of a visible shape displays something or has failed. */
  get areDisplayed(): boolean {
    return this.#areAllVisible(({ missingPatches }) => missingPatches.size === 0);
  }

  /** Whether no file of a visible shape is being loaded. */
  get areSettled(): boolean {
    return this.#areAllVisible(({ isSettled }) => isSettled);
  }

  /** The state of the shape that a group belongs to; undefined for a group of no shape. */
  loadStateOf(group: object): LoadState | undefined {
    const element = this.#elementOf.get(group);
    const shape = element && this.get(element);
    if (shape === undefined) return undefined;
    if (shape.missingPatches.size > 0) return "loading";
    return !shape.object.isEmpty ? "displayed" : shape.geometry === undefined ? "empty" : "failed";
  }

  /** Width of the widest point or line in CSS pixels; 0 where no shape sets one. */
  get maxWidth(): number {
    return Array.from(this).reduce((max, { object }) => Math.max(max, object.maxWidth), 0);
  }

  *pickCandidates(): Generator<PickCandidate> {
    for (const { object } of this) {
      if (!object.isPickable) continue;
      for (const candidate of object.pickCandidates()) if (isVisibleInScene(candidate.group)) yield candidate;
    }
  }

  /** Empties `missingPatches` of visible shapes that have no file left to load. */
  forgetMissing(): void {
    for (const shape of this) shape.forgetMissing();
  }

  override dispose(): void {
    super.dispose();
    for (const { object } of this.#objects.values()) object.dispose();
    this.#objects.clear();
  }

  protected override get isSuspended(): boolean {
    return false; // after a context loss, three.js uploads everything again by itself
  }

  protected override makeShape(described: ShapeDescription): AppShape {
    const { object } = this.#objectOf(described);
    object.setShape(described);
    return new AppShape(this.#context, this.#deliveries, described, object, this.#listener);
  }

  #objectOf(shape: ShapeDescription): InstancedObject {
    const known = this.#objects.get(shape.element) ?? {
      object: new ShapeObject(this.#context, shape),
      instances: new Map<NodeInstance, ShapeDescription>(),
    };
    this.#objects.set(shape.element, known);
    return known;
  }

  #isVisible({ element }: ShapeDescription): boolean {
    return Array.from(this.#objects.get(element)?.instances.values() ?? []).some(({ visible }) => visible);
  }

  #areAllVisible(condition: (shape: AppShape) => boolean): boolean {
    for (const shape of this) if (shape.isVisible && !condition(shape)) return false;
    return true;
  }
}
