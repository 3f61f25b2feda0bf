import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { shapesOf } from "./description.ts";
import { onlyShape, sceneOf } from "./scenes.testing.ts";

const node =
  '<ImageGeometry DEF="g" profile="compact" position="1 1 1" size="2 2 2" positionBits="20" recordCount="4" vertexCount="6" data="a.png" bboxCenter="1 1 1" bboxSize="2 2 1"/>';

describe("a shape with `patch`", () => {
  test("has that patch of the node's file, and the node's box, counts and lattice", () => {
    const { geometry, box } = onlyShape(`${node}<Shape patch="g#17"/>`);
    assert.deepEqual(geometry?.patches[0]?.data, { url: "a.png", patchIndex: 17 });
    assert.equal(geometry.positionBits, 20);
    assert.equal(geometry.patches[0].vertexCount, 4);
    assert.deepEqual(geometry.patches[0].draws, [{ primitive: "triangles", count: 6 }]);
    assert.deepEqual(box, { min: [0, 0, 0.5], max: [2, 2, 1.5] });
  });

  test("shares its geometry with shapes of the same `patch` alone", () => {
    const scene = sceneOf(`${node}<Shape patch="g#1"/><Shape patch="g#2"/><Shape patch="g#1"/>`);
    const [a, b, c] = shapesOf(scene.root).map(({ geometry }) => geometry);
    assert.equal(a, c);
    assert.notEqual(a, b);
    assert.deepEqual(scene.warnings, []);
  });

  test("prefers a geometry of its own", () => {
    assert.equal(
      onlyShape(`${node}<Shape patch="g#1"><ImageGeometry data="b.png"/></Shape>`).geometry?.patches[0]?.data?.url,
      "b.png",
    );
  });

  for (const patch of ["g", "g#", "g#x", "h#1", "#1", "g#-1", "plain#1"]) {
    test(`is empty, with a warning, where it is "${patch}"`, () => {
      const scene = sceneOf(
        `${node}<ImageGeometry DEF="plain" coord="c.png" vertexCount="3"/><Shape patch="${patch}"/>`,
      );
      assert.equal(shapesOf(scene.root)[0]?.geometry, undefined);
      assert.equal(scene.warnings.length, 1);
    });
  }
});
