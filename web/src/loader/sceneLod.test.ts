import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { BoxGeometry, Group, LOD, Mesh, type Object3D, PerspectiveCamera, Raycaster, Vector3 } from "three";
import type { LoadState } from "./sceneLod.ts";
import { SceneLod } from "./sceneLod.ts";

const element = { localName: "LOD", children: [], getAttribute: () => null, getAttributeNames: () => [] };

/** Levels of a box each, around (1, 0, 0), of which those are here that are in `here`. */
function levelsOf(range: readonly number[], here: Set<number>, empty?: number, others: LoadState = "loading") {
  const updates = { count: 0 };
  const indexOf = (level: Object3D) => Number(level.name);
  const levels = new SceneLod(
    { element, center: [1, 0, 0], range, levelCount: range.length + 1 },
    {
      loadStateOf: (level) => (!here.has(indexOf(level)) ? others : indexOf(level) === empty ? "empty" : "displayed"),
      onCamera: () => {
        updates.count += 1;
      },
    },
  );
  for (let index = 0; index <= range.length; ++index) {
    const group = new Group();
    group.name = String(index);
    if (index !== empty) group.add(new Mesh(new BoxGeometry()));
    levels.add(group);
  }
  levels.fill();
  return { levels, updates };
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
  test("is a three.js LOD, and displays its last level until a camera has updated it", () => {
    const { levels } = levelsOf([10, 20], new Set([0, 1, 2]));
    assert.ok(levels instanceof LOD && levels.autoUpdate);
    assert.deepEqual(
      levels.levels.map(({ distance }) => distance),
      [0, 10, 20],
    );
    assert.deepEqual([displayedLevelsOf(levels), levels.getCurrentLevel()], [[2], 2]);
    assert.equal(levels.takeDistance(), Infinity);
  });

  test("displays the level for each camera, by the distance from its centre in its own units", () => {
    const { levels, updates } = levelsOf([10, 20], new Set([0, 1, 2]));
    const around = new Group();
    around.scale.setScalar(2);
    around.position.set(100, 0, 0);
    around.add(levels);
    around.updateMatrixWorld(true);
    for (const [x, level] of [
      [102 + 18, 0],
      [102 + 30, 1],
      [102 + 50, 2],
      [102 - 18, 0],
    ] as const) {
      levels.update(cameraAt(x));
      assert.deepEqual([displayedLevelsOf(levels), levels.getCurrentLevel()], [[level], level], `from ${x}`);
    }
    assert.equal(updates.count, 4);
    assert.equal(levels.takeDistance(), 9); // the nearest of all that have looked
    assert.equal(levels.takeDistance(), Infinity);
  });

  test("keeps its level until all of another displays something", () => {
    const here = new Set([2]);
    const { levels } = levelsOf([10, 20], here);
    const near = cameraAt(1, 5);
    levels.update(near);
    assert.deepEqual(displayedLevelsOf(levels), [2]);
    here.add(1);
    levels.update(near);
    assert.deepEqual(displayedLevelsOf(levels), [2]);
    here.add(0);
    levels.update(near);
    assert.deepEqual(displayedLevelsOf(levels), [0]);
    here.clear(); // what has been displayed stays
    levels.update(near);
    assert.deepEqual(displayedLevelsOf(levels), [0]);
  });

  test("displays the required level while it loads where no other can stand in", () => {
    const { levels } = levelsOf([10], new Set([1]), 1);
    assert.deepEqual(displayedLevelsOf(levels), [1]);
    levels.update(cameraAt(1, 5));
    assert.deepEqual(displayedLevelsOf(levels), [0]);
  });

  test("keeps its level where nothing of another has come", () => {
    const { levels } = levelsOf([10, 20], new Set([2]), undefined, "failed");
    levels.update(cameraAt(1, 5));
    assert.deepEqual([displayedLevelsOf(levels), levels.getCurrentLevel()], [[2], 2]);
  });

  test("is intersected by rays in its displayed level only", () => {
    const { levels } = levelsOf([10, 20], new Set([0, 1, 2]));
    const scene = new Group().add(levels);
    levels.update(cameraAt(1, 15));
    scene.updateMatrixWorld(true);
    const hits = new Raycaster(new Vector3(0, 0, 50), new Vector3(0, 0, -1)).intersectObject(scene);
    assert.deepEqual(
      hits.map(({ object }) => object.parent?.name),
      ["1", "1"],
    ); // in and out of one box
  });

  test("without extent is infinitely far", () => {
    const { levels } = levelsOf([10], new Set([0, 1]));
    levels.scale.setScalar(0);
    levels.updateMatrixWorld(true);
    levels.update(cameraAt(1));
    assert.deepEqual(displayedLevelsOf(levels), [1]);
  });
});
