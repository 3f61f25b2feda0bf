import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, test } from "node:test";
import type { Chunk } from "./priority.ts";
import { chunkWeightsOf, defaultChunkWeights, priorityOf, weightOfView } from "./priority.ts";
import type { ViewMetrics } from "./viewMetrics.ts";

const chunk = (type: Chunk["type"], plane = 1): Chunk => ({ type, plane });
const viewOf = (pixels: number, isInView = true): ViewMetrics => ({ pixels, isInView, pixelsPerUnit: 1 });

describe("the priority of a request", () => {
  test("orders files by content as the paper does", () => {
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
    const values = order.map((each) => priorityOf(1, each, viewOf(100)));
    assert.deepEqual(
      values,
      values.toSorted((a, b) => b - a),
    );
    assert.equal(new Set(values).size, values.length);
  });

  test("prefers coarse data of all objects of about the same size to fine data of any", () => {
    const patches = [60, 150, 400, 800].map((pixels) => viewOf(pixels));
    const minCoordPriority = Math.min(...patches.map((view) => priorityOf(1, chunk("coord"), view)));
    const maxIndexPriority = Math.max(...patches.map((view) => priorityOf(1, chunk("index"), view)));
    assert.ok(minCoordPriority > maxIndexPriority);
  });

  test("prefers the surface of an object that fills the screen to the points of a tiny one", () => {
    assert.ok(priorityOf(1, chunk("index"), viewOf(800)) > priorityOf(1, chunk("coord"), viewOf(8)));
  });

  test("prefers the first byte of everything in view to the second byte of anything", () => {
    assert.ok(priorityOf(1, chunk("coord"), viewOf(0)) > priorityOf(1, chunk("refinement"), viewOf(1e6)));
  });

  test("prefers objects in view, and outside of the view larger objects", () => {
    assert.ok(priorityOf(1, chunk("refinement"), viewOf(1)) > priorityOf(1, chunk("normal"), viewOf(4096, false)));
    assert.ok(weightOfView(viewOf(100, false)) > weightOfView(viewOf(10, false)));
  });

  test("is proportional to the factor of the author, which may be 0", () => {
    assert.equal(priorityOf(4, chunk("index"), viewOf(50)), priorityOf(1, chunk("coord"), viewOf(50)));
    assert.equal(priorityOf(0, chunk("coord"), viewOf(50)), 0);
  });

  test("is finite and positive for any size on the screen", () => {
    for (const pixels of [0, -1, 1e300, Infinity])
      assert.ok(Number.isFinite(weightOfView(viewOf(pixels))) && weightOfView(viewOf(pixels)) > 0);
  });
});

test("the default weights are those of docs/formats/nodes.md", () => {
  const text = readFileSync(join(import.meta.dirname, "../../../docs/formats/nodes.md"), "utf8");
  const [line = ""] = text.split("\n## Order of requests\n")[1]?.match(/^- \*\*chunk type\*\*: .*$/m) ?? [];
  const documented = Array.from(line.matchAll(/`(\w+)` (\d+)/g), ([, type, weight]) => [type, Number(weight)]);
  assert.deepEqual(Object.fromEntries(documented), defaultChunkWeights);
});

describe("weights from an author", () => {
  const problems: string[] = [];
  const weightsOf = (text: string) => {
    problems.length = 0;
    return chunkWeightsOf(text, (problem) => problems.push(problem));
  };

  test("change only the weights that they name, with any case and spacing", () => {
    assert.deepEqual(weightsOf(" Normal:8 ;texcoord : 0.5;; "), { ...defaultChunkWeights, normal: 8, texCoord: 0.5 });
    assert.deepEqual(problems, []);
    assert.deepEqual(weightsOf(""), defaultChunkWeights);
    assert.equal(priorityOf(1, chunk("refinement", 2), viewOf(1), weightsOf("refinement: 100")), 25);
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
    test(`"${text}" is ignored and reported`, () => {
      assert.deepEqual(weightsOf(`${text}; color: 3`), { ...defaultChunkWeights, color: 3 });
      assert.equal(problems.length, 1);
    });
  }
});
