import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { Vector3 } from "three";
import { faceOf, nearestVertex, primitiveAt, primitiveEndingAt, primitiveIn } from "./pickedPrimitive.ts";

/** A bent strip of four triangles: three squares' corners along x, the last square folded up. */
const places = [
  [0, 0, 0],
  [0, 1, 0],
  [1, 0, 0],
  [1, 1, 0],
  [1, 0, 1],
  [1, 1, 1],
].map((place) => new Vector3(...place));
const positionOf = (n: number) => places[n] ?? new Vector3();
const index = Uint16Array.from([0, 2, 1, 1, 2, 3, 3, 2, 4, 3, 4, 5, 4, 2, 3]);

describe("the primitive under a point", () => {
  test("is the one of those that end in the vertex on which the point lies", () => {
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

  test("is none where none ends in that vertex", () => {
    assert.equal(primitiveIn(index, "triangles", 0, new Vector3(), positionOf), undefined);
    assert.equal(primitiveIn(new Uint16Array(), "triangles", 0, new Vector3(), positionOf), undefined);
  });

  test("of lines is the nearest, with its nearer end", () => {
    const lines = Uint32Array.from([0, 1, 2, 1, 3, 1]);
    const point = new Vector3(0.3, 0.7, 0);
    assert.deepEqual(primitiveIn(lines, "lines", 1, point, positionOf), { number: 1, vertices: [2, 1] });
    assert.equal(nearestVertex([2, 1], point, positionOf), 1);
  });

  test("of a line strip ends in each of its vertices but the first", () => {
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

  test("of wide lines has its own number", () => {
    const range = { primitive: "lines", first: 10, count: 6, isWide: true } as const;
    assert.deepEqual(primitiveAt(1, range, Uint16Array.from([7, 8, 9, 4, 5, 6])), { number: 1, vertices: [9, 4] });
    assert.deepEqual(primitiveAt(1, range, undefined), { number: 1, vertices: [12, 13] });
    assert.deepEqual(primitiveAt(2, { ...range, primitive: "lineStrip" }, Uint16Array.from([7, 8, 9, 4])), {
      number: 2,
      vertices: [9, 4],
    });
  });

  test("without area has no normal and still a nearest vertex", () => {
    assert.equal(faceOf([2, 2, 3], positionOf).normal.length(), 0);
    assert.equal(nearestVertex([2, 2, 3], positionOf(2), positionOf), 2);
    assert.deepEqual(faceOf([2, 1, 0], positionOf), { point: positionOf(2), normal: new Vector3(0, 0, 1) });
  });
});
