import assert from "node:assert/strict";
import { test } from "node:test";
import { drawnFieldOf, routes, sceneOf } from "./animation.testing.ts";
import { visitMoments } from "./motionMoments.ts";

function momentsIn(markup: string): unknown[] {
  const root = sceneOf(markup);
  const before = root.children.map((child) => child.getAttributeNames().map((name) => child.getAttribute(name)));
  const seen: unknown[] = [];
  visitMoments({ roots: [root], documentOf: () => undefined }, drawnFieldOf, (changes) => {
    for (const { element, value } of changes) seen.push([element.getAttribute("DEF"), value]);
  });
  assert.deepEqual(
    root.children.map((child) => child.getAttributeNames().map((name) => child.getAttribute(name))),
    before,
    "attributes have changed",
  );
  return seen;
}

const way = (keys: string, values: string): string =>
  `<PositionInterpolator DEF="way" key="${keys}" keyValue="${values}"/><Transform DEF="t"/>` +
  routes("clock.fraction_changed way.set_fraction", "way.value_changed t.translation");

test("the moments of a clock are the keys and halfway between them, though it does not run", () => {
  assert.deepEqual(momentsIn(`<TimeSensor DEF="clock" enabled="false"/>${way("0 1", "0 0 0 4 0 0")}`), [
    ["t", [0, 0, 0]],
    ["t", [2, 0, 0]],
    ["t", [4, 0, 0]],
  ]);
});

test("many keys are sampled, with the first and the last moment", () => {
  const indices = Array.from({ length: 500 }, (_, n) => n);
  const seen = momentsIn(
    `<TimeSensor DEF="clock"/>${way(indices.map((n) => n / 499).join(" "), indices.map((n) => `${n} 0 0`).join(" "))}`,
  );
  assert.equal(seen.length, 64);
  assert.deepEqual(
    [seen[0], seen.at(-1)],
    [
      ["t", [0, 0, 0]],
      ["t", [499, 0, 0]],
    ],
  );
});

test("what no clock moves has no moments", () => {
  assert.deepEqual(momentsIn(`<TouchSensor DEF="clock"/>${way("0 1", "0 0 0 4 0 0")}`), []);
  assert.deepEqual(momentsIn(`<TimeSensor DEF="clock"/><Transform/>`), []);
});
