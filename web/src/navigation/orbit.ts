// A camera pose in spherical coordinates around its center, as <model-viewer> has them: theta about the up axis from +z
// towards +x, phi from the up axis, and the radius.

import type { Sphere } from "three";
import { MathUtils, Matrix4, Quaternion, Vector3 } from "three";
import type { Pose } from "./cameraPose.ts";
import { framingDistance } from "./cameraPose.ts";

/** Angles in radians: theta unbounded, phi 0 (above) … π (below). */
export interface Orbit {
  readonly theta: number;
  readonly phi: number;
  readonly radius: number;
}

/** A length in scene units, or a factor of the distance at which the scene fills the view. */
export type RadiusSetting = { readonly length: number } | { readonly factor: number };

/** The author's values of an orbit; undefined: not set. */
export interface OrbitSetting {
  readonly theta: number | undefined;
  readonly phi: number | undefined;
  readonly radius: RadiusSetting | undefined;
}

/** The author's camera attributes. */
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

/** The smallest angle between the view direction and the up axis: the horizon is undefined at a pole. */
const minPoleAngle = 0.02;

export function orbitOf(pose: Pose): Orbit {
  const towardsEye = pose.position.clone().sub(pose.center);
  const radius = towardsEye.length();
  if (radius === 0) return { theta: 0, phi: Math.PI / 2, radius };
  const { x, y, z } = towardsEye.applyQuaternion(uprightFrame(pose.up).invert());
  return { theta: Math.atan2(x, z), phi: Math.acos(MathUtils.clamp(y / radius, -1, 1)), radius };
}

/** The pose that looks at the same center from a point of the orbit, upright. */
export function poseOnOrbit(pose: Pose, { theta, phi, radius }: Orbit): Pose {
  const boundedPhi = MathUtils.clamp(phi, minPoleAngle, Math.PI - minPoleAngle);
  const towardsEye = new Vector3()
    .setFromSphericalCoords(radius, boundedPhi, theta)
    .applyQuaternion(uprightFrame(pose.up));
  const position = pose.center.clone().add(towardsEye);
  const orientation = new Quaternion().setFromRotationMatrix(new Matrix4().lookAt(position, pose.center, pose.up));
  return { ...pose, position, orientation };
}

/** The pose with the author's camera attributes applied. */
export function poseWith(pose: Pose, { orbit, target, fieldOfView }: CameraSetting, sphere: Sphere): Pose {
  const withAttributes = {
    ...pose,
    fieldOfView: fieldOfView ?? pose.fieldOfView,
    center: target ? new Vector3(...target) : pose.center,
  };
  if (orbit === undefined && target === undefined) return withAttributes;
  const previous = orbitOf(pose);
  return poseOnOrbit(withAttributes, {
    theta: orbit?.theta ?? previous.theta,
    phi: orbit?.phi ?? previous.phi,
    radius: lengthOf(orbit?.radius, withAttributes, sphere) ?? previous.radius,
  });
}

/** The nearest pose within the author's bounds. Theta is bounded only where both bounds are set. */
export function poseWithin(pose: Pose, { minOrbit, maxOrbit }: CameraSetting, sphere: Sphere): Pose {
  if (minOrbit === undefined && maxOrbit === undefined) return pose;
  const { theta, phi, radius } = orbitOf(pose);
  const [minTheta, maxTheta] = [minOrbit?.theta, maxOrbit?.theta];
  const bounded = {
    theta:
      minTheta === undefined || maxTheta === undefined
        ? theta
        : MathUtils.clamp(angleNearest(theta, (minTheta + maxTheta) / 2), minTheta, maxTheta),
    phi: MathUtils.clamp(phi, minOrbit?.phi ?? 0, maxOrbit?.phi ?? Math.PI),
    radius: MathUtils.clamp(
      radius,
      lengthOf(minOrbit?.radius, pose, sphere) ?? 0,
      lengthOf(maxOrbit?.radius, pose, sphere) ?? Infinity,
    ),
  };
  const isWithin =
    bounded.phi === phi && bounded.radius === radius && Math.abs(angleNearest(bounded.theta, theta) - theta) < 1e-9;
  return isWithin ? pose : poseOnOrbit(pose, bounded);
}

function lengthOf(radius: RadiusSetting | undefined, pose: Pose, sphere: Sphere): number | undefined {
  if (radius === undefined) return undefined;
  return "length" in radius ? radius.length : radius.factor * framingDistance(sphere, pose.fieldOfView);
}

/** The equivalent angle at most half a turn from `to`. */
function angleNearest(angle: number, to: number): number {
  return angle + 2 * Math.PI * Math.round((to - angle) / (2 * Math.PI));
}

/** The shortest rotation from +y to `up`. */
function uprightFrame(up: Vector3): Quaternion {
  return new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), up);
}
