import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { Quaternion, Sphere, Vector3 } from "three";
import type { Pose } from "./cameraPose.ts";
import { orbitPose, zoomPose } from "./cameraPose.ts";
import { SurfaceAhead } from "./surfaceAhead.ts";

const sphere = new Sphere(new Vector3(0, 0, 0), 2);

/** A camera on the z axis that looks at the origin. */
function poseAt(z: number): Pose {
  return {
    position: new Vector3(0, 0, z),
    orientation: new Quaternion(),
    center: new Vector3(),
    up: new Vector3(0, 1, 0),
    fieldOfView: 0.8,
  };
}

/** Zooms in steps, with the answer of a surface at z = 1 after each step, and returns the poses. */
function approachSurface(surface: SurfaceAhead, pose: Pose, factor: number, steps: number): Pose[] {
  const poses: Pose[] = [];
  for (let step = 0; step < steps; step += 1) {
    pose = surface.approach(pose, zoomPose(pose, factor, sphere), sphere);
    if (surface.takeSearch(pose) !== undefined) {
      const rest = surface.found(pose, pose.position.z - 1, pose);
      if (rest < 1) pose = surface.approach(pose, zoomPose(pose, rest, sphere), sphere);
    }
    poses.push(pose);
  }
  return poses;
}

describe("an approach to a surface", () => {
  test("stops a two-hundredth of the scene's radius before it, whatever the steps", () => {
    for (const [factor, steps] of [
      [0.99, 2000],
      [0.8, 80],
      [0.1, 40],
      [0.001, 40],
    ] as const) {
      const poses = approachSurface(new SurfaceAhead(), poseAt(5), factor, steps);
      const heights = poses.map(({ position }) => position.z);
      for (const [i, z] of heights.entries())
        assert.ok(z >= 1.01 - 1e-9 && z <= (heights[i - 1] ?? 5), `z is ${String(z)}`);
      assert.ok((heights.at(-1) ?? 5) < 1.02);
    }
  });

  test("reaches the scene's bounds without knowing what is ahead", () => {
    const surface = new SurfaceAhead();
    const pose = surface.approach(poseAt(10), zoomPose(poseAt(10), 0.5, sphere), sphere);
    assert.equal(pose.position.z, 5);
    assert.ok(Math.abs(surface.approach(pose, zoomPose(pose, 0.1, sphere), sphere).position.z - 2.02) < 1e-9);
  });

  test("waits inside of the bounds until it is known what is ahead", () => {
    const surface = new SurfaceAhead();
    const start = poseAt(1.8);
    assert.equal(surface.approach(start, zoomPose(start, 0.5, sphere), sphere), start);
    assert.equal(surface.takeSearch(start), start);
    assert.equal(surface.takeSearch(start), undefined);
    assert.equal(surface.found(start, Infinity, start), 0.5);
    assert.equal(surface.approach(start, zoomPose(start, 0.5, sphere), sphere).position.z, 0.9);
  });

  test("does not hold back a camera that moves away", () => {
    const start = poseAt(1.1);
    assert.equal(new SurfaceAhead().approach(start, zoomPose(start, 2, sphere), sphere).position.z, 2.2);
  });

  test("ignores an answer for a direction that the camera has left", () => {
    const surface = new SurfaceAhead();
    const start = poseAt(1.8);
    surface.approach(start, zoomPose(start, 0.5, sphere), sphere);
    const turned = orbitPose(start, 1, 0);
    assert.equal(surface.found(start, 0.8, turned), 1);
    assert.equal(surface.approach(turned, zoomPose(turned, 0.5, sphere), sphere), turned);
  });
});
