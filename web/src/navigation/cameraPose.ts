// The camera as a pose: pure functions from one pose to the next, in double
// precision. Turning is about the pose's own `up`.

import type { PerspectiveCamera } from "three";
import { MathUtils, Matrix4, Quaternion, Sphere, Vector3 } from "three";
import type { ViewpointInstance } from "../scene/instances.ts";

export interface Pose {
  readonly position: Vector3;
  readonly orientation: Quaternion;
  /** What turning turns around and zooming comes near. */
  readonly center: Vector3;
  readonly up: Vector3;
  /** Radians, along the shorter side of what has to be seen. */
  readonly fieldOfView: number;
  /** Of what has to be seen, width over height; 1 where it is absent. */
  readonly aspectRatio?: number | undefined;
}

/** Transforms around a viewpoint move and turn it; their scale moves it only, since X3D leaves open what a stretched view is. */
export function poseOfViewpoint({ viewpoint, sceneFromViewpoint }: Omit<ViewpointInstance, "element">): Pose {
  const [x, y, z, angle] = viewpoint.orientation;
  const frame = new Quaternion();
  sceneFromViewpoint.decompose(new Vector3(), frame, new Vector3());
  const orientation = frame
    .clone()
    .multiply(new Quaternion().setFromAxisAngle(new Vector3(x, y, z).normalize(), angle));
  return {
    position: new Vector3(...viewpoint.position).applyMatrix4(sceneFromViewpoint),
    orientation,
    center: new Vector3(...viewpoint.centerOfRotation).applyMatrix4(sceneFromViewpoint),
    up: uprightOf(orientation, new Vector3(0, 1, 0).applyQuaternion(frame)),
    fieldOfView: MathUtils.clamp(viewpoint.fieldOfView, 0.01, 3.1),
    aspectRatio: viewpoint.aspectRatio,
  };
}

/** X3D's up, +y around the viewpoint, so that a statue keeps standing; the camera's own where it is tilted or looks along it. */
function uprightOf(orientation: Quaternion, upright: Vector3): Vector3 {
  const [right, up, back] = [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)].map((axis) =>
    axis.applyQuaternion(orientation),
  ) as [Vector3, Vector3, Vector3];
  const isLevel = Math.abs(right.dot(upright)) < 0.02 && up.dot(upright) > 0;
  return isLevel && Math.abs(back.dot(upright)) < 0.98 ? upright : up;
}

const defaultFieldOfView = 0.7854;

/** Sees the whole sphere from slightly above and beside, where the document has no Viewpoint. */
export function poseFraming(sphere: Sphere): Pose {
  return poseShowingAll(
    {
      position: sphere.center.clone().add(new Vector3(0.35, 0.25, 1)),
      orientation: lookRotation(new Vector3(-0.35, -0.25, -1), new Vector3(0, 1, 0)),
      center: sphere.center.clone(),
      up: new Vector3(0, 1, 0),
      fieldOfView: defaultFieldOfView,
    },
    sphere,
  );
}

/** From where the sphere just fills the shorter side of the view. */
export function framingDistance(sphere: Sphere, fieldOfView: number): number {
  return Math.max(sphere.radius, 1e-9) / Math.sin(fieldOfView / 2);
}

/** The same direction of view, so far away that the whole sphere is seen. */
export function poseShowingAll(pose: Pose, sphere: Sphere): Pose {
  const distance = framingDistance(sphere, pose.fieldOfView);
  const center = sphere.center.clone();
  return { ...pose, center, position: center.clone().addScaledVector(forwardOf(pose), -distance) };
}

/** Turns around the centre by angles in radians: to the right around `up`, and over the top; never past a pole. */
export function orbited(pose: Pose, right: number, over: number): Pose {
  const turn = boundedRotation(pose, right, over);
  return {
    ...pose,
    position: pose.position.clone().sub(pose.center).applyQuaternion(turn).add(pose.center),
    orientation: turn.multiply(pose.orientation).normalize(),
  };
}

