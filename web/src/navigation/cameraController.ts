// The camera's pose over time: viewpoints bind, user input moves the camera, and transitions animate it. Independent of
// the document and the screen; the renderer calls `advance` for the pose of each frame.

import { Sphere, Vector3 } from "three";
import type { NavigationDescription } from "../document/description.ts";
import type { SceneElement } from "../document/element.ts";
import type { ViewpointInstance } from "../scene/instances.ts";
import { AutoRotation } from "./autoRotation.ts";
import { avatarOf, clearanceOf } from "./avatar.ts";
import { BindingStack } from "./bindingStack.ts";
import { CameraHome, shownBoundsOf } from "./cameraHome.ts";
import type { Pose } from "./cameraPose.ts";
import { orbitPose, panPose, poseShowingAll, zoomPose } from "./cameraPose.ts";
import { CameraTransition } from "./cameraTransition.ts";
import type { MovementInput } from "./firstPerson.ts";
import { applyMovement, isNoMovement, movePose, noMovement, turnPose } from "./firstPerson.ts";
import type { DepthCamera, GroundSamples } from "./groundSamples.ts";
import { bindViewpoints, boundPoseOf } from "./homePose.ts";
import { LateWalk } from "./lateWalking.ts";
import type { NavigationType } from "./navigationType.ts";
import { navigationTypesOf } from "./navigationType.ts";
import type { CameraSetting } from "./orbit.ts";
import { poseWithin, unsetCamera } from "./orbit.ts";
import { SurfaceAhead } from "./surfaceAhead.ts";
import type { Avatar } from "./walkableGround.ts";

/** The data of a scene that the camera depends on. */
export interface NavigatedScene {
  /** Bounds everything visible. */
  readonly sphere: Sphere;
  readonly viewpoints: readonly ViewpointInstance[];
  readonly navigation: NavigationDescription;
}

/** What moved the camera, in <model-viewer>'s terms. */
export type ChangeSource = "user-interaction" | "automatic" | "none";

/** A longer time between frames counts as this one, so that a hidden tab does not make the camera jump. */
const maxFrameSeconds = 0.1;

export class CameraController {
  /** Transitions take no time, for users who prefer reduced motion. */
  isInstant = false;
  readonly autoRotation: AutoRotation;
  readonly #onMove: () => void;
  readonly #onNavigation: () => void;
  readonly #viewpoints = new BindingStack<SceneElement>();
  readonly #walk = new LateWalk();
  readonly #surfaceAhead = new SurfaceAhead();
  readonly #home = new CameraHome();
  #scene: NavigatedScene | undefined;
  #motion: Sphere | undefined;
  #camera = unsetCamera;
  #pose = this.#home.pose;
  #transition: CameraTransition | undefined;
  #input = noMovement;
  #lastMs: number | undefined;
  #typesKey = "";
  #type: NavigationType = "examine";
  #source: ChangeSource = "none";

  /**
   * `onMove` is called when another frame is due, `onNavigation` when another viewpoint is bound or the navigation type
   * changes.
   */
  constructor(onMove: () => void, onNavigation: () => void) {
    this.#onMove = onMove;
    this.#onNavigation = onNavigation;
    this.autoRotation = new AutoRotation(onMove);
  }

  get pose(): Pose {
    return this.#pose;
  }

  /** Whether the camera is at the bound viewpoint, or at the initial pose where there is none. */
  get isAtHome(): boolean {
    return this.#pose === this.#home.pose;
  }

  /** What last changed the pose. */
  get source(): ChangeSource {
    return this.#source;
  }

  get type(): NavigationType {
    return this.#type;
  }

