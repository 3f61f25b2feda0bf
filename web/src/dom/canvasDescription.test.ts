import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { canvasDescriber } from "./canvasDescription.ts";
import { keyLabels } from "./labels.ts";

/** A canvas that records its attributes and classes, and the texts that are announced. */
function fakeInterface() {
  const attributes: Record<string, string> = {};
  const announced: string[] = [];
  const canvas = {
    setAttribute: (name: string, value: string) => (attributes[name] = value),
    classList: { toggle: (name: string, isOn: boolean) => (attributes[name] = String(isOn)) },
    ariaDescription: null,
    ariaRoleDescription: null,
    tabIndex: 0,
  };
  const describeCanvas = canvasDescriber({
    canvas: canvas as unknown as HTMLCanvasElement,
    announce: (text) => announced.push(text),
  });
  return { attributes, canvas, announced, describeCanvas };
}

describe("the description of a canvas", () => {
  test("lists the keys of the navigation type, and has the focus in its order", () => {
    const { attributes, canvas, announced, describeCanvas } = fakeInterface();
    describeCanvas("A horse", "fly", false);
    assert.deepEqual(attributes, { "aria-label": "A horse", role: "application", moves: "true" });
    assert.deepEqual([canvas.ariaRoleDescription, canvas.ariaDescription], ["3D view", keyLabels.fly]);
    assert.deepEqual([canvas.tabIndex, announced], [0, []]);
  });

  test("is that of an image where the canvas takes no input", () => {
    const { attributes, canvas, describeCanvas } = fakeInterface();
    describeCanvas("A horse", "examine", true);
    assert.deepEqual(attributes, { "aria-label": "A horse", role: "img", moves: "false" });
    assert.deepEqual([canvas.ariaRoleDescription, canvas.ariaDescription, canvas.tabIndex], [null, null, -1]);
  });

  test("announces each navigation type that replaces another, once", () => {
    const { announced, describeCanvas } = fakeInterface();
    for (const type of ["examine", "examine", "walk", "walk"] as const) describeCanvas("A hall", type, false);
    assert.deepEqual(announced, [`Walking. ${keyLabels.walk}`]);
  });
});