/** What turns a camera to the right around `up` and downwards, but never past a pole. */
export function boundedRotation(pose: Pose, right: number, down: number): Quaternion {
  const sideways = new Vector3(1, 0, 0).applyQuaternion(pose.orientation);
  const towards = forwardOf(pose).angleTo(pose.up); // 0: looks along up; pi: straight down, from over the top
  const nearestToPole = 0.02;
  const pitch = MathUtils.clamp(down, nearestToPole - towards, Math.PI - nearestToPole - towards);
  return new Quaternion()
    .setFromAxisAngle(pose.up, -right)
    .multiply(new Quaternion().setFromAxisAngle(sideways, -pitch));
}

/** Multiplies the distance to the centre, between a thousandth of the scene's radius and a thousand of them. */
export function zoomed(pose: Pose, factor: number, sphere: Sphere): Pose {
  const distance = pose.position.distanceTo(pose.center);
  const least = Math.min(distance, sphere.radius / 1000);
  const most = Math.max(distance, sphere.radius * 1000);
  const wanted = MathUtils.clamp(distance * factor, least, most);
  return {
    ...pose,
    position: pose.center.clone().addScaledVector(pose.position.clone().sub(pose.center), wanted / (distance || 1)),
  };
}

/** Shifts what is seen by shares of the view's shorter side, as seen at the centre. */
export function panned(pose: Pose, right: number, up: number): Pose {
  const extent = 2 * Math.tan(pose.fieldOfView / 2) * pose.position.distanceTo(pose.center);
  const shift = new Vector3(-right * extent, -up * extent, 0).applyQuaternion(pose.orientation);
  return { ...pose, position: pose.position.clone().add(shift), center: pose.center.clone().add(shift) };
}

/** What a camera sees of a scene; lengths in the scene's coordinates. */
export interface Lens {
  /** Radians, from the top to the bottom of the view. */
  readonly fieldOfView: number;
  readonly near: number;
  readonly far: number;
}

/**
 * For a view of `aspect` (width / height) onto a scene inside `sphere`. From inside,
 * what is nearer than `clearance` need not be seen.
 */
export function lensOf(pose: Pose, aspect: number, sphere: Sphere, clearance: number): Lens {
  const proportion = pose.aspectRatio ?? 1;
  // Of what has to be seen; a view of another shape shows more of one side, never less of the other.
  const [width, height] = [Math.max(proportion, 1), Math.max(1 / proportion, 1)];
  const half = Math.tan(pose.fieldOfView / 2) * Math.max(height, width / aspect);
  // Depth is spent on the scene alone; from inside, a ten-thousandth of the depth is near enough,
  // and a hundredth still leaves a room's walls standing whose author says that nobody gets so close.
  const distance = pose.position.distanceTo(sphere.center);
  const radius = Math.max(sphere.radius * 1.01, 1e-9);
  const far = distance + radius;
  const near = Math.max(distance - radius, MathUtils.clamp(clearance, far * 1e-4, far * 1e-2));
  return { fieldOfView: 2 * Math.atan(half), near, far };
}

/** Sets the camera up to see so. */
export function applyPose(camera: PerspectiveCamera, pose: Pose, aspect: number, sphere: Sphere, clearance = 0): void {
  camera.position.copy(pose.position);
  camera.quaternion.copy(pose.orientation);
  const { fieldOfView, near, far } = lensOf(pose, aspect, sphere, clearance);
  camera.fov = MathUtils.radToDeg(fieldOfView);
  camera.aspect = aspect;
  camera.near = near;
  camera.far = far;
  camera.updateProjectionMatrix();
}

export function forwardOf(pose: Pick<Pose, "orientation">): Vector3 {
  return new Vector3(0, 0, -1).applyQuaternion(pose.orientation);
}

function lookRotation(forward: Vector3, up: Vector3): Quaternion {
  return new Quaternion().setFromRotationMatrix(new Matrix4().lookAt(new Vector3(), forward, up));
}
