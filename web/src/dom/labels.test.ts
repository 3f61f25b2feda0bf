import assert from "node:assert/strict";
import { test } from "node:test";
import { viewLabelOf } from "./labels.ts";

test("a view is named after its side and its height", () => {
  const at = (theta: number, phi: number) =>
    viewLabelOf({ theta: (theta * Math.PI) / 180, phi: (phi * Math.PI) / 180 });
  assert.equal(at(0, 90), "View from the front");
  assert.equal(at(-10, 80), "View from the front");
  assert.equal(at(46, 60), "View from the front right, from above");
  assert.equal(at(-90, 120), "View from the left, from below");
  assert.equal(at(179, 90), "View from the back");
  assert.equal(at(-181, 90), "View from the back");
  assert.equal(at(30, 5), "View from above");
  assert.equal(at(30, 178), "View from below");
});
