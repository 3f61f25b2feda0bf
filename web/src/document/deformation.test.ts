import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { SceneDescription, ShapeDescription } from "./description.ts";
import { shapesOf } from "./description.ts";
import { sceneOf } from "./scenes.testing.ts";

const identity = "1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1";
const attribute = (name: string, components: number): string =>
  `<FloatVertexAttribute name="${name}" numComponents="${components}"/>`;
const skinAttributes = attribute("skin.joints0", 4) + attribute("skin.weights0", 4);

/** A BinaryGeometry with these attributes, in a file each. */
function geometry(attributes: string): string {
  const urls = Array.from(attributes.matchAll(/<Float/g), (_, n) => `"${n}.bin"`).join(" ");
  return `<BinaryGeometry coord="c.bin">${attributes}<GeometryPatch coord="c.bin" attrib='${urls}'/></BinaryGeometry>`;
}

/** Two joints, and a humanoid whose shape has these children. */
function humanoid(
  fields: string,
  joints = ["hip", "knee"],
  shape = geometry(skinAttributes),
  more = "",
): SceneDescription {
  const uses = joints.map((joint) => `<HAnimJoint USE="${joint}" containerField="joints"/>`).join("");
  return sceneOf(`<HAnimJoint DEF="hip"><HAnimJoint DEF="knee"/></HAnimJoint>
    <HAnimHumanoid ${fields}>${uses}${more}<Shape>${shape}</Shape></HAnimHumanoid>`);
}

function onlyShapeOf(scene: SceneDescription): ShapeDescription {
  const [shape] = shapesOf(scene.root);
  assert.ok(shape);
  return shape;
}

function messagesOf({ warnings }: SceneDescription): readonly string[] {
  return warnings.map(({ element, message }) => `${element.localName} ${message}`);
}

describe("a skin", () => {
  test("has the joints in the order of their USEs, with a matrix each", () => {
    const matrices = `${identity}  2 0 0 0  0 2 0 0  0 0 2 0  5 6 7 1`;
    const scene = humanoid(`inverseBindMatrices="${matrices}"`, ["knee", "hip"]);
    const { skin, displacers } = onlyShapeOf(scene).deformer ?? {};
    assert.deepEqual(
      skin?.joints.map((joint) => joint.getAttribute("DEF")),
      ["knee", "hip"],
    );
    assert.deepEqual(skin.inverseBindMatrices.slice(16), [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 5, 6, 7, 1]);
    assert.deepEqual(displacers, []);
    assert.deepEqual(scene.warnings, []);
  });

  test("may have eight joints for each vertex", () => {
    const eight = skinAttributes + attribute("skin.joints1", 4) + attribute("skin.weights1", 4);
    const scene = humanoid(`inverseBindMatrices="${identity} ${identity}"`, undefined, geometry(eight));
    const { layout, attributes } = onlyShapeOf(scene).geometry?.deformation ?? {};
    assert.deepEqual(layout, { jointSets: 2, displacers: 0, displacesNormals: false });
    assert.deepEqual(
      attributes?.map(({ name }) => name),
      ["skin.joints0", "skin.weights0", "skin.joints1", "skin.weights1"],
    );
  });

  for (const [problem, fields, joints] of [
    ["has 16 numbers in inverseBindMatrices for 2 joints", `inverseBindMatrices="${identity}"`, ["hip", "knee"]],
    ["has 17 numbers in inverseBindMatrices for 1 joints", `inverseBindMatrices="${identity} 1"`, ["hip"]],
    ['names no joint with DEF="toe"', `inverseBindMatrices="${identity} ${identity}"`, ["hip", "toe"]],
  ] as const)
    test(`that ${problem} stays as it was modelled, with one sentence`, () => {
      const scene = humanoid(fields, [...joints]);
      assert.equal(onlyShapeOf(scene).deformer?.skin, undefined);
      assert.deepEqual(messagesOf(scene), [`HAnimHumanoid ${problem}: its skin stays as it was modelled`]);
    });

  test("of HAnim's own form stays as it was modelled, with a sentence that names the command", () => {
    const coordinate = '<Coordinate containerField="skinCoord" point="0 0 0"/>';
    const scene = humanoid("", undefined, undefined, coordinate);
    assert.equal(onlyShapeOf(scene).deformer?.skin, undefined);
    assert.match(messagesOf(scene).join(), /^HAnimHumanoid has a skinCoord, .* until `imgeo convert`$/);
  });
});

test("an HAnimMotion, and HAnimDisplacers of joints and segments, have no effect, with a sentence each", () => {
  const scene = sceneOf(`<HAnimHumanoid><HAnimJoint containerField="skeleton" rotation="0 0 1 1">
      <HAnimDisplacer containerField="displacers" weight="1"/>
      <HAnimSegment><Coordinate point="0 0 0"/><HAnimDisplacer weight="1"/><Shape><Box/></Shape></HAnimSegment>
    </HAnimJoint><HAnimMotion containerField="motions" values="1 2 3"/></HAnimHumanoid>`);
  assert.equal(shapesOf(scene.root).length, 1);
  const displacer =
    "HAnimDisplacer has no effect on an HAnimJoint or HAnimSegment: pages move the vertices of a Shape that it is a child of";
  assert.deepEqual(messagesOf(scene), [
    displacer,
    displacer,
    "HAnimMotion has no effect: pages play interpolators whose values are routed to the joints",
  ]);
});

test("the transform of an HAnimSite applies to its children, and an HAnimSegment may hide them", () => {
  const site = `<HAnimSite translation="1 2 3" rotation="0 1 0 0.5" scale="2 1 1" center="0 1 0"><Shape><Box/></Shape></HAnimSite>`;
  const { root, warnings } = sceneOf(`<HAnimSegment visible="false">${site}</HAnimSegment>${site}`);
  assert.deepEqual(warnings, []);
  assert.deepEqual(
    shapesOf(root).map(({ visible }) => visible),
    [false, true],
  );
  const group = root.children.at(-1);
  assert.ok(group?.kind === "group");
  assert.ok(group.transform);
  const { translation, rotation, scale, center } = group.transform;
  assert.deepEqual(
    [translation, rotation, scale, center],
    [
      [1, 2, 3],
      [0, 1, 0, 0.5],
      [2, 1, 1],
      [0, 1, 0],
    ],
  );
});

describe("displacers", () => {
  const morph = geometry(attribute("displacer.0", 3) + attribute("displacer.1", 3));

  test("have their weights in the order of the displacements, and may be USEd", () => {
    const scene = sceneOf(`<Shape>${morph}<HAnimDisplacer DEF="a" weight="0.5"/><HAnimDisplacer weight="-2"/></Shape>
      <Shape>${morph}<HAnimDisplacer USE="a"/></Shape>`);
    assert.deepEqual(
      shapesOf(scene.root).map(({ deformer }) => deformer?.displacers.map(({ weight }) => weight)),
      [[0.5, -2], [0.5]],
    );
    assert.deepEqual(scene.warnings, []);
  });

  test("beyond the displacements have no effect, with one sentence", () => {
    const scene = sceneOf(`<Shape>${morph}${"<HAnimDisplacer weight='1'/>".repeat(3)}</Shape>`);
    assert.equal(onlyShapeOf(scene).deformer?.displacers.length, 2);
    assert.deepEqual(messagesOf(scene), ["Shape has 3 HAnimDisplacers for 2 displacements: the last have no effect"]);
  });
});
