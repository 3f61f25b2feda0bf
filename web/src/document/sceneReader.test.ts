import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { SceneDescription } from "./description.ts";
import { shapesOf } from "./description.ts";
import { RandomNumbers, EditedDocument, elementsIn } from "./edits.testing.ts";
import type { SceneElement } from "./element.ts";
import { elementsOf } from "./elements.testing.ts";
import { operatorReader } from "./operatorReader.ts";
import { readScene } from "./readScene.ts";
import { inlineGeometryReader } from "./inlineGeometry.ts";
import { SceneReader } from "./sceneReader.ts";

/** A description as text, with numbers for elements and geometries: equal texts mean the same objects. */
function textOf(scene: SceneDescription, numbers: Map<SceneElement, number>): string {
  const numberOf = (element: SceneElement) => {
    if (!numbers.has(element)) numbers.set(element, numbers.size);
    return numbers.get(element);
  };
  const shared = [...new Set(shapesOf(scene.root).map(({ geometry }) => geometry))];
  const replacer = (key: string, value: unknown) => {
    if (key === "element" || key === "host") return numberOf(value as SceneElement);
    return key === "geometry"
      ? { sharedIndex: shared.indexOf(value as (typeof shared)[number]), ...(value as object) }
      : value;
  };
  return JSON.stringify({ ...scene, warnings: scene.warnings.map(({ message }) => message) }, replacer, 1);
}

describe("a document that changes", () => {
  test("gives the same scene as a new reader", () => {
    let shapeCount = 0;
    for (let seed = 1; seed <= 40; ++seed) {
      const random = new RandomNumbers(seed);
      const edited = new EditedDocument(random);
      const numbers = new Map<SceneElement, number>();
      for (let round = 0; round < 25; ++round) {
        for (let edits = random.below(4); edits >= 0; --edits) edited.edit();
        const [updated, expected] = [edited.reader.read(), readScene(edited.x3d, edited)];
        assert.equal(textOf(updated, numbers), textOf(expected, numbers), `seed ${seed}, round ${round}`);
        shapeCount += shapesOf(expected.root).length;
      }
    }
    assert.ok(shapeCount > 5000, `only ${shapeCount} shapes have been read`);
  });

  const x3d =
    elementsOf(`<X3D><Scene><Transform id="t"><Shape><Appearance DEF="A"><Material id="m"/></Appearance><Box/></Shape></Transform>
    <Group id="g"><Shape id="user"><Appearance USE="A"/><Sphere/></Shape></Group><Group><Shape><Box id="b"/></Shape></Group></Scene></X3D>`);
  const named = (id: string) => {
    const element = elementsIn(x3d).find(({ attributes }) => attributes.get("id") === id);
    assert.ok(element);
    return element;
  };
  /** For each group, whether `change` makes its description another object. */
  const changedBy = (change: (reader: SceneReader) => void) => {
    const reader = new SceneReader(x3d, { inlineGeometry: inlineGeometryReader });
    const before = reader.read().root.children;
    change(reader);
    return reader.read().root.children.map((node, index) => node !== before[index]);
  };

  test("keeps the objects of everything unchanged", () => {
    const reader = new SceneReader(x3d, { inlineGeometry: inlineGeometryReader });
    assert.equal(reader.read(), reader.read());
    assert.deepEqual(
      changedBy((other) => {
        other.touch(named("t"));
      }),
      [true, false, false],
    );
    assert.deepEqual(
      changedBy((other) => {
        other.touch(named("m"));
      }),
      [true, true, false],
      "a change of a USEd node changes all its users",
    );
    assert.deepEqual(
      changedBy((other) => {
        other.touch(named("b"));
      }),
      [false, false, true],
    );
  });

  test("keeps the geometry object of a shape that is moved or colored", () => {
    const reader = new SceneReader(x3d, { inlineGeometry: inlineGeometryReader });
    const geometryOf = () => shapesOf(reader.read().root).map(({ geometry }) => geometry);
    const before = geometryOf();
    for (const id of ["t", "m", "b", "user"]) reader.touch(named(id));
    assert.deepEqual(
      geometryOf().map((geometry, index) => geometry === before[index]),
      [true, true, true],
    );
  });
});

test("changed operators are applied to the geometry that was read", () => {
  const x3d = elementsOf('<X3D><Scene><Shape><Sphere operators="negate(x)"/></Shape></Scene></X3D>');
  const sphere = elementsIn(x3d).find(({ localName }) => localName === "Sphere");
  assert.ok(sphere);
  let readings = 0;
  const inlineGeometry: typeof inlineGeometryReader = {
    ...inlineGeometryReader,
    read: (...args) => {
      readings += 1;
      return inlineGeometryReader.read(...args);
    },
  };
  const reader = new SceneReader(x3d, { inlineGeometry, operators: operatorReader });
  const [before] = shapesOf(reader.read().root);
  sphere.attributes.set("operators", "scale(0.5)");
  reader.touchAttribute(sphere, "operators");
  const [after] = shapesOf(reader.read().root);
  assert.ok(after?.geometry);
  assert.equal(after.geometry, before?.geometry);
  assert.deepEqual(after.appearance.operators, operatorReader.read("scale(0.5)", after.geometry).operators);
  assert.equal(readings, 1);
  sphere.attributes.set("radius", "2");
  reader.touchAttribute(sphere, "operators");
  reader.touchAttribute(sphere, "radius");
  reader.touchAttribute(sphere, "operators");
  assert.notEqual(shapesOf(reader.read().root)[0]?.geometry, before?.geometry);
});

test("groups that USE one another exponentially are cut off at the limit of instances", () => {
  const nestedGroups = Array.from(
    { length: 40 },
    (_, i) => `<Group DEF="g${i + 1}"><Group USE="g${i}"/><Group USE="g${i}"/></Group>`,
  );
  const x3d = elementsOf(
    `<X3D><Scene><Group DEF="g0"><Shape><Box/></Shape></Group>${nestedGroups.join("")}<Shape><Sphere/></Shape></Scene></X3D>`,
  );
  const reader = new SceneReader(x3d, { inlineGeometry: inlineGeometryReader }, 1000);
  const truncated = reader.read();
  assert.deepEqual(
    truncated.warnings.map(({ message }) => message),
    ["has more than 1000 instances of nodes: the rest is left out"],
  );
  const count = shapesOf(truncated.root).length;
  assert.ok(count > 300 && count < 1000, `${count} shapes`);

  const scene = x3d.children[0];
  assert.ok(scene);
  scene.children.splice(6, 35); // g0 to g5 and the sphere remain
  reader.rearrange(scene);
  const remaining = reader.read();
  assert.deepEqual(remaining.warnings, []);
  assert.equal(shapesOf(remaining.root).length, 1 + 2 + 4 + 8 + 16 + 32 + 1);
});
