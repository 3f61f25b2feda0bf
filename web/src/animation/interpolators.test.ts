import assert from "node:assert/strict";
import { test } from "node:test";
import type { Value } from "./fieldTypes.ts";
import { play } from "./animation.testing.ts";

/** The values that an interpolator sends for fractions. */
function valuesOf(markup: string, fractions: readonly number[]): (Value | undefined)[] {
  const scene = play(markup.replace(" ", ' DEF="it" '));
  return fractions.map((fraction) => {
    scene.set("it", "set_fraction", String(fraction));
    const it = scene.root.named("it");
    return scene.player.fieldOf(it, it.localName === "EaseInEaseOut" ? "modifiedFraction" : "value_changed")?.value;
  });
}

function assertNear(actual: Value | undefined, expected: readonly number[] | number, tolerance = 1e-9): void {
  const [a, b] = [[actual].flat() as number[], [expected].flat()];
  assert.equal(a.length, b.length);
  a.forEach((value, i) => {
    assert.ok(Math.abs(value - (b[i] ?? NaN)) <= tolerance, `${String(actual)} is not ${String(expected)}`);
  });
}

test("a position is linear between two keys and constant outside of all", () => {
  const [before, first, quarter, second, after] = valuesOf(
    `<PositionInterpolator key="0 0.5 1" keyValue="0 0 0  2 4 6  2 0 0"/>`,
    [-1, 0, 0.25, 0.5, 7],
  );
  assertNear(before, [0, 0, 0]);
  assertNear(first, [0, 0, 0]);
  assertNear(quarter, [1, 2, 3]);
  assertNear(second, [2, 4, 6]);
  assertNear(after, [2, 0, 0]);
});

test("of equal keys the last one counts, so that values may jump", () => {
  const [below, at, above] = valuesOf(`<ScalarInterpolator key="0 0.5 0.5 1" keyValue="0 1 5 6"/>`, [0.25, 0.5, 0.75]);
  assertNear(below, 0.5);
  assertNear(at, 5);
  assertNear(above, 5.5);
});

test("a single key is a constant", () => {
  assert.deepEqual(valuesOf(`<ScalarInterpolator key="0.3" keyValue="4"/>`, [0, 0.3, 1]), [4, 4, 4]);
});

test("orientations turn at constant speed, the shorter way", () => {
  const quarter = Math.PI / 2;
  const [half, third] = valuesOf(`<OrientationInterpolator key="0 1" keyValue="0 1 0 0  0 1 0 ${quarter}"/>`, [
    0.5,
    1 / 3,
  ]);
  assertNear(half, [0, 1, 0, Math.PI / 4]);
  assertNear(third, [0, 1, 0, Math.PI / 6]);
  const [shorter] = valuesOf(`<OrientationInterpolator key="0 1" keyValue="0 0 1 0.2  0 0 1 6.0831853"/>`, [0.5]);
  assertNear([(shorter as number[])[3] ?? 1], [0], 1e-6);
});

test("at a key an orientation is the author's own", () => {
  assert.deepEqual(valuesOf(`<OrientationInterpolator key="0 1" keyValue="0 0 2 7  1 0 0 -3"/>`, [0, 1]), [
    [0, 0, 2, 7],
    [1, 0, 0, -3],
  ]);
});

test("colours are mixed in HSV space", () => {
  const [orange, green, dark, grey] = [
    ...valuesOf(`<ColorInterpolator key="0 1" keyValue="1 0 0  1 1 0"/>`, [0.5]),
    ...valuesOf(`<ColorInterpolator key="0 1" keyValue="1 1 0  0 1 1"/>`, [0.5]),
    ...valuesOf(`<ColorInterpolator key="0 1" keyValue="1 0 0  0.5 0 0"/>`, [0.5]),
    ...valuesOf(`<ColorInterpolator key="0 1" keyValue="1 1 1  0 0 1"/>`, [0.5]),
  ];
  assertNear(orange, [1, 0.5, 0]);
  assertNear(green, [0, 1, 0]);
  assertNear(dark, [0.75, 0, 0]);
  assertNear(grey, [0.5, 0.5, 1]); // white has no hue: it becomes blue without another hue in between
  assertNear(valuesOf(`<ColorInterpolator key="0 1" keyValue="1 0 0.2  1 0.2 0"/>`, [0.5])[0], [1, 0, 0]);
});

test("coordinates and normals have a list of vectors for each key", () => {
  assertNear(
    valuesOf(`<CoordinateInterpolator key="0 1" keyValue="0 0 0 1 0 0  0 2 0 3 0 0"/>`, [0.5])[0],
    [0, 1, 0, 2, 0, 0],
  );
  assertNear(valuesOf(`<CoordinateInterpolator2D key="0 1" keyValue="0 0 1 0  0 2 3 0"/>`, [0.5])[0], [0, 1, 2, 0]);
  const root = Math.sqrt(1 / 2);
  assertNear(valuesOf(`<NormalInterpolator key="0 1" keyValue="1 0 0  0 1 0"/>`, [0.5])[0], [root, root, 0]);
  assertNear(valuesOf(`<PositionInterpolator2D key="0 1" keyValue="0 0  4 2"/>`, [0.5])[0], [2, 1]);
});

