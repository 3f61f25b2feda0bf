import assert from "node:assert/strict";
import { test } from "node:test";
import { orthographicView, perspectiveView } from "../../levels/levelViews.testing.ts";
import type { Point } from "../../scheduler/viewMetrics.ts";
import type { SceneView } from "../../levels/levelViews.ts";
import { CameraMotion } from "./cameraMotion.ts";

const viewAt = (eye: Point, angle = 0): SceneView => {
  const { camera } = perspectiveView(eye, { direction: [Math.sin(angle), 0, Math.cos(angle)] });
  return { camera, isOrthographic: false };
};

/** Views every 100 ms. */
function motionOf(views: readonly SceneView[]): CameraMotion {
  const motion = new CameraMotion();
  views.forEach((view, n) => {
    motion.follow([view], 1000 + 100 * n);
  });
  return motion;
}

const isClose = (actual: readonly number[], expected: readonly number[], tolerance: number): void => {
  expected.forEach((value, n) => {
    assert.ok(Math.abs((actual[n] ?? NaN) - value) <= tolerance, `${actual.join(" ")} for ${expected.join(" ")}`);
  });
};

test("a camera that moves evenly is where its movement leads, with the frustum that it has there", () => {
  const steps = [0, 1, 2].map((n) => viewAt([10 * n, 5, 100 - 20 * n]));
  const [ahead] = motionOf(steps).viewsAhead(500);
  const expected = viewAt([70, 5, -40]).camera;
  isClose(ahead?.camera.position ?? [], expected.position, 1e-9);
  expected.planes.forEach((plane, n) => {
    // The far plane is 1e7 away.
    isClose(ahead?.camera.planes[n] ?? [], plane, 1e-6);
  });
});

test("a camera that turns looks further to that side, and its planes keep their distances from it", () => {
  const steps = [0, 0.05, 0.1].map((angle) => viewAt([0, 0, 0], angle));
  const [ahead] = motionOf(steps).viewsAhead(200);
  const expected = viewAt([0, 0, 0], 0.2).camera;
  expected.planes.forEach((plane, n) => {
    isClose(ahead?.camera.planes[n]?.slice(0, 3) ?? [], plane.slice(0, 3), 0.01);
    assert.ok(Math.abs((ahead?.camera.planes[n]?.[3] ?? NaN) - plane[3]) < 1e-6);
  });
});

test("a parallel view moves with its sides", () => {
  const steps = [0, 1, 2].map((n): SceneView => {
    return { camera: orthographicView([10 * n, 0, 0], {}).camera, isOrthographic: true };
  });
  const [ahead] = motionOf(steps).viewsAhead(100);
  isClose(ahead?.camera.planes[0] ?? [], orthographicView([30, 0, 0], {}).camera.planes[0] ?? [], 1e-6);
});

test("a camera that rests, has rested, or has jumped to another place has no views ahead", () => {
  assert.deepEqual(new CameraMotion().viewsAhead(500), []);
  const still = viewAt([0, 0, 0]);
  assert.deepEqual(motionOf([still, still, still]).viewsAhead(500), []);
  assert.deepEqual(motionOf([still, viewAt([1000, 0, 0])]).viewsAhead(500), [], "one step is a jump");
  const motion = motionOf([still, viewAt([1, 0, 0]), viewAt([2, 0, 0])]);
  assert.equal(motion.viewsAhead(500).length, 1);
  motion.follow([viewAt([2, 0, 0])], 1300);
  assert.equal(motion.viewsAhead(500).length, 1, "the same view again, soon");
  motion.follow([viewAt([2, 0, 0])], 1600);
  assert.deepEqual(motion.viewsAhead(500), []);
});

test("views in one frame count as one, and another number of cameras begins anew", () => {
  const motion = motionOf([viewAt([0, 0, 0]), viewAt([1, 0, 0]), viewAt([2, 0, 0])]);
  motion.follow([viewAt([2.1, 0, 0])], 1201);
  const [ahead] = motion.viewsAhead(100);
  isClose(ahead?.camera.position ?? [], [3.2, 0, 0], 1e-9);
  motion.follow([viewAt([2.2, 0, 0]), viewAt([0, 0, 0])], 1300);
  assert.deepEqual(motion.viewsAhead(100), []);
});
