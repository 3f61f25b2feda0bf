import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type {
  GeometryDescription,
  NodeDescription,
  SceneDescription,
  ShapeDescription,
  ViewpointDescription,
} from "./description.ts";
import { shapesOf, viewpointsOf } from "./description.ts";
import { elementsOf } from "./elements.testing.ts";
import { referenceOf } from "./geometry.ts";
import { nodeFields } from "./nodes.ts";
import { readScene } from "./readScene.ts";
import { readInlineGeometry } from "./inlineGeometry.ts";
import { SceneReader } from "./sceneReader.ts";
import { missingBytesMidpoint, dequantizationOf } from "./dequantization.ts";

function sceneOf(markup: string): SceneDescription {
  return readScene(elementsOf(`<X3D><Scene>${markup}</Scene></X3D>`));
}

function onlyShape(markup: string): ShapeDescription {
  const shapes = shapesOf(sceneOf(markup).root);
  assert.equal(shapes.length, 1);
  const shape = shapes[0];
  assert.ok(shape);
  return shape;
}

function geometryOf(markup: string): GeometryDescription {
  const { geometry } = onlyShape(`<Shape>${markup}</Shape>`);
  assert.ok(geometry);
  return geometry;
}

function viewpointsIn(scene: SceneDescription): ViewpointDescription[] {
  return viewpointsOf(scene.root).map(({ viewpoint }) => viewpoint);
}

function visibleShapes(node: NodeDescription): ShapeDescription[] {
  if (node.kind === "shape") return node.visible ? [node] : [];
  return node.kind === "group" && node.visible ? node.children.flatMap(visibleShapes) : [];
}

const patches = `
  <ImageGeometry position="1 2 3" size="2 2 2" positionBits="12" solid="false" index="unused.png">
    <GeometryPatch bboxCenter="1 2 3" bboxSize="2 1 1" recordCount="300" primType='"TRIANGLES" "TRIANGLESTRIP"'
      vertexCount="900 12" implicitMeshSize="512 2" index="i.png#1024" coord='"a.png" "b.png#512"' normal="n.png"/>
    <GeometryPatch bboxCenter="1 2 3" bboxSize="1 2 1" recordCount="4" primType="LINESTRIP" vertexCount="4" coord="c.png"/>
  </ImageGeometry>`;

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

describe("a field", () => {
  test("is found case-insensitively, as HTML and XML write it", () => {
    for (const markup of [
      '<Viewpoint fieldOfView="0.5"/>',
      '<viewpoint fieldofview="0.5"/>',
      '<VIEWPOINT FIELDOFVIEW="0.5"/>',
    ]) {
      assert.equal(viewpointsIn(sceneOf(markup))[0]?.fieldOfView, 0.5);
    }
  });

  test("may separate its numbers by commas or white space", () => {
    assert.deepEqual(viewpointsIn(sceneOf('<Viewpoint position=" 1,2 ,\n 3 "/>'))[0]?.position, [1, 2, 3]);
  });

  for (const text of ["1 2", "1 2 3 4", "1 2 x", "1 2 Infinity", "1 2 NaN", ""]) {
    test(`has its default value, with a warning, where it is "${text}" instead of three numbers`, () => {
      const scene = sceneOf(`<Viewpoint position="${text}"/>`);
      assert.deepEqual(viewpointsIn(scene)[0]?.position, nodeFields.Viewpoint.position.defaultValue);
      assert.equal(scene.warnings.length, 1);
      assert.match(scene.warnings[0]?.message ?? "", /position=.*SFVec3f/);
    });
  }

  test("may have quoted or bare strings, with escaped quotes", () => {
    const parse = (text: string) => nodeFields.GeometryPatch.coord.type.parse(text);
    assert.deepEqual(parse('"a b.png" "c\\"d"'), ["a b.png", 'c"d']);
    assert.deepEqual(parse("a.png b.png"), ["a.png", "b.png"]);
    assert.deepEqual(parse(""), []);
    assert.equal(parse('"a" b'), undefined);
  });
});

