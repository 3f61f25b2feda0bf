// Where the camera is, and why: viewpoints bind and unbind, hands and keys move
// it, journeys lead it. Knows nothing of the document or the screen; whoever
// draws asks `advance` for the pose of each frame.

import { Sphere, Vector3 } from "three";
import type { NavigationDescription } from "../document/description.ts";
import type { SceneElement } from "../document/element.ts";
import { BindingStack } from "./bindingStack.ts";
import type { PlacedViewpoint, Pose } from "./camera.ts";
import { panned, poseFraming, poseOfViewpoint, poseShowingAll, turned, zoomed } from "./camera.ts";
import { Journey } from "./journey.ts";
import type { NavigationType } from "./navigationType.ts";
import { navigationTypesOf } from "./navigationType.ts";
import type { Motion } from "./travel.ts";
import { isStandingStill, looked, standingStill, stepped, travelled } from "./travel.ts";

/** What the navigator must know of a scene. */
export interface NavigatedScene {
  /** Around all that is seen. */
  readonly sphere: Sphere;
  readonly viewpoints: readonly PlacedViewpoint[];
  readonly navigation: NavigationDescription;
}

/** Who moved the camera, in the words of <model-viewer>. */
export type ChangeSource = "user-interaction" | "automatic" | "none";

/** A frame that came so much later is treated as if it came then: nobody wants to cover the time of a hidden tab. */
const longestFrameSeconds = 0.1;

export class Navigator {
  /** Journeys take no time, as people ask for who prefer reduced motion. */
  isInstant = false;
  readonly #onChange: () => void;
  readonly #viewpoints = new BindingStack<SceneElement>();
  #scene: NavigatedScene | undefined;
  #home = poseFraming(new Sphere(new Vector3(), 1));
  #homeKey = "";
  #pose = this.#home;
  #journey: Journey | undefined;
  #motion = standingStill;
  #lastMs: number | undefined;
  #typesKey = "";
  #type: NavigationType = "examine";
  #source: ChangeSource = "none";

  /** `onChange` is called when another frame is due, or what is bound or allowed has changed. */
  constructor(onChange: () => void) {
    this.#onChange = onChange;
  }

  get pose(): Pose {
    return this.#pose;
  }

  /** Why the pose last changed. */
  get source(): ChangeSource {
    return this.#source;
  }

  get type(): NavigationType {
    return this.#type;
  }

