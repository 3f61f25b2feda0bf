import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { SceneDescription } from "./description.ts";
import { shapesOf } from "./description.ts";
import type { SceneElement } from "./element.ts";
import { elementsOf, type TestElement } from "./elements.testing.ts";
import type { Supplements } from "./readScene.ts";
import { readScene } from "./readScene.ts";
import { SceneReader } from "./sceneReader.ts";

/** Numbers that look random and are the same in every run (Marsaglia 2003, xorshift). */
class Dice {
  #state: number;

  constructor(seed: number) {
    this.#state = seed * 2654435769 + 1;
  }

  below(count: number): number {
    this.#state ^= this.#state << 13;
    this.#state ^= this.#state >>> 17;
    this.#state ^= this.#state << 5;
    return (this.#state >>> 0) % count;
  }

  of<Item>(items: readonly Item[]): Item {
    const item = items[this.below(items.length)];
    if (item === undefined) throw new RangeError("nothing to choose from");
    return item;
  }
}

const names = ["A", "B", "C", "D"];
const geometries = [
  '<Box size="1 2 3"/>', '<Box size="no"/>', '<PointSet><Coordinate DEF="C" point="1 2 3"/></PointSet>', '<PointSet DEF="E"><Coordinate USE="C"/></PointSet>',
  '<PointSet USE="E"/>',
  '<ImageGeometry DEF="B" vertexCount="3" coord="a.png" priority="2"/>', '<ImageGeometry USE="B"/>',
];
const snippets = [
  "<Group/>", "<Transform/>", '<Switch whichChoice="0"/>', "<LOD range='5'/>", "<Unknown/>", '<Viewpoint description="v"/>', "<DirectionalLight/>",
  '<NavigationInfo speed="3"/>', '<Background skyColor="1 0 0"/>', "<Group USE='A'/>", "<Shape USE='D'/>", "<Inline url='a.x3d'/>", '<MetadataString name="m"/>',
  '<Shape><Appearance DEF="A"><Material DEF="D"/></Appearance><Box/></Shape>', '<Shape><Appearance USE="A"/><Box/></Shape>',
  ...geometries.map((geometry) => `<Shape>${geometry}</Shape>`),
];
const attributes: Readonly<Record<string, readonly string[]>> = {
  DEF: names, USE: names, visible: ["true", "false", "perhaps"], priority: ["2", "high"], translation: ["1 2 3", "x"], bboxSize: ["1 1 1", "2 2 2"],
  whichChoice: ["0", "1", "-1"], diffuseColor: ["1 0 0", "0 1 0"], bind: ["true"], load: ["false"], url: ["a.x3d", "b.x3d"], solid: ["false"],
  point: ["3 4 5", "6 7 8"],
};
const inlinable = {
  "a.x3d": `<X3D><Group DEF="A"><Shape><Box/></Shape></Group><Group USE="A"/><Inline url="b.x3d"/><NavigationInfo speed="9"/></X3D>`,
  "b.x3d": `<X3D><LOD range="1"><Shape id="near"/><Shape id="far"/></LOD><Inline url="a.x3d"/></X3D>`,
};

/** A document that is edited, with what is told of it besides. */
class Edited implements Supplements {
  readonly x3d = elementsOf(`<X3D><Scene>${snippets.join("")}</Scene></X3D>`);
  readonly reader = new SceneReader(this.x3d, this);
  readonly #dice: Dice;
  readonly #documents = Object.entries(inlinable).map(([url, text]) => ({ url, x3d: elementsOf(text) }));
  readonly #arrived = new Set<SceneElement>();
  readonly #levels = new Map<SceneElement, number>();

  constructor(dice: Dice) {
    this.#dice = dice;
  }

