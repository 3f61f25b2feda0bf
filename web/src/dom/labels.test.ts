import assert from "node:assert/strict";
import { test } from "node:test";
import { viewLabelOf } from "./labels.ts";
import { gestureRows } from "./overlayLabels.ts";
import { fileNameOf } from "./savePicture.ts";

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

test("the help of each navigation type lists gestures for fingers and keys, each once", () => {
  for (const type of ["examine", "walk", "fly"] as const) {
    const inputs = gestureRows(type).map(([input]) => input);
    assert.equal(new Set(inputs).size, inputs.length, type);
    for (const expected of ["Drag, one finger", "Pinch, wheel, + and −", "Arrow keys", "?"])
      assert.ok(inputs.includes(expected), `${type}: ${expected}`);
  }
  assert.ok(gestureRows("none").every(([input]) => !input.includes("finger")));
});

test("a saved picture is named after the scene", () => {
  assert.equal(fileNameOf("Marble statue of a rider"), "marble-statue-of-a-rider");
  assert.equal(fileNameOf("  Zürich/../Étage №2 "), "zürich-étage-2");
  assert.equal(fileNameOf("../"), "scene");
  assert.equal(fileNameOf("x".repeat(500)).length, 60);
});