  /** Ignored where the scene does not allow this type. */
  set type(type: NavigationType) {
    if (!this.allowedTypes.includes(type) || type === this.#type) return;
    this.#type = type;
    this.#input = noMovement;
    this.#walk.stop();
    this.#onNavigation();
  }

  get allowedTypes(): readonly NavigationType[] {
    return navigationTypesOf(this.#scene?.navigation.type ?? []).allowed;
  }

  /** The types that the scene names. */
  get listedTypes(): readonly NavigationType[] {
    return navigationTypesOf(this.#scene?.navigation.type ?? []).listed;
  }

  /** Sets the author's camera attributes, which take precedence over viewpoints; a change moves the camera. */
  setCamera(camera: CameraSetting): void {
    this.#camera = camera;
    this.#updateHome(this.#scene !== undefined);
  }

  get viewpoints(): readonly ViewpointInstance[] {
    return this.#scene?.viewpoints ?? [];
  }

  /** Those with a description, among which the user may choose. */
  get namedViewpoints(): readonly ViewpointInstance[] {
    return this.viewpoints.filter(({ viewpoint }) => viewpoint.description.trim() !== "");
  }

  /** The element of the bound viewpoint. */
  get bound(): SceneElement | undefined {
    return this.#viewpoints.bound;
  }

  /**
   * A newly bound or changed viewpoint moves the camera. Without viewpoints the camera frames the scene until the user
   * moves it.
   */
  setScene(scene: NavigatedScene): void {
    const isFirst = this.#scene === undefined;
    const before = this.bound;
    this.#scene = scene;
    bindViewpoints(this.#viewpoints, scene.viewpoints);
    const typesKey = scene.navigation.type.join(" ");
    if (typesKey !== this.#typesKey) this.#type = navigationTypesOf(scene.navigation.type).first;
    this.#typesKey = typesKey;
    this.#updateHome(!isFirst && this.bound !== before);
    this.#onNavigation();
  }

  /** The bounds of all moments of what moves in the scene, which the initial view shows; undefined where nothing does. */
  setMotion(sphere: Sphere | undefined): void {
    if (sphere === this.#motion) return;
    this.#motion = sphere;
    if (this.#scene !== undefined) this.#updateHome(false);
  }

  /** The scene has moved: the camera follows the bound viewpoint, but without one it does not frame the scene anew. */
  followMoves(scene: NavigatedScene): void {
    // The list is another one where a viewpoint has moved. The author's orbit may be relative to the scene's size.
    const mayHaveMoved = scene.viewpoints !== this.#scene?.viewpoints || this.#camera.orbit !== undefined;
    this.#scene = scene;
    if (mayHaveMoved && this.bound !== undefined) this.#updateHome(false);
  }

  /** The description of the viewpoint that the camera is at. */
  get viewpointName(): string | undefined {
    const instance = this.viewpoints.find(({ element }) => element === this.bound);
    return this.isAtHome && instance?.viewpoint.description !== "" ? instance?.viewpoint.description : undefined;
  }

  /** Binds or unbinds a viewpoint of the scene, as X3D's set_bind does. */
  bind(element: SceneElement, isBound = true): void {
    if (!this.viewpoints.some((viewpoint) => viewpoint.element === element)) return;
    if (isBound) this.#viewpoints.bind(element);
    else this.#viewpoints.unbind(element);
    this.#updateHome(true);
    // Also where it was bound before: a user returns to a viewpoint by binding it again.
    if (isBound) this.#transitionTo(this.#home.pose, "none");
    this.#onNavigation();
  }

  /**
   * Turns the scene by radians to the right and downwards on the screen: orbits in EXAMINE, looks around in WALK and
   * FLY.
   */
  turn(right: number, down: number): void {
    if (this.#type === "examine") {
      this.#moveTo(orbitPose(this.#pose, right, down));
    } else {
      const scale = this.#pose.fieldOfView / Math.PI; // dragging across the whole view is half a turn
      this.#moveTo(turnPose(this.#pose, -right * scale, down * scale));
    }
  }

  /**
   * Multiplies the distance to the center, as far as no surface is in between; WALK and FLY move ahead instead. Where
   * it is not known yet what is ahead, the rest of the way follows when the renderer has found it.
   */
  zoom(factor: number): void {
    if (this.#type !== "examine") this.#step(-Math.log(factor) * this.#speed, 0, 0);
    else
      this.#moveTo(this.#surfaceAhead.approach(this.#pose, zoomPose(this.#pose, factor, this.#sphere), this.#sphere));
  }

  /** Moves the scene with the pointer, by fractions of the view's shorter side. */
  pan(right: number, up: number): void {
    if (this.#type === "examine") this.#moveTo(panPose(this.#pose, right, up));
    else if (this.#type === "walk") this.#step(-up * this.#speed, -right * this.#speed, 0);
    else this.#step(0, -right * this.#speed, -up * this.#speed);
  }

  /** Sets the movement of WALK and FLY, which continues until the next call. */
  move(input: MovementInput): void {
    this.#input = this.#type === "walk" || this.#type === "fly" ? input : noMovement;
    if (isNoMovement(this.#input)) return;
    this.#transition = undefined;
    this.autoRotation.pause();
    this.#onMove();
  }

  /** Returns to the bound viewpoint. */
  reset(): void {
    if (this.#type !== "none") this.#transitionTo(this.#home.pose, "user-interaction");
  }

  showAll(): void {
    if (this.#type !== "none") this.#transitionTo(poseShowingAll(this.#pose, this.#sphere), "user-interaction");
  }

  /** The pose at this time, in milliseconds of any steady clock. */
  advance(nowMs: number): Pose {
    const seconds = Math.min((nowMs - (this.#lastMs ?? nowMs)) / 1000, maxFrameSeconds);
    this.#lastMs = nowMs;
    this.#walk.pushWaiting(this.#speed);
    if (this.#transition !== undefined) {
      this.#pose = this.#transition.poseAt(nowMs);
      if (this.#pose === this.#transition.to) this.#transition = undefined;
    } else if (!isNoMovement(this.#input) || this.#walk.isMoving) {
      this.#source = "user-interaction";
      this.#moveFor(Math.max(seconds, 0));
    } else if (this.#isRotating) {
      this.#source = "automatic";
      this.#pose = orbitPose(this.#pose, this.autoRotation.radiansPerSecond * Math.max(seconds, 0), 0);
    }
    if (!this.isMoving) this.#lastMs = undefined;
    return this.#pose;
  }

  /** Surfaces nearer than this distance need not be drawn. */
  get clearance(): number {
    return clearanceOf(this.#type, this.#avatar);
  }

  /** The depth camera that the renderer is to sample the ground with; undefined where no samples are needed. */
  get depthCamera(): DepthCamera | undefined {
    return this.#type === "walk" ? this.#walk.depthCameraFor(this.#pose, this.#avatar, this.#speed) : undefined;
  }

  addGroundSamples(camera: DepthCamera, samples: GroundSamples): void {
    this.#walk.addGroundSamples(camera, samples);
  }

  /** The pose whose surface at the center the renderer is to find; undefined if none is needed. */
  get surfaceSearch(): Pose | undefined {
    return this.#type === "examine" ? this.#surfaceAhead.takeSearch(this.#pose) : undefined;
  }

  /** The distance of the surface that a pose shows at its center; Infinity if it shows none there. */
  addSurfaceAhead(pose: Pose, distance: number): void {
    const rest = this.#surfaceAhead.found(pose, distance, this.#pose);
    if (rest < 1 && this.#type === "examine") this.zoom(rest);
  }

  /** Whether the next frame differs from the last without further input. */
  get isMoving(): boolean {
    return this.#transition !== undefined || !isNoMovement(this.#input) || this.#walk.isMoving || this.#isRotating;
  }

  get #isRotating(): boolean {
    return this.autoRotation.isRotating && this.#type === "examine";
  }

  get #sphere(): Sphere {
    return this.#scene?.sphere ?? new Sphere(new Vector3(), 1);
  }

  /**
   * Scene units per second: NavigationInfo's speed, else a third of the scene's radius, on a floor at most two avatar
   * heights.
   */
  get #speed(): number {
    const defaultSpeed = this.#sphere.radius / 3;
    return (
      this.#scene?.navigation.speed ??
      (this.#walk.isOnFloor ? Math.min(defaultSpeed, 2 * this.#avatar.height) : defaultSpeed)
    );
  }

  get #avatar(): Avatar {
    return avatarOf(this.#scene?.navigation, this.#sphere);
  }

  /** Moves ahead, to the right and up, by lengths in scene units. */
  #step(forward: number, right: number, up: number): void {
    const isWalking = this.#type === "walk";
    const pose = movePose(this.#pose, forward, right, up, isWalking);
    if (isWalking) this.#walk.push(pose.position.clone().sub(this.#pose.position), this.#speed);
    this.#moveTo(isWalking ? this.#pose : pose);
  }

  /** Moves the camera for `seconds`, as pressed keys and the pending movement of WALK request. */
  #moveFor(seconds: number): void {
    this.#pose =
      this.#type === "walk"
        ? this.#walk.walk(this.#pose, this.#input, seconds, this.#speed)
        : applyMovement(this.#pose, this.#input, seconds, this.#speed, false);
  }

  #moveTo(pose: Pose): void {
    if (this.#type === "none") return;
    this.#transition = undefined;
    this.#pose = this.#type === "examine" ? poseWithin(pose, this.#camera, this.#sphere) : pose;
    this.#source = "user-interaction";
    this.autoRotation.pause();
    this.#onMove();
  }

  #transitionTo(pose: Pose, source: ChangeSource): void {
    const { transitionType, transitionTime } = this.#scene?.navigation ?? { transitionType: [], transitionTime: 0 };
    const isInstant = this.isInstant || transitionType[0]?.toUpperCase() === "TELEPORT" || transitionTime <= 0;
    this.#source = source;
    this.autoRotation.pause();
    this.#walk.stop();
    this.#transition = isInstant ? undefined : new CameraTransition(this.#pose, pose, transitionTime * 1000);
    if (isInstant) this.#pose = pose;
    this.#onMove();
  }

  /** Recomputes the home pose and moves the camera there where it has changed; `isAnimated`: by a transition. */
  #updateHome(isAnimated: boolean): void {
    const wasAtHome = this.isAtHome;
    const viewpoint = boundPoseOf(this.#viewpoints, this.viewpoints);
    const change = this.#home.follow(viewpoint, this.#camera, shownBoundsOf(this.#sphere, this.#motion));
    // A home pose that has only grown with the scene does not move a camera that has left it.
    if (change === "none" || (change === "grown" && !wasAtHome)) return;
    if (change === "replaced" && isAnimated) {
      this.#transitionTo(this.#home.pose, "none");
    } else {
      this.#transition = undefined;
      this.#walk.stop();
      this.#pose = this.#home.pose;
      this.#source = "none";
      this.#onMove();
    }
  }
}
