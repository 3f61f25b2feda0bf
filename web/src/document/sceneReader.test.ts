import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { SceneDescription } from "./description.ts";
import { shapesOf } from "./description.ts";
import { Dice, EditedDocument, elementsIn } from "./edits.testing.ts";
import type { SceneElement } from "./element.ts";
import { elementsOf } from "./elements.testing.ts";
import { readScene } from "./readScene.ts";
import { readInlineGeometry } from "./inlineGeometry.ts";
import { SceneReader } from "./sceneReader.ts";

/** A description as text: elements and geometries by number, so that equal texts mean the same ones. */
function textOf(scene: SceneDescription, numbers: Map<SceneElement, number>): string {
  const numberOf = (element: SceneElement) => {
    if (!numbers.has(element)) numbers.set(element, numbers.size);
    return numbers.get(element);
  };
  const shared = [...new Set(shapesOf(scene.root).map(({ geometry }) => geometry))];
  const replacer = (key: string, value: unknown) => {
    if (key === "element" || key === "host") return numberOf(value as SceneElement);
    return key === "geometry" ? { is: shared.indexOf(value as (typeof shared)[number]), ...(value as object) } : value;
  };
  return JSON.stringify({ ...scene, warnings: scene.warnings.map(({ message }) => message) }, replacer, 1);
}

describe("a document that changes", () => {
  test("reads as a fresh reader reads it", () => {
    let shapes = 0;
    for (let seed = 1; seed <= 40; ++seed) {
      const dice = new Dice(seed);
      const edited = new EditedDocument(dice);
      const numbers = new Map<SceneElement, number>();
      for (let round = 0; round < 25; ++round) {
        for (let edits = dice.below(4); edits >= 0; --edits) edited.edit();
        const [again, afresh] = [edited.reader.read(), readScene(edited.x3d, edited)];
        assert.equal(textOf(again, numbers), textOf(afresh, numbers), `seed ${seed}, round ${round}`);
        shapes += shapesOf(afresh.root).length;
      }
    }
    assert.ok(shapes > 5000, `only ${shapes} shapes have been read`);
  });

  const x3d =
    elementsOf(`<X3D><Scene><Transform id="t"><Shape><Appearance DEF="A"><Material id="m"/></Appearance><Box/></Shape></Transform>
    <Group id="g"><Shape id="user"><Appearance USE="A"/><Sphere/></Shape></Group><Group><Shape><Box id="b"/></Shape></Group></Scene></X3D>`);
  const named = (id: string) => {
    const element = elementsIn(x3d).find(({ attributes: own }) => own.get("id") === id);
    assert.ok(element);
    return element;
  };
  /** Which of the groups are other objects after `change`. */
  const changedBy = (change: (reader: SceneReader) => void) => {
    const reader = new SceneReader(x3d, { inlineGeometry: readInlineGeometry });
    const before = reader.read().root.children;
    change(reader);
    return reader.read().root.children.map((node, place) => node !== before[place]);
  };

  test("keeps the objects of everything unchanged", () => {
    const reader = new SceneReader(x3d, { inlineGeometry: readInlineGeometry });
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
      "what is USEd says the same everywhere",
    );
    assert.deepEqual(
      changedBy((other) => {
        other.touch(named("b"));
      }),
      [false, false, true],
    );
  });

  test("gives the geometry of a shape that is moved or coloured as the same object", () => {
    const reader = new SceneReader(x3d, { inlineGeometry: readInlineGeometry });
    const geometryOf = () => shapesOf(reader.read().root).map(({ geometry }) => geometry);
    const before = geometryOf();
    for (const id of ["t", "m", "b", "user"]) reader.touch(named(id));
    assert.deepEqual(
      geometryOf().map((geometry, place) => geometry === before[place]),
      [true, true, true],
    );
  });
});

test("groups that USE one another exponentially are cut off at the limit of instances", () => {
  const bomb = Array.from(
    { length: 40 },
    (_, i) => `<Group DEF="g${i + 1}"><Group USE="g${i}"/><Group USE="g${i}"/></Group>`,
  );
  const x3d = elementsOf(
    `<X3D><Scene><Group DEF="g0"><Shape><Box/></Shape></Group>${bomb.join("")}<Shape><Sphere/></Shape></Scene></X3D>`,
  );
  const reader = new SceneReader(x3d, { inlineGeometry: readInlineGeometry }, 1000);
  const shown = reader.read();
  assert.deepEqual(
    shown.warnings.map(({ message }) => message),
    ["has more than 1000 instances of nodes: the rest is left out"],
  );
  const count = shapesOf(shown.root).length;
  assert.ok(count > 300 && count < 1000, `${count} shapes`);

  const scene = x3d.children[0];
  assert.ok(scene);
  scene.children.splice(6, 35); // what is left are g0 to g5 and the sphere
  reader.rearrange(scene);
  const rest = reader.read();
  assert.deepEqual(rest.warnings, []);
  assert.equal(shapesOf(rest.root).length, 1 + 2 + 4 + 8 + 16 + 32 + 1);
});
