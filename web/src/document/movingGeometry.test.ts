import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { GeometryDescription, Reference } from "./description.ts";
import { shapesOf } from "./description.ts";
import { elementsOf } from "./elements.testing.ts";
import type { TestElement } from "./elements.testing.ts";
import { inlineGeometryReader } from "./inlineGeometry.ts";
import { SceneReader } from "./sceneReader.ts";

const square = "0 0 0 1 0 0 1 1 0 0 1 0";
const moved = [0, 0, 0.5, 2, 0, 0, 1, 3, -1, 0, 1, 1];

/** Geometry nodes, the element and the field of them that moves, and the numbers that it gets. */
const samples: readonly (readonly [name: string, markup: string, element: string, field: string, numbers: number[]])[] =
  [
    [
      "faces",
      `<IndexedFaceSet coordIndex="0 1 2 3 -1"><Coordinate point="${square}"/></IndexedFaceSet>`,
      "Coordinate",
      "point",
      moved,
    ],
    [
      "faces with a crease angle",
      `<IndexedFaceSet creaseAngle="1" ccw="false" coordIndex="0 1 2 -1 0 2 3 -1"><Coordinate point="${square}"/></IndexedFaceSet>`,
      "Coordinate",
      "point",
      moved,
    ],
    [
      "triangles with normals and colors",
      `<IndexedTriangleSet index="0 1 2 0 2 3"><Coordinate point="${square}"/><Normal vector="0 0 1 0 0 1 0 0 1 0 0 1"/><Color color="${square}"/></IndexedTriangleSet>`,
      "Normal",
      "vector",
      [1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0],
    ],
    [
      "colors for each face",
      `<IndexedFaceSet colorPerVertex="false" coordIndex="0 1 2 -1 0 2 3 -1"><Coordinate point="${square}"/><Color color="1 0 0 0 1 0"/></IndexedFaceSet>`,
      "Color",
      "color",
      [0, 0.5, 1, 2, -1, 0.25],
    ],
    [
      "colors with opacity",
      `<PointSet><Coordinate point="${square}"/><ColorRGBA color="1 0 0 1 0 1 0 1 0 0 1 1 1 1 1 1"/></PointSet>`,
      "ColorRGBA",
      "color",
      [1, 0, 0, 0.5, 0, 1, 0, 0.1, 0, 0, 1, 1, 1, 1, 0, 1],
    ],
    [
      "texture coordinates",
      `<IndexedFaceSet coordIndex="0 1 2 3 -1"><Coordinate point="${square}"/><TextureCoordinate point="0 0 1 0 1 1 0 1"/></IndexedFaceSet>`,
      "TextureCoordinate",
      "point",
      [0, 0.5, 1, 0.5, 1, 1, 0, 1],
    ],
    [
      "lines",
      `<IndexedLineSet coordIndex="0 1 2 -1 2 3 -1"><Coordinate point="${square}"/></IndexedLineSet>`,
      "Coordinate",
      "point",
      moved,
    ],
    [
      "heights",
      `<ElevationGrid xDimension="2" zDimension="2" height="0 0 0 0"/>`,
      "ElevationGrid",
      "height",
      [1, 0, 2, -1],
    ],
    ["a polyline", `<Polyline2D lineSegments="0 0 1 0 1 1"/>`, "Polyline2D", "lineSegments", [0, 0, 2, 0, 1, 3]],
  ];

interface Arrays {
  readonly positions: number[];
  readonly normals: number[];
  readonly texCoords: number[];
  readonly colors: number[];
}

function arraysIn({ patches: [patch] }: GeometryDescription): Arrays {
  const bytesOf = (reference: Reference | undefined) =>
    Uint8Array.from(atob(reference?.url.split(",")[1] ?? ""), (character) => character.charCodeAt(0));
  const floats = (reference: Reference | undefined) => [...new Float32Array(bytesOf(reference).buffer)];
  return {
    positions: floats(patch?.coord[0]),
    normals: floats(patch?.normal),
    texCoords: floats(patch?.texCoord),
    colors: [...bytesOf(patch?.color)],
  };
}

function elementNamed(name: string, root: TestElement): TestElement {
  const find = (element: TestElement): TestElement | undefined =>
    element.localName === name ? element : element.children.map(find).find((found) => found !== undefined);
  const found = find(root);
  assert.ok(found, name);
  return found;
}

