// Steers deliveries by what the camera sees: says which files each geometry
// needs, and how soon, when the scene or the view has changed.

import type { PlacedGeometry, Viewing } from "../delivery/demand.ts";
import { demandFor, placeGeometry, textureDemandFor } from "../delivery/demand.ts";
import type { SceneDeliveries } from "../delivery/demandWithin.ts";
import { demandWithin, storedBytesOf } from "../delivery/demandWithin.ts";
import { pictureKeyOf } from "../delivery/textureDeliveries.ts";
import type { GeometryDescription, SceneDescription } from "../document/description.ts";
import { shapesOf } from "../document/description.ts";
import type { SceneElement } from "../document/element.ts";
import type { SceneRenderer } from "../render/sceneRenderer.ts";
import type { View } from "../render/view.ts";
import type { ChunkWeights } from "../scheduler/priority.ts";
import { chunkWeightsOf, defaultChunkWeights } from "../scheduler/priority.ts";
import { planesOf } from "../scheduler/view.ts";

/** While the camera moves, the order changes this often; a few files' time on a fast line. */
const steeringIntervalMs = 100;

export class Steering {
  readonly #renderer: SceneRenderer;
  readonly #deliveries: SceneDeliveries;
  readonly #onSteered: () => void;
  #places: Places = { geometries: new Map(), pictures: new Map() };
  #weights: ChunkWeights = defaultChunkWeights;
  #view: View | undefined;
  #mostBytes = Infinity;
  /** What all deliveries were known to take when they were last steered. */
  #knownBytes = 0;
  #timer: ReturnType<typeof setTimeout> | undefined;
  #isHeld = true;

  /** `onSteered` is called when files may have been added to those that are wanted, or taken from them. */
  constructor(renderer: SceneRenderer, deliveries: SceneDeliveries, onSteered: () => void) {
    this.#renderer = renderer;
    this.#deliveries = deliveries;
    this.#onSteered = onSteered;
  }

  /** Steers by this scene, which the renderer shows already; `onProblem` is told what cannot be read of its weights. */
  setScene(scene: SceneDescription, onProblem: (problem: string) => void): void {
    this.#weights = chunkWeightsOf(scene.chunkPriority, onProblem);
    this.#places = placesIn(scene, this.#renderer);
    this.steer();
  }

  /** Bytes on the GPU that deliveries may take. */
  setBudget(mostBytes: number): void {
    if (mostBytes === this.#mostBytes) return;
    this.#mostBytes = mostBytes;
    this.steer();
  }

  /** Asks for nothing before this. */
  begin(): void {
    this.#isHeld = false;
    this.steer();
  }

  /** Soon, if since the last time the camera has moved, or more has come than may. */
  follow(): void {
    if (this.#timer !== undefined) return;
    const storedBytes = storedBytesOf(this.#deliveries);
    const isOverBudget = storedBytes > this.#mostBytes && storedBytes !== this.#knownBytes;
    if (!isOverBudget && isSameView(this.#renderer.view, this.#view)) return;
    this.#timer = setTimeout(() => { this.steer(); }, steeringIntervalMs);
  }

  /** Now. */
  steer(): void {
    this.stop();
    if (this.#isHeld) return;
    this.#view = this.#renderer.view;
    const viewing = viewingOf(this.#view, this.#weights);
    demandWithin(this.#deliveries, (geometry) => demandFor(this.#places.geometries.get(geometry) ?? [], viewing),
                 (key, chunk) => textureDemandFor(this.#places.pictures.get(key) ?? [], chunk, viewing), this.#mostBytes);
    this.#knownBytes = storedBytesOf(this.#deliveries);
    this.#onSteered();
  }

  stop(): void {
    clearTimeout(this.#timer);
    this.#timer = undefined;
  }
}

interface Places {
  readonly geometries: Map<GeometryDescription, PlacedGeometry[]>;
  /** By their keys. */
  readonly pictures: Map<string, PlacedGeometry[]>;
}

/** Where each geometry and picture is seen: a shape stands in as many places as it is met with in the tree. */
function placesIn(scene: SceneDescription, renderer: SceneRenderer): Places {
  const met = new Map<SceneElement, number>();
  const places: Places = { geometries: new Map(), pictures: new Map() };
  for (const { element, geometry, visible, priority, appearance: { textures } } of shapesOf(scene.root)) {
    const place = met.get(element) ?? 0;
    met.set(element, place + 1);
    const matrix = renderer.sceneFromShape(element, place);
    if (geometry === undefined || matrix === undefined || !visible) continue;
    const placed = placeGeometry(geometry, matrix, priority, textures.length > 0);
    note(places.geometries, geometry, placed);
    for (const texture of textures) note(places.pictures, pictureKeyOf(texture), placed);
  }
  return places;
}

function note<Key>(places: Map<Key, PlacedGeometry[]>, key: Key, placed: PlacedGeometry): void {
  const known = places.get(key) ?? [];
  known.push(placed);
  places.set(key, known);
}

function viewingOf(view: View | undefined, weights: ChunkWeights): Viewing {
  return { weights, camera: view && { ...view, planes: planesOf(view.clipFromScene) } };
}

function isSameView(a: View | undefined, b: View | undefined): boolean {
  if (a === undefined || b === undefined) return a === b;
  return a.pixelsPerUnit === b.pixelsPerUnit && a.clipFromScene.every((value, place) => value === b.clipFromScene[place]);
}