describe("a scene", () => {
  test("is empty by default, with a headlight and no background", () => {
    const scene = sceneOf("");
    assert.deepEqual(shapesOf(scene.root), []);
    assert.equal(scene.navigation.headlight, true);
    assert.equal(scene.navigation.speed, undefined);
    assert.deepEqual(scene.warnings, []);
    assert.deepEqual(viewpointsIn(scene), []);
    assert.equal(scene.background, undefined);
  });

  test("has viewpoints in document order, at any depth", () => {
    const scene = sceneOf(
      `<Group><Viewpoint description="a"/></Group><Transform><Viewpoint description="b" set_bind="true"/></Transform>`,
    );
    assert.deepEqual(
      viewpointsIn(scene).map(({ description, set_bind }) => [description, set_bind]),
      [
        ["a", false],
        ["b", true],
      ],
    );
  });

  test("has the first NavigationInfo, or one whose bind is true", () => {
    assert.equal(sceneOf('<NavigationInfo speed="2"/><NavigationInfo speed="3"/>').navigation.speed, 2);
    assert.equal(sceneOf('<NavigationInfo speed="2"/><NavigationInfo bind="true" speed="3"/>').navigation.speed, 3);
  });

  test("keeps shapes in document order below unknown nodes, groups and transforms", () => {
    const scene = sceneOf(`<Shape DEF="a"/><Unknown><Shape DEF="b"/></Unknown>
      <Transform translation="1 0 0"><Group><Shape DEF="c"/></Group></Transform>`);
    assert.deepEqual(
      shapesOf(scene.root).map((shape) => shape.element.getAttribute("DEF")),
      ["a", "b", "c"],
    );
  });

  test("follows USE for shapes, materials and geometries, and gives each shape the identity of the element that USEs it", () => {
    const scene = sceneOf(`
      <Shape DEF="s"><Appearance DEF="a"><Material diffuseColor="1 0 0"/></Appearance>${patches}</Shape>
      <Shape USE="s"/><Shape><Appearance USE="a"/></Shape>`);
    const shapes = shapesOf(scene.root);
    assert.deepEqual(
      shapes.map(({ appearance: { material } }) => material.kind === "phong" && material.diffuseColor),
      [
        [1, 0, 0],
        [1, 0, 0],
        [1, 0, 0],
      ],
    );
    assert.ok(shapes[0]?.geometry);
    assert.equal(shapes[1]?.geometry, shapes[0].geometry); // the same object: it is delivered once
    assert.equal(new Set(shapes.map((shape) => shape.element)).size, 3);
  });

  test("assigns each texture to the field of its containerField, also where it is USEd", () => {
    const texturesOf = (markup: string) =>
      shapesOf(sceneOf(`<Shape><Appearance>${markup}</Appearance></Shape>`).root)[0]?.appearance.textures.map(
        ({ role, urls, preview, sampling: { isData } }) => [role, urls[0], preview, isData].join(" "),
      );
    assert.deepEqual(texturesOf('<Material/><ImageTexture url="a.png" preview="small.webp"/>'), [
      "color a.png small.webp false",
    ]);
    assert.deepEqual(
      texturesOf(
        '<Material/><MultiTexture><MovieTexture/><ImageTexture url="a.png"/><ImageTexture url="b.png"/></MultiTexture>',
      ),
      ["color a.png  false"],
    );
    assert.deepEqual(
      texturesOf(`<PhysicalMaterial><ImageTexture DEF="ORM" url="orm.png" containerField="occlusionTexture"/>
      <ImageTexture USE="ORM" containerField="metallicRoughnessTexture"/><ImageTexture url="n.png" containerField="normalTexture"/>
      <ImageTexture url="s.png" containerField="specularTexture"/></PhysicalMaterial><ImageTexture url="a.png"/>`),
      ["color a.png  false", "metallicRoughness orm.png  true", "normal n.png  true", "occlusion orm.png  true"],
    );
    assert.deepEqual(
      texturesOf('<UnlitMaterial><ImageTexture url="a.png" containerField="emissiveTexture"/></UnlitMaterial>'),
      ["color a.png  false"],
    );
  });

  test("has three kinds of material, and lights with and without a position", () => {
    const materialIn = (markup: string) =>
      shapesOf(sceneOf(`<Shape><Appearance>${markup}</Appearance></Shape>`).root)[0]?.appearance.material;
    assert.deepEqual(materialIn(""), { kind: "unlit", emissiveColor: [1, 1, 1], transparency: 0 });
    assert.equal(materialIn("<Material/>")?.kind, "phong");
    assert.deepEqual(materialIn('<PhysicalMaterial baseColor="1 0.5 0" metallic="0"/>'), {
      kind: "physical",
      baseColor: [1, 0.5, 0],
      metallic: 0,
      roughness: 1,
      emissiveColor: [0, 0, 0],
      transparency: 0,
      normalScale: 1,
      occlusionStrength: 1,
    });
    assert.deepEqual(materialIn('<UnlitMaterial transparency="0.5"/>'), {
      kind: "unlit",
      emissiveColor: [1, 1, 1],
      transparency: 0.5,
    });
    const lights = sceneOf('<DirectionalLight/><PointLight location="1 2 3"/><SpotLight cutOffAngle="1"/>').root
      .children;
    assert.deepEqual(
      lights.map((node) => node.kind === "light" && node.light.kind),
      ["directional", "point", "spot"],
    );
    const [, point] = lights;
    assert.ok(point?.kind === "light" && point.light.kind === "point");
    assert.deepEqual([point.light.location, point.light.attenuation, point.light.radius], [[1, 2, 3], [1, 0, 0], 100]);
  });

  test("has lines with the width and dashes of LineProperties, and thin solid lines by default", () => {
    const linesOf = (fields: string) =>
      onlyShape(`<Shape><Appearance><LineProperties ${fields}/></Appearance></Shape>`).appearance.lines;
    assert.deepEqual(linesOf('linewidthScaleFactor="2.5"'), { width: 2.5, dashes: [] });
    assert.deepEqual(linesOf('linetype="3"'), { width: 1, dashes: [1, 2] });
    assert.deepEqual(linesOf('linetype="13" linewidthScaleFactor="1e30"'), {
      width: 1024,
      dashes: [14, 3, 4, 3, 4, 3],
    });
    for (const fields of [
      "",
      'linewidthScaleFactor="1"',
      'linewidthScaleFactor="-4"',
      'linetype="2" linewidthScaleFactor="4" applied="false"',
    ]) {
      assert.equal(linesOf(fields), undefined, fields);
    }
    const arrows = sceneOf('<Shape><Appearance><LineProperties linetype="6"/></Appearance></Shape>');
    assert.deepEqual(
      arrows.warnings.map(({ message }) => message),
      ["linetype 6 is not supported; the lines are solid"],
    );
  });

  test("has a shape once for each instance of a USEd group around it", () => {
    const shapes = shapesOf(
      sceneOf(`<Group DEF="g"><Shape>${patches}</Shape></Group><Transform><Group USE="g"/></Transform>`).root,
    );
    assert.equal(shapes.length, 2);
    assert.equal(shapes[0]?.element, shapes[1]?.element);
  });

  test("has nodes visible where `visible` and X3DOM's `render` are both true, and at most one visible child in a Switch", () => {
    const visibleIds = (markup: string) =>
      visibleShapes(sceneOf(markup).root).map((shape) => shape.element.getAttribute("DEF"));
    assert.deepEqual(visibleIds('<Shape DEF="a"/><Shape DEF="b" visible="false"/><Shape DEF="c" render="false"/>'), [
      "a",
    ]);
    assert.deepEqual(
      visibleIds(
        '<Group render="false"><Shape DEF="a"/></Group><Transform visible="false"><Shape DEF="b"/></Transform>',
      ),
      [],
    );
    for (const [choice, expected] of [
      ["0", ["a", "b"]],
      ["1", ["c"]],
      ["-1", []],
      ["7", []],
    ] as const) {
      assert.deepEqual(
        visibleIds(
          `<Switch whichChoice="${choice}"><Group><Shape DEF="a"/><Shape DEF="b"/></Group><Shape DEF="c"/></Switch>`,
        ),
        expected,
      );
    }
    assert.deepEqual(visibleIds('<Switch><Shape DEF="a"/></Switch>'), []);
  });

  test("hides shapes that are hidden themselves or by a group around them", () => {
    const scene = sceneOf(`<Group visible="false"><Transform><Shape/></Transform></Group>
      <Transform visible="false"><Group><Shape/></Group></Transform><Shape visible="false"/><Group><Shape/></Group>`);
    assert.deepEqual(
      shapesOf(scene.root).map(({ visible }) => visible),
      [false, false, false, true],
    );
  });

  test("warns of USE in a circle and of unknown names", () => {
    const scene = sceneOf(
      '<Group DEF="g"><Group USE="h"/></Group><Group DEF="h"><Group USE="g"/></Group><Shape USE="none"/>',
    );
    assert.deepEqual(shapesOf(scene.root), []);
    assert.ok(scene.warnings.some(({ message }) => message.includes("itself")));
    assert.ok(scene.warnings.some(({ message }) => message.includes("no DEF")));
  });
});

