import assert from "node:assert/strict";
import { test } from "node:test";
import { viewpointsOf } from "./description.ts";
import { elementsOf } from "./elements.testing.ts";
import { readScene } from "./readScene.ts";
import { cross, dot, minus, rotated } from "../tessellate/vectors.ts";

test("an OrthoViewpoint shows its field of view, near and far in the same size", () => {
  const scene = readScene(
    elementsOf(`<X3D><OrthoViewpoint description="plan" position="1 10 2" orientation="1 0 0 -1.5707963"
    fieldOfView="-4 -3 8 5" centerOfRotation="1 0 2"/></X3D>`),
  );
  const viewpoint = viewpointsOf(scene.root)[0]?.viewpoint;
  assert.ok(viewpoint);
  assert.equal(viewpoint.description, "plan");
  assert.equal(viewpoint.aspectRatio, 1.5);
  const [right, up] = [rotated([1, 0, 0], viewpoint.orientation), rotated([0, 1, 0], viewpoint.orientation)];
  const back = cross(right, up);
  /** Projects a point; coordinates are -1 … 1 over the shorter side of the view. */
  const project = (point: readonly [number, number, number]) => {
    const from = minus(point, viewpoint.position);
    const half = -dot(from, back) * Math.tan(viewpoint.fieldOfView / 2);
    return [dot(from, right) / half, dot(from, up) / half];
  };
  // It looks down on y = 0; the view reaches from z = 5 at its bottom to z = -3 at its top, around x = 3.
  for (const [point, x, y] of [
    [[3, 0, 5], 0, -1],
    [[3, 0, -3], 0, 1],
    [[7, 0, 1], 1, 0],
  ] as const) {
    const [actualX = 9, actualY = 9] = project(point);
    assert.ok(Math.abs(actualX - x) < 1e-3 && Math.abs(actualY - y) < 1e-3, `${actualX} ${actualY}`);
    assert.ok(Math.abs(Math.hypot(...project([point[0], 4, point[2]])) - Math.hypot(x, y)) < 0.01);
  }
});