class Document {
  readonly root: TestElement;
  readonly reader: SceneReader;

  constructor(markup: string) {
    this.root = elementsOf(`<X3D><Scene><Shape>${markup}</Shape></Scene></X3D>`);
    this.reader = new SceneReader(this.root, { inlineGeometry: inlineGeometryReader });
  }

  get geometry(): GeometryDescription {
    const geometry = shapesOf(this.reader.read().root)[0]?.geometry;
    assert.ok(geometry);
    return geometry;
  }
}

function movingArrays({ moving }: GeometryDescription): Arrays {
  assert.ok(moving);
  const { positions, normals = [], texCoords = [], colors = [] } = moving.arrays;
  return { positions: [...positions], normals: [...normals], texCoords: [...texCoords], colors: [...colors] };
}

describe("geometry that animation moves", () => {
  for (const [name, markup, element, field, numbers] of samples)
    test(`${name}: has the vertices that a document with these numbers has, in the same arrays`, () => {
      const document = new Document(markup);
      const { reader } = document;
      const node = elementNamed(element, document.root);
      const initial = (node.getAttribute(field) ?? "").split(" ").map(Number);
      assert.equal(document.geometry.moving, undefined);
      assert.equal(reader.moveVertices(node, field, initial), false, "the first numbers are read");
      reader.touch(node);
      const { geometry } = document;
      const positions = geometry.moving?.arrays.positions;
      for (const each of [numbers, initial, numbers]) {
        assert.equal(reader.moveVertices(node, field, each), true);
        const fresh = new Document(markup);
        elementNamed(element, fresh.root).attributes.set(field, each.join(" "));
        const expected = arraysIn(fresh.geometry);
        // Texture coordinates that are not given are those of the geometry at first.
        const { texCoords } = element === "TextureCoordinate" ? expected : movingArrays(document.geometry);
        assert.deepEqual(movingArrays(document.geometry), { ...expected, texCoords });
        assert.equal(document.geometry, geometry);
        assert.equal(geometry.moving?.arrays.positions, positions);
      }
    });
});

const faces = `<IndexedFaceSet coordIndex="0 1 2 3 -1"><Coordinate DEF="p" point="${square}"/></IndexedFaceSet>`;

function movingFaces(): Document & { coordinate: TestElement } {
  const document = new Document(faces);
  const coordinate = elementNamed("Coordinate", document.root);
  document.reader.moveVertices(coordinate, "point", square.split(" ").map(Number));
  document.reader.touch(coordinate);
  return Object.assign(document, { coordinate });
}

test("bounds contain all vertices so far, and do not grow in each frame", () => {
  const { reader, geometry, coordinate } = movingFaces();
  let changes = 0;
  let bounds = geometry.moving?.bounds;
  for (let frame = 0; frame <= 1000; ++frame) {
    const z = Math.sin(frame / 50) * (frame / 100);
    reader.moveVertices(coordinate, "point", [0, 0, z, 1, 0, 0, 1, 1, 0, 0, 1, 0]);
    const now = geometry.moving?.bounds;
    if (now !== bounds) changes += 1;
    bounds = now;
    assert.ok(bounds && bounds.min[2] <= z && z <= bounds.max[2], `frame ${frame}`);
  }
  assert.ok(changes > 1 && changes < 60, `${changes} changes`);
});

test("with fewer numbers than corners need, the geometry is read again, and another one takes its place", () => {
  const document = movingFaces();
  const { reader, coordinate, geometry } = document;
  assert.equal(reader.moveVertices(coordinate, "point", [0, 0, 0]), false);
  reader.moveVertices(coordinate, "point", moved);
  reader.touch(coordinate);
  assert.equal(document.geometry, geometry);
  elementNamed("IndexedFaceSet", document.root).attributes.set("coordIndex", "0 1 2 -1");
  reader.touch(elementNamed("IndexedFaceSet", document.root));
  assert.notEqual(document.geometry, geometry);
  assert.deepEqual(movingArrays(document.geometry).positions, moved.slice(0, 9));
});

test("an attribute that a script sets counts again", () => {
  const document = movingFaces();
  const { reader, coordinate } = document;
  reader.moveVertices(coordinate, "point", moved);
  coordinate.attributes.set("point", square);
  reader.touchAttribute(coordinate, "point");
  assert.equal(document.geometry.moving, undefined);
  assert.equal(arraysIn(document.geometry).positions[2], 0);
});
