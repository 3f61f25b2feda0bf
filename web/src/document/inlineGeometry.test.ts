import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { describe, test } from "node:test";
import type { GeometryDescription, Reference } from "./description.ts";
import { shapesOf } from "./description.ts";
import { elementsOf } from "./elements.testing.ts";
import { readScene } from "./readScene.ts";

interface Triangles {
  readonly geometry: GeometryDescription;
  readonly positions: number[];
  readonly normals: number[];
}

function bytesOf(reference: Reference | undefined): ArrayBuffer {
  assert.ok(reference);
  assert.ok(reference.url.startsWith("data:"));
  return Uint8Array.from(atob(reference.url.slice(reference.url.indexOf(",") + 1)), (character) =>
    character.charCodeAt(0),
  ).buffer;
}

function read(markup: string): { geometry: GeometryDescription | undefined; warnings: number } {
  const scene = readScene(elementsOf(`<X3D><Scene><Shape>${markup}</Shape></Scene></X3D>`));
  return { geometry: shapesOf(scene.root)[0]?.geometry, warnings: scene.warnings.length };
}

function trianglesOf(markup: string): Triangles {
  const { geometry, warnings } = read(markup);
  assert.ok(geometry, markup);
  assert.equal(warnings, 0, markup);
  const [patch] = geometry.patches;
  return {
    geometry,
    positions: [...new Float32Array(bytesOf(patch?.coord[0]))],
    normals: [...new Float32Array(bytesOf(patch?.normal))],
  };
}

/** The volume inside a closed surface of triangles that face outwards. */
function volumeOf(positions: number[]): number {
  let volume = 0;
  for (let i = 0; i < positions.length; i += 9) {
    const [ax = 0, ay = 0, az = 0, bx = 0, by = 0, bz = 0, cx = 0, cy = 0, cz = 0] = positions.slice(i, i + 9);
    volume += (ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)) / 6;
  }
  return volume;
}

const square = '<Coordinate point="0 0 0, 1 0 0, 1 1 0, 0 1 0"/>';

interface NodeVector {
  readonly name: string;
  readonly node: string;
  readonly corners?: unknown;
}

/** The attributes of the corners, in the order in which they are drawn; numbers have eight digits. */
function cornersOf({ node }: NodeVector): unknown {
  const { geometry, warnings } = read(node);
  assert.equal(warnings, 0, node);
  const [patch] = geometry?.patches ?? [];
  const floats = (reference: Reference | undefined) =>
    reference ? [...new Float32Array(bytesOf(reference))].map((value) => Number(value.toPrecision(8))) : [];
  return {
    primitive: patch?.draws[0]?.primitive,
    positions: floats(patch?.coord[0]),
    normals: floats(patch?.normal),
    texCoords: patch?.texCoord ? floats(patch.texCoord) : [],
    colors: patch?.color ? [...new Uint8Array(bytesOf(patch.color))] : [],
  };
}

// src/import/x3d/tessellation_vectors_test.cpp reads the same file. With IMGEO_REWRITE_GOLDEN=1 the corners are
// rewritten.
test("nodes have the corners of vectors/tessellation/geometryNodes.json", () => {
  const path = join(import.meta.dirname, "../../../vectors/tessellation/geometryNodes.json");
  const vectors = JSON.parse(readFileSync(path, "utf8")) as NodeVector[];
  const actual = vectors.map((vector) => ({ ...vector, corners: cornersOf(vector) }));
  if (process.env.IMGEO_REWRITE_GOLDEN !== undefined)
    writeFileSync(path, `[\n${actual.map((vector) => JSON.stringify(vector)).join(",\n")}\n]\n`);
  else for (const [i, vector] of vectors.entries()) assert.deepEqual(actual[i]?.corners, vector.corners, vector.name);
});

interface SolidVector extends NodeVector {
  /** One of so many elements is in the file. */
  readonly every: number;
}

