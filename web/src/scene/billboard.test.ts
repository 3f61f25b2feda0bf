import assert from "node:assert/strict";
import { test } from "node:test";
import { Vector3 } from "three";
import { RandomNumbers } from "../document/edits.testing.ts";
import { billboardRotation } from "./billboard.ts";

const up = new Vector3(0, 1, 0);

function axes(rotation: ReturnType<typeof billboardRotation>): [Vector3, Vector3, Vector3] {
  const [x, y, z] = [new Vector3(), new Vector3(), new Vector3()];
  rotation.extractBasis(x, y, z);
  return [x, y, z];
}

test("a billboard faces the viewer as far as rotation about its axis allows", () => {
  const random = new RandomNumbers(7);
  const randomNumber = () => random.below(2001) / 1000 - 1;
  for (let round = 0; round < 200; ++round) {
    const axis = new Vector3(randomNumber(), randomNumber(), randomNumber());
    const eye = new Vector3(randomNumber(), randomNumber(), randomNumber()).multiplyScalar(10);
    const rotation = billboardRotation(axis.toArray(), eye, up);
    const [, , z] = axes(rotation);
    axis.normalize();
    assert.ok(Math.abs(rotation.determinant() - 1) < 1e-9);
    assert.ok(axis.clone().applyMatrix4(rotation).distanceTo(axis) < 1e-9, "the rotation keeps the axis");
    const [front, toEye] = [z.projectOnPlane(axis), eye.clone().projectOnPlane(axis)];
    assert.ok(front.angleTo(toEye) < 1e-6, `${front.angleTo(toEye)} from the direction to the eye`);
  }
});

test("a billboard without an axis is parallel to the screen", () => {
  const [x, y, z] = axes(billboardRotation([0, 0, 0], new Vector3(3, 4, 12), up));
  assert.ok(z.distanceTo(new Vector3(3 / 13, 4 / 13, 12 / 13)) < 1e-12);
  assert.ok(Math.abs(x.y) < 1e-12 && y.y > 0, "the y axis is upright on the screen");
});

test("a billboard whose rotation is undefined stays unrotated", () => {
  for (const [axis, eye] of [
    [
      [0, 1, 0],
      [0, 5, 0],
    ],
    [
      [0, 0, 1],
      [1, 2, 3],
    ],
    [
      [0, 1, 0],
      [0, 0, 0],
    ],
    [
      [0, 0, 0],
      [0, 2, 0],
    ],
  ] as const) {
    assert.deepEqual(
      billboardRotation(axis, new Vector3(...eye), up).toArray(),
      [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1],
    );
  }
});
