import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { shapesOf } from "./description.ts";
import { elementsOf } from "./elements.testing.ts";
import { readScene } from "./readScene.ts";
import { inlineGeometryReader } from "./inlineGeometry.ts";
import { SceneReader } from "./sceneReader.ts";

const geometry = `<ImageGeometry>
  <FloatVertexAttribute name="heat" numComponents="1" valueBits="16" valueMin="-2" valueSize="5"/>
  <FloatVertexAttribute name="flow" numComponents="2" valueBits="24" valueMin="-3 0" valueSize="1 4"/>
  <GeometryPatch coord="c.png" vertexCount="3" attrib='"h1.png#9" "h0.png" "f2.png" "f1.png" "f0.png"'/></ImageGeometry>`;

function read(fields: string, node = geometry) {
  const scene = readScene(elementsOf(`<X3D><Shape ${fields}>${node}</Shape></X3D>`));
  const [shape] = shapesOf(scene.root);
  assert.ok(shape?.geometry);
  return { shape, geometry: shape.geometry, messages: scene.warnings.map(({ message }) => message) };
}

describe("a shape's colorBy", () => {
  test("selects the files of the named attribute, and the range of its values", () => {
    const heat = read(`colorBy="heat"`);
    assert.equal(heat.geometry.value?.name, "heat");
    assert.deepEqual(heat.geometry.patches[0]?.value, [
      { url: "h1.png", firstTexel: 9 },
      { url: "h0.png", firstTexel: 0 },
    ]);
    assert.deepEqual(heat.shape.appearance.colorMap?.range, [-2, 3]);
    const flow = read(`colorBy="flow"`);
    assert.deepEqual(
      flow.geometry.patches[0]?.value.map(({ url }) => url),
      ["f2.png", "f1.png", "f0.png"],
    );
    assert.deepEqual(flow.shape.appearance.colorMap?.range, [0, 5]); // of the length of (-3 … -2, 0 … 4)
  });

  test("selects one file in BG", () => {
    const { geometry } = read(
      `colorBy="flow"`,
      `<BinaryGeometry><FloatVertexAttribute name="heat" numComponents="1"/>
      <FloatVertexAttribute name="flow" numComponents="3"/><GeometryPatch coord="c.bin" attrib='"h.bin" "f.bin#4+16"'/></BinaryGeometry>`,
    );
    assert.deepEqual(geometry.patches[0]?.value, [{ url: "f.bin", byteOffset: 4, byteStride: 16 }]);
  });

  test("selects no files in compact, whose patch files contain the values", () => {
    const {
      geometry: {
        value,
        patches: [patch],
      },
      shape,
    } = read(
      `colorBy="heat"`,
      `<ImageGeometry profile="compact" data="p.png">
      <FloatVertexAttribute name="heat" numComponents="1" valueBits="24" valueMin="-1" valueSize="3"/></ImageGeometry>`,
    );
    assert.deepEqual(
      [value?.bits, value?.fileCount, patch?.value, shape.appearance.colorMap?.range],
      [24, 0, [], [-1, 2]],
    );
  });

  test("is the depth in fog where it has its name, unless another attribute colors the shape", () => {
    const bg = `<BinaryGeometry coord="c.bin"><FloatVertexAttribute name="heat" numComponents="1"/>
      <FloatVertexAttribute name="fogDepth" numComponents="1"/><GeometryPatch coord="c.bin" attrib='"h.bin" "f.bin"'/></BinaryGeometry>`;
    const plain = read("", bg);
    assert.deepEqual([plain.geometry.value?.name, plain.geometry.valueUse], ["fogDepth", "fogDepth"]);
    assert.equal(plain.shape.appearance.colorMap, undefined);
    assert.deepEqual(plain.messages, []);
    const colored = read(`colorBy="heat"`, bg);
    assert.deepEqual([colored.geometry.value?.name, colored.geometry.valueUse], ["heat", "color"]);
    assert.deepEqual(colored.messages, [`colorBy="heat": its fog depends on the distance from the viewer`]);
  });

  test("colors nothing where it is absent or names an unknown attribute", () => {
    assert.deepEqual(read("").geometry.patches[0]?.value, []);
    assert.deepEqual(read("").messages, []);
    const unknown = read(`colorBy="cold"`);
    assert.equal(unknown.shape.appearance.colorMap, undefined);
    assert.deepEqual(unknown.messages, [`colorBy="cold" is no attribute of the geometry`]);
  });

  test("gives one geometry per attribute, however often the document is read", () => {
    const scene =
      elementsOf(`<X3D><Shape colorBy="heat">${geometry.replace("<ImageGeometry", `<ImageGeometry DEF="g"`)}</Shape>
      <Shape colorBy="heat" colorMap="gray"><ImageGeometry USE="g"/></Shape><Shape colorBy="flow"><ImageGeometry USE="g"/></Shape></X3D>`);
    const reader = new SceneReader(scene, { inlineGeometry: inlineGeometryReader });
    const [first, second, third] = shapesOf(reader.read().root);
    assert.equal(first?.geometry, second?.geometry);
    assert.notEqual(first?.geometry, third?.geometry);
    reader.touch(scene);
    for (const shape of scene.children) reader.touch(shape);
    assert.equal(shapesOf(reader.read().root)[0]?.geometry, first?.geometry);
  });

  test("takes its colors from a named map or from a list", () => {
    const colors = (text: string) => read(`colorBy="heat" colorMap="${text}"`);
    assert.deepEqual(colors("gray").shape.appearance.colorMap?.colors, [
      [0, 0, 0],
      [1, 1, 1],
    ]);
    assert.deepEqual(colors("1 0 0, 0 1 0, 0 0 1").shape.appearance.colorMap?.colors, [
      [1, 0, 0],
      [0, 1, 0],
      [0, 0, 1],
    ]);
    const viridis = read(`colorBy="heat"`).shape.appearance.colorMap?.colors;
    assert.equal(viridis?.length, 10);
    for (const wrong of ["rainbows", "1 0 0", "1 0 0 1", "1 0 0 1 0 x"]) {
      assert.equal(colors(wrong).messages.length, 1, wrong);
      assert.deepEqual(colors(wrong).shape.appearance.colorMap?.colors, viridis);
    }
  });
});

describe("a FloatVertexAttribute", () => {
  test("leaves its node out, with one warning, where no file can hold it", () => {
    for (const [text, other, message] of [
      ['valueBits="16"', 'valueBits="12"', "valueBits is none of 8, 16 and 24"],
      ['numComponents="2"', 'numComponents="5"', "numComponents is none of 1 to 4"],
      ['numComponents="2"', 'numComponents="-2"', "numComponents -2 is negative"],
      ['name="heat"', 'name=""', "an attribute has no name"],
      ['name="heat"', 'name="flow"', "a geometry has two attributes of one name"],
      ['valueSize="5"', 'valueSize="-5"', "valueMin and valueSize are no range of numbers"],
      ['valueMin="-3 0"', 'valueMin="-3"', "valueMin and valueSize are no range of numbers"],
      ['"h1.png#9"', "", "attrib names fewer files than the attributes need"],
      ['"h1.png#9"', '"a" "b"', "attrib names more files than the attributes need"],
    ] as const) {
      const { warnings, root } = readScene(elementsOf(`<X3D><Shape>${geometry.replace(text, other)}</Shape></X3D>`), {
        inlineGeometry: inlineGeometryReader,
      });
      assert.equal(shapesOf(root)[0]?.geometry, undefined);
      assert.deepEqual(
        warnings.map((warning) => warning.message),
        [message],
      );
    }
  });
});
