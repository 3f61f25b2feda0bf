import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { Sphere, Vector3 } from "three";
import type { Pose } from "./cameraPose.ts";
import { forwardOf, orbitPose, poseFraming } from "./cameraPose.ts";
import { interpolatePose } from "./cameraTransition.ts";
import { assertPose } from "./poses.testing.ts";

describe("a camera transition", () => {
  const from = poseFraming(new Sphere(new Vector3(0, 0, 0), 3));

  test("begins and ends exactly at the two poses", () => {
    const to = orbitPose(from, 2, 0.3);
    assert.equal(interpolatePose(from, to, 0), from);
    assert.equal(interpolatePose(from, to, 1), to);
    assertPose(interpolatePose(from, to, 1e-9), from, 1e-6);
    assertPose(interpolatePose(from, to, 1 - 1e-9), to, 1e-6);
  });

  test("to the other side goes around the scene and keeps its distance", () => {
    const to = orbitPose(from, Math.PI * 0.95, 0);
    const distance = from.position.distanceTo(from.center);
    for (let t = 0; t <= 1; t += 0.05) {
      const pose = interpolatePose(from, to, t);
      assert.ok(Math.abs(pose.position.distanceTo(pose.center) - distance) < 1e-6 * distance);
      assert.ok(forwardOf(pose).angleTo(pose.center.clone().sub(pose.position)) < 1e-5);
    }
  });

  test("stays finite where the eye is at the center", () => {
    const inside: Pose = { ...from, center: from.position.clone() };
    for (const [a, b] of [
      [from, inside],
      [inside, from],
      [inside, inside],
    ] as const) {
      const { position, orientation } = interpolatePose(a, b, 0.5);
      assert.ok([...position.toArray(), ...orientation.toArray()].every(Number.isFinite));
    }
  });
});