  readonly inlined = (inline: SceneElement) =>
    (this.#arrived.has(inline) ? this.#documents.find(({ url }) => inline.getAttribute("url")?.includes(url)) : undefined);

  readonly levelOf = (lod: SceneElement) => this.#levels.get(lod);

  edit(): void {
    const dice = this.#dice;
    const element = dice.of(elementsIn(this.x3d));
    const others = elementsIn(this.x3d).slice(2);
    switch (dice.below(8)) {
      case 0: case 1: this.#insert(elementsOf(dice.of(snippets)), element); break;
      case 2: if (others.length > 0) this.#remove(dice.of(others)); break;
      case 3: if (others.length > 0) this.#move(dice.of(others), element); break;
      case 4: this.#rearrange(element); break;
      case 5: this.#supplement(); break;
      default: this.#set(element);
    }
  }

  #insert(element: TestElement, parent: TestElement): void {
    parent.children.splice(this.#dice.below(parent.children.length + 1), 0, element);
    this.reader.rearrange(parent);
  }

  #remove(element: TestElement): void {
    const parent = elementsIn(this.x3d).find(({ children }) => children.includes(element));
    if (parent === undefined) return;
    parent.children.splice(parent.children.indexOf(element), 1);
    this.reader.rearrange(parent);
  }

  #move(element: TestElement, parent: TestElement): void {
    if (elementsIn(element).includes(parent)) return;
    this.#remove(element);
    this.#insert(element, parent);
  }

  #rearrange(element: TestElement): void {
    element.children.reverse();
    this.reader.rearrange(element);
  }

  #supplement(): void {
    const reached = [this.x3d, ...this.#documents.map(({ x3d }) => x3d)].flatMap(elementsIn);
    const some = reached.filter(({ localName }) => ["Inline", "LOD"].includes(localName));
    if (some.length === 0) return;
    const element = this.#dice.of(some);
    if (element.localName === "LOD") this.#levels.set(element, this.#dice.below(2));
    else if (!this.#arrived.delete(element)) this.#arrived.add(element);
    this.reader.touch(element);
  }

  #set(element: TestElement): void {
    const name = element.localName === "Coordinate" ? "point" : this.#dice.of(Object.keys(attributes));
    const hadName = element.attributes.delete(name);
    if (!hadName || this.#dice.below(2) === 0) element.attributes.set(name, this.#dice.of(attributes[name] ?? []));
    this.reader.touch(element);
  }
}

function elementsIn(element: TestElement): TestElement[] {
  return [element, ...element.children.flatMap(elementsIn)];
}

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
  test("reads as if it had been written so from the start", () => {
    let shapes = 0;
    for (let seed = 1; seed <= 40; ++seed) {
      const dice = new Dice(seed);
      const edited = new Edited(dice);
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

  const x3d = elementsOf(`<X3D><Scene><Transform id="t"><Shape><Appearance DEF="A"><Material id="m"/></Appearance><Box/></Shape></Transform>
    <Group id="g"><Shape id="user"><Appearance USE="A"/><Sphere/></Shape></Group><Group><Shape><Box id="b"/></Shape></Group></Scene></X3D>`);
  const named = (id: string) => {
    const element = elementsIn(x3d).find(({ attributes: own }) => own.get("id") === id);
    assert.ok(element);
    return element;
  };
  /** Which of the groups are other objects after `change`. */
  const changedBy = (change: (reader: SceneReader) => void) => {
    const reader = new SceneReader(x3d);
    const before = reader.read().root.children;
    change(reader);
    return reader.read().root.children.map((node, place) => node !== before[place]);
  };

  test("is the same object where nothing has, and the same objects but for what has", () => {
    const reader = new SceneReader(x3d);
    assert.equal(reader.read(), reader.read());
    assert.deepEqual(changedBy((other) => { other.touch(named("t")); }), [true, false, false]);
    assert.deepEqual(changedBy((other) => { other.touch(named("m")); }), [true, true, false], "what is USEd says the same everywhere");
    assert.deepEqual(changedBy((other) => { other.touch(named("b")); }), [false, false, true]);
  });

  test("gives the geometry of a shape that is moved or coloured as the same object", () => {
    const reader = new SceneReader(x3d);
    const geometryOf = () => shapesOf(reader.read().root).map(({ geometry }) => geometry);
    const before = geometryOf();
    for (const id of ["t", "m", "b", "user"]) reader.touch(named(id));
    assert.deepEqual(geometryOf().map((geometry, place) => geometry === before[place]), [true, true, true]);
  });
});
