import assert from "node:assert/strict";
import { test } from "node:test";
import { viewLabelOf } from "./labels.ts";

test("a view label names the side and the height of the camera", () => {
  const labelAt = (theta: number, phi: number) =>
    viewLabelOf({ theta: (theta * Math.PI) / 180, phi: (phi * Math.PI) / 180 });
  assert.equal(labelAt(0, 90), "View from the front");
  assert.equal(labelAt(-10, 80), "View from the front");
  assert.equal(labelAt(46, 60), "View from the front right, from above");
  assert.equal(labelAt(-90, 120), "View from the left, from below");
  assert.equal(labelAt(179, 90), "View from the back");
  assert.equal(labelAt(-181, 90), "View from the back");
  assert.equal(labelAt(30, 5), "View from above");
  assert.equal(labelAt(30, 178), "View from below");
});
