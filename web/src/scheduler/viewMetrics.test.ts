import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { Camera, Point } from "./viewMetrics.ts";
import { distanceToBox, planesOf, scaleOf, sphereOf, viewMetricsOf } from "./viewMetrics.ts";

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

const at = (numbers: readonly number[], index: number): number => numbers[index] ?? NaN;

describe("the distance to a box", () => {
  const box = { min: [-1, 2, 3], max: [1, 2.5, 7] } as const;

  test("is that to its nearest point, whatever the rotation and the scale", () => {
    const [cosine, sine] = [Math.cos(0.7), Math.sin(0.7)];
    const matrix = [2 * cosine, 2 * sine, 0, 0, -3 * sine, 3 * cosine, 0, 0, 0, 0, 0.5, 0, 4, 5, 6, 1];
    for (const point of [
      [0, 0, 0],
      [9, -7, 3],
      [-8, 9, 20],
      [1, 12, 8],
      [-1.1, 12, 8],
    ] as const) {
      let nearest = Infinity;
      for (let n = 0; n < 41 ** 3; ++n) {
        const along = (axis: 0 | 1 | 2): number =>
          box.min[axis] + ((box.max[axis] - box.min[axis]) * (Math.floor(n / 41 ** axis) % 41)) / 40;
        const [x, y, z] = [along(0), along(1), along(2)];
        const offsets = point.map(
          (value, row) =>
            at(matrix, row) * x + at(matrix, 4 + row) * y + at(matrix, 8 + row) * z + at(matrix, 12 + row) - value,
        );
        nearest = Math.min(nearest, Math.hypot(...offsets));
      }
      const distance = distanceToBox(point, box, matrix);
      assert.ok(
        distance <= nearest + 1e-9 && distance > nearest - 0.2,
        `${distance} from ${point.join(" ")}: ${nearest}`,
      );
    }
  });

  test("is 0 inside, and where the edges of the box are not at right angles", () => {
    assert.equal(distanceToBox([0, 2.2, 5], box, identity), 0);
    assert.equal(distanceToBox([0, 2.2, 9], box, identity), 2);
    assert.equal(distanceToBox([90, 90, 90], box, [1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]), 0);
  });
});
