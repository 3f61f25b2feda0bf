// Documents that are edited at random, with the state that Inlines and LODs get from outside, for tests that compare an
// updated result with a result from scratch.

import type { SceneElement } from "./element.ts";
import { elementsOf, type TestElement } from "./elements.testing.ts";
import type { SceneReaderOptions } from "./readScene.ts";
import { inlineGeometryReader } from "./inlineGeometry.ts";
import { refusals } from "./refused.ts";
import { SceneReader } from "./sceneReader.ts";

/** Numbers that look random and are the same in every run (Marsaglia 2003, xorshift). */
export class RandomNumbers {
  #state: number;

  constructor(seed: number) {
    this.#state = seed * 2654435769 + 1;
  }

  /** An integer from 0 to `count` - 1. */
  below(count: number): number {
    this.#state ^= this.#state << 13;
    this.#state ^= this.#state >>> 17;
    this.#state ^= this.#state << 5;
    return (this.#state >>> 0) % count;
  }

  choose<Item>(items: readonly Item[]): Item {
    const item = items[this.below(items.length)];
    if (item === undefined) throw new RangeError("nothing to choose from");
    return item;
  }
}

const names = ["A", "B", "C", "D"];
const geometries = [
  '<Box size="1 2 3"/>',
  '<Box size="no"/>',
  '<PointSet><Coordinate DEF="C" point="1 2 3"/></PointSet>',
  '<PointSet DEF="E"><Coordinate USE="C"/></PointSet>',
  '<PointSet USE="E"/>',
  '<ImageGeometry DEF="B" vertexCount="3" coord="a.png" priority="2"/>',
  '<ImageGeometry USE="B"/>',
];
const snippets = [
  "<Group/>",
  "<Transform/>",
  "<Billboard><Shape/></Billboard>",
  '<Anchor url="a.html"><Collision><Shape/></Collision></Anchor>',
  '<Switch whichChoice="0"/>',
  "<LOD range='5'/>",
  "<Unknown/>",
  '<Viewpoint description="v"/>',
  "<DirectionalLight/>",
  '<PointLight global="false" ambientIntensity="1"/>',
  '<Transform><SpotLight global="false"/><Group><DirectionalLight/><Shape/></Group></Transform>',
  '<NavigationInfo speed="3"/>',
  '<Background skyColor="1 0 0"/>',
  "<Group USE='A'/>",
  "<Shape USE='D'/>",
  "<Inline url='a.x3d'/>",
  '<MetadataString name="m"/>',
  '<Shape><Appearance DEF="A"><Material DEF="D"/></Appearance><Box/></Shape>',
  '<Shape><Appearance USE="A"/><Box/></Shape>',
  ...geometries.map((geometry) => `<Shape>${geometry}</Shape>`),
];
const attributes: Readonly<Record<string, readonly string[]>> = {
  DEF: names,
  USE: names,
  visible: ["true", "false", "perhaps"],
  priority: ["2", "high"],
  translation: ["1 2 3", "x"],
  bboxSize: ["1 1 1", "2 2 2"],
  whichChoice: ["0", "1", "-1"],
  diffuseColor: ["1 0 0", "0 1 0"],
  bind: ["true"],
  load: ["false"],
  url: ["a.x3d", "b.x3d"],
  solid: ["false"],
  point: ["3 4 5", "6 7 8"],
  global: ["true", "false"],
  on: ["false"],
  axisOfRotation: ["0 0 1", "1 0 0", "0 0 0"],
};
const inlinable = {
  "a.x3d": `<X3D><Group DEF="A"><Shape><Box/></Shape></Group><Group USE="A"/><Inline url="b.x3d"/><NavigationInfo speed="9"/></X3D>`,
  "b.x3d": `<X3D><LOD range="1"><Shape id="near"/><Shape id="far"/></LOD><Inline url="a.x3d"/></X3D>`,
};

/** A document, a reader that follows its edits, and the options of both this reader and a new one. */
export class EditedDocument implements SceneReaderOptions {
  readonly x3d = elementsOf(`<X3D><Scene>${snippets.join("")}</Scene></X3D>`);
  readonly inlineGeometry = inlineGeometryReader;
  readonly refusals = refusals;
  readonly reader = new SceneReader(this.x3d, this);
  readonly #random: RandomNumbers;
  readonly #documents = Object.entries(inlinable).map(([url, text]) => ({ url, x3d: elementsOf(text) }));
  readonly #loadedInlines = new Set<SceneElement>();
  readonly #levels = new Map<SceneElement, number>();

  constructor(random: RandomNumbers) {
    this.#random = random;
  }

  readonly inlined = (inline: SceneElement) =>
    this.#loadedInlines.has(inline)
      ? this.#documents.find(({ url }) => inline.getAttribute("url")?.includes(url))
      : undefined;

  readonly levelOf = (lod: SceneElement) => this.#levels.get(lod);

  /** Makes one random change and reports it to the reader. */
  edit(): void {
    const random = this.#random;
    const element = random.choose(elementsIn(this.x3d));
    const others = elementsIn(this.x3d).slice(2);
    switch (random.below(8)) {
      case 0:
      case 1:
        this.#insert(elementsOf(random.choose(snippets)), element);
        break;
      case 2:
        if (others.length > 0) this.#remove(random.choose(others));
        break;
      case 3:
        if (others.length > 0) this.#move(random.choose(others), element);
        break;
      case 4:
        this.#rearrange(element);
        break;
      case 5:
        this.#changeOptions();
        break;
      default:
        this.#set(element);
    }
  }

  #insert(element: TestElement, parent: TestElement): void {
    parent.children.splice(this.#random.below(parent.children.length + 1), 0, element);
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

  #changeOptions(): void {
    const allElements = [this.x3d, ...this.#documents.map(({ x3d }) => x3d)].flatMap(elementsIn);
    const candidates = allElements.filter(({ localName }) => ["Inline", "LOD"].includes(localName));
    if (candidates.length === 0) return;
    const element = this.#random.choose(candidates);
    if (element.localName === "LOD") this.#levels.set(element, this.#random.below(2));
    else if (!this.#loadedInlines.delete(element)) this.#loadedInlines.add(element);
    this.reader.touch(element);
  }

  #set(element: TestElement): void {
    const name = element.localName === "Coordinate" ? "point" : this.#random.choose(Object.keys(attributes));
    const hadName = element.attributes.delete(name);
    if (!hadName || this.#random.below(2) === 0)
      element.attributes.set(name, this.#random.choose(attributes[name] ?? []));
    this.reader.touch(element);
  }
}

export function elementsIn(element: TestElement): TestElement[] {
  return [element, ...element.children.flatMap(elementsIn)];
}