/** The number of elements, and the attributes of the corners of some. */
function someElementsOf({ every, ...vector }: SolidVector): object {
  const corners = cornersOf(vector) as Record<string, number[]> & { primitive: string };
  const { primitive, positions = [], normals = [], texCoords = [] } = corners;
  const cornerCount = { triangles: 3, lines: 2, points: 1 }[primitive] ?? 1;
  const some = (numbers: number[], size: number) =>
    numbers.filter((_, i) => Math.floor(i / (size * cornerCount)) % every === 0);
  return {
    primitive,
    elementCount: positions.length / 3 / cornerCount,
    positions: some(positions, 3),
    normals: some(normals, 3),
    texCoords: some(texCoords, 2),
  };
}

// src/import/x3d/tessellation_vectors_test.cpp reads the same file. With IMGEO_REWRITE_GOLDEN=1 the elements are
// rewritten.
test("nodes that state sizes have the elements of vectors/tessellation/solids.json", () => {
  const path = join(import.meta.dirname, "../../../vectors/tessellation/solids.json");
  const vectors = JSON.parse(readFileSync(path, "utf8")) as (SolidVector & { readonly elements?: object })[];
  const actual = vectors.map((vector) => ({ ...vector, elements: someElementsOf(vector) }));
  if (process.env.IMGEO_REWRITE_GOLDEN !== undefined)
    writeFileSync(path, `[\n${actual.map((vector) => JSON.stringify(vector)).join(",\n")}\n]\n`);
  else for (const [i, vector] of vectors.entries()) assert.deepEqual(actual[i]?.elements, vector.elements, vector.name);
});

/** The area of a geometry's triangles in the plane z = 0, all of which face +z. */
function areaInPlane(markup: string): number {
  const { positions, normals } = trianglesOf(markup);
  assert.ok(
    normals.every((value, i) => value === (i % 3 === 2 ? 1 : 0)),
    markup,
  );
  let area = 0;
  for (let i = 0; i < positions.length; i += 9) {
    const [ax = 0, ay = 0, , bx = 0, by = 0, , cx = 0, cy = 0] = positions.slice(i, i + 9);
    const doubleArea = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay);
    assert.ok(doubleArea > 0, `${markup} has a triangle that faces -z`);
    area += doubleArea / 2;
  }
  return area;
}

describe("geometry in a plane", () => {
  for (const [markup, area] of [
    ['<Disk2D outerRadius="2"/>', 4 * Math.PI],
    ['<Disk2D innerRadius="2" outerRadius="1"/>', 3 * Math.PI],
    ['<Rectangle2D size="3 0.5"/>', 1.5],
    ["<ArcClose2D/>", Math.PI / 4],
    ['<ArcClose2D closureType="CHORD"/>', Math.PI / 4 - 0.5],
    ['<ArcClose2D startAngle="1.5708" endAngle="0"/>', (3 * Math.PI) / 4],
    ['<ArcClose2D startAngle="1" endAngle="1" radius="2"/>', 4 * Math.PI],
    ['<TriangleSet2D vertices="0 0 4 0 0 1"/>', 2],
  ] as const) {
    test(`${markup} has its area and faces +z`, () => {
      assert.ok(Math.abs(areaInPlane(markup) / area - 1) < 0.01, `${areaInPlane(markup)} instead of ${area}`);
      assert.equal(trianglesOf(markup).geometry.solid, false);
    });
  }

  for (const [markup, length] of [
    ['<Circle2D radius="3"/>', 6 * Math.PI],
    ["<Arc2D/>", Math.PI / 2],
    ['<Arc2D startAngle="3.1415927" endAngle="0"/>', Math.PI],
    ['<Disk2D innerRadius="1" outerRadius="1"/>', 2 * Math.PI],
    ['<Polyline2D lineSegments="0 0 3 4 3 5"/>', 6],
  ] as const) {
    test(`${markup} is a line of its length`, () => {
      const { geometry } = read(markup);
      assert.equal(geometry?.patches[0]?.draws[0]?.primitive, "lines");
      const positions = [...new Float32Array(bytesOf(geometry.patches[0].coord[0]))];
      let sum = 0;
      for (let i = 0; i < positions.length; i += 6) {
        const [ax = 0, ay = 0, , bx = 0, by = 0] = positions.slice(i, i + 6);
        sum += Math.hypot(bx - ax, by - ay);
      }
      assert.ok(Math.abs(sum / length - 1) < 0.005, `${sum} instead of ${length}`);
    });
  }

  test("textures fill the square around a disk, and a rectangle", () => {
    const texCoordsOf = (markup: string) => [...new Float32Array(bytesOf(read(markup).geometry?.patches[0]?.texCoord))];
    assert.deepEqual(texCoordsOf("<Rectangle2D/>"), [0, 0, 1, 0, 1, 1, 0, 0, 1, 1, 0, 1]);
    assert.deepEqual(texCoordsOf('<Disk2D outerRadius="4"/>').slice(0, 4), [0.5, 0.5, 1, 0.5]);
  });
});

