import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { Vector3 } from "three";
import { faceOf, nearestVertex, primitiveAt, primitiveEndingAt, primitiveIn } from "./pickedPrimitive.ts";

/** Two squares with a common edge, in the planes z = 0 and x = 1. */
const positions = [
  [0, 0, 0],
  [0, 1, 0],
  [1, 0, 0],
  [1, 1, 0],
  [1, 0, 1],
  [1, 1, 1],
].map((position) => new Vector3(...position));
const positionOf = (n: number) => positions[n] ?? new Vector3();
/** Two triangles for each square; then the third triangle again, reversed. */
const index = Uint16Array.from([0, 2, 1, 1, 2, 3, 3, 2, 4, 3, 4, 5, 4, 2, 3]);

describe("the hit primitive", () => {
  test("is the one that contains the point, of those that end in the given vertex", () => {
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

  test("is the one whose face, edge or corner is nearest to a point that none contains", () => {
    const withoutArea = [2, 2, 3];
    const triangles = Uint16Array.from([0, 1, 3, ...withoutArea, 4, 5, 3]);
    for (const [point, number] of [
      [new Vector3(0.2, 0.9, 0.3), 0],
      [new Vector3(-1, -0.2, 0), 0],
      [new Vector3(0.9, 0.2, 0), 1],
      [new Vector3(1, -0.2, -0.1), 1],
      [new Vector3(0.8, 1.5, 0.5), 2],
      [new Vector3(1.5, 0.2, 0.9), 2],
    ] as const)
      assert.equal(primitiveIn(triangles, "triangles", 3, point, positionOf)?.number, number, point.toArray().join());
  });

  test("is undefined if no primitive ends in the vertex", () => {
    assert.equal(primitiveIn(index, "triangles", 0, new Vector3(), positionOf), undefined);
    assert.equal(primitiveIn(new Uint16Array(), "triangles", 0, new Vector3(), positionOf), undefined);
  });

  test("is the nearest of several lines, whose nearer end is the nearest vertex", () => {
    const lines = Uint32Array.from([0, 1, 2, 1, 3, 1]);
    const point = new Vector3(0.3, 0.7, 0);
    assert.deepEqual(primitiveIn(lines, "lines", 1, point, positionOf), { number: 1, vertices: [2, 1] });
    assert.equal(nearestVertex([2, 1], point, positionOf), 1);
  });

  test("is found by its last vertex in strips and in draws without an index", () => {
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

  test("has a nearest vertex but no normal if it has no area", () => {
    assert.equal(faceOf([2, 2, 3], positionOf).normal.length(), 0);
    assert.equal(nearestVertex([2, 2, 3], positionOf(2), positionOf), 2);
    assert.deepEqual(faceOf([2, 1, 0], positionOf), { point: positionOf(2), normal: new Vector3(0, 0, 1) });
  });
});
