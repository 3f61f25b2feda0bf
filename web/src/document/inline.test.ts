import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { absoluteUrls } from "./absoluteUrls.ts";
import { shapesOf } from "./description.ts";
import type { SceneElement } from "./element.ts";
import { elementsOf, type TestElement } from "./elements.testing.ts";
import type { InlinedDocument } from "./readScene.ts";
import { readScene } from "./readScene.ts";

/** Gives the document for an Inline's URL, parsed once. */
function inlinedFrom(
  documents: Readonly<Record<string, string>>,
): (inline: SceneElement) => InlinedDocument | undefined {
  const parsed = new Map<string, InlinedDocument>();
  return (inline) => {
    const url = inline.getAttribute("url")?.replaceAll('"', "") ?? "";
    const text = documents[url];
    const known = parsed.get(url) ?? (text === undefined ? undefined : { url, x3d: elementsOf(text) });
    if (known !== undefined) parsed.set(url, known);
    return known;
  };
}

const shape = (id: string, attributes = "") => `<Shape id="${id}" ${attributes}><Box/></Shape>`;

describe("Inline", () => {
  test("replaces itself by a document with its own DEF names", () => {
    const page =
      elementsOf(`<X3D><Scene>${shape("own", 'DEF="S"')}<Transform translation="1 0 0"><Inline id="in" url='"a.x3d"'/></Transform>
      <Inline url="lost.x3d"/><Switch whichChoice="-1"><Inline url='"b.x3d"'/></Switch><Inline load="false" url='"c.x3d"'/></Scene></X3D>`);
    const inlined = inlinedFrom({
      "a.x3d": `<X3D><Scene>${shape("inner", 'DEF="S"')}<Shape USE="S"/><NavigationInfo headlight="false"/></Scene></X3D>`,
    });
    const scene = readScene(page, { inlined });
    assert.deepEqual(
      shapesOf(scene.root).map(({ element, host }) => [element.getAttribute("id"), host.getAttribute("id")]),
      [
        ["own", "own"],
        ["inner", "in"],
        [null, "in"],
      ],
    );
    assert.deepEqual(
      scene.inlines.map(({ urls, visible }) => [urls[0], visible]),
      [
        ["a.x3d", true],
        ["lost.x3d", true],
        ["b.x3d", false],
      ],
    );
    assert.deepEqual(scene.warnings, []);
  });

  test("takes NavigationInfo from inlined documents only where the scene has none of its own", () => {
    const inlined = inlinedFrom({
      "outer.x3d": `<X3D><Inline url="inner.x3d"/></X3D>`,
      "inner.x3d": `<X3D><NavigationInfo headlight="false"/></X3D>`,
    });
    const sceneOf = (own: string) => {
      const { navigation } = readScene(
        elementsOf(`<X3D><Scene><Inline url="outer.x3d"/><Inline url="inner.x3d"/>${own}</Scene></X3D>`),
        { inlined },
      );
      return navigation.headlight;
    };
    assert.equal(sceneOf(""), false);
    assert.equal(sceneOf("<NavigationInfo/>"), true);
  });

  test("warns of documents that inline one another in a circle, or too deeply", () => {
    const circle = inlinedFrom({
      "a.x3d": `<X3D><Inline url="b.x3d"/>${shape("a")}</X3D>`,
      "b.x3d": `<X3D><Inline url="a.x3d"/>${shape("b")}</X3D>`,
    });
    const scene = readScene(elementsOf('<X3D><Inline url="a.x3d"/></X3D>'), { inlined: circle });
    assert.deepEqual(
      shapesOf(scene.root).map(({ element }) => element.getAttribute("id")),
      ["b", "a"],
    );
    assert.deepEqual(
      scene.warnings.map(({ message }) => message),
      ["names a.x3d, which contains it"],
    );
    const chain = inlinedFrom(
      Object.fromEntries(Array.from({ length: 40 }, (_, i) => [`${i}`, `<X3D><Inline url="${i + 1}"/></X3D>`])),
    );
    const deep = readScene(elementsOf('<X3D><Inline url="0"/></X3D>'), { inlined: chain });
    assert.match(deep.warnings[0]?.message ?? "", /more than 16 documents deep/);
  });

  test("resolves URLs against the document's own folder", () => {
    const x3d =
      elementsOf(`<X3D><ImageTexture url='"a.png" "../b.png" "https://c.org/d.png"'/><ImageGeometry base="g/b.png#12">
      <GeometryPatch index="g/i.png#7" coord='"g/x.png#1" "g/y.png"' bboxCenter="1 2 3"/></ImageGeometry>
      <IndexedTriangleSet index="0 1 2"/><Inline url="deep.x3d"/><Background frontUrl='"sky.png"'/>
      <Anchor url='"#Tower" "more.html"'/><Texture><img src="p.png"/></Texture></X3D>`);
    absoluteUrls(asWritable(x3d), "https://h.org/w/a.x3d");
    const attributes: string[] = [];
    const collect = (element: TestElement) => {
      attributes.push(...element.attributes.values());
      element.children.forEach(collect);
    };
    collect(x3d);
    assert.deepEqual(attributes, [
      '"https://h.org/w/a.png" "https://h.org/b.png" "https://c.org/d.png"',
      "https://h.org/w/g/b.png#12",
      "https://h.org/w/g/i.png#7",
      '"https://h.org/w/g/x.png#1" "https://h.org/w/g/y.png"',
      "1 2 3",
      "0 1 2",
      "https://h.org/w/deep.x3d",
      '"https://h.org/w/sky.png"',
      '"#Tower" "https://h.org/w/more.html"',
      "https://h.org/w/p.png",
    ]);
  });
});

function asWritable(element: TestElement): TestElement & { setAttribute(name: string, value: string): void } {
  element.children.forEach(asWritable);
  return Object.assign(element, {
    setAttribute: (name: string, value: string) => {
      element.attributes.set(name, value);
    },
  });
}
