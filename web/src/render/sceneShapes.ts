// What of a scene is drawn: the shapes of its document by their elements, hung
// into the groups that place them, and how far they reach.

import type { Camera, Object3D, Sphere } from "three";
import { Box3, Frustum, Group, Matrix4, Vector3 } from "three";
import type { Bounds, Stage } from "../decode/stage.ts";
import type { GeometryDescription, SceneDescription, ShapeDescription, TextureRole } from "../document/description.ts";
import { shapesOf } from "../document/description.ts";
import type { SceneElement } from "../document/element.ts";
import type { PlacedViewpoint } from "../navigation/camera.ts";
import { sphereAround } from "../navigation/camera.ts";
import type { PlacedLevels } from "../navigation/placement.ts";
import { isDrawable } from "../navigation/placement.ts";
import type { Batches } from "./batches/batches.ts";
import { planOf } from "./batches/plan.ts";
import type { ShownPicture } from "./look.ts";
import type { PickCandidate } from "./picking.ts";
import type { BoundedGroup } from "./sceneGraph.ts";
import { buildGraph } from "./sceneGraph.ts";
import type { ShapeSetting } from "./shapeObject.ts";
import { ShapeObject } from "./shapeObject.ts";

/** What the scene has in it, in the scene's coordinates. */
export interface BuiltScene {
  /** Around all that is seen. */
  readonly sphere: Sphere;
  /** In document order. */
  readonly viewpoints: readonly PlacedViewpoint[];
  readonly levels: readonly PlacedLevels[];
}

export class SceneShapes {
  readonly #scene: Object3D;
  readonly #setting: ShapeSetting;
  readonly #batches: Batches;
  readonly #shapes = new Map<SceneElement, ShapeObject>();
  #root = new Group();
  #sphere = sphereAround(new Box3());
  #box = new Box3();
  #bounded: readonly BoundedGroup[] = [];

  /** What is drawn hangs in `scene`. */
  constructor(scene: Object3D, setting: ShapeSetting & { readonly batches: Batches }) {
    this.#scene = scene;
    this.#setting = setting;
    this.#batches = setting.batches;
    scene.add(this.#batches.root);
  }

  /** No shape shows anything yet. */
  get isEmpty(): boolean {
    for (const { isEmpty } of this.#shapes.values()) if (!isEmpty) return false;
    return true;
  }

  /** Around all that is seen, in the scene's coordinates. Grows when vertices tell of a box that the document does not. */
  get sphere(): Sphere {
    return this.#sphere;
  }

  /** What points and lines may be wide, in CSS pixels; 0 where no shape says. */
  get largestWidth(): number {
    let largest = 0;
    for (const { largestWidth } of this.#shapes.values()) largest = Math.max(largest, largestWidth);
    return largest;
  }

  /** What puts a shape into its place number `place`: 16 numbers, column by column. */
  sceneFromShape(element: SceneElement, place: number): readonly number[] | undefined {
    return this.#shapes.get(element)?.groupAt(place).matrixWorld.elements;
  }

  /** Shows this scene from now on. Shapes that are gone give back what they hold on the GPU. */
  setScene(description: SceneDescription): BuiltScene {
    const everywhere = shapesOf(description.root);
    const shapes = new Map(everywhere.map((shape) => [shape.element, shape]));
    const drawingOf = planOf(everywhere);
    for (const [element, object] of this.#shapes) {
      if (shapes.has(element)) continue;
      object.dispose();
      this.#shapes.delete(element);
    }
    const places = new Map<SceneElement, number>();
    const { root, box, bounded, viewpoints, levels, attenuations } = buildGraph(description, (shape) => {
      const place = places.get(shape.element) ?? 0;
      places.set(shape.element, place + 1);
      return this.#objectOf(shape).groupAt(place);
    });
    for (const [element, shape] of shapes) {
      const object = this.#objectOf(shape);
      object.keepPlaces(places.get(element) ?? 0);
      object.setShape(shape, shape.geometry ? drawingOf(shape.geometry) : "alone");
    }
    this.#setting.shared.attenuations.value = attenuations;
    this.#root.removeFromParent();
    this.#root = root;
    this.#scene.add(root);
    root.updateMatrixWorld();
    this.#box = box;
    this.#bounded = bounded;
    this.#sphere = sphereAround(box);
    for (const object of this.#shapes.values()) for (const bounds of object.bounds()) this.#grow(object, bounds);
    this.#batches.sync(this.#sphere);
    return { sphere: this.#sphere, viewpoints, levels };
  }

  /** Replaces what a patch of a shape shows. */
  setStage(element: SceneElement, geometry: GeometryDescription, patch: number, stage: Stage | undefined): void {
    const object = this.#shapes.get(element);
    object?.setStage(geometry, patch, stage);
    if (object !== undefined && stage?.kind === "buffers" && stage.bounds !== undefined) this.#grow(object, stage.bounds);
  }

  setPicture(element: SceneElement, role: TextureRole, picture: ShownPicture | undefined): void {
    this.#shapes.get(element)?.setPicture(role, picture);
  }

  /** Surfaces as they are, or their vertices. */
  drawAsPoints(asPoints: boolean): void {
    if (asPoints === this.#setting.drawing.asPoints) return;
    this.#setting.drawing.asPoints = asPoints;
    for (const object of this.#shapes.values()) object.redraw();
  }

  /** Takes away what a shape shows. */
  clearShape(element: SceneElement): void {
    this.#shapes.get(element)?.clear();
  }

  /** What is drawn and may be picked. */
  *pickCandidates(): Generator<PickCandidate> {
    for (const [element, object] of this.#shapes) if (object.isPickable) yield* shownDraws(element, object);
  }

  /** What the document shows, also where the last frame has not looked. */
  drawsAround(): PickCandidate[] {
    const passedOver = this.#bounded.filter(({ group }) => !group.visible);
    for (const { group } of passedOver) group.visible = true;
    const draws = Array.from(this.#shapes).flatMap(([element, object]) => Array.from(shownDraws(element, object)));
    for (const { group } of passedOver) group.visible = false;
    return draws;
  }

  /** Before a frame: groups that tell where they end are not looked into when they are out of the view. */
  passOver(camera: Camera): void {
    camera.updateMatrixWorld();
    this.#batches.update(camera);
    if (this.#bounded.length === 0) return;
    const frustum = new Frustum().setFromProjectionMatrix(new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse));
    for (const { group, box } of this.#bounded) group.visible = frustum.intersectsBox(box);
  }

  dispose(): void {
    for (const object of this.#shapes.values()) object.dispose();
    this.#shapes.clear();
    this.#batches.dispose();
  }

  #grow(object: ShapeObject, { min, max }: Bounds): void {
    for (const group of object.groups) {
      const box = new Box3(new Vector3(...min), new Vector3(...max)).applyMatrix4(group.matrixWorld);
      if (isDrawable(box) && !this.#box.containsBox(box)) this.#sphere = sphereAround(this.#box.union(box));
    }
  }

  #objectOf(shape: ShapeDescription): ShapeObject {
    const known = this.#shapes.get(shape.element);
    if (known !== undefined) return known;
    const object = new ShapeObject(this.#setting, shape);
    this.#shapes.set(shape.element, object);
    return object;
  }
}

function* shownDraws(element: SceneElement, object: ShapeObject): Generator<PickCandidate> {
  for (const drawn of object.placedDraws()) if (isShown(drawn.group)) yield { ...drawn, element };
}

function isShown(object: Object3D | null): boolean {
  return object === null || (object.visible && isShown(object.parent));
}
