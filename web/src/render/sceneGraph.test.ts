import assert from "node:assert/strict";
import { test } from "node:test";
import { Vector3 } from "three";
import { nodeFields } from "../document/nodes.ts";
import { matrixOf } from "./sceneGraph.ts";

const identity = Object.fromEntries(Object.entries(nodeFields.Transform).map(([name, field]) => [name, field.defaultValue])) as
  Parameters<typeof matrixOf>[0];

function placed(changes: Partial<typeof identity>, point: [number, number, number]): number[] {
  return new Vector3(...point).applyMatrix4(matrixOf({ ...identity, ...changes })).toArray().map((value) => Math.round(value * 1e9) / 1e9);
}

test("a Transform scales, then turns, then moves", () => {
  assert.deepEqual(placed({}, [1, 2, 3]), [1, 2, 3]);
  assert.deepEqual(placed({ translation: [10, 0, 0], rotation: [0, 0, 5, Math.PI / 2], scale: [2, 1, 1] }, [1, 0, 0]), [10, 2, 0]);
});

test("a Transform's centre stays where it is under turning and scaling", () => {
  assert.deepEqual(placed({ center: [1, 2, 3], rotation: [1, 1, 0, 2], scale: [3, 4, 5] }, [1, 2, 3]), [1, 2, 3]);
});

test("a Transform scales along the axes of its scaleOrientation", () => {
  assert.deepEqual(placed({ scaleOrientation: [0, 0, 1, Math.PI / 4], scale: [3, 1, 1] }, [1, 1, 0]), [3, 3, 0]);
  assert.deepEqual(placed({ scaleOrientation: [0, 0, 1, Math.PI / 4], scale: [3, 1, 1] }, [1, -1, 0]), [1, -1, 0]);
});

test("a rotation without an axis turns nothing", () => {
  assert.deepEqual(placed({ rotation: [0, 0, 0, 1] }, [1, 2, 3]), [1, 2, 3]);
});
