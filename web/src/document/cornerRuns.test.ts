import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { VertexData } from "../tessellate/faces.ts";
import { primitiveOf, runReaders } from "./cornerRuns.ts";
import { elementsOf } from "./elements.testing.ts";
import { nodeFields, readFields } from "./nodes.ts";

/** Positions of 7 vertices. */
const positions: VertexData = {
  positions: Array.from({ length: 21 }, () => 0),
  normals: [],
  texCoords: [],
  colors: [],
  colorComponents: 3,
};

/** The runs of a node with these attributes. */
function runsOf(name: string, attributes: string, data = positions) {
  const fields = readFields(elementsOf(`<${name} ${attributes}/>`), nodeFields.InlineGeometry, []);
  return runReaders[name.toLowerCase()]?.(fields, data) ?? assert.fail(`${name} has no runs`);
}

function positionsOf(name: string, attributes: string): number[][] {
  return runsOf(name, attributes).map((run) => run.map(({ position }) => position));
}

describe("the runs of corners", () => {
  for (const [name, attributes, runs] of [
    [
      "TriangleSet",
      "",
      [
        [0, 1, 2],
        [3, 4, 5],
      ],
    ],
    ["QuadSet", "", [[0, 1, 2, 3]]],
    ["PointSet", "", [[0], [1], [2], [3], [4], [5], [6]]],
    ["IndexedTriangleSet", 'index="6 5 -1 4 3"', [[6, 5, 4]]],
    ["IndexedQuadSet", 'index="3 2 1 0 -1 6"', [[3, 2, 1, 0]]],
    [
      "LineSet",
      'vertexCount="2 3"',
      [
        [0, 1],
        [2, 3, 4],
      ],
    ],
    ["LineSet", 'vertexCount="2 -1 2"', [[0, 1], [], [2, 3]]],
    [
      "TriangleStripSet",
      'stripCount="4 3"',
      [
        [0, 1, 2],
        [1, 3, 2],
        [4, 5, 6],
      ],
    ],
    [
      "IndexedTriangleStripSet",
      'index="6 5 4 3 -1 2 1 0"',
      [
        [6, 5, 4],
        [5, 3, 4],
        [2, 1, 0],
      ],
    ],
    [
      "TriangleFanSet",
      'fanCount="4 3"',
      [
        [0, 1, 2],
        [0, 2, 3],
        [4, 5, 6],
      ],
    ],
    [
      "IndexedTriangleFanSet",
      'index="6 5 4 3 -1 2 1 0"',
      [
        [6, 5, 4],
        [6, 4, 3],
        [2, 1, 0],
      ],
    ],
    [
      "IndexedFaceSet",
      'coordIndex="0 1 2 3 -1 4 5 6"',
      [
        [0, 1, 2, 3],
        [4, 5, 6],
      ],
    ],
    [
      "IndexedLineSet",
      'coordIndex="0 1 -1 2 3"',
      [
        [0, 1],
        [2, 3],
      ],
    ],
  ] as const)
    test(`of <${name} ${attributes}> name its vertices`, () => {
      assert.deepEqual(positionsOf(name, attributes), runs);
    });

  test("have indices only of attributes that the geometry has", () => {
    assert.deepEqual(runsOf("TriangleSet", "")[0]?.[2], { position: 2, normal: -1, texCoord: -1, color: -1 });
  });

  test("have attributes of each vertex, or of each face", () => {
    const all = { ...positions, normals: [0, 0, 1], texCoords: [0, 0], colors: [1, 0, 0] };
    const cornersOf = (name: string, attributes: string) => runsOf(name, attributes, all).at(1)?.[2];
    assert.deepEqual(cornersOf("TriangleSet", ""), { position: 5, normal: 5, texCoord: 5, color: 5 });
    const perFace = 'normalPerVertex="false" colorPerVertex="false"';
    assert.deepEqual(cornersOf("TriangleSet", perFace), { position: 5, normal: 1, texCoord: 5, color: 1 });
    const faces = 'coordIndex="0 1 2 -1 3 4 5"';
    assert.deepEqual(cornersOf("IndexedFaceSet", faces), { position: 5, normal: 5, texCoord: 5, color: 5 });
    assert.deepEqual(cornersOf("IndexedFaceSet", `${faces} ${perFace}`), {
      position: 5,
      normal: 1,
      texCoord: 5,
      color: 1,
    });
    const indices = 'normalIndex="9 8" colorIndex="7 6 5 -1 4 3 2" texCoordIndex="0 1 2 -1 8 7 6"';
    assert.deepEqual(cornersOf("IndexedFaceSet", `${faces} ${indices} normalPerVertex="false"`), {
      position: 5,
      normal: 8,
      texCoord: 6,
      color: 2,
    });
  });

  test("are drawn as points, lines or triangles", () => {
    const names = ["pointset", "lineset", "indexedlineset", "indexedfaceset", "quadset"];
    assert.deepEqual(names.map(primitiveOf), ["points", "lines", "lines", "triangles", "triangles"]);
  });
});
