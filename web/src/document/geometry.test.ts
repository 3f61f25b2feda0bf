import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { missingBytesMidpoint, dequantizationOf } from "./dequantization.ts";
import type { GeometryDescription } from "./description.ts";
import { shapesOf } from "./description.ts";
import { elementsOf } from "./elements.testing.ts";
import { referenceOf } from "./patchReferences.ts";
import { inlineGeometryReader } from "./inlineGeometry.ts";
import { SceneReader } from "./sceneReader.ts";
import { onlyShape, sceneOf, twoPatches } from "./scenes.testing.ts";

function geometryOf(markup: string): GeometryDescription {
  const { geometry } = onlyShape(`<Shape>${markup}</Shape>`);
  assert.ok(geometry);
  return geometry;
}

describe("a compact geometry with neither position nor size", () => {
  const data = 'bboxCenter="3 5 0.5" bboxSize="4 2 1" recordCount="4" vertexCount="6" data="a.png#3"';

  test("has the cube over the longest edge of its box, and profile compact", () => {
    const { encoding, position, size, patches: read } = geometryOf(`<ImageGeometry ${data}/>`);
    assert.deepEqual({ encoding, position, size }, { encoding: "compact", position: [3, 6, 2], size: [4, 4, 4] });
    assert.deepEqual(read[0]?.data, { url: "a.png", patchIndex: 3 });
    assert.deepEqual(read[0].box, { min: [1, 4, 0], max: [5, 6, 1] });
  });

  test("has the defaults where it has a size or no box", () => {
    assert.deepEqual(geometryOf(`<ImageGeometry ${data} size="8 8 8"/>`).position, [0, 0, 0]);
    assert.deepEqual(geometryOf('<ImageGeometry data="a.png"/>').size, [1, 1, 1]);
  });
});