describe("the author's priority", () => {
  const shapesIn = (markup: string) => shapesOf(sceneOf(markup).root);

  test("is multiplied down the tree, from groups to geometries", () => {
    const [first, second, third, fourth] = shapesIn(`
      <Group priority="2"><Transform priority="high"><Shape priority="0.5"><ImageGeometry priority="3"/></Shape></Transform></Group>
      <Group priority="low"><Shape><BinaryGeometry priority="0"/></Shape></Group><Shape priority="auto"/>
      <Group priority="8"><Shape priority="low"/></Group>`);
    assert.deepEqual(
      [first, second, third, fourth].map((shape) => shape?.priority),
      [2 * 4 * 0.5 * 3, 0, 1, 8 / 4],
    );
  });

  test("does not change the identity of a geometry", () => {
    const [one, other] = shapesIn('<Shape><ImageGeometry priority="7"/></Shape><Shape><ImageGeometry/></Shape>');
    assert.deepEqual(one?.geometry, other?.geometry);
  });

  for (const text of ["-1", "much", "", "1 2", "NaN"]) {
    test(`is 1, with a warning, where the attribute is "${text}"`, () => {
      const scene = sceneOf(`<Shape priority="${text}"><ImageGeometry priority="${text}"/></Shape>`);
      assert.equal(shapesOf(scene.root)[0]?.priority, 1);
      assert.equal(scene.warnings.length, 2);
    });
  }

  test("of file contents is a field of the scene", () => {
    assert.equal(readScene(elementsOf('<x3d chunkpriority="normal: 2"/>')).chunkPriority, "normal: 2");
  });
});

