import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { Vector3 } from "three";
import { faceOf, nearestVertex, primitiveAt, primitiveEndingAt, primitiveIn } from "./pickedPrimitive.ts";

/** A bent strip of four triangles: three squares' corners along x, the last square folded up. */
const positions = [
  [0, 0, 0],
  [0, 1, 0],
  [1, 0, 0],
  [1, 1, 0],
  [1, 0, 1],
  [1, 1, 1],
].map((position) => new Vector3(...position));
const positionOf = (n: number) => positions[n] ?? new Vector3();
const index = Uint16Array.from([0, 2, 1, 1, 2, 3, 3, 2, 4, 3, 4, 5, 4, 2, 3]);

describe("the hit primitive", () => {
  test("is, among those that end in the given vertex, the one on which the point lies", () => {
    for (const [number, [a = 0, b = 0, c = 0]] of [
      [0, 2, 1],
      [1, 2, 3],
      [3, 2, 4],
      [3, 4, 5],
    ].entries()) {
      const inside = positionOf(a)
        .clone()
        .multiplyScalar(0.2)
        .addScaledVector(positionOf(b), 0.3)
        .addScaledVector(positionOf(c), 0.5);
      assert.deepEqual(primitiveIn(index, "triangles", c, inside, positionOf), { number, vertices: [a, b, c] });
      assert.equal(nearestVertex([a, b, c], inside, positionOf), c);
    }
  });

  test("is undefined where no primitive ends in the vertex", () => {
    assert.equal(primitiveIn(index, "triangles", 0, new Vector3(), positionOf), undefined);
    assert.equal(primitiveIn(new Uint16Array(), "triangles", 0, new Vector3(), positionOf), undefined);
  });

  test("is the nearest of several lines, and its nearer end is reported", () => {
    const lines = Uint32Array.from([0, 1, 2, 1, 3, 1]);
    const point = new Vector3(0.3, 0.7, 0);
    assert.deepEqual(primitiveIn(lines, "lines", 1, point, positionOf), { number: 1, vertices: [2, 1] });
    assert.equal(nearestVertex([2, 1], point, positionOf), 1);
  });

  test("ends in each vertex of a line strip but the first", () => {
    const strip = Uint16Array.from([0, 1, 3, 2]);
    assert.deepEqual(primitiveIn(strip, "lineStrip", 3, new Vector3(0.5, 1, 0), positionOf), {
      number: 1,
      vertices: [1, 3],
    });
    assert.deepEqual(primitiveEndingAt(2, { primitive: "lineStrip", first: 10, count: 4 }), {
      number: 1,
      vertices: [11, 12],
    });
    assert.deepEqual(primitiveEndingAt(5, { primitive: "triangles", first: 10, count: 9 }), {
      number: 1,
      vertices: [13, 14, 15],
    });
  });

  test("is found by its own index among wide lines", () => {
    const range = { primitive: "lines", first: 10, count: 6, isWide: true } as const;
    assert.deepEqual(primitiveAt(1, range, Uint16Array.from([7, 8, 9, 4, 5, 6])), { number: 1, vertices: [9, 4] });
    assert.deepEqual(primitiveAt(1, range, undefined), { number: 1, vertices: [12, 13] });
    assert.deepEqual(primitiveAt(2, { ...range, primitive: "lineStrip" }, Uint16Array.from([7, 8, 9, 4])), {
      number: 2,
      vertices: [9, 4],
    });
  });

  test("has no normal but a nearest vertex where it has no area", () => {
    assert.equal(faceOf([2, 2, 3], positionOf).normal.length(), 0);
    assert.equal(nearestVertex([2, 2, 3], positionOf(2), positionOf), 2);
    assert.deepEqual(faceOf([2, 1, 0], positionOf), { point: positionOf(2), normal: new Vector3(0, 0, 1) });
  });
});
