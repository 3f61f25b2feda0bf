import assert from "node:assert/strict";
import { test } from "node:test";
import { Object3D, PerspectiveCamera, PointLight, Vector3 } from "three";
import type { SceneDescription, ShapeDescription } from "../../document/description.ts";
import { RandomNumbers, EditedDocument } from "../../document/edits.testing.ts";
import { elementsOf } from "../../document/elements.testing.ts";
import { nodeFields } from "../../document/nodes.ts";
import { readScene } from "../../document/readScene.ts";
import { inlineGeometryReader } from "../../document/inlineGeometry.ts";
import { SceneReader } from "../../document/sceneReader.ts";
import { matrixOf } from "../../scene/transforms.ts";
import type { TransformChange } from "../../scene/instanceTree.ts";
import type { NodeInstance } from "../../scene/nodeInstance.ts";
import type { ShapeGroup } from "./shapeGroup.ts";
import type { ShapeInstanceListener } from "./sceneGroups.ts";
import { SceneGroups } from "./sceneGroups.ts";
import { addVisited } from "./visitedGroup.ts";

const viewer = new PerspectiveCamera();
viewer.position.set(3, 1, 5);
viewer.updateMatrixWorld();

/** A SceneGroups, and the shape instances that it has reported. */
class Watched {
  readonly moved: NodeInstance[] = [];
  readonly shapes = new Map<NodeInstance, { shape: ShapeDescription; group: ShapeGroup }>();
  readonly graph: SceneGroups;
  readonly #listener: ShapeInstanceListener = {
    onEnter: (shape, instance, group) => {
      assert.ok(!this.shapes.has(instance));
      this.shapes.set(instance, { shape, group });
      addVisited(group, [new Object3D()]); // as what draws the shape
      group.updateMatrixWorld(true);
    },
    onChange: (shape, instance, group, before) => {
      assert.deepEqual([this.shapes.get(instance)?.shape, this.shapes.get(instance)?.group], [before, group]);
      this.shapes.set(instance, { shape, group });
    },
    onLeave: (_, instance) => {
      assert.ok(this.shapes.delete(instance));
    },
  };

  /** `isWorld`: see ShapeInstanceListener. */
  constructor(isWorld = false) {
    this.graph = new SceneGroups({ ...this.#listener, isWorld });
  }

  /** Everything that a renderer can see. */
  get seen(): unknown {
    this.graph.rotateBillboards(viewer);
    const { box, boundedGroups, viewpoints, lods, lightUniforms, root } = this.graph;
    const groups = (of: Object3D): string =>
      of.children
        .map((group) => [group.type, group.visible, group.matrixWorld.elements, groups(group)].join(" "))
        .sort()
        .join();
    const shapes = Array.from(this.shapes.values(), ({ shape, group }) =>
      [shape.priority, group.visible, group.effectScope?.value, group.matrixWorld.elements].join(" "),
    );
    return {
      box,
      bounded: boundedGroups.map((each) => each.box),
      viewpoints,
      lods,
      lightUniforms,
      shapes: shapes.sort(),
      groups: groups(root),
    };
  }

  /** The same without elements, which differ from document to document. */
  get seenText(): string {
    return JSON.stringify(this.seen, (name, value: unknown) => (name === "element" ? undefined : value));
  }
}

function buildGraph(scene: SceneDescription): SceneGroups {
  const { graph } = new Watched();
  graph.follow(scene.root);
  return graph;
}

test("groups that follow edits of a document equal groups that are made from the edited document", () => {
  let shapes = 0;
  for (let seed = 1; seed <= 30; ++seed) {
    const edited = new EditedDocument(new RandomNumbers(seed));
    const following = new Watched();
    for (let round = 0; round < 15; ++round) {
      for (let edits = seed % 4; edits >= 0; --edits) edited.edit();
      const { root } = edited.reader.read();
      const fresh = new Watched();
      for (const each of [following, fresh]) each.graph.follow(root);
      assert.deepEqual(following.seen, fresh.seen, `seed ${seed}, round ${round}`);
      shapes += following.shapes.size;
    }
  }
  assert.ok(shapes > 3000, `only ${shapes} shapes have been shown`);
});

test("shapes that have not changed are not reported again", () => {
  const x3d = elementsOf(
    "<X3D><Transform><Shape/></Transform><Transform><Shape/></Transform><Group><Shape/></Group></X3D>",
  );
  const reader = new SceneReader(x3d, { inlineGeometry: inlineGeometryReader });
  const reported: string[] = [];
  const report = (shape: ShapeDescription) => {
    reported.push(shape.element === x3d.children[1]?.children[0] ? "second" : "another");
  };
  const graph = new SceneGroups({ onEnter: report, onChange: report, onLeave: report });
  graph.follow(reader.read().root);
  assert.equal(reported.splice(0).length, 3);
  x3d.children[1]?.attributes.set("translation", "1 0 0");
  for (const element of x3d.children) reader.touch(element);
  graph.follow(reader.read().root);
  assert.deepEqual(reported, ["second"]);
});

const movingDocument = (a: string, b: string, size: string): string => `<X3D><Viewpoint/>
  <Transform translation="${a}"><Shape><Box size="2 2 2"/></Shape><PointLight global="true"/><Viewpoint position="0 0 1"/>
    <Transform rotation="0 0 1 ${b}" center="1 0 0"><Shape><Sphere/></Shape><Group><Shape><Cone/></Shape></Group></Transform>
  </Transform>
  <Group bboxSize="${size}"><Transform translation="${a}"><Shape><Box/></Shape></Transform><Shape><Box size="1 9 1"/></Shape></Group>
  <Billboard><Transform translation="${a}"><Shape><Box size="3 1 1"/></Shape></Transform></Billboard>
  <Transform scale="2 2 2"><Group bboxSize="4 4 4"><Shape><Box/></Shape></Group></Transform></X3D>`;

for (const isWorld of [false, true])
  test(`moved Transforms are where a document with their values has them, and boxes around them no longer count${isWorld ? ", in groups that share matrices" : ""}`, () => {
    const values = ["0 0 0", "5 1 0", "-3 0 8", "100 0 0", "5 1 0"];
    const x3d = elementsOf(movingDocument("0 0 0", "0", "6 6 6"));
    const reader = new SceneReader(x3d, { inlineGeometry: inlineGeometryReader });
    const moving = new Watched(isWorld);
    moving.graph.follow(reader.read().root);
    const transforms = (root: typeof x3d): (typeof x3d)[] => [
      ...(root.localName === "Transform" ? [root] : []),
      ...root.children.flatMap(transforms),
    ];
    for (const [round, value] of values.entries()) {
      const translation = value.split(" ").map(Number);
      const rotation = [0, 0, 1, round];
      moving.graph.move(
        transforms(x3d).flatMap((element): TransformChange[] => [
          ...(element.attributes.has("translation")
            ? [{ element, field: "translation" as const, value: translation }]
            : []),
          ...(element.attributes.has("rotation") ? [{ element, field: "rotation" as const, value: rotation }] : []),
        ]),
      );
      const fresh = new Watched();
      // Without the box of the group in which something has moved.
      fresh.graph.follow(
        readScene(elementsOf(movingDocument(value, String(round), "-1 -1 -1")), {
          inlineGeometry: inlineGeometryReader,
        }).root,
      );
      assert.equal(moving.seenText, fresh.seenText, `round ${round}`);
    }
    for (const element of transforms(x3d)) {
      if (element.attributes.has("translation")) element.attributes.set("translation", values.at(-1) ?? "");
      if (element.attributes.has("rotation")) element.attributes.set("rotation", `0 0 1 ${values.length - 1}`);
      reader.touch(element);
    }
    const before = moving.seenText;
    moving.graph.follow(reader.read().root);
    assert.equal(moving.seenText, before, "the document says the same");
  });

const identity = Object.fromEntries(
  Object.entries(nodeFields.Transform).map(([name, field]) => [name, field.defaultValue]),
) as Parameters<typeof matrixOf>[0];

function transformed(changes: Partial<typeof identity>, point: [number, number, number]): number[] {
  return new Vector3(...point)
    .applyMatrix4(matrixOf({ ...identity, ...changes }))
    .toArray()
    .map((value) => Math.round(value * 1e9) / 1e9);
}

test("a Transform scales, then rotates, then translates", () => {
  assert.deepEqual(transformed({}, [1, 2, 3]), [1, 2, 3]);
  assert.deepEqual(
    transformed({ translation: [10, 0, 0], rotation: [0, 0, 5, Math.PI / 2], scale: [2, 1, 1] }, [1, 0, 0]),
    [10, 2, 0],
  );
});

test("a Transform's center stays fixed under rotation and scaling", () => {
  assert.deepEqual(transformed({ center: [1, 2, 3], rotation: [1, 1, 0, 2], scale: [3, 4, 5] }, [1, 2, 3]), [1, 2, 3]);
});

test("a Transform scales along the axes of its scaleOrientation", () => {
  assert.deepEqual(transformed({ scaleOrientation: [0, 0, 1, Math.PI / 4], scale: [3, 1, 1] }, [1, 1, 0]), [3, 3, 0]);
  assert.deepEqual(transformed({ scaleOrientation: [0, 0, 1, Math.PI / 4], scale: [3, 1, 1] }, [1, -1, 0]), [1, -1, 0]);
});

test("a rotation without an axis has no effect", () => {
  assert.deepEqual(transformed({ rotation: [0, 0, 0, 1] }, [1, 2, 3]), [1, 2, 3]);
});

test("a scene's box contains its visible shapes, with their transforms", () => {
  const box = (size: string) => `<Shape bboxCenter="0 0 0" bboxSize="${size}"/>`;
  const scene = readScene(
    elementsOf(`<X3D><Transform translation="10 0 0" scale="2 1 1">${box("2 2 2")}
    <Group visible="false">${box("100 100 100")}</Group><Switch whichChoice="1">${box("90 90 90")}${box("1 1 8")}</Switch></Transform></X3D>`),
  );
  const {
    box: { min, max },
  } = buildGraph(scene);
  assert.deepEqual(
    [min.toArray(), max.toArray()],
    [
      [8, -1, -4],
      [12, 1, 4],
    ],
  );
});

test("a scaled-up light reaches further, and lights what it reaches as brightly as before", () => {
  const scene = readScene(
    elementsOf(`<X3D><Transform scale="4 4 4"><Transform scale="-1 1 1">
    <PointLight radius="10" attenuation="1 0.5 0.25"/></Transform></Transform></X3D>`),
  );
  const {
    root,
    lightUniforms: { attenuations },
  } = buildGraph(scene);
  const lights: PointLight[] = [];
  root.traverse((object) => {
    if (object instanceof PointLight) lights.push(object);
  });
  assert.deepEqual(
    lights.map(({ distance, decay }) => [distance, attenuations.value[decay]?.toArray()]),
    [[40, [1, 0.125, 0.015625]]],
  );
});

test("shapes with infinite, zero or mirrored scales do not spoil the scene's box", () => {
  const shape = '<Shape bboxCenter="0 0 0" bboxSize="2 2 2"/>';
  const scaled = ["1e30 1e30 1e30", "1e308 1e308 1e308", "0 0 0", "1e-300 1 1", "-1 1 1"].map(
    (scale) => `<Transform scale="${scale}">${shape}</Transform>`,
  );
  const {
    box: { min, max },
  } = buildGraph(readScene(elementsOf(`<X3D>${shape}${scaled.join("")}</X3D>`)));
  assert.deepEqual(
    [min.toArray(), max.toArray()],
    [
      [-1, -1, -1],
      [1, 1, 1],
    ],
  );
  const scene = readScene(elementsOf(`<X3D><Transform scale="NaN 1 1">${shape}</Transform></X3D>`));
  assert.match(scene.warnings[0]?.message ?? "", /scale="NaN 1 1" is no SFVec3f/);
});

test("a group's bounding box field stands for the boxes of its children, and lets them be culled together", () => {
  const scene = readScene(
    elementsOf(`<X3D><Transform translation="10 0 0" scale="2 1 1" bboxCenter="1 0 0" bboxSize="4 2 2">
    <Shape bboxCenter="0 0 0" bboxSize="90 90 90"/><Group bboxCenter="0 0 0" bboxSize="1 1 1"><Shape/></Group></Transform>
    <Group visible="false" bboxCenter="0 0 0" bboxSize="500 1 1"><Shape/></Group></X3D>`),
  );
  const {
    box: { min, max },
    boundedGroups,
  } = buildGraph(scene);
  assert.deepEqual(
    [min.toArray(), max.toArray()],
    [
      [8, -1, -1],
      [16, 1, 1],
    ],
  );
  assert.deepEqual(
    boundedGroups.map(({ box }) => [box.min.x, box.max.x]),
    [
      [8, 16],
      [9, 11],
    ],
  );
});

test("a billboard turns its z axis to the viewer, together with its content", () => {
  const scene = readScene(
    elementsOf(`<X3D><Transform translation="3 0 0" rotation="0 1 0 1.5708"><Billboard><Transform translation="0 2 1">
    <Shape bboxCenter="0 0 0" bboxSize="0.1 0.1 0.1"/></Transform></Billboard></Transform></X3D>`),
  );
  const watched = new Watched();
  watched.graph.follow(scene.root);
  const seenFrom = (...eye: [number, number, number]): number[] => {
    const camera = new PerspectiveCamera();
    camera.position.set(...eye);
    camera.updateMatrixWorld();
    watched.graph.rotateBillboards(camera);
    const [{ group } = { group: undefined }] = watched.shapes.values();
    return new Vector3()
      .setFromMatrixPosition(group?.matrixWorld ?? viewer.matrixWorld)
      .toArray()
      .map((value) => Math.round(value * 1e3) / 1e3 + 0);
  };
  assert.deepEqual(
    [seenFrom(3, 9, 7), seenFrom(-4, 0, 0), seenFrom(3, 0, -1), seenFrom(3, 8, 0)],
    [
      [3, 2, 1],
      [2, 2, 0],
      [3, 2, -1],
      [4, 2, 0],
    ],
  );
  const { min, max } = watched.graph.box;
  for (const corner of [
    [3, 2, 1.1],
    [1.9, 2, 0],
    [4.1, 2, 0],
  ] as const)
    assert.ok(min.x <= corner[0] && max.x >= corner[0] && max.y >= 2.05 && max.z >= corner[2]);
});

test("the matrices of a skin map from the shape as it was modelled to its joints, relative to the shape", () => {
  const scene = readScene(
    elementsOf(`<X3D><Scene>
      <Transform translation="0 5 0"><HAnimJoint DEF="hip" rotation="0 0 1 1.5707963267948966"/></Transform>
      <HAnimHumanoid translation="10 0 0" inverseBindMatrices="1 0 0 0  0 1 0 0  0 0 1 0  -1 0 0 1">
        <HAnimJoint USE="hip" containerField="joints"/>
        <Shape><BinaryGeometry coord="c.bin"><FloatVertexAttribute name="skin.joints0" numComponents="4"/>
          <FloatVertexAttribute name="skin.weights0" numComponents="4"/>
          <GeometryPatch coord="c.bin" attrib='"j.bin" "w.bin"'/></BinaryGeometry></Shape>
      </HAnimHumanoid></Scene></X3D>`),
  );
  const { graph } = new Watched();
  graph.follow(scene.root);
  const [pose] = Array.from(graph.poses());
  const [matrix] = pose?.matrices ?? [];
  assert.ok(matrix);
  // The point (2, 0, 0) is (1, 0, 0) at the joint, which turns it to (0, 1, 0) and stands at (0, 5, 0).
  const moved = new Vector3(2, 0, 0).applyMatrix4(matrix);
  assert.ok(moved.distanceTo(new Vector3(-10, 6, 0)) < 1e-6, JSON.stringify(moved));
});
