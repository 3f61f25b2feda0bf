import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { shapesOf } from "../document/description.ts";
import { elementsOf } from "../document/elements.testing.ts";
import { lodLevelAt } from "./lodLevel.ts";
import { readScene } from "../document/readScene.ts";

describe("levels of detail", () => {
  test("change at the distances of their ranges, up to the last child", () => {
    const levelAt = (distance: number) => lodLevelAt(distance, [10, 20], 3, undefined);
    assert.deepEqual([0, 9.9, 10, 19.9, 20, 1e9].map(levelAt), [0, 0, 1, 1, 2, 2]);
    assert.equal(lodLevelAt(1e9, [10, 20], 2, undefined), 1);
    assert.equal(lodLevelAt(5, [], 3, undefined), 0);
  });

  test("do not flicker at the distance of a range", () => {
    let level = 0,
      changes = 0;
    for (const distance of [9.8, 10.2, 9.8, 10.2, 9.8, 10.6, 10.2, 9.8, 10.2, 9.4, 9.8]) {
      const next = lodLevelAt(distance, [10], 2, level);
      changes += Number(next !== level);
      level = next;
    }
    assert.equal(changes, 2);
    assert.equal(lodLevelAt(1000, [10, 20, 30], 4, 0), 3);
  });

  test("are read as a group with one visible child", () => {
    const x3d =
      elementsOf(`<X3D><Scene><LOD range="5 50" center="1 2 3"><Shape id="a"><Box/></Shape><Group><Shape id="b"><Box/></Shape></Group>
      <Shape id="c"><Box/></Shape></LOD></Scene></X3D>`);
    const visibleAt = (level: number | undefined) =>
      shapesOf(readScene(x3d, { levelOf: () => level }).root)
        .filter(({ visible }) => visible)
        .map(({ element }) => element.getAttribute("id"));
    assert.deepEqual(visibleAt(undefined), ["c"]);
    assert.deepEqual([0, 1, 2, 9].map(visibleAt), [["a"], ["b"], ["c"], ["c"]]);
    const [lod] = readScene(x3d).root.children;
    assert.deepEqual(lod?.kind === "group" && { ...lod.lod, element: undefined }, {
      element: undefined,
      center: [1, 2, 3],
      range: [5, 50],
      levelCount: 3,
    });
  });
});
