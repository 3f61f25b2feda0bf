import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { shapesOf } from "./description.ts";
import { elementsOf } from "./elements.testing.ts";
import type { Vec3 } from "./fieldTypes.ts";
import { operatedBox, operatedPoint, orientationOf, readOperators } from "./operators.ts";
import { readScene } from "./readScene.ts";

const read = (text: string) => {
  const { operators, problem } = readOperators(text);
  assert.equal(problem, undefined);
  return operators;
};
const mapped = (text: string, ...point: Vec3) =>
  operatedPoint(read(text), point).map((coordinate) => Math.round(coordinate * 1e9) / 1e9);

describe("operators", () => {
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
    for (const [text, sentence] of [
      ["rotate(1)", /"rotate" is none of translate, /],
      ["translate(1) turn", /"turn" is no operator with arguments/],
      ["translate()", /translate takes one number, or one for each axis/],
      ["scale(1 2)", /scale takes one number/],
      ["gamma(0)", /gamma takes positive numbers/],
      ["gamma(a)", /gamma takes one number/],
      ["translate(1e9)", /no number from -1000000 to 1000000/],
      ["swizzle(xxy)", /swizzle takes the three axes/],
      ["negate(xw)", /negate takes axes/],
      ["threshold(0.6 0.2)", /threshold takes the largest/],
      ["posterise(1)", /posterise takes a number of levels/],
      ["blur(2)", /blur mixes vertices/],
      ["negate() ".repeat(17), /more than 16 operators/],
    ] as const) {
      const { operators, problem } = readOperators(text);
      assert.deepEqual(operators, []);
      assert.match(problem ?? "", sentence);
    }
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
