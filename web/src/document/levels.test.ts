import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { shapesOf } from "./description.ts";
import { elementsOf } from "./elements.testing.ts";
import { levelAt } from "./levels.ts";
import { readScene } from "./readScene.ts";

describe("levels of detail", () => {
  test("begin at their ranges and end with the last child", () => {
    const at = (distance: number) => levelAt(distance, [10, 20], 3, undefined);
    assert.deepEqual([0, 9.9, 10, 19.9, 20, 1e9].map(at), [0, 0, 1, 1, 2, 2]);
    assert.equal(levelAt(1e9, [10, 20], 2, undefined), 1);
    assert.equal(levelAt(5, [], 3, undefined), 0);
  });

  test("do not change to and fro on a bound", () => {
    let level = 0,
      changes = 0;
    for (const distance of [9.8, 10.2, 9.8, 10.2, 9.8, 10.6, 10.2, 9.8, 10.2, 9.4, 9.8]) {
      const next = levelAt(distance, [10], 2, level);
      changes += Number(next !== level);
      level = next;
    }
    assert.equal(changes, 2);
    assert.equal(levelAt(1000, [10, 20, 30], 4, 0), 3);
  });

  test("are read as a choice, of which nothing but the chosen is seen", () => {
    const x3d =
      elementsOf(`<X3D><Scene><LOD range="5 50" center="1 2 3"><Shape id="a"><Box/></Shape><Group><Shape id="b"><Box/></Shape></Group>
      <Shape id="c"><Box/></Shape></LOD></Scene></X3D>`);
    const seenAt = (level: number | undefined) =>
      shapesOf(readScene(x3d, { levelOf: () => level }).root)
        .filter(({ visible }) => visible)
        .map(({ element }) => element.getAttribute("id"));
    assert.deepEqual(seenAt(undefined), ["c"]);
    assert.deepEqual([0, 1, 2, 9].map(seenAt), [["a"], ["b"], ["c"], ["c"]]);
    const [lod] = readScene(x3d).root.children;
    assert.deepEqual(lod?.kind === "group" && { ...lod.levels, element: undefined }, {
      element: undefined,
      center: [1, 2, 3],
      range: [5, 50],
      count: 3,
    });
  });
});
