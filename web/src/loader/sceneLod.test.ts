import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { BoxGeometry, Group, LOD, Mesh, type Object3D, PerspectiveCamera, Raycaster, Vector3 } from "three";
import type { LoadState } from "./sceneLod.ts";
import { SceneLod } from "./sceneLod.ts";

const element = { localName: "LOD", children: [], getAttribute: () => null, getAttributeNames: () => [] };

/**
 * A LOD with center (1, 0, 0) whose levels hold a box each, except `emptyLevel`. Levels outside of `loadedLevels` have
 * the state `otherState`.
 */
function lodOf(
  range: readonly number[],
  loadedLevels: Set<number>,
  emptyLevel?: number,
  otherState: LoadState = "loading",
) {
  const updates = { count: 0 };
  const indexOf = (level: Object3D) => Number(level.name);
  const lod = new SceneLod(
    { element, center: [1, 0, 0], range, levelCount: range.length + 1 },
    {
      loadStateOf: (level) =>
        !loadedLevels.has(indexOf(level)) ? otherState : indexOf(level) === emptyLevel ? "empty" : "displayed",
      onCameraUpdate: () => {
        updates.count += 1;
      },
    },
  );
  for (let index = 0; index <= range.length; ++index) {
    const group = new Group();
    group.name = String(index);
    if (index !== emptyLevel) group.add(new Mesh(new BoxGeometry()));
    lod.add(group);
  }
  lod.fill();
  return { lod, updates };
}

function cameraAt(x: number, y = 0, z = 0): PerspectiveCamera {
  const camera = new PerspectiveCamera();
  camera.position.set(x, y, z);
  camera.updateMatrixWorld();
  return camera;
}

function displayedLevelsOf({ children }: LOD): number[] {
  return children.flatMap(({ visible }, index) => (visible ? [index] : []));
}

describe("a LOD in a three.js app", () => {
  test("is a three.js LOD that displays its last level until a camera has updated it", () => {
    const { lod } = lodOf([10, 20], new Set([0, 1, 2]));
    assert.ok(lod instanceof LOD && lod.autoUpdate);
    assert.deepEqual(
      lod.levels.map(({ distance }) => distance),
      [0, 10, 20],
    );
    assert.deepEqual([displayedLevelsOf(lod), lod.getCurrentLevel()], [[2], 2]);
    assert.equal(lod.takeDistance(), Infinity);
  });

  test("displays the level for each camera by the distance from its center in its own units", () => {
    const { lod, updates } = lodOf([10, 20], new Set([0, 1, 2]));
    const parent = new Group();
    parent.scale.setScalar(2);
    parent.position.set(100, 0, 0);
    parent.add(lod);
    parent.updateMatrixWorld(true);
    for (const [x, level] of [
      [102 + 18, 0],
      [102 + 30, 1],
      [102 + 50, 2],
      [102 - 18, 0],
    ] as const) {
      lod.update(cameraAt(x));
      assert.deepEqual([displayedLevelsOf(lod), lod.getCurrentLevel()], [[level], level], `from ${x}`);
    }
    assert.equal(updates.count, 4);
    assert.equal(lod.takeDistance(), 9); // of the nearest camera
    assert.equal(lod.takeDistance(), Infinity);
  });

  test("keeps its level until every shape of the required level displays something", () => {
    const loadedLevels = new Set([2]);
    const { lod } = lodOf([10, 20], loadedLevels);
    const near = cameraAt(1, 5);
    lod.update(near);
    assert.deepEqual(displayedLevelsOf(lod), [2]);
    loadedLevels.add(1);
    lod.update(near);
    assert.deepEqual(displayedLevelsOf(lod), [2]);
    loadedLevels.add(0);
    lod.update(near);
    assert.deepEqual(displayedLevelsOf(lod), [0]);
    loadedLevels.clear(); // a level that has been displayed counts as loaded
    lod.update(near);
    assert.deepEqual(displayedLevelsOf(lod), [0]);
  });

  test("displays the required level while it loads if every other level is empty or loading", () => {
    const { lod } = lodOf([10], new Set([1]), 1);
    assert.deepEqual(displayedLevelsOf(lod), [1]);
    lod.update(cameraAt(1, 5));
    assert.deepEqual(displayedLevelsOf(lod), [0]);
  });

  test("keeps its level if the required one has failed", () => {
    const { lod } = lodOf([10, 20], new Set([2]), undefined, "failed");
    lod.update(cameraAt(1, 5));
    assert.deepEqual([displayedLevelsOf(lod), lod.getCurrentLevel()], [[2], 2]);
  });

  test("intersects rays with its displayed level only", () => {
    const { lod } = lodOf([10, 20], new Set([0, 1, 2]));
    const scene = new Group().add(lod);
    lod.update(cameraAt(1, 15));
    scene.updateMatrixWorld(true);
    const hits = new Raycaster(new Vector3(0, 0, 50), new Vector3(0, 0, -1)).intersectObject(scene);
    assert.deepEqual(
      hits.map(({ object }) => object.parent?.name),
      ["1", "1"],
    ); // the ray enters and leaves one box
  });

  test("is infinitely far if it is scaled to nothing", () => {
    const { lod } = lodOf([10], new Set([0, 1]));
    lod.scale.setScalar(0);
    lod.updateMatrixWorld(true);
    lod.update(cameraAt(1));
    assert.deepEqual(displayedLevelsOf(lod), [1]);
  });
});
