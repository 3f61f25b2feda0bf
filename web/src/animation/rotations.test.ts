import assert from "node:assert/strict";
import { test } from "node:test";
import type { Quaternion, Rotation } from "./rotations.ts";
import { quaternionOf, slerp, turnBetween } from "./rotations.ts";

function distance(a: Quaternion, b: Quaternion): number {
  const cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
  return 1 - Math.abs(cosine); // q and -q are one rotation
}

test("a turn about one axis is the arc between its rotations", () => {
  const axes = [
    [0, 1, 0],
    [1, 2, -3],
  ] as const;
  const angles = [-9, -Math.PI, -3, -0.2, 0, 0.1, 1.5, 3, Math.PI, 3.2, 6, 6.5, 12];
  for (const [x, y, z] of axes)
    for (const begin of angles)
      for (const end of angles)
        for (const scale of [1, -2]) {
          const from: Rotation = [x, y, z, begin];
          const to: Rotation = [scale * x, scale * y, scale * z, end];
          const words = `${from.join(" ")} to ${to.join(" ")}`;
          const turn = turnBetween(from, to);
          if (begin === 0 && end === 0) {
            assert.equal(turn, undefined);
            continue;
          }
          assert.ok(turn, words);
          assert.ok(Math.abs(turn.difference) <= Math.PI + 1e-12);
          // Both ways of half a turn are the shortest.
          if (Math.abs(Math.abs(turn.difference) - Math.PI) < 1e-9) continue;
          for (const t of [0, 0.25, 0.5, 1]) {
            const expected = slerp(quaternionOf(...from), quaternionOf(...to), t);
            const actual = quaternionOf(...turn.axis, turn.angle + t * turn.difference);
            assert.ok(distance(actual, expected) < 1e-12, `${words} at ${t}`);
          }
        }
});

test("from or to no rotation, the axis is that of the other", () => {
  assert.deepEqual(turnBetween([0, 0, 1, 0], [0, 2, 0, 1]), { axis: [0, 1, 0], angle: 0, difference: 1 });
  assert.deepEqual(turnBetween([0, 2, 0, 1], [0, 0, 0, 5]), { axis: [0, 1, 0], angle: 1, difference: -1 });
  assert.deepEqual(turnBetween([0, 0, 0, 5], [0, 2, 0, 1]), { axis: [0, 1, 0], angle: 0, difference: 1 });
  assert.deepEqual(turnBetween([0, 2, 0, 1], [1, 0, 0, 0]), { axis: [0, 1, 0], angle: 1, difference: -1 });
});

test("about different axes there is no turn", () => {
  assert.equal(turnBetween([0, 1, 0, 1], [0, 1, 0.001, 2]), undefined);
  assert.equal(turnBetween([0, 0, 1, 1], [0, 1, 0, 1]), undefined);
});