test("modes of TextureCoordinateGenerator that need the camera are drawn with a warning", () => {
  const { geometry, warnings } = read(
    `<IndexedFaceSet coordIndex="0 1 2 3">${square}<TextureCoordinateGenerator/></IndexedFaceSet>`,
  );
  assert.equal(warnings, 1);
  assert.ok(new Float32Array(bytesOf(geometry?.patches[0]?.texCoord)).every((value) => value === 0.5));
});

test("NURBS are left out with a warning", () => {
  const { geometry, warnings } = read("<Appearance/><NurbsPatchSurface/>");
  assert.equal(geometry, undefined);
  assert.equal(warnings, 1);
});

test("of several sets of texture coordinates the first is used, with a warning", () => {
  const sets = '<TextureCoordinate point="0 0 1 0 1 1 0 1"/><TextureCoordinateGenerator/>';
  const { geometry, warnings } = read(
    `<QuadSet>${square}<MultiTextureCoordinate>${sets}</MultiTextureCoordinate></QuadSet>`,
  );
  assert.equal(warnings, 1);
  assert.deepEqual(
    [...new Float32Array(bytesOf(geometry?.patches[0]?.texCoord))],
    [0, 0, 1, 0, 1, 1, 0, 0, 1, 1, 0, 1],
  );
});

