// Compares camera poses, for tests.

import assert from "node:assert/strict";
import { Vector3 } from "three";
import type { Pose } from "./cameraPose.ts";
import { forwardOf } from "./cameraPose.ts";

export function assertNear(actual: Vector3, expected: Vector3 | [number, number, number], tolerance = 1e-9): void {
  const expectedVector = Array.isArray(expected) ? new Vector3(...expected) : expected;
  assert.ok(
    actual.distanceTo(expectedVector) <= tolerance,
    `${actual.toArray().join(" ")} is not ${expectedVector.toArray().join(" ")}`,
  );
}

export function assertPose(actual: Pose, expected: Pose, tolerance = 1e-9): void {
  assertNear(actual.position, expected.position, tolerance);
  assertNear(forwardOf(actual), forwardOf(expected), tolerance);
}
