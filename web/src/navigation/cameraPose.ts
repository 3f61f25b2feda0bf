// Camera poses, and pure functions from one pose to the next, in double precision. Rotations are about the pose's `up`.

import type { PerspectiveCamera, Sphere } from "three";
import { MathUtils, Matrix4, Quaternion, Vector3 } from "three";
import type { ViewpointInstance } from "../scene/instances.ts";

export interface Pose {
  readonly position: Vector3;
  readonly orientation: Quaternion;
  /** The center that orbiting rotates about and zooming approaches. */
  readonly center: Vector3;
  readonly up: Vector3;
  /** Radians, along the shorter side of the area that must be visible. */
  readonly fieldOfView: number;
  /** Width over height of the area that must be visible; 1 where absent. */
  readonly aspectRatio?: number | undefined;
}

/**
 * The pose of a viewpoint. Transforms around it rotate and move it; their scale affects its position only, since X3D
 * does not define a scaled view.
 */
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
    up: upAxisOf(orientation, new Vector3(0, 1, 0).applyQuaternion(frame)),
    fieldOfView: MathUtils.clamp(viewpoint.fieldOfView, 0.01, 3.1),
    aspectRatio: viewpoint.aspectRatio,
  };
}

/**
 * The axis that user rotations keep: +y of the viewpoint's frame, or the camera's own up where it is tilted or looks
 * along +y.
 */
function upAxisOf(orientation: Quaternion, upright: Vector3): Vector3 {
  const [right, up, back] = [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)].map((axis) =>
    axis.applyQuaternion(orientation),
  ) as [Vector3, Vector3, Vector3];
  const isLevel = Math.abs(right.dot(upright)) < 0.02 && up.dot(upright) > 0;
  return isLevel && Math.abs(back.dot(upright)) < 0.98 ? upright : up;
}

const defaultFieldOfView = 0.7854;

/** The pose for a document without Viewpoint: shows the whole sphere, from slightly above and from the side. */
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

/** The distance at which the sphere just fills the shorter side of the view. */
export function framingDistance(sphere: Sphere, fieldOfView: number): number {
  return Math.max(sphere.radius, 1e-9) / Math.sin(fieldOfView / 2);
}

/** The same viewing direction, at a distance that shows the whole sphere. */
export function poseShowingAll(pose: Pose, sphere: Sphere): Pose {
  const distance = framingDistance(sphere, pose.fieldOfView);
  const center = sphere.center.clone();
  return { ...pose, center, position: center.clone().addScaledVector(forwardOf(pose), -distance) };
}

/**
 * Orbits around the center, so that the scene turns on the screen by radians to the right about `up`, and downwards,
 * but not past a pole.
 */
export function orbitPose(pose: Pose, right: number, down: number): Pose {
  const turn = boundedRotation(pose, right, down);
  return {
    ...pose,
    position: pose.position.clone().sub(pose.center).applyQuaternion(turn).add(pose.center),
    orientation: turn.multiply(pose.orientation).normalize(),
  };
}

/** The rotation of a camera to the right about `up`, and downwards, but not past a pole. */
export function boundedRotation(pose: Pose, right: number, down: number): Quaternion {
  const sideways = new Vector3(1, 0, 0).applyQuaternion(pose.orientation);
  const poleAngle = forwardOf(pose).angleTo(pose.up); // 0: looks along up; pi: straight down, from over the top
  const minPoleAngle = 0.02;
  const pitch = MathUtils.clamp(down, minPoleAngle - poleAngle, Math.PI - minPoleAngle - poleAngle);
  return new Quaternion()
    .setFromAxisAngle(pose.up, -right)
    .multiply(new Quaternion().setFromAxisAngle(sideways, -pitch));
}

/** Multiplies the distance to the center, within 1/1000 … 1000 of the scene's radius. */
export function zoomPose(pose: Pose, factor: number, sphere: Sphere): Pose {
  const distance = pose.position.distanceTo(pose.center);
  const minDistance = Math.min(distance, sphere.radius / 1000);
  const maxDistance = Math.max(distance, sphere.radius * 1000);
  const newDistance = MathUtils.clamp(distance * factor, minDistance, maxDistance);
  return {
    ...pose,
    position: pose.center
      .clone()
      .addScaledVector(pose.position.clone().sub(pose.center), newDistance / (distance || 1)),
  };
}

/** Moves the scene by fractions of the view's shorter side, measured at the center. */
export function panPose(pose: Pose, right: number, up: number): Pose {
  const extent = 2 * Math.tan(pose.fieldOfView / 2) * pose.position.distanceTo(pose.center);
  const shift = new Vector3(-right * extent, -up * extent, 0).applyQuaternion(pose.orientation);
  return { ...pose, position: pose.position.clone().add(shift), center: pose.center.clone().add(shift) };
}

/** A camera's field of view and clipping planes, in scene units. */
export interface Lens {
  /** Radians, from the top to the bottom of the view. */
  readonly fieldOfView: number;
  readonly near: number;
  readonly far: number;
}

/**
 * The lens for a view of `aspect` (width / height) onto a scene inside `sphere`. A camera inside the sphere need not
 * see surfaces nearer than `clearance`.
 */
export function lensOf(pose: Pose, aspect: number, sphere: Sphere, clearance: number): Lens {
  const aspectRatio = pose.aspectRatio ?? 1;
  // The area that must be visible; a view of another shape shows more along one side and not less along the other.
  const [width, height] = [Math.max(aspectRatio, 1), Math.max(1 / aspectRatio, 1)];
  const halfHeight = Math.tan(pose.fieldOfView / 2) * Math.max(height, width / aspect);
  // Depth precision is spent on the scene only. Inside it the near plane is at 1/10000 … 1/100 of the far plane: 1/100
  // still shows the walls of a room whose author allows no smaller clearance.
  const toCenter = sphere.center.clone().sub(pose.position);
  const radius = Math.max(sphere.radius * 1.01, 1e-9);
  const far = toCenter.length() + radius;
  // Planes are at depths: a scene at the side of the view is nearer along the axis than its distance.
  const near = Math.max(toCenter.dot(forwardOf(pose)) - radius, MathUtils.clamp(clearance, far * 1e-4, far * 1e-2));
  return { fieldOfView: 2 * Math.atan(halfHeight), near, far };
}

/** Sets the camera to a pose. */
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
