import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { Camera, Point } from "./viewMetrics.ts";
import { planesOf, scaleOf, sphereOf, viewMetricsOf } from "./viewMetrics.ts";

const identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

/** A camera at the origin that looks along -z, with 90 degrees and 1000 pixels both ways, and z from -1 to -100. */
const clipFromScene = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -101 / 99, -1, 0, 0, -200 / 99, 0];
const camera: Camera = { position: [0, 0, 0], planes: planesOf(clipFromScene), pixelsPerUnit: 500, near: 1 };

const ball = (center: Point, radius: number) => viewMetricsOf({ center, radius }, camera);

describe("the view metrics of a sphere", () => {
  test("are those of a sphere in view if it is inside of the six planes or crosses them", () => {
    for (const center of [
      [0, 0, -10],
      [9.9, -9.9, -10],
      [0, 0, -1.1],
      [0, 0, -99],
    ] as const)
      assert.ok(ball(center, 0).isInView, String(center));
    for (const center of [
      [10.1, 0, -10],
      [0, -10.1, -10],
      [0, 0, 10],
      [0, 0, -0.9],
      [0, 0, -101],
    ] as const)
      assert.ok(!ball(center, 0).isInView, String(center));
    assert.ok(ball([11, 0, -10], 1).isInView);
    assert.ok(!ball([12, 0, -10], 1).isInView);
  });

  test("halve its size at twice the distance, wherever the camera looks", () => {
    assert.equal(ball([0, 0, -10], 1).pixels, 100);
    assert.equal(ball([0, 0, -20], 1).pixels, 50);
    assert.equal(ball([0, 20, 0], 1).pixels, 50);
  });

  test("give it the maximum size, which is finite, around the camera", () => {
    assert.equal(ball([0, 0, -0.5], 4).pixels, 1000);
    assert.equal(ball([0, 0, 0], 0).pixels, 0);
    assert.equal(ball([0, 0, -3], 5).pixelsPerUnit, 500);
  });

  test("give it the scale at its nearest point", () => {
    assert.equal(ball([0, 0, -10], 5).pixelsPerUnit, 100);
  });
});

describe("the sphere around a box", () => {
  test("holds all corners, and touches one, with any matrix", () => {
    for (const matrix of [
      identity,
      [2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 4, 0, 5, 6, 7, 1],
      [1, 2, 0.5, 0, -1, 1, 0, 0, 0.3, 0, 2, 0, 1, 1, 1, 1],
      [0, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1],
    ]) {
      const min = [-1, 2, 3] as const;
      const max = [1, 2.5, 7] as const;
      const { center, radius } = sphereOf({ min, max }, matrix);
      const distances = Array.from({ length: 8 }, (_, corner) => {
        const point = [0, 1, 2].map((axis) => (((corner >> axis) & 1) === 1 ? max : min)[axis] ?? 0);
        const transformed = [0, 1, 2].map(
          (row) =>
            (matrix[12 + row] ?? 0) +
            [0, 1, 2].reduce((sum, axis) => sum + (matrix[4 * axis + row] ?? 0) * (point[axis] ?? 0), 0),
        );
        return Math.hypot(...transformed.map((value, axis) => value - (center[axis] ?? 0)));
      });
      assert.ok(Math.abs(Math.max(...distances) - radius) < 1e-9, `${distances.join(" ")} in ${radius}`);
    }
  });

  test("grows with the longest axis of its matrix", () => {
    assert.equal(scaleOf([2, 0, 0, 0, 0, 3, 4, 0, 0, 0, 1, 0, 9, 9, 9, 1]), 5);
  });
});