  /** Ignored where the scene does not allow it. */
  set type(type: NavigationType) {
    if (!this.allowedTypes.includes(type) || type === this.#type) return;
    this.#type = type;
    this.#motion = standingStill;
    this.#onChange();
  }

  get allowedTypes(): readonly NavigationType[] {
    return navigationTypesOf(this.#scene?.navigation.type ?? []).allowed;
  }

  get viewpoints(): readonly PlacedViewpoint[] {
    return this.#scene?.viewpoints ?? [];
  }

  /** The element of the viewpoint that is bound. */
  get bound(): SceneElement | undefined {
    return this.#viewpoints.bound;
  }

  /** A viewpoint that is new here, bound or changed takes the camera with it; without one the scene stays framed until somebody moves. */
  setScene(scene: NavigatedScene): void {
    const isFirst = this.#scene === undefined;
    const before = this.bound;
    this.#scene = scene;
    const wanted = new Set(scene.viewpoints.filter(({ viewpoint }) => viewpoint.set_bind || viewpoint.bind).map(({ element }) => element));
    this.#viewpoints.setNodes(scene.viewpoints.map(({ element }) => element), (element) => wanted.has(element));
    const typesKey = scene.navigation.type.join(" ");
    if (typesKey !== this.#typesKey) this.#type = navigationTypesOf(scene.navigation.type).first;
    this.#typesKey = typesKey;
    this.#followHome(!isFirst && this.bound !== before);
  }

  /** set_bind of a viewpoint of the scene. */
  bind(element: SceneElement, isBound = true): void {
    if (!this.viewpoints.some((viewpoint) => viewpoint.element === element)) return;
    if (isBound) this.#viewpoints.bind(element);
    else this.#viewpoints.unbind(element);
    this.#followHome(true);
    // Also when it was bound before: that is how one returns to it.
    if (isBound) this.#travelTo(this.#home, "none");
  }

  /** Radians to the right and over the top; who walks or flies looks about instead. */
  turn(right: number, over: number): void {
    if (this.#type === "examine") this.#moveTo(turned(this.#pose, right, over));
    else this.#moveTo(looked(this.#pose, -right, over));
  }

  /** Multiplies the distance to the centre; who walks or flies goes as far ahead. */
  zoom(factor: number): void {
    if (this.#type === "examine") this.#moveTo(zoomed(this.#pose, factor, this.#sphere));
    else this.#moveTo(stepped(this.#pose, -Math.log(factor) * this.#speed, 0, 0, this.#type === "walk"));
  }

  /** Shares of the view's shorter side by which the scene follows the hand. */
  pan(right: number, up: number): void {
    const isWalking = this.#type === "walk";
    if (this.#type === "examine") this.#moveTo(panned(this.#pose, right, up));
    else this.#moveTo(stepped(this.#pose, isWalking ? -up * this.#speed : 0, -right * this.#speed, isWalking ? 0 : -up * this.#speed, isWalking));
  }

  /** Moves on and on like this, until it is told otherwise; for walking and flying. */
  move(motion: Motion): void {
    this.#motion = this.#type === "walk" || this.#type === "fly" ? motion : standingStill;
    if (isStandingStill(this.#motion)) return;
    this.#journey = undefined;
    this.#onChange();
  }

  /** Back to the bound viewpoint. */
  reset(): void {
    if (this.#type !== "none") this.#travelTo(this.#home, "user-interaction");
  }

  showAll(): void {
    if (this.#type !== "none") this.#travelTo(poseShowingAll(this.#pose, this.#sphere), "user-interaction");
  }

  /** The pose at this moment, in milliseconds of any clock that goes on evenly. */
  advance(nowMs: number): Pose {
    const seconds = Math.min((nowMs - (this.#lastMs ?? nowMs)) / 1000, longestFrameSeconds);
    this.#lastMs = nowMs;
    if (this.#journey !== undefined) {
      this.#pose = this.#journey.poseAt(nowMs);
      if (this.#pose === this.#journey.to) this.#journey = undefined;
    } else if (!isStandingStill(this.#motion)) {
      this.#source = "user-interaction";
      this.#pose = travelled(this.#pose, this.#motion, Math.max(seconds, 0), this.#speed, this.#type === "walk");
    }
    if (!this.isMoving) this.#lastMs = undefined;
    return this.#pose;
  }

  /** Whether the next frame will differ from the last without anybody doing anything. */
  get isMoving(): boolean {
    return this.#journey !== undefined || !isStandingStill(this.#motion);
  }

  get #sphere(): Sphere {
    return this.#scene?.sphere ?? new Sphere(new Vector3(), 1);
  }

  /** Lengths a second; where the document is silent, a third of the scene's radius. */
  get #speed(): number {
    return this.#scene?.navigation.speed ?? this.#sphere.radius / 3;
  }

  #moveTo(pose: Pose): void {
    if (this.#type === "none") return;
    this.#journey = undefined;
    this.#pose = pose;
    this.#source = "user-interaction";
    this.#onChange();
  }

  #travelTo(pose: Pose, source: ChangeSource): void {
    const { transitionType, transitionTime } = this.#scene?.navigation ?? { transitionType: [], transitionTime: 0 };
    const isInstant = this.isInstant || transitionType[0]?.toUpperCase() === "TELEPORT" || transitionTime <= 0;
    this.#source = source;
    this.#journey = isInstant ? undefined : new Journey(this.#pose, pose, transitionTime * 1000);
    if (isInstant) this.#pose = pose;
    this.#onChange();
  }

  /** Home is the bound viewpoint; without one, the whole scene. */
  #followHome(isJourney: boolean): void {
    const viewpoint = this.viewpoints.find(({ element }) => element === this.bound);
    const home = viewpoint ? poseOfViewpoint(viewpoint) : poseFraming(this.#sphere);
    const key = viewpoint ? JSON.stringify(home) : "";
    const wasAtHome = this.#pose === this.#home;
    const isOther = key !== this.#homeKey;
    if (viewpoint !== undefined && !isOther) return;
    this.#homeKey = key;
    this.#home = home;
    if (!isOther && !wasAtHome) return;
    if (isJourney) {
      this.#travelTo(this.#home, "none");
    } else {
      this.#journey = undefined;
      this.#pose = this.#home;
      this.#source = "none";
      this.#onChange();
    }
  }
}
