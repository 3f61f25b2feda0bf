import assert from "node:assert/strict";
import { test } from "node:test";
import { shapesOf } from "./description.ts";
import { onlyShape, sceneOf } from "./scenes.testing.ts";

const node = (mode: string, children: string, attributes = "") =>
  `<Shape><ImageGeometry implicitMeshMode="${mode}" ${attributes}>${children}</ImageGeometry></Shape>`;

const patch = (size: string, attributes = "") =>
  `<GeometryPatch coord="c.png" implicitMeshSize="${size}" ${attributes}></GeometryPatch>`;

test("a grid's vertices and triangles follow from its size", () => {
  for (const [mode, triangles] of [
    ["heightMap", 2 * 4 * 2],
    ["geometryImage", 2 * 4 * 2],
    ["sculpt", 2 * 5 * 2],
  ] as const) {
    const read = onlyShape(node(mode, "", 'coord="c.png" index="i.png" implicitMeshSize="5 3"')).geometry?.patches[0];
    assert.deepEqual(read?.draws, [{ primitive: "triangles", count: 3 * triangles }]);
    assert.deepEqual([read.vertexCount, read.index], [15, undefined]);
  }
});

test("the patches of a height map are parts of one map, from their gridOrigin on", () => {
  const patches = patch("5 3") + patch("4 3", 'gridOrigin="4 0"') + patch("8 7", 'gridOrigin="0 2"');
  const parts = onlyShape(node("heightMap", patches)).geometry?.patches.map(({ grid }) => grid?.part);
  const whole = { columns: 8, rows: 9 };
  assert.deepEqual(parts, [
    { column: 0, row: 0, ...whole },
    { column: 4, row: 0, ...whole },
    { column: 0, row: 2, ...whole },
  ]);
  assert.deepEqual(
    onlyShape(node("sculpt", patches)).geometry?.patches.map(({ grid }) => grid?.part),
    [undefined, undefined, undefined],
  );
});

test("a grid without a surface, or beyond the limits, is left out with one warning", () => {
  for (const [mode, patches, warning] of [
    ["sculpt", patch("1 5"), "a grid of 1 x 5 vertices has no surface"],
    ["heightMap", patch("5 5", 'gridOrigin="-1 0"'), "gridOrigin is no column and row"],
    ["heightMap", patch("5 5", 'gridOrigin="0 2.5"'), "gridOrigin is no column and row"],
    ["heightMap", patch("5 5", 'gridOrigin="65535 0"'), "a height map has more than 65536 columns or rows"],
  ] as const) {
    const scene = sceneOf(node(mode, patch("5 5") + patches));
    assert.equal(shapesOf(scene.root)[0]?.geometry, undefined);
    assert.deepEqual(
      scene.warnings.map(({ message }) => message),
      [warning],
    );
  }
});