test("an open spline passes its keys, at rest at both ends", () => {
  const [start, middle, end, early, late] = valuesOf(
    `<SplinePositionInterpolator key="0 0.5 1" keyValue="0 0 0  1 2 0  2 0 0"/>`,
    [0, 0.5, 1, 0.25, 0.75],
  );
  assertNear(start, [0, 0, 0]);
  assertNear(middle, [1, 2, 0]);
  assertNear(end, [2, 0, 0]);
  // Hermite with tangents 0 and (2 0 0)/2 at half of the way: (v0 + v1) / 2 + (T0 - T1) / 8.
  assertNear(early, [0.5 - 1 / 8, 1, 0]);
  assertNear(late, [1.5 + 1 / 8, 1, 0]);
});

test("velocities of a spline are its tangents, scaled to the curve's length if asked", () => {
  assertNear(valuesOf(`<SplineScalarInterpolator key="0 1" keyValue="0 1" keyVelocity="4 0"/>`, [0.5])[0], 0.5 + 4 / 8);
  assertNear(
    valuesOf(
      `<SplineScalarInterpolator key="0 1" keyValue="0 1" keyVelocity="4 2" normalizeVelocity="true"/>`,
      [0.5],
    )[0],
    0.5 + (1 - 1) / 8,
  );
});

test("a closed spline has the same velocity at both ends", () => {
  const values = `key="0 0.25 0.5 0.75 1" keyValue="1 0 0  0 1 0  -1 0 0  0 -1 0  1 0 0"`;
  const [nearStart, nearEnd] = valuesOf(`<SplinePositionInterpolator ${values} closed="true"/>`, [1e-4, 1 - 1e-4]);
  const [, up = 0] = nearStart as number[];
  const [, down = 0] = nearEnd as number[];
  assert.ok(up > 1e-4, "it leaves with a velocity");
  assertNear(up, -down, 1e-9);
});

test("a squad passes its keys and turns smoothly", () => {
  const values = `key="0 0.5 1" keyValue="0 1 0 0  0 1 0 1  0 1 0 1.5"`;
  const [start, middle, end, before, after] = valuesOf(
    `<SquadOrientationInterpolator ${values}/>`,
    [0, 0.5, 1, 0.499, 0.501],
  ).map((value) => (value as number[])[3] ?? NaN);
  assertNear(start, 0);
  assertNear(middle, 1);
  assertNear(end, 1.5);
  const [arriving, leaving] = [(1 - (before ?? 0)) / 0.001, ((after ?? 0) - 1) / 0.001];
  assertNear(arriving, leaving, 0.01);
});

test("EaseInEaseOut leaves slowly and arrives slowly", () => {
  const [first, quarter, half, last] = valuesOf(
    `<EaseInEaseOut key="0 1" easeInEaseOut="0 0.5  0.5 0"/>`,
    [0, 0.25, 0.5, 1],
  );
  assertNear(first, 0);
  assertNear(quarter, 0.125); // u² · t / easeOut with t = 1 / (2 - 0.5 - 0.5)
  assertNear(half, 0.5);
  assertNear(last, 1);
});

test("interpolators that cannot work say why, once, and send nothing", () => {
  const warningsOf = (markup: string): string[] => {
    const scene = play(markup);
    scene.set("it", "set_fraction", "0.5");
    scene.set("it", "set_fraction", "0.6");
    return [...scene.warnings, ...scene.events];
  };
  assert.deepEqual(warningsOf(`<ScalarInterpolator DEF="it" key="0 1 0.5" keyValue="1 2 3"/>`), [
    `<ScalarInterpolator DEF="it"> has keys that are not in ascending order, and sends no events`,
  ]);
  assert.deepEqual(warningsOf(`<ScalarInterpolator DEF="it" keyValue="1 2 3"/>`), [
    `<ScalarInterpolator DEF="it"> has 0 keys and 3 values, and sends no events`,
  ]);
  assert.deepEqual(warningsOf(`<ScalarInterpolator DEF="it"/>`), []);
  const [warning, first] = warningsOf(`<ScalarInterpolator DEF="it" key="0 1 2" keyValue="1 2"/>`);
  assert.equal(warning, `<ScalarInterpolator DEF="it"> has 3 keys and 2 values: only the first 2 of both count`);
  assert.equal(first, "it.value_changed 1.5");
  assert.match(
    warningsOf(`<ScalarInterpolator DEF="it" key="0 NaN" keyValue="1 2"/>`)[0] ?? "",
    /key="0 NaN" is no MFFloat: its default counts/,
  );
  assert.match(
    warningsOf(`<CoordinateInterpolator DEF="it" key="0 1" keyValue="0 0 0 1 1 1 2 2 2"/>`)[0] ?? "",
    /has 3 values, which are not a multiple of its 2 keys/,
  );
});

test("a fraction that is no number has no effect", () => {
  const scene = play(`<ScalarInterpolator DEF="it" key="0 1" keyValue="1 2"/>`);
  scene.set("it", "set_fraction", "NaN");
  assert.deepEqual(scene.events, []);
  assert.deepEqual(scene.warnings, [
    `<ScalarInterpolator DEF="it"> set_fraction="NaN" is no SFFloat and has no effect`,
  ]);
});

test("new keys count from the next fraction on", () => {
  const scene = play(`<ScalarInterpolator DEF="it" key="0 1" keyValue="0 1"/>`);
  scene.set("it", "set_fraction", "0.5");
  scene.set("it", "keyValue", "0 10");
  scene.set("it", "set_fraction", "0.5");
  assert.deepEqual(
    scene.events.filter((event) => event.startsWith("it.value")),
    ["it.value_changed 0.5", "it.value_changed 5"],
  );
});
