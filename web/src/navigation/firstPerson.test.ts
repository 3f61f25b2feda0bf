import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { Quaternion, Vector3 } from "three";
import type { Pose } from "./cameraPose.ts";
import { forwardOf } from "./cameraPose.ts";
import { applyMovement, movePose, noMovement, turnPose } from "./firstPerson.ts";
import { assertNear } from "./poses.testing.ts";

describe("walking and flying", () => {
  const upright: Pose = {
    position: new Vector3(0, 1.6, 0),
    orientation: new Quaternion(),
    center: new Vector3(0, 1.6, -4),
    up: new Vector3(0, 1, 0),
    fieldOfView: 0.8,
  };

  test("walking stays on its level wherever the camera looks, flying follows the view direction", () => {
    const lookingDown = turnPose(upright, 0, -0.8);
    assertNear(movePose(lookingDown, 2, 0, 0, true).position, [0, 1.6, -2]);
    assertNear(movePose(lookingDown, 2, 0, 0, false).position, [0, 1.6 - 2 * Math.sin(0.8), -2 * Math.cos(0.8)]);
    assertNear(movePose(lookingDown, 0, 3, 1, true).position, [3, 2.6, 0]);
  });

  test("a camera that looks straight down still walks ahead", () => {
    const { position } = movePose(turnPose(upright, 0, -10), 2, 0, 0, true);
    assertNear(position, [0, 1.6, -2], 1e-6);
  });

  test("turning rotates the camera about its position, at most up to the zenith", () => {
    const pose = turnPose(upright, Math.PI / 2, 0);
    assertNear(forwardOf(pose), [1, 0, 0]);
    assertNear(pose.position, upright.position);
    assertNear(pose.center, [4, 1.6, 0]);
    assert.ok(forwardOf(turnPose(upright, 0, 9)).y < 1);
    assert.ok(forwardOf(turnPose(upright, 0, 9)).y > 0.99);
  });

  test("covers speed times time, however many frames it takes", () => {
    const motion = { ...noMovement, forward: 1 };
    let pose = upright;
    for (let frame = 0; frame < 60; ++frame) pose = applyMovement(pose, motion, 1 / 60, 2.5, true);
    assertNear(pose.position, [0, 1.6, -2.5], 1e-9);
  });
});
