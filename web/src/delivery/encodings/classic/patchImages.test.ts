import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { PatchDescription } from "../../../document/description.ts";
import { geometryOf } from "../../delivery.testing.ts";
import { columnsOf, planeCountOf, recordLayoutOf } from "./patchImages.ts";

function patchOf(markup: string): PatchDescription {
  return geometryOf(markup).patches[0] ?? assert.fail("no patch");
}

const indexed = (vertexCount: number) =>
  patchOf(
    `<ImageGeometry><GeometryPatch recordCount="${vertexCount}" vertexCount="600" implicitMeshSize="256 4" index="i.png"
      coord="a.png"/></ImageGeometry>`,
  );
const grid = patchOf('<ImageGeometry implicitMeshMode="geometryImage" implicitMeshSize="8 4" coord="a.png"/>');
const points = patchOf('<ImageGeometry primType="POINTS" vertexCount="20" implicitMeshSize="16 2" coord="a.png"/>');
const size = { width: 100, height: 5 };

describe("the images of a patch", () => {
  test("with an index have vertices texel by texel: as many as it states, or else all from the first texel on", () => {
    assert.deepEqual(recordLayoutOf(indexed(70), size, 30), { count: 70, rowLength: 0 });
    assert.deepEqual(recordLayoutOf(indexed(0), size, 30), { count: 470, rowLength: 0 });
    assert.equal(columnsOf(indexed(70), size), 100);
  });

  test("of a grid, or without an index, have vertices in rows of the implicit mesh", () => {
    assert.deepEqual(recordLayoutOf(grid, size), { count: 32, rowLength: 8 });
    assert.deepEqual(recordLayoutOf(points, size), { count: 20, rowLength: 16 });
    assert.deepEqual([columnsOf(grid, size), columnsOf(points, size)], [8, 16]);
  });

  test("of an attribute are one, and one more for each further byte", () => {
    const images = ["high", "low"].map((url) => `<ImageTexture containerField="normal" url="${url}.png"/>`).join("");
    const patch = patchOf(
      `<ImageGeometry primType="POINTS" vertexCount="16" implicitMeshSize="16 1" coord="c.png">${images}</ImageGeometry>`,
    );
    assert.deepEqual([planeCountOf(patch, "normal"), planeCountOf(patch, "color")], [2, 1]);
  });
});
