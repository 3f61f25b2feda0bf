// Where the camera is, and why: viewpoints bind and unbind, hands and keys move
// it, journeys lead it. Knows nothing of the document or the screen; whoever
// draws asks `advance` for the pose of each frame.

import { Sphere, Vector3 } from "three";
import type { NavigationDescription } from "../document/description.ts";
import type { SceneElement } from "../document/element.ts";
import { BindingStack } from "./bindingStack.ts";
import type { Pose } from "./cameraPose.ts";
import type { ViewpointInstance } from "../scene/instances.ts";
import { panned, poseFraming, poseShowingAll, orbited, zoomed } from "./cameraPose.ts";
import { avatarOf, bindViewpoints, boundPoseOf, clearanceOf, homePoseOf } from "./homePose.ts";
import { CameraTransition } from "./cameraTransition.ts";
import type { NavigationType } from "./navigationType.ts";
import { navigationTypesOf } from "./navigationType.ts";
import type { MovementInput } from "./firstPerson.ts";
import type { CameraSetting } from "./orbit.ts";
import { poseWithin, unsetCamera } from "./orbit.ts";
import { isNoMovement, lookedAround, noMovement, moved, movedFor } from "./firstPerson.ts";
import { AutoRotation } from "./autoRotation.ts";
import type { Avatar } from "./walkableGround.ts";
import type { DepthCamera, GroundSamples } from "./groundSamples.ts";
import { WalkController } from "./walkController.ts";

/** What the navigator must know of a scene. */
export interface NavigatedScene {
  /** Around all that is seen. */
  readonly sphere: Sphere;
  readonly viewpoints: readonly ViewpointInstance[];
  readonly navigation: NavigationDescription;
}

/** Who moved the camera, in the words of <model-viewer>. */
export type ChangeSource = "user-interaction" | "automatic" | "none";

/** A frame that came so much later is treated as if it came then: nobody wants to cover the time of a hidden tab. */
const longestFrameSeconds = 0.1;

export class CameraController {
  /** Journeys take no time, as people ask for who prefer reduced motion. */
  isInstant = false;
  readonly autoRotation: AutoRotation;
  readonly #onMove: () => void;
  readonly #onNavigation: () => void;
  readonly #viewpoints = new BindingStack<SceneElement>();
  readonly #walker = new WalkController();
  #scene: NavigatedScene | undefined;
  #home = poseFraming(new Sphere(new Vector3(), 1));
  #homeKey = "";
  #camera = unsetCamera;
  #pose = this.#home;
  #journey: CameraTransition | undefined;
  #motion = noMovement;
  #lastMs: number | undefined;
  #typesKey = "";
  #type: NavigationType = "examine";
  #source: ChangeSource = "none";

  /** `onMove` is called when another frame is due, `onNavigation` when another viewpoint is bound or one moves in another way. */
  constructor(onMove: () => void, onNavigation: () => void) {
    this.#onMove = onMove;
    this.#onNavigation = onNavigation;
    this.autoRotation = new AutoRotation(onMove);
  }

  get pose(): Pose {
    return this.#pose;
  }

  /** At the bound viewpoint, or where all is framed at first. */
  get isAtHome(): boolean {
    return this.#pose === this.#home;
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
    this.#motion = noMovement;
    this.#walker.stop();
    this.#onNavigation();
  }

