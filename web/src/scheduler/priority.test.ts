import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { Chunk } from "./priority.ts";
import { chunkWeightsOf, defaultChunkWeights, priorityOf, weightOfView } from "./priority.ts";
import type { ViewMetrics } from "./viewMetrics.ts";

const chunk = (type: Chunk["type"], plane = 1): Chunk => ({ type, plane });
const seen = (pixels: number, isInView = true): ViewMetrics => ({ pixels, isInView, pixelsPerUnit: 1 });

describe("the number of a request", () => {
  test("orders what a file holds as the paper does", () => {
    const order = [
      chunk("coord"),
      chunk("index"),
      chunk("normal"),
      chunk("texCoord"),
      chunk("color"),
      chunk("refinement", 1),
      chunk("refinement", 2),
      chunk("refinement", 3),
    ];
    const values = order.map((each) => priorityOf(1, each, seen(100)));
    assert.deepEqual(
      values,
      values.toSorted((a, b) => b - a),
    );
    assert.equal(new Set(values).size, values.length);
  });

  test("makes objects of about the same size coarse before it makes one fine", () => {
    const patches = [60, 150, 400, 800].map((pixels) => seen(pixels));
    const least = Math.min(...patches.map((view) => priorityOf(1, chunk("coord"), view)));
    const most = Math.max(...patches.map((view) => priorityOf(1, chunk("index"), view)));
    assert.ok(least > most);
  });

  test("prefers the surface of what fills the screen to the dots of what is hardly seen", () => {
    assert.ok(priorityOf(1, chunk("index"), seen(800)) > priorityOf(1, chunk("coord"), seen(8)));
  });

  test("prefers the first byte of all that is seen to the second byte of anything", () => {
    assert.ok(priorityOf(1, chunk("coord"), seen(0)) > priorityOf(1, chunk("refinement"), seen(1e6)));
  });

  test("puts what is seen before what lies beside the view, and there what is large first", () => {
    assert.ok(priorityOf(1, chunk("refinement"), seen(1)) > priorityOf(1, chunk("normal"), seen(4096, false)));
    assert.ok(weightOfView(seen(100, false)) > weightOfView(seen(10, false)));
  });

  test("follows the author in proportion, from nothing upwards", () => {
    assert.equal(priorityOf(4, chunk("index"), seen(50)), priorityOf(1, chunk("coord"), seen(50)));
    assert.equal(priorityOf(0, chunk("coord"), seen(50)), 0);
  });

  test("is a number of 0 or more whatever is seen", () => {
    for (const pixels of [0, -1, 1e300, Infinity])
      assert.ok(Number.isFinite(weightOfView(seen(pixels))) && weightOfView(seen(pixels)) > 0);
  });
});

describe("weights that an author writes", () => {
  const problems: string[] = [];
  const weightsOf = (text: string) => {
    problems.length = 0;
    return chunkWeightsOf(text, (problem) => problems.push(problem));
  };

  test("change what they name and nothing else, in any case and spacing", () => {
    assert.deepEqual(weightsOf(" Normal:8 ;texcoord : 0.5;; "), { ...defaultChunkWeights, normal: 8, texCoord: 0.5 });
    assert.deepEqual(problems, []);
    assert.deepEqual(weightsOf(""), defaultChunkWeights);
    assert.equal(priorityOf(1, chunk("refinement", 2), seen(1), weightsOf("refinement: 100")), 25);
  });

  for (const text of [
    "normals: 8",
    "normal: much",
    "normal: -1",
    "normal",
    "normal:",
    "normal: 1: 2",
    "normal: Infinity",
  ]) {
    test(`"${text}" is left out and told`, () => {
      assert.deepEqual(weightsOf(`${text}; color: 3`), { ...defaultChunkWeights, color: 3 });
      assert.equal(problems.length, 1);
    });
  }
});
