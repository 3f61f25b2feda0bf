// A pose as a place on a sphere around its centre, in the words of
// <model-viewer>: theta around the up axis from +z towards +x, phi down from
// above, and the radius.

import type { Sphere } from "three";
import { MathUtils, Matrix4, Quaternion, Vector3 } from "three";
import type { Pose } from "./cameraPose.ts";
import { framingDistance } from "./cameraPose.ts";

/** Angles in radians: theta any, phi 0 (above) … π (below). */
export interface Orbit {
  readonly theta: number;
  readonly phi: number;
  readonly radius: number;
}

/** A length in the scene, or a share of the distance from which the scene fills the view. */
export type RadiusSetting = { readonly length: number } | { readonly share: number };

/** What an author says of an orbit; undefined: as it is otherwise. */
export interface OrbitSetting {
  readonly theta: number | undefined;
  readonly phi: number | undefined;
  readonly radius: RadiusSetting | undefined;
}

/** What an author says of the camera, beside the viewpoints. */
export interface CameraSetting {
  readonly orbit: OrbitSetting | undefined;
  readonly target: readonly [number, number, number] | undefined;
  /** Radians, along the shorter side of the view. */
  readonly fieldOfView: number | undefined;
  readonly minOrbit: OrbitSetting | undefined;
  readonly maxOrbit: OrbitSetting | undefined;
}

export const unsetCamera: CameraSetting = {
  orbit: undefined,
  target: undefined,
  fieldOfView: undefined,
  minOrbit: undefined,
  maxOrbit: undefined,
};

/** So near to a pole the camera has no horizon any more. */
const nearestToPole = 0.02;

export function orbitOf(pose: Pose): Orbit {
  const towardsEye = pose.position.clone().sub(pose.center);
  const radius = towardsEye.length();
  if (radius === 0) return { theta: 0, phi: Math.PI / 2, radius };
  const { x, y, z } = towardsEye.applyQuaternion(uprightFrame(pose.up).invert());
  return { theta: Math.atan2(x, z), phi: Math.acos(MathUtils.clamp(y / radius, -1, 1)), radius };
}

/** The same centre seen from a place on the orbit, upright. */
export function poseOnOrbit(pose: Pose, { theta, phi, radius }: Orbit): Pose {
  const steep = MathUtils.clamp(phi, nearestToPole, Math.PI - nearestToPole);
  const towardsEye = new Vector3().setFromSphericalCoords(radius, steep, theta).applyQuaternion(uprightFrame(pose.up));
  const position = pose.center.clone().add(towardsEye);
  const orientation = new Quaternion().setFromRotationMatrix(new Matrix4().lookAt(position, pose.center, pose.up));
  return { ...pose, position, orientation };
}

/** The pose with what the author says of the camera in its place. */
export function poseWith(pose: Pose, { orbit, target, fieldOfView }: CameraSetting, sphere: Sphere): Pose {
  const placed = {
    ...pose,
    fieldOfView: fieldOfView ?? pose.fieldOfView,
    center: target ? new Vector3(...target) : pose.center,
  };
  if (orbit === undefined && target === undefined) return placed;
  const before = orbitOf(pose);
  return poseOnOrbit(placed, {
    theta: orbit?.theta ?? before.theta,
    phi: orbit?.phi ?? before.phi,
    radius: lengthOf(orbit?.radius, placed, sphere) ?? before.radius,
  });
}

/** The nearest pose between the author's bounds. Theta is bounded only where both bounds are said. */
export function poseWithin(pose: Pose, { minOrbit, maxOrbit }: CameraSetting, sphere: Sphere): Pose {
  if (minOrbit === undefined && maxOrbit === undefined) return pose;
  const { theta, phi, radius } = orbitOf(pose);
  const [least, most] = [minOrbit?.theta, maxOrbit?.theta];
  const bounded = {
    theta:
      least === undefined || most === undefined
        ? theta
        : MathUtils.clamp(turnNearest(theta, (least + most) / 2), least, most),
    phi: MathUtils.clamp(phi, minOrbit?.phi ?? 0, maxOrbit?.phi ?? Math.PI),
    radius: MathUtils.clamp(
      radius,
      lengthOf(minOrbit?.radius, pose, sphere) ?? 0,
      lengthOf(maxOrbit?.radius, pose, sphere) ?? Infinity,
    ),
  };
  const isWithin =
    bounded.phi === phi && bounded.radius === radius && Math.abs(turnNearest(bounded.theta, theta) - theta) < 1e-9;
  return isWithin ? pose : poseOnOrbit(pose, bounded);
}

function lengthOf(radius: RadiusSetting | undefined, pose: Pose, sphere: Sphere): number | undefined {
  if (radius === undefined) return undefined;
  return "length" in radius ? radius.length : radius.share * framingDistance(sphere, pose.fieldOfView);
}

/** The same angle, less than half a turn from `to`. */
function turnNearest(angle: number, to: number): number {
  return angle + 2 * Math.PI * Math.round((to - angle) / (2 * Math.PI));
}

/** Turns +y to `up`, the shortest way. */
function uprightFrame(up: Vector3): Quaternion {
  return new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), up);
}