describe("a geometry", () => {
  test("takes draws and references from its patches only, where it has any", () => {
    const geometry = geometryOf(patches);
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
    assert.equal(geometryOf('<ImageGeometry coord="a" index="i"/>').indexType, "Uint16");
    assert.equal(geometryOf('<ImageGeometry coord="a" index="i" indexType="uint32"/>').indexType, "Uint32");
  });

  test("has the encoding of normals of two numbers, and their location in X3DOM's files", () => {
    assert.equal(geometryOf('<ImageGeometry coord="a" normal="n" vertexCount="3"/>').normalEncoding, "rgb");
    assert.equal(
      geometryOf('<ImageGeometry coord="a" normal="n" normalEncoding="Octahedral"/>').normalEncoding,
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
    const wrong = sceneOf(
      '<Shape><BinaryGeometry coord="c" normalAsSphericalCoordinates="true" normalEncoding="cube"/></Shape>',
    );
    assert.equal(wrong.warnings.length, 2);
  });

  test("has triangles for an unknown primitive and the default for an unknown element type, with warnings", () => {
    const scene = sceneOf('<Shape><BinaryGeometry coordType="Float64" primType="QUADS" vertexCount="3 -1"/></Shape>');
    const geometry = shapesOf(scene.root)[0]?.geometry;
    assert.equal(geometry?.coordType, "Float32");
    assert.deepEqual(geometry.patches[0]?.draws, [
      { primitive: "triangles", count: 3 },
      { primitive: "triangles", count: 0 },
    ]);
    assert.equal(scene.warnings.length, 3);
  });

  test("has the first four of more byte planes, with a warning", () => {
    const scene = sceneOf('<Shape><ImageGeometry coord="a b c d e"/></Shape>');
    assert.deepEqual(
      shapesOf(scene.root)[0]?.geometry?.patches[0]?.coord.map(({ url }) => url),
      ["a", "b", "c", "d"],
    );
    assert.match(scene.warnings[0]?.message ?? "", /4 of 5/);
  });

  test("gives its shape the union of the patches' boxes where the shape has none", () => {
    assert.deepEqual(onlyShape(`<Shape>${patches}</Shape>`).box, { min: [0, 1, 2.5], max: [2, 3, 3.5] });
    assert.deepEqual(onlyShape(`<Shape bboxCenter="0 0 0" bboxSize="2 2 2">${patches}</Shape>`).box, {
      min: [-1, -1, -1],
      max: [1, 1, 1],
    });
    assert.deepEqual(onlyShape('<Shape><ImageGeometry position="1 1 1" size="2 2 2"/></Shape>').box, {
      min: [0, 0, 0],
      max: [2, 2, 2],
    });
  });

  test("reads references of each encoding in the units of its files", () => {
    assert.deepEqual(referenceOf("a/b.png#70", "classic"), { url: "a/b.png", firstTexel: 70 });
    assert.deepEqual(referenceOf("a+4.png", "classic"), { url: "a+4.png", firstTexel: 0 });
    assert.deepEqual(referenceOf("a.png#7", "compact"), { url: "a.png", patchIndex: 7 });
    assert.deepEqual(referenceOf("a.bin#0+0", "bg"), { url: "a.bin", byteOffset: 0, byteStride: 0 });
    assert.deepEqual(referenceOf("a.bin#-1+x", "bg"), { url: "a.bin", byteOffset: 0, byteStride: 0 });
  });
});

describe("a second reading", () => {
  const x3d = elementsOf(`<X3D><Shape>${patches}</Shape></X3D>`);
  const element = x3d.children[0]?.children[0];
  assert.ok(element);
  const reader = new SceneReader(x3d, { inlineGeometry: readInlineGeometry });
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
  const reader = new SceneReader(x3d, { inlineGeometry: readInlineGeometry });
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
      geometryOf(`<BinaryGeometry position="10 0 0" size="4 4 4" coordType="${type}" vertexCount="3"/>`);
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