describe("a geometry", () => {
  test("takes draws and references from its patches only, where it has any", () => {
    const geometry = geometryOf(twoPatches);
    const [first, second] = geometry.patches;
    assert.equal(geometry.patches.length, 2);
    assert.equal(geometry.encoding, "classic");
    assert.equal(geometry.solid, false);
    assert.deepEqual(first?.draws, [
      { primitive: "triangles", count: 900 },
      { primitive: "triangleStrip", count: 12 },
    ]);
    assert.deepEqual(first.index, { url: "i.png", firstTexel: 1024 });
    assert.deepEqual(first.coord, [
      { url: "a.png", firstTexel: 0 },
      { url: "b.png", firstTexel: 512 },
    ]);
    assert.equal(first.implicitWidth, 512);
    assert.deepEqual(first.box, { min: [0, 1.5, 2.5], max: [2, 2.5, 3.5] });
    assert.deepEqual(second?.draws, [{ primitive: "lineStrip", count: 4 }]);
    assert.equal(second.index, undefined);
    assert.equal(second.vertexCount, 4);
  });

  test("takes images from ImageTexture children, as in X3DOM, with byte planes in document order", () => {
    const [patch, ...others] = geometryOf(`
      <ImageGeometry vertexCount="6" implicitMeshSize="300 0">
        <ImageTexture containerField="coord" url="high.png"/><ImageTexture containerField="index" url='"i.png"'/>
        <ImageTexture containerField="coord" url="low.png"/><ImageTexture containerField="normal" url="n.png"/>
      </ImageGeometry>`).patches;
    assert.deepEqual(others, []);
    assert.deepEqual(
      patch?.coord.map((plane) => plane.url),
      ["high.png", "low.png"],
    );
    assert.equal(patch.index?.url, "i.png");
    assert.equal(patch.normal?.url, "n.png");
    assert.equal(patch.box, undefined);
  });

  test("has types, offsets and strides of typed arrays, and X3DOM's stride in a file's name", () => {
    const {
      patches: [patch],
      ...geometry
    } = geometryOf(`
      <BinaryGeometry coordType="uint16" normalType="Int8" indexType="Uint32" rgbaColors="true" vertexCount="3"
        coord="c.bin#12+8" normal="n.bin+4" index="i.bin"/>`);
    assert.equal(geometry.coordType, "Uint16");
    assert.equal(geometry.indexType, "Uint32");
    assert.equal(geometry.colorComponents, 4);
    assert.deepEqual(patch?.coord, [{ url: "c.bin", byteOffset: 12, byteStride: 8 }]);
    assert.deepEqual(patch.normal, { url: "n.bin+4", byteOffset: 0, byteStride: 4 });
  });

  test("has 16-bit indices in images by default", () => {
    assert.equal(geometryOf('<ImageGeometry coord="a" index="i" vertexCount="3"/>').indexType, "Uint16");
    assert.equal(
      geometryOf('<ImageGeometry coord="a" index="i" indexType="uint32" vertexCount="3"/>').indexType,
      "Uint32",
    );
  });

  test("has the encoding of normals of two numbers, and their location in X3DOM's files", () => {
    assert.equal(geometryOf('<ImageGeometry coord="a" normal="n" vertexCount="3"/>').normalEncoding, "rgb");
    assert.equal(
      geometryOf('<ImageGeometry coord="a" normal="n" normalEncoding="Octahedral" vertexCount="3"/>').normalEncoding,
      "octahedral",
    );
    for (const [coord, byteOffset, byteStride] of [
      ["c.bin", 6, 8],
      ["c.bin?+8", 6, 8],
      ["c.bin#24+32", 30, 32],
    ] as const) {
      const {
        patches: [patch],
        ...geometry
      } = geometryOf(`
        <BinaryGeometry coordType="Uint16" normalAsSphericalCoordinates="true" normal="ignored" coord="${coord}"/>`);
      assert.deepEqual([geometry.normalEncoding, geometry.normalType], ["spherical", "Uint8"]);
      assert.deepEqual(patch?.normal, { url: patch?.coord[0]?.url, byteOffset, byteStride });
    }
  });

  test("has one patch without data for the whole mesh where it has levels of detail", () => {
    const geometry = geometryOf(
      `<ImageGeometry profile="compact" positionBits="18" levels=" l/levels.png" base="l/0/0.png"
        bboxCenter="0 0 0" bboxSize="2 2 2"><GeometryPatch data="ignored.png"/></ImageGeometry>`,
    );
    assert.deepEqual(geometry.levels, { url: "l/levels.png" });
    assert.deepEqual(geometry.base, { url: "l/0/0.png", patchIndex: 0 });
    assert.deepEqual(
      geometry.patches.map(({ data, box }) => [data, box?.max]),
      [[undefined, [1, 1, 1]]],
    );
    assert.equal(geometryOf('<ImageGeometry coord="c" vertexCount="3" levels="l/levels.png"/>').levels, undefined);
  });

  test("is left out with one warning where fields state what neither pages nor the tool read", () => {
    for (const [node, warning] of [
      ['<BinaryGeometry coord="c" vertexCount="-1"/>', /^vertexCount -1 is negative$/],
      ['<BinaryGeometry coord="c" coordType="Float64"/>', /^coordType="Float64" is none of Int8, /],
      ['<BinaryGeometry coord="c" index="i" indexType="Int32"/>', /^indices of type Int32 are not read/],
      ['<BinaryGeometry coord="c" normal="n" normalType="Uint8"/>', /^normals of type Uint8 are not read/],
      [
        '<BinaryGeometry coord="c" normal="n" normalEncoding="octahedral"/>',
        /^normals of two numbers of type Float32 are not read/,
      ],
      [
        '<BinaryGeometry coord="c" normalAsSphericalCoordinates="true"/>',
        /^spherical normals in coordinates of type Fl/,
      ],
      ['<BinaryGeometry coord="c" normalEncoding="cube"/>', /^normalEncoding="cube" is none of rgb, /],
      ['<BinaryGeometry coord="c" compressed="true"/>', /^compressed arrays are not read/],
      ['<ImageGeometry coord="c" indexType="Uint8"/>', /^indexType="Uint8" is none of Uint16, Uint32$/],
      ['<ImageGeometry coord="c" profile="fast"/>', /^profile="fast" is none of classic, compact$/],
      ['<ImageGeometry coord="c" implicitMeshMode="torus"/>', /^implicitMeshMode="torus" is none of auto, sig, /],
      ['<ImageGeometry coord="c" numColorComponents="2"/>', /^numColorComponents="2" is neither 3 nor 4$/],
      ['<ImageGeometry coord="c" normal="n" normalBits="7"/>', /^1 images of normal hold no numbers of 7 bits$/],
      [
        '<ImageGeometry coord="c" texCoord="n" texCoordBits="24"/>',
        /^1 images of texCoord hold no numbers of 24 bits$/,
      ],
      ['<BinaryGeometry index="i.bin" vertexCount="3"/>', /^there are no coordinates$/],
      [
        "<ImageGeometry><MultiTexture containerField='coord'><ImageTexture url='c.png'/></MultiTexture></ImageGeometry>",
        /^there are no coordinates$/,
      ],
      ["<ImageGeometry><GeometryPatch/></ImageGeometry>", /^there are no coordinates$/],
      ['<ImageGeometry profile="compact"/>', /^a patch of compact has no data$/],
      [
        "<ImageGeometry><MovieTexture containerField='coord' url='m.webm'/></ImageGeometry>",
        /^a movie with coordinates names/,
      ],
      ['<ImageGeometry USE="none"/>', /^USE="none" names no DEF of this scene$/],
      ['<Box USE="none"/>', /^USE="none" names no DEF of this scene$/],
      ['<ImageGeometry coord="c" size="0 0 0"/>', /^size is the extent of no box$/],
      ['<ImageGeometry coord="c" size="1 -1 1"/>', /^size is the extent of no box$/],
      ['<BinaryGeometry coord="c" coordType="Uint8" size="0 0 0"/>', /^size is the extent of no box$/],
      ['<BinaryGeometry coord="c" positionBits="25"/>', /^positionBits is no precision of coordinates of 4 bytes$/],
      ['<ImageGeometry coord="c" positionBits="9"/>', /^positionBits is no precision of coordinates of 1 bytes$/],
      ['<ImageGeometry coord="c" positionBits="-1"/>', /^positionBits -1 is negative$/],
      ['<ImageGeometry coord="c"/>', /^vertexCount is 0; nothing is drawn$/],
      ['<BinaryGeometry coord="c" primType="POINTS LINES" vertexCount="0 0"/>', /^vertexCount is 0; nothing is drawn$/],
      ['<ImageGeometry profile="compact" data="d" positionBits="31"/>', /^positionBits is no precision/],
      ['<ImageGeometry coord="c" recordCount="-1"/>', /^recordCount -1 is negative$/],
      ['<ImageGeometry coord="c" implicitMeshSize="0 1"/>', /^implicitMeshSize has no columns$/],
      ['<ImageGeometry coord="c" implicitMeshSize="1.5 1"/>', /^implicitMeshSize is no size of an image$/],
      ['<ImageGeometry coord="c" implicitMeshCount="-1 1"/>', /^implicitMeshSize is no size of an image$/],
      ['<ImageGeometry coord="c#x"/>', /^a reference's fragment is not an index in its file$/],
      ['<ImageGeometry coord="c#1#2"/>', /^a reference has two fragments$/],
      ['<ImageGeometry coord="#1"/>', /^a reference has no url$/],
      ['<BinaryGeometry coord="c#0+4294967296"/>', /^a reference's fragment is not an index in its file$/],
      [
        '<ImageGeometry><GeometryPatch coord="a"/><GeometryPatch coord=\'"a" "b"\'/></ImageGeometry>',
        /^patches differ in their coordinate images$/,
      ],
      [
        '<ImageGeometry><GeometryPatch coord="a" normal="n"/><GeometryPatch coord="a" normal=\'"a" "b"\'/></ImageGeometry>',
        /^patches differ in their images of normal$/,
      ],
    ] as const) {
      const scene = sceneOf(`<Shape>${node}</Shape>`);
      const [shape] = shapesOf(scene.root);
      assert.equal(shape?.geometry, undefined, node);
      assert.equal(scene.warnings.length, 1, node);
      assert.match(scene.warnings[0]?.message ?? "", warning);
      assert.ok(shape?.unreadableGeometry?.endsWith(scene.warnings[0]?.message ?? "?"));
    }
  });

  test("has triangles where it names no primitive, and ignores the primitives after those of its draws", () => {
    const drawsOf = (fields: string) => geometryOf(`<BinaryGeometry coord="c" ${fields}/>`).patches[0]?.draws;
    assert.deepEqual(drawsOf('vertexCount="6"'), [{ primitive: "triangles", count: 6 }]);
    assert.deepEqual(drawsOf("primType='\"LINES\" \"POINTS\"' vertexCount='6'"), [{ primitive: "lines", count: 6 }]);
  });

  test("warns once of what it draws by default", () => {
    const warningsOf = (markup: string): string[] =>
      sceneOf(`<Shape>${markup}</Shape>`).warnings.map(({ message }) => message);
    assert.deepEqual(warningsOf('<BinaryGeometry coord="c.bin" vertexCount="six"/>'), [
      'vertexCount="six" is no MFInt32; it counts as absent',
    ]);
    assert.deepEqual(warningsOf('<BinaryGeometry coord="c.bin" bboxSize="1 1"/>'), [
      'bboxSize="1 1" is no SFVec3f; it counts as absent',
    ]);
    assert.deepEqual(warningsOf('<BinaryGeometry coord="c.bin" primType="POINTS" vertexCount="3 6"/>'), [
      "primType has 1 of 2 draws; TRIANGLES are drawn for the others",
    ]);
    assert.deepEqual(warningsOf(`<BinaryGeometry coord="c.bin" primType='"LINES" "POINTS"' vertexCount="2"/>`), [
      "primType has 2 draws, vertexCount 1; the further ones are not used",
    ]);
  });

  test("has the first four of more byte planes, with a warning", () => {
    const scene = sceneOf('<Shape><ImageGeometry coord=\'"a" "b" "c" "d" "e"\' vertexCount="3"/></Shape>');
    assert.deepEqual(
      shapesOf(scene.root)[0]?.geometry?.patches[0]?.coord.map(({ url }) => url),
      ["a", "b", "c", "d"],
    );
    assert.match(scene.warnings[0]?.message ?? "", /4 of 5/);
  });

  test("gives its shape the union of the patches' boxes where the shape has none", () => {
    assert.deepEqual(onlyShape(`<Shape>${twoPatches}</Shape>`).box, { min: [0, 1, 2.5], max: [2, 3, 3.5] });
    assert.deepEqual(onlyShape(`<Shape bboxCenter="0 0 0" bboxSize="2 2 2">${twoPatches}</Shape>`).box, {
      min: [-1, -1, -1],
      max: [1, 1, 1],
    });
    assert.deepEqual(
      onlyShape('<Shape><ImageGeometry position="1 1 1" size="2 2 2" coord="c" vertexCount="3"/></Shape>').box,
      {
        min: [0, 0, 0],
        max: [2, 2, 2],
      },
    );
  });

  test("reads references of each encoding in the units of its files", () => {
    assert.deepEqual(referenceOf("a/b.png#70", "classic"), { url: "a/b.png", firstTexel: 70 });
    assert.deepEqual(referenceOf("a+4.png", "classic"), { url: "a+4.png", firstTexel: 0 });
    assert.deepEqual(referenceOf("a.png#7", "compact"), { url: "a.png", patchIndex: 7 });
    assert.deepEqual(referenceOf("a.bin#0+0", "bg"), { url: "a.bin", byteOffset: 0, byteStride: 0 });
    assert.deepEqual(referenceOf("a.bin#12", "bg"), { url: "a.bin", byteOffset: 12, byteStride: 0 });
    for (const fragment of ["x", "-1+x", "12+", "+4", "1+2+3"])
      assert.throws(() => referenceOf(`a.bin#${fragment}`, "bg"), /fragment is not an index/, fragment);
  });
});

describe("a second reading", () => {
  const x3d = elementsOf(`<X3D><Shape>${twoPatches}</Shape></X3D>`);
  const element = x3d.children[0]?.children[0];
  assert.ok(element);
  const reader = new SceneReader(x3d, { inlineGeometry: inlineGeometryReader });
  const read = () => shapesOf(reader.read().root)[0]?.geometry;
  const first = read();

  test("gives the same object where nothing has changed, even if it was touched", () => {
    assert.ok(first);
    assert.equal(read(), first);
    reader.touch(element);
    assert.equal(read(), first);
  });

  test("gives another object where something has changed", () => {
    element.attributes.set("solid", "true");
    reader.touch(element);
    assert.equal(read()?.solid, true);
    assert.notEqual(read(), first);
    assert.equal(read(), read());
  });
});

test("geometries with the same files and fields are one object, for as long as they are equal", () => {
  const copy = '<ImageGeometry coord="a.png" index="i.png" vertexCount="3"/>';
  const shapes = [
    copy,
    copy,
    copy.replace("a.png", "b.png"),
    copy.replace("index", 'decode="cpu" index'),
    "<Box/>",
    "<Box/>",
  ];
  const x3d = elementsOf(`<X3D>${shapes.map((geometry) => `<Shape>${geometry}</Shape>`).join("")}</X3D>`);
  const reader = new SceneReader(x3d, { inlineGeometry: inlineGeometryReader });
  const read = () => shapesOf(reader.read().root).map(({ geometry }) => geometry);
  const before = read();
  assert.deepEqual(
    before.map((geometry) => before.indexOf(geometry)),
    [0, 0, 2, 3, 4, 5],
  );
  const changed = x3d.children[1]?.children[0];
  assert.ok(changed);
  changed.attributes.set("coord", "b.png");
  reader.touch(changed);
  const after = read();
  assert.deepEqual(
    after.map((geometry) => before.indexOf(geometry)),
    [0, 2, 2, 3, 4, 5],
  );
});

describe("stored integers", () => {
  const planesOf = (count: number, bits = 8 * count) =>
    geometryOf(`
    <ImageGeometry position="10 0 0" size="4 4 4" positionBits="${bits}" vertexCount="3"
      coord='${Array.from({ length: count }, (_, plane) => `"${plane}.png"`).join(" ")}'/>`);
  const coordinateOf = (geometry: GeometryDescription, stored: number) => {
    const patch = geometry.patches[0];
    assert.ok(patch);
    const { origin, step } = dequantizationOf(geometry, patch);
    return origin[0] + stored * step[0];
  };

  for (const count of [1, 2, 3, 4]) {
    test(`with ${count} bytes span the whole quantization box`, () => {
      assert.equal(coordinateOf(planesOf(count), 0), 8);
      assert.ok(Math.abs(coordinateOf(planesOf(count), 256 ** count - 1) - 12) < 1e-12);
    });
  }

  test("in typed arrays follow X3DOM: unsigned from the corner, signed around the center, floats as they are", () => {
    const typed = (type: string) =>
      geometryOf(`<BinaryGeometry position="10 0 0" size="4 4 4" coordType="${type}" coord="c" vertexCount="3"/>`);
    assert.equal(coordinateOf(typed("Uint16"), 65535), 12);
    assert.equal(coordinateOf(typed("Int16"), 0), 10);
    assert.ok(Math.abs(coordinateOf(typed("Int16"), -16383) - 8) < 1e-3);
    assert.equal(coordinateOf(typed("Float32"), 7.5), 7.5);
  });

  test("have a step above 0 along a flat side of the box, so that the matrix can be inverted", () => {
    const flat = geometryOf('<ImageGeometry size="4 4 0" vertexCount="3" coord="a.png"/>');
    const patch = flat.patches[0];
    assert.ok(patch && dequantizationOf(flat, patch).step.every((step) => step > 0));
  });

  test("are at the midpoint of the possible values while their low bytes are missing", () => {
    for (const [planes, bits] of [
      [2, 16],
      [2, 12],
      [2, 9],
      [3, 24],
      [3, 17],
      [4, 32],
      [1, 8],
    ] as const) {
      for (let present = 1; present <= planes; ++present) {
        // The values that the missing bytes can take, given that the lowest bits are 0.
        const low = 0;
        const high = 2 ** (8 * (planes - present)) - 2 ** Math.min(8 * planes - bits, 8 * (planes - present));
        assert.equal(
          missingBytesMidpoint(planesOf(planes, bits), planes, present),
          present === planes ? 0 : (low + high) / 2,
        );
      }
    }
  });
});