describe("geometry in the document", () => {
  for (const [markup, volume, size] of [
    ['<Box size="1 2 3"/>', 6, [1, 2, 3]],
    ["<Sphere/>", (4 / 3) * Math.PI, [2, 2, 2]],
    ['<Cylinder radius="0.5" height="3"/>', 0.75 * Math.PI, [1, 3, 1]],
    ['<Cone bottomRadius="1" height="3"/>', Math.PI, [2, 3, 2]],
    ['<Extrusion spine="0 -0.5 0 0 0.5 0"/>', 4, [2, 1, 2]],
    // A spine that points down; and a twist by a quarter turn with half of the width at the end.
    ['<Extrusion spine="0 1 0 0 -1 0"/>', 8, [2, 2, 2]],
    ['<Extrusion spine="0 -1 0 0 1 0" scale="1 0.5" orientation="0 1 0 1.5707963"/>', 4, [1, 2, 2]],
  ] as const) {
    test(`${markup} is closed, faces outwards and has its size`, () => {
      const { geometry, positions, normals } = trianglesOf(markup);
      assert.ok(Math.abs(volumeOf(positions) / volume - 1) < 0.01, `${volumeOf(positions)} instead of ${volume}`);
      const box = geometry.patches[0]?.box;
      box?.max.forEach((edge, axis) => {
        assert.ok(Math.abs(edge - (box.min[axis] ?? 0) - (size[axis] ?? 0)) < 1e-5);
      });
      for (let i = 0; i < normals.length; i += 3) {
        const outwards = normals
          .slice(i, i + 3)
          .reduce((sum, value, axis) => sum + value * (positions[i + axis] ?? 0), 0);
        assert.ok(outwards > 0 && Math.abs(Math.hypot(...normals.slice(i, i + 3)) - 1) < 1e-5);
      }
    });
  }

  for (const markup of [
    '<Box size="1 -2 3"/>',
    '<Sphere radius="-1"/>',
    '<Cone height="-3"/>',
    '<Cylinder radius="-1"/>',
  ])
    test(`${markup} is left out with one warning`, () => {
      const { geometry, warnings } = read(markup);
      assert.equal(geometry, undefined);
      assert.equal(warnings, 1);
    });

  test("has the same triangles in every node type that can represent them", () => {
    const twoTriangles = [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0];
    for (const markup of [
      `<IndexedFaceSet coordIndex="0 1 2 3 -1">${square}</IndexedFaceSet>`,
      `<IndexedFaceSet ccw="false" coordIndex="3 2 1 0">${square}</IndexedFaceSet>`,
      `<IndexedTriangleSet index="0 1 2 0 2 3">${square}</IndexedTriangleSet>`,
      `<IndexedTriangleFanSet index="0 1 2 3 -1">${square}</IndexedTriangleFanSet>`,
      `<TriangleFanSet fanCount="4">${square}</TriangleFanSet>`,
      '<TriangleSet><Coordinate point="0 0 0 1 0 0 1 1 0 0 0 0 1 1 0 0 1 0"/></TriangleSet>',
    ]) {
      const { positions, normals } = trianglesOf(markup);
      // Reversed polygons begin at another corner, so their triangles differ: compare the volumes between the triangles
      // and a point behind them.
      const raised = (numbers: readonly number[]) =>
        volumeOf(numbers.map((value, i) => (i % 3 === 2 ? value + 1 : value)));
      assert.equal(positions.length, twoTriangles.length, markup);
      assert.ok(Math.abs(raised(positions) - raised(twoTriangles)) < 1e-6, markup);
      assert.ok(
        normals.every((value, i) => Math.abs(value - (i % 3 === 2 ? 1 : 0)) < 1e-6),
        markup,
      );
    }
    assert.deepEqual(
      trianglesOf(`<IndexedTriangleStripSet index="0 1 3 2">${square}</IndexedTriangleStripSet>`).positions,
      [0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0],
    );
  });

  test("triangulates concave polygons and caps within their outline", () => {
    const hook = "0 0 0 3 0 0 3 1 0 1 1 0 1 3 0 0 3 0"; // of area 5; the triangles of a fan about its corner 4 cover 9
    // The volume of a pyramid of height 3 is the area of its base.
    const signedAreaOf = (positions: number[]) =>
      volumeOf(positions.map((value, i) => (i % 3 === 2 ? value + 3 : value)));
    const faces = (convex: boolean) =>
      `<IndexedFaceSet convex="${convex}" coordIndex="4 5 0 1 2 3"><Coordinate point="${hook}"/></IndexedFaceSet>`;
    const areaOf = (positions: number[]) =>
      Array.from({ length: positions.length / 9 }, (_, i) => {
        const [ax = 0, ay = 0, , bx = 0, by = 0, , cx = 0, cy = 0] = positions.slice(9 * i, 9 * i + 9);
        return Math.abs((bx - ax) * (cy - ay) - (cx - ax) * (by - ay)) / 2;
      }).reduce((sum, area) => sum + area, 0);
    assert.ok(Math.abs(signedAreaOf(trianglesOf(faces(false)).positions) - 5) < 1e-6);
    assert.ok(Math.abs(areaOf(trianglesOf(faces(false)).positions) - 5) < 1e-6);
    assert.ok(areaOf(trianglesOf(faces(true)).positions) > 6, "a fan overlaps itself");
    const { positions } = trianglesOf('<Extrusion convex="false" crossSection="0 0 0 3 1 3 1 1 3 1 3 0 0 0"/>');
    assert.ok(Math.abs(volumeOf(positions) - 5) < 1e-6, `${volumeOf(positions)}`);
  });

  test("sweeps a cross-section around a closed spine, smoothly", () => {
    const points = Array.from({ length: 33 }, (_, i) => [
      3 * Math.cos((i * Math.PI) / 16),
      0,
      -3 * Math.sin((i * Math.PI) / 16),
    ]);
    points[32] = points[0] ?? [];
    const { positions, normals } =
      trianglesOf(`<Extrusion beginCap="false" endCap="false" creaseAngle="3.2" spine="${points.flat().join(" ")}"
      crossSection="0.5 0 0.35 -0.35 0 -0.5 -0.35 -0.35 -0.5 0 -0.35 0.35 0 0.5 0.35 0.35 0.5 0"/>`);
    assert.ok(Math.abs(Math.abs(volumeOf(positions)) / (2 * Math.PI * 3 * 0.7) - 1) < 0.03, `${volumeOf(positions)}`);
    const atStart = new Set(
      positions.flatMap((x, i) =>
        i % 3 === 0 && Math.abs(x - 3.5) < 1e-4 && Math.abs(positions[i + 2] ?? 1) < 1e-4
          ? [
              normals
                .slice(i, i + 3)
                .map((value) => value.toFixed(3))
                .join(),
            ]
          : [],
      ),
    );
    assert.equal(atStart.size, 1, [...atStart].join(" | "));
  });

  test("reads sets of texture coordinates, of which each texture names its own", () => {
    const texture = (role: string) => `<ImageTexture containerField="${role}Texture" url="a.png"></ImageTexture>`;
    const scene = readScene(
      elementsOf(`<X3D><Scene><Shape><Appearance>
        <PhysicalMaterial baseTextureMapping="base" occlusionTextureMapping="light" normalTextureMapping="light.normal"
          emissiveTextureMapping="none">
          ${["base", "occlusion", "normal", "emissive"].map(texture).join("")}</PhysicalMaterial>
        <MultiTextureTransform><TextureTransform mapping="light" scale="2 2"></TextureTransform>
          <TextureTransform scale="3 3"></TextureTransform></MultiTextureTransform></Appearance>
        <IndexedTriangleSet index="0 1 2"><Coordinate point="0 0 0 1 0 0 0 1 0"></Coordinate>
          <MultiTextureCoordinate><TextureCoordinate mapping="base" point="0 0 1 0 0 1"></TextureCoordinate>
            <TextureCoordinate mapping="light" point="5 5 6 5 5 6"></TextureCoordinate></MultiTextureCoordinate>
        </IndexedTriangleSet></Shape></Scene></X3D>`),
    );
    const [shape] = shapesOf(scene.root);
    const [patch] = shape?.geometry?.patches ?? [];
    assert.deepEqual([...new Float32Array(bytesOf(patch?.texCoord))], [0, 0, 1, 0, 0, 1]);
    assert.deepEqual([...new Float32Array(bytesOf(patch?.texCoord1))], [5, 5, 6, 5, 5, 6]);
    assert.equal(patch?.texCoord2, undefined);
    const sets = shape?.appearance.textures.map(({ role, texCoordSet, transform: [scale] }) => [
      role,
      texCoordSet,
      scale,
    ]);
    assert.deepEqual(sets, [
      ["color", 0, 3],
      ["emissive", 0, 3],
      ["normal", 1, 3],
      ["occlusion", 1, 2],
    ]);
  });

  test("reads a grid of heights with vertex attributes", () => {
    const grid = '<ElevationGrid xDimension="3" zDimension="2" xSpacing="2" height="0 1 0 0 1 0"';
    const { geometry, positions, normals } = trianglesOf(`${grid}/>`);
    assert.equal(positions.length, 4 * 9);
    assert.deepEqual(geometry.patches[0]?.box, { min: [0, 0, 0], max: [4, 1, 1] });
    assert.ok(
      normals.every((value, i) => i % 3 !== 1 || value > 0.5),
      "normals point upwards",
    );
    assert.equal(read('<ElevationGrid xDimension="3" zDimension="3" height="0 1"/>').warnings, 1);
    assert.deepEqual(
      [
        ...new Uint8Array(
          bytesOf(
            read(`${grid}><Color color="1 0 0 1 0 0 1 0 0 0 0 1 0 0 1 0 0 1"/></ElevationGrid>`).geometry?.patches[0]
              ?.color,
          ),
        ),
      ].slice(0, 8),
      [255, 0, 0, 0, 0, 255, 0, 0],
    );
  });

  test("has hard edges where faces meet at more than creaseAngle", () => {
    const roof = (angle: number) =>
      trianglesOf(`<IndexedFaceSet creaseAngle="${angle}" coordIndex="0 3 2 1 -1 1 2 5 4">
      <Coordinate point="0 0 0 1 0 0 1 0 1 0 0 1 1 -1 0 1 -1 1"/></IndexedFaceSet>`).normals;
    const distinct = (normals: number[]) =>
      new Set(normals.flatMap((_, i) => (i % 3 === 0 ? [normals.slice(i, i + 3).join()] : []))).size;
    assert.equal(distinct(roof(0.5)), 2);
    assert.equal(distinct(roof(2)), 3); // the third one, at the shared edge, is the mean of both
  });

  test("draws lines and points, in the colors of vertices or of lines", () => {
    const draws = (markup: string) => read(markup).geometry?.patches[0]?.draws;
    assert.deepEqual(draws(`<IndexedLineSet coordIndex="0 1 2 -1 3 0">${square}</IndexedLineSet>`), [
      { primitive: "lines", count: 6 },
    ]);
    assert.deepEqual(draws(`<LineSet vertexCount="2 2">${square}</LineSet>`), [{ primitive: "lines", count: 4 }]);
    assert.deepEqual(draws(`<PointSet>${square}</PointSet>`), [{ primitive: "points", count: 4 }]);
    const { geometry } = read(
      `<IndexedLineSet colorPerVertex="false" coordIndex="0 1 -1 2 3">${square}<ColorRGBA color="1 0 0 1 0 1 0 0.5"/></IndexedLineSet>`,
    );
    assert.deepEqual(
      [...new Uint8Array(bytesOf(geometry?.patches[0]?.color))],
      [255, 0, 0, 255, 255, 0, 0, 255, 0, 255, 0, 128, 0, 255, 0, 128],
    );
  });

  test("resolves USE of its child nodes, and warns of missing coordinates", () => {
    const scene = readScene(
      elementsOf(`<X3D><Scene><Shape><PointSet><Coordinate DEF="C" point="1 2 3"/></PointSet></Shape>
      <Shape><PointSet><Coordinate USE="C"/></PointSet></Shape></Scene></X3D>`),
    );
    assert.ok(shapesOf(scene.root).every(({ geometry }) => geometry?.patches[0]?.vertexCount === 1));
    assert.equal(read(`<IndexedFaceSet coordIndex="0 1 9">${square}</IndexedFaceSet>`).warnings, 1);
    assert.equal(read("<TriangleSet/>").geometry, undefined);
    assert.equal(read("<Text string='\"a\"'/>").geometry, undefined);
  });
});

test("the numbers that the importer refuses raise a warning", () => {
  const file = join(import.meta.dirname, "../../../vectors/tessellation/refused.json");
  for (const markup of JSON.parse(readFileSync(file, "utf8")) as string[]) {
    assert.ok(read(markup).warnings > 0, markup);
  }
});