  get allowedTypes(): readonly NavigationType[] {
    return navigationTypesOf(this.#scene?.navigation.type ?? []).allowed;
  }

  /** Those that the scene names. */
  get listedTypes(): readonly NavigationType[] {
    return navigationTypesOf(this.#scene?.navigation.type ?? []).listed;
  }

  /** What stands beside the viewpoints, and outweighs them; a change takes the camera with it. */
  setCamera(camera: CameraSetting): void {
    this.#camera = camera;
    this.#followHome(this.#scene !== undefined);
  }

  get viewpoints(): readonly ViewpointInstance[] {
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
    bindViewpoints(this.#viewpoints, scene.viewpoints);
    const typesKey = scene.navigation.type.join(" ");
    if (typesKey !== this.#typesKey) this.#type = navigationTypesOf(scene.navigation.type).first;
    this.#typesKey = typesKey;
    this.#followHome(!isFirst && this.bound !== before);
    this.#onNavigation();
  }

  /** The name of the viewpoint at which the camera stands. */
  get viewpointName(): string | undefined {
    const placed = this.viewpoints.find(({ element }) => element === this.bound);
    return this.#pose === this.#home && placed?.viewpoint.description !== ""
      ? placed?.viewpoint.description
      : undefined;
  }

  /** set_bind of a viewpoint of the scene. */
  bind(element: SceneElement, isBound = true): void {
    if (!this.viewpoints.some((viewpoint) => viewpoint.element === element)) return;
    if (isBound) this.#viewpoints.bind(element);
    else this.#viewpoints.unbind(element);
    this.#followHome(true);
    // Also when it was bound before: that is how one returns to it.
    if (isBound) this.#travelTo(this.#home, "none");
    this.#onNavigation();
  }

  /** Radians to the right and over the top. Who walks or flies looks about instead, so that what he sees follows his hand. */
  turn(right: number, over: number): void {
    if (this.#type === "examine") {
      this.#moveTo(orbited(this.#pose, right, over));
    } else {
      const share = this.#pose.fieldOfView / Math.PI; // half a turn is a hand's way across the view
      this.#moveTo(lookedAround(this.#pose, -right * share, over * share));
    }
  }

  /** Multiplies the distance to the centre; who walks or flies goes as far ahead. */
  zoom(factor: number): void {
    if (this.#type === "examine") this.#moveTo(zoomed(this.#pose, factor, this.#sphere));
    else this.#step(-Math.log(factor) * this.#speed, 0, 0);
  }

  /** Shares of the view's shorter side by which the scene follows the hand. */
  pan(right: number, up: number): void {
    if (this.#type === "examine") this.#moveTo(panned(this.#pose, right, up));
    else if (this.#type === "walk") this.#step(-up * this.#speed, -right * this.#speed, 0);
    else this.#step(0, -right * this.#speed, -up * this.#speed);
  }

  /** Moves on and on like this, until it is told otherwise; for walking and flying. */
  move(motion: MovementInput): void {
    this.#motion = this.#type === "walk" || this.#type === "fly" ? motion : noMovement;
    if (isNoMovement(this.#motion)) return;
    this.#journey = undefined;
    this.autoRotation.pause();
    this.#onMove();
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
    } else if (!isNoMovement(this.#motion) || this.#walker.isMoving) {
      this.#source = "user-interaction";
      this.#travel(Math.max(seconds, 0));
    } else if (this.#isTurning) {
      this.#source = "automatic";
      this.#pose = orbited(this.#pose, this.autoRotation.radiansPerSecond * Math.max(seconds, 0), 0);
    }
    if (!this.isMoving) this.#lastMs = undefined;
    return this.#pose;
  }

  /** What is nearer need not be seen. */
  get clearance(): number {
    return clearanceOf(this.#type, this.#avatar);
  }

  /** From where whoever draws is to look around, for somebody who walks. Undefined where nobody does. */
  get depthCamera(): DepthCamera | undefined {
    return this.#type === "walk" ? this.#walker.depthCameraFor(this.#pose, this.#avatar, this.#speed) : undefined;
  }

  /** What was seen from there. */
  addGroundSamples(lookout: DepthCamera, surroundings: GroundSamples): void {
    this.#walker.addGroundSamples(lookout, surroundings);
  }

  /** Whether the next frame will differ from the last without anybody doing anything. */
  get isMoving(): boolean {
    return this.#journey !== undefined || !isNoMovement(this.#motion) || this.#walker.isMoving || this.#isTurning;
  }

  get #isTurning(): boolean {
    return this.autoRotation.isRotating && this.#type === "examine";
  }

  get #sphere(): Sphere {
    return this.#scene?.sphere ?? new Sphere(new Vector3(), 1);
  }

  /** Lengths a second; where the document is silent, a third of the scene's radius, and on a floor no more than two bodies'. */
  get #speed(): number {
    const usual = this.#sphere.radius / 3;
    return this.#scene?.navigation.speed ?? (this.#walker.isOnFloor ? Math.min(usual, 2 * this.#avatar.height) : usual);
  }

  get #avatar(): Avatar {
    return avatarOf(this.#scene?.navigation, this.#sphere);
  }

  /** By lengths in the scene, ahead, aside and up. */
  #step(forward: number, right: number, up: number): void {
    const isWalking = this.#type === "walk";
    const pose = moved(this.#pose, forward, right, up, isWalking);
    if (isWalking) this.#walker.push(pose.position.clone().sub(this.#pose.position), this.#speed);
    this.#moveTo(isWalking ? this.#pose : pose);
  }

  /** As keys that are held, and a walk that is not over, lead in this time. */
  #travel(seconds: number): void {
    if (this.#type !== "walk") {
      this.#pose = movedFor(this.#pose, this.#motion, seconds, this.#speed, false);
      return;
    }
    const standing = this.#pose;
    const wanted = movedFor(standing, this.#motion, seconds, this.#speed, true);
    const way = wanted.position.clone().sub(standing.position);
    if (way.lengthSq() > 0) this.#walker.push(way, this.#speed);
    const looksAbout = this.#motion.turn !== 0 || this.#motion.look !== 0;
    const facing = looksAbout
      ? { ...wanted, position: standing.position, center: wanted.center.clone().sub(way) }
      : standing;
    this.#pose = this.#walker.walk(facing, seconds);
  }

  #moveTo(pose: Pose): void {
    if (this.#type === "none") return;
    this.#journey = undefined;
    this.#pose = this.#type === "examine" ? poseWithin(pose, this.#camera, this.#sphere) : pose;
    this.#source = "user-interaction";
    this.autoRotation.pause();
    this.#onMove();
  }

  #travelTo(pose: Pose, source: ChangeSource): void {
    const { transitionType, transitionTime } = this.#scene?.navigation ?? { transitionType: [], transitionTime: 0 };
    const isInstant = this.isInstant || transitionType[0]?.toUpperCase() === "TELEPORT" || transitionTime <= 0;
    this.#source = source;
    this.autoRotation.pause();
    this.#walker.stop();
    this.#journey = isInstant ? undefined : new CameraTransition(this.#pose, pose, transitionTime * 1000);
    if (isInstant) this.#pose = pose;
    this.#onMove();
  }

  /** Home is the bound viewpoint or the whole scene, and what the author says of the camera. */
  #followHome(isJourney: boolean): void {
    const viewpoint = boundPoseOf(this.#viewpoints, this.viewpoints);
    const home = homePoseOf(viewpoint, this.#camera, this.#sphere);
    const key = JSON.stringify([viewpoint, this.#camera]);
    const isOther = key !== this.#homeKey;
    if (!isOther && JSON.stringify(home) === JSON.stringify(this.#home)) return;
    const wasAtHome = this.#pose === this.#home;
    this.#homeKey = key;
    this.#home = home;
    // A home that has merely grown with the scene takes nobody along who has left it.
    if (!isOther && !wasAtHome) return;
    if (isOther && isJourney) {
      this.#travelTo(this.#home, "none");
    } else {
      this.#journey = undefined;
      this.#walker.stop();
      this.#pose = this.#home;
      this.#source = "none";
      this.#onMove();
    }
  }
}
