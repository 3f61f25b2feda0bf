import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { Box3, Matrix4, Vector3 } from "three";
import { extend, flatBoxOf, isDrawable, isEmpty, makeEmpty, makeFlatBox, setBox3, setTransformed } from "./flatBox.ts";

/** The same numbers in every run, in -1 … 1 (a linear congruential generator). */
function randomNumbers(): () => number {
  let state = 1;
  return () => (state = (state * 48271) % 2147483647) / 1073741823.5 - 1;
}

function assertNear(actual: Box3, expected: Box3): void {
  assert.ok(actual.min.distanceTo(expected.min) < 1e-12 && actual.max.distanceTo(expected.max) < 1e-12);
}

describe("boxes of six numbers", () => {
  test("are transformed as those of three.js, by mirrors and shears, too", () => {
    const next = randomNumbers();
    for (let round = 0; round < 200; ++round) {
      const corners = Array.from({ length: 2 }, () => new Vector3(next(), next(), next()));
      const box = new Box3().setFromPoints(corners);
      const matrix = new Matrix4().fromArray(
        Array.from({ length: 16 }, (_, i) => (i % 4 === 3 ? +(i === 15) : next())),
      );
      const transformed = makeFlatBox();
      setTransformed(transformed, matrix, flatBoxOf({ min: box.min.toArray(), max: box.max.toArray() }));
      assertNear(setBox3(new Box3(), transformed), box.clone().applyMatrix4(matrix));
    }
  });

  test("are extended as those of three.js, and by an empty one not at all", () => {
    const next = randomNumbers();
    const [sum, expected] = [makeFlatBox(), new Box3()];
    for (let round = 0; round < 20; ++round) {
      const box = new Box3().setFromPoints([new Vector3(next(), next(), next()), new Vector3(next(), next(), next())]);
      extend(sum, flatBoxOf({ min: box.min.toArray(), max: box.max.toArray() }));
      extend(sum, makeFlatBox());
      expected.union(box);
      assertNear(setBox3(new Box3(), sum), expected);
    }
  });

  test("are drawable where no coordinate is beyond a GPU's reach", () => {
    assert.ok(isEmpty(makeFlatBox()) && !isDrawable(makeFlatBox()));
    const point = flatBoxOf({ min: [1, 2, 3], max: [1, 2, 3] });
    assert.ok(!isEmpty(point) && isDrawable(point));
    for (const coordinate of [1e18, -Infinity, NaN])
      assert.ok(!isDrawable(flatBoxOf({ min: [coordinate, 0, 0], max: [1, 1, 1] })));
    assert.ok(isEmpty(makeEmpty(point)));
  });
});
