import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { describe, test } from "node:test";
import { shapesOf } from "./description.ts";
import { elementsOf } from "./elements.testing.ts";
import type { Vec3 } from "./fieldTypes.ts";
import type { Box3 } from "./geometryDescription.ts";
import { operatedBox, operatedPoint, orientationOf } from "./operators.ts";
import { readOperators } from "./readOperators.ts";
import { readScene } from "./readScene.ts";

const read = (text: string) => {
  const { operators, problem } = readOperators(text, true);
  assert.equal(problem, undefined);
  return operators;
};
const mapped = (text: string, ...point: Vec3) =>
  operatedPoint(read(text), point).map((coordinate) => Math.round(coordinate * 1e9) / 1e9);

/** What a list of operators means; src/scene/operators_test.cpp reads the same file. */
interface Vector {
  text: string;
  /** The whole sentence; absent: the list can be read. */
  problem?: string;
  operators?: { kind: string; a: Vec3; b: Vec3 }[];
  orientation?: string;
  points?: { from: Vec3; to: Vec3 }[];
  boxes?: { from: Box3; to: Box3 }[];
}

const vectorPoints: readonly Vec3[] = [
  [0, 0, 0],
  [1, 1, 1],
  [0.1, 0.5, 0.75],
  [0.6, 0.3, 0.2],
  [-0.25, 1.5, 0.999],
];
const vectorBoxes: readonly Box3[] = [
  { min: [0, 0, 0], max: [1, 1, 1] },
  { min: [0.1, 0.4, -0.5], max: [0.3, 0.45, 2] },
];

function outputOf(text: string): Vector {
  const { operators, problem } = readOperators(text, true);
  if (problem !== undefined) return { text, problem };
  return {
    text,
    operators: operators.map(({ kind, a, b }) => ({ kind, a, b })),
    orientation: orientationOf(operators),
    points: vectorPoints.map((from) => ({ from, to: operatedPoint(operators, from) })),
    boxes: vectorBoxes.map((from) => ({ from, to: operatedBox(operators, from) })),
  };
}

describe("operators", () => {
  test("are those of the vectors", () => {
    const path = join(import.meta.dirname, "../../../vectors/operators.json");
    const vectors = JSON.parse(readFileSync(path, "utf8")) as Vector[];
    assert.ok(vectors.length > 60);
    const outputs = vectors.map(({ text }) => outputOf(text));
    if (process.env.IMGEO_REWRITE_GOLDEN === "1")
      writeFileSync(path, `[\n${outputs.map((output) => JSON.stringify(output)).join(",\n")}\n]\n`);
    else assert.deepEqual(JSON.parse(JSON.stringify(outputs)), vectors);
  });

  test("map points of the unit box", () => {
    for (const [text, expected] of [
      ["", [0.1, 0.5, 0.75]],
      ["translate(0.1 0 -0.25)", [0.2, 0.5, 0.5]],
      ["brightness(0.1)", [0.2, 0.6, 0.85]],
      ["scale(2)", [-0.3, 0.5, 1]],
      ["contrast(2, 1, 0.5)", [-0.3, 0.5, 0.625]],
      ["gamma(2)", [0.01, 0.25, 0.5625]],
      ["negate()", [0.9, 0.5, 0.25]],
      ["negative(xz)", [0.9, 0.5, 0.25]],
      ["negate(z)", [0.1, 0.5, 0.25]],
      ["swizzle(zxy)", [0.75, 0.1, 0.5]],
      ["solarize(0.6)", [0.1, 0.5, 0.45]],
      ["threshold(0.3)", [0.1, 0.3, 0.3]],
      ["threshold(0.2 0.6)", [0.2, 0.5, 0.6]],
      ["posterise(3)", [0, 0.5, 1]],
      ["Translate( 0.1 ) , negate()", [0.8, 0.4, 0.15]],
      ["negate() translate(0.1)", [1, 0.6, 0.35]],
    ] as const)
      assert.deepEqual(mapped(text, 0.1, 0.5, 0.75), expected, text);
  });

  test("are refused as a whole, with one sentence", () => {
    const { operators, problem } = readOperators("negate() translate(1e9)", true);
    assert.deepEqual(operators, []);
    assert.equal(
      problem,
      'operators="negate() translate(1e9)": "1e9" of translate has something that is no number from -1000000 to ' +
        "1000000; none is applied",
    );
  });

  test("refuse a blur of geometry that has no images of coordinates", () => {
    assert.equal(
      readOperators("blur(2)", false).problem,
      'operators="blur(2)": blur filters images of coordinates, and this geometry has none; none is applied',
    );
    assert.equal(readOperators("blur(0) negate()", false).problem, undefined);
  });

  test("map the stated box of a shape of floats as they map its vertices: in the box around its geometry", () => {
    const scene = readScene(
      elementsOf(`<X3D><Scene><Shape bboxCenter="0.5 1 1" bboxSize="3 2 2">
        <BinaryGeometry coordType="Float32" operators="negate(x)">
          <GeometryPatch bboxCenter="1 1 1" bboxSize="2 2 2" primType="POINTS" vertexCount="4" coord="c.bin"/>
        </BinaryGeometry></Shape></Scene></X3D>`),
    );
    assert.deepEqual(shapesOf(scene.root)[0]?.box, { min: [0, 0, 0], max: [3, 2, 2] });
  });

  test("map a box to one around all mapped points of it", () => {
    const lists = [
      "gamma(3) solarize(0.4) swizzle(yzx)",
      "scale(-2 1 3) solarize(0.1 0.9 0.5) gamma(0.5)",
      "translate(0.3) threshold(0.1 0.8) posterise(5) negate(y)",
    ].map(read);
    let seed = 1;
    const random = () => (seed = (seed * 48271) % 2147483647) / 2147483647;
    for (const operators of lists)
      for (let n = 0; n < 50; ++n) {
        const ends = [0, 1, 2].map(() => [random(), random()].sort((a, b) => a - b));
        const vector = (pick: (range: readonly number[]) => number) => ends.map(pick) as unknown as Vec3;
        const box = operatedBox(operators, { min: vector(([low]) => low ?? 0), max: vector(([, high]) => high ?? 0) });
        for (let point = 0; point < 50; ++point)
          operatedPoint(
            operators,
            vector(([low = 0, high = 0]) => low + random() * (high - low)),
          ).forEach((coordinate, axis) => {
            assert.ok(coordinate >= (box.min[axis] ?? 0) - 1e-9 && coordinate <= (box.max[axis] ?? 0) + 1e-9);
          });
      }
  });

  test("flip faces when they mirror", () => {
    for (const [text, orientation] of [
      ["translate(1) scale(2) gamma(2)", "kept"],
      ["negate()", "flipped"],
      ["negate(xy)", "kept"],
      ["swizzle(yxz)", "flipped"],
      ["swizzle(yzx)", "kept"],
      ["swizzle(yxz) negate(z)", "kept"],
      ["scale(-1 1 1)", "flipped"],
      ["negate() solarize(0.5)", "folded"],
    ] as const)
      assert.equal(orientationOf(read(text)), orientation, text);
  });
});
