import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { NodeDescription, SceneDescription, ShapeDescription, ViewpointDescription } from "./description.ts";
import { shapesOf, viewpointsOf } from "./description.ts";
import { elementsOf } from "./elements.testing.ts";
import { nodeFields } from "./nodes.ts";
import type { PartName } from "./parts.ts";
import { readScene } from "./readScene.ts";
import { SceneReader } from "./sceneReader.ts";
import { onlyShape, sceneOf, twoPatches } from "./scenes.testing.ts";

function viewpointsIn(scene: SceneDescription): ViewpointDescription[] {
  return viewpointsOf(scene.root).map(({ viewpoint }) => viewpoint);
}

function visibleShapes(node: NodeDescription): ShapeDescription[] {
  if (node.kind === "shape") return node.visible ? [node] : [];
  return node.kind === "group" && node.visible ? node.children.flatMap(visibleShapes) : [];
}

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
    const parse = (text: string) => nodeFields.GeometryPatch.primType.type.parse(text);
    assert.deepEqual(parse('"a b" "c\\"d"'), ["a b", 'c"d']);
    assert.deepEqual(parse("a b"), ["a", "b"]);
    assert.deepEqual(parse(""), []);
    assert.equal(parse('"a" b'), undefined);
  });

  test("of URLs may be one bare URL, with spaces", () => {
    const parse = (text: string) => nodeFields.GeometryPatch.coord.type.parse(text);
    assert.deepEqual(parse('"a b.png" "c.png"'), ["a b.png", "c.png"]);
    assert.deepEqual(parse(" a b.png "), ["a b.png"]);
    assert.deepEqual(parse(" "), []);
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
      <Shape DEF="s"><Appearance DEF="a"><Material diffuseColor="1 0 0"/></Appearance>${twoPatches}</Shape>
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

  test("needs the part with wide lines where lines have a width or dashes", () => {
    const partsOf = (fields: string) => {
      const appearance = `<Appearance><LineProperties ${fields}/></Appearance>`;
      const shape = `<Shape><ImageGeometry profile="compact" data="a.png"/>${appearance}</Shape>`;
      const parts: PartName[] = [];
      new SceneReader(elementsOf(`<X3D><Scene>${shape}</Scene></X3D>`), { need: (part) => parts.push(part) }).read();
      return parts;
    };
    assert.deepEqual(partsOf('linewidthScaleFactor="2"'), ["files"]);
    assert.deepEqual(partsOf('linetype="3"'), ["files"]);
    assert.deepEqual(partsOf(""), []);
  });

  test("has a shape once for each instance of a USEd group around it", () => {
    const shapes = shapesOf(
      sceneOf(`<Group DEF="g"><Shape>${twoPatches}</Shape></Group><Transform><Group USE="g"/></Transform>`).root,
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
      <Group priority="2"><Transform priority="high"><Shape priority="0.5"><ImageGeometry priority="3" coord="a" vertexCount="3"/></Shape></Transform></Group>
      <Group priority="low"><Shape><BinaryGeometry priority="0" coord="a"/></Shape></Group><Shape priority="auto"/>
      <Group priority="8"><Shape priority="low"/></Group>`);
    assert.deepEqual(
      [first, second, third, fourth].map((shape) => shape?.priority),
      [2 * 4 * 0.5 * 3, 0, 1, 8 / 4],
    );
  });

  test("does not change the identity of a geometry", () => {
    const [one, other] = shapesIn(
      '<Shape><ImageGeometry priority="7" data="a"/></Shape><Shape><ImageGeometry data="a"/></Shape>',
    );
    assert.deepEqual(one?.geometry, other?.geometry);
  });

  for (const text of ["-1", "much", "", "1 2", "NaN"]) {
    test(`is 1, with a warning, where the attribute is "${text}"`, () => {
      const scene = sceneOf(`<Shape priority="${text}"><ImageGeometry priority="${text}" data="a.png"/></Shape>`);
      assert.equal(shapesOf(scene.root)[0]?.priority, 1);
      assert.equal(scene.warnings.length, 2);
    });
  }

  test("of file contents is a field of the scene", () => {
    assert.equal(readScene(elementsOf('<x3d chunkpriority="normal: 2"/>')).chunkPriority, "normal: 2");
  });
});

test("elements and values that are named like members of every object are unknown", () => {
  for (const name of ["constructor", "__proto__"]) {
    const node = `<${name} containerField="coord"/>`;
    const { root, warnings } = sceneOf(
      `${node}<Shape>${node}</Shape><Shape><Appearance>${node}</Appearance><ImageGeometry coord="a.png" vertexCount="3">${node}</ImageGeometry></Shape>`,
    );
    assert.deepEqual(
      warnings.map(({ message }) => message),
      ["it is no geometry node that pages draw; nothing is drawn"],
    );
    assert.equal(shapesOf(root)[1]?.geometry?.patches.length, 1);
    assert.equal(sceneOf(`<Shape priority="${name}" colorMap="${name}"/>`).warnings.length, 2);
  }
});
