// Tests texts in a font whose glyphs are half an em wide, with ink from 0.7 em above to 0.2 em below the baseline; "j"
// extends 0.1 em to the left of the pen, a space has no ink.

import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { shapesOf, type ShapeDescription } from "../document/description.ts";
import { elementsOf } from "../document/elements.testing.ts";
import { hasInk, glyphAtlasOf } from "./glyphAtlas.ts";
import { readScene } from "../document/readScene.ts";
import { SceneReader } from "../document/sceneReader.ts";
import { textReader } from "./textGeometry.ts";
import type { Font, MeasureRun, TextStyle } from "./textLayout.ts";
import { alignments, layOut } from "./textLayout.ts";

const measure: MeasureRun = (_, text) => {
  const isBlank = text.trim() === "";
  const ink = isBlank
    ? { left: 0, right: 0, up: 0, down: 0 }
    : { left: text.startsWith("j") ? 0.1 : 0, right: 0.5 * text.length, up: 0.7, down: 0.2 };
  return { advance: 0.5 * text.length, ink, ascent: 0.9, descent: 0.3 };
};

const font: Font = { family: "serif", isBold: false, isItalic: false };
const plain: TextStyle = {
  font,
  spacing: 1.5,
  horizontal: true,
  leftToRight: true,
  topToBottom: true,
  major: "BEGIN",
  minor: "FIRST",
};

function layOutRounded(
  strings: string[],
  style: Partial<TextStyle> = {},
  lengths: number[] = [],
  maxExtent = 0,
): { text: string; x: number; y: number; stretchX: number; stretchY: number }[] {
  const round = (value: number) => Math.round(value * 1e6) / 1e6 + 0;
  return layOut(strings, lengths, maxExtent, { ...plain, ...style }, measure).map(
    ({ text, x, y, stretchX, stretchY }) => ({
      text,
      x: round(x),
      y: round(y),
      stretchX: round(stretchX),
      stretchY: round(stretchY),
    }),
  );
}
const positionsOf = (...args: Parameters<typeof layOutRounded>) =>
  layOutRounded(...args).map(({ text, x, y }) => [text, x, y]);

function readText(text: string, measured = measure): { shape: ShapeDescription | undefined; warnings: string[] } {
  const { root, warnings } = readScene(elementsOf(`<X3D><Scene>${text}</Scene></X3D>`), {
    text: textReader(measured),
  });
  return { shape: shapesOf(root)[0], warnings: warnings.map(({ message }) => message) };
}

describe("the layout of a text", () => {
  test("puts lines below one another, aligned along both axes", () => {
    assert.deepEqual(positionsOf(["ab", "abcd"]), [
      ["ab", 0, 0],
      ["abcd", 0, -1.5],
    ]);
    const xOf = (major: TextStyle["major"]) => positionsOf(["ab", "abcd"], { major }).map(([, x]) => x);
    assert.deepEqual(alignments.map(xOf), [
      [0, 0],
      [0, 0],
      [-0.5, -1],
      [-1, -2],
    ]);
    const yOf = (minor: TextStyle["minor"]) => positionsOf(["ab", "abcd"], { minor }).map(([, , y]) => y);
    // From 0.9 above the first baseline to 0.3 below the second.
    assert.deepEqual(alignments.map(yOf), [
      [0, -1.5],
      [-0.9, -2.4],
      [0.45, -1.05],
      [1.8, 0.3],
    ]);
  });

  test("can run right to left, and bottom to top", () => {
    assert.deepEqual(positionsOf(["abc"], { leftToRight: false }), [["cba", -1.5, 0]]);
    assert.deepEqual(positionsOf(["abc"], { leftToRight: false, major: "END" }), [["cba", 0, 0]]);
    const yOf = (minor: TextStyle["minor"]) =>
      positionsOf(["a", "b"], { topToBottom: false, minor }).map(([, , y]) => y);
    assert.deepEqual(alignments.map(yOf), [
      [0, 1.5],
      [0.3, 1.8],
      [-1.05, 0.45],
      [-2.4, -0.9],
    ]);
  });

  test("stacks grapheme clusters in vertical text", () => {
    assert.deepEqual(positionsOf(["ab", "c"], { horizontal: false }), [
      ["a", 0.25, -0.75],
      ["b", 0.25, -1.75],
      ["c", 1.75, -0.75],
    ]);
    assert.deepEqual(positionsOf(["ab"], { horizontal: false, topToBottom: false }), [
      ["a", 0.25, 0.25],
      ["b", 0.25, 1.25],
    ]);
    assert.deepEqual(positionsOf(["a", "b"], { horizontal: false, leftToRight: false }), [
      ["a", -0.75, -0.75],
      ["b", -2.25, -0.75],
    ]);
    assert.deepEqual(positionsOf(["ab"], { horizontal: false, major: "MIDDLE", minor: "MIDDLE" }), [
      ["a", -0.25, 0.25],
      ["b", -0.25, -0.75],
    ]);
    const family = "\u{1F468}\u200D\u{1F469}\u200D\u{1F467}";
    assert.deepEqual(
      layOutRounded([`e\u0301${family}`], { horizontal: false }).map(({ text }) => text),
      ["e\u0301", family],
    );
    assert.deepEqual(
      layOutRounded([`e\u0301${family}`], { leftToRight: false }).map(({ text }) => text),
      [`${family}e\u0301`],
    );
  });

  test("stretches strings to their length, and shrinks all by the factor that the longest needs", () => {
    assert.deepEqual(
      layOutRounded(["ab", "ab"], {}, [3]).map(({ stretchX }) => stretchX),
      [3, 1],
    );
    assert.deepEqual(
      layOutRounded(["ab", "ab"], {}, [3], 1.5).map(({ stretchX }) => stretchX),
      [1.5, 0.5],
    );
    assert.deepEqual(
      layOutRounded(["ab"], { major: "END" }, [3]).map(({ x }) => x),
      [-3],
    );
    assert.deepEqual(
      layOutRounded(["ab"], { horizontal: false }, [4]).map(({ y, stretchY }) => [y, stretchY]),
      [
        [-1.5, 2],
        [-3.5, 2],
      ],
    );
    assert.deepEqual(
      layOutRounded([""], {}, [3], 1).map(({ stretchX }) => stretchX),
      [1],
    );
    assert.deepEqual(layOutRounded([]), []);
  });
});

describe("the glyph atlas of a text", () => {
  test("has a cell for each run with ink, disjoint, with a margin for the distance field", () => {
    const runs = layOut(["jab", "long string", " ", "jab", "x"], [], 0, plain, measure);
    const atlas = glyphAtlasOf(runs);
    assert.ok(atlas);
    assert.deepEqual([...atlas.cells.keys()], ["jab", "long string", "x"]);
    const cells = [...atlas.cells.entries()];
    for (const [text, { left, top, width, height, penX, penY }] of cells) {
      const { ink } = measure(font, text);
      assert.ok(left >= 0 && top >= 0 && left + width <= atlas.width && top + height <= atlas.height, text);
      assert.ok(
        penX - ink.left * atlas.texelsPerEm >= left + 8 && penX + ink.right * atlas.texelsPerEm <= left + width - 8,
        text,
      );
      assert.ok(
        penY - ink.up * atlas.texelsPerEm >= top + 8 && penY + ink.down * atlas.texelsPerEm <= top + height - 8,
        text,
      );
      const isDisjoint = cells.every(
        ([, other]) =>
          (other.left === left && other.top === top) ||
          other.left >= left + width ||
          left >= other.left + other.width ||
          other.top >= top + height ||
          top >= other.top + other.height,
      );
      assert.ok(isDisjoint, text);
    }
    assert.deepEqual(runs.map(hasInk), [true, true, false, true, true]);
  });

  test("has more texels per em for fewer glyphs, fits every GPU, and is undefined for a text that does not fit", () => {
    const texelsFor = (lines: number, characters: number) => {
      const atlas = glyphAtlasOf(
        layOut(
          Array.from({ length: lines }, (_, line) => String(line).padEnd(characters, "x")),
          [],
          0,
          plain,
          measure,
        ),
      );
      assert.ok(!atlas || (atlas.width <= 2048 && atlas.height <= 2048));
      return atlas?.texelsPerEm;
    };
    assert.deepEqual(
      [texelsFor(1, 10), texelsFor(1, 80), texelsFor(20, 20), texelsFor(1000, 1000)],
      [96, 48, 24, undefined],
    );
  });
});

describe("a shape of text", () => {
  const hello = `<Shape><Appearance><Material diffuseColor="1 0 0"/><ImageTexture url="a.png"/></Appearance>
    <Text string='"Hi" "you"' solid="true"><FontStyle DEF="F" size="2" family='"My Font" "SANS" "SERIF"' style="BOLDITALIC"/></Text></Shape>`;

  test("has two triangles a line, the glyph atlas as texture, and a tight box", () => {
    const { shape, warnings } = readText(hello);
    assert.ok(shape?.geometry?.glyphAtlas !== undefined);
    const { geometry, box, appearance } = shape;
    assert.deepEqual([geometry.solid, geometry.patches[0]?.draws], [true, [{ primitive: "triangles", count: 12 }]]);
    assert.ok(box?.min[2] === 0 && box.max[2] === 0);
    // The ink of two lines and their field: twice 8 of 96 texels.
    const expected = [
      [-1 / 6, -2.4 - 1 / 6],
      [3 + 1 / 6, 1.4 + 1 / 6],
    ];
    [box.min, box.max].forEach((corner, i) => {
      [0, 1].forEach((axis) => {
        assert.ok(
          Math.abs(corner[axis as 0 | 1] - (expected[i]?.[axis] ?? 0)) < 0.05,
          `${corner[axis as 0 | 1]} for ${expected[i]?.[axis]}`,
        );
      });
    });
    assert.deepEqual(
      appearance.textures.map(({ role, urls: [url], sampling }) => [role, url, sampling.isDistanceField]),
      [["color", geometry.glyphAtlas, true]],
    );
    assert.equal(appearance.alpha.mode, "BLEND");
    assert.deepEqual(warnings, ["is a text: its textures are not shown"]);
    const description = JSON.parse(Buffer.from(shape.geometry.glyphAtlas.split(",")[1] ?? "", "base64").toString()) as {
      font: string;
      runs: { text: string }[];
    };
    assert.equal(description.font, 'italic bold 96px "My Font", sans-serif');
    assert.deepEqual(
      description.runs.map(({ text }) => text),
      ["Hi", "you"],
    );
  });

  test("reads text without quotes as one string, and quoted strings with escapes", () => {
    const linesOf = (string: string) =>
      (readText(`<Shape><Text string=${string}/></Shape>`).shape?.geometry?.patches[0]?.draws[0]?.count ?? 0) / 6;
    assert.deepEqual(["'two words'", `'"a" "" "b c"'`, `'"&quot;" "\\\\"'`, "''", "' '"].map(linesOf), [1, 2, 2, 0, 0]);
  });

  test("draws nothing and warns for size 0 and for too long text", () => {
    assert.match(
      readText(`<Shape><Text string='"a"'><FontStyle size="0"/></Text></Shape>`).warnings[0] ?? "",
      /no font size/,
    );
    const tooLong = readText(`<Shape><Text string='${"x".repeat(20_000)}'/></Shape>`);
    assert.equal(tooLong.shape?.geometry, undefined);
    assert.match(tooLong.warnings[0] ?? "", /more characters than one glyph atlas holds/);
  });

  test("keeps its geometry until its string or style changes, also where it is USEd", () => {
    const x3d = elementsOf(
      `<X3D><Scene><Shape><Text DEF="T" string='"a"'><FontStyle DEF="F"/></Text></Shape><Shape><Text string='"b"'><FontStyle USE="F"/></Text></Shape></Scene></X3D>`,
    );
    const reader = new SceneReader(x3d, { text: textReader(measure) });
    const geometries = () => shapesOf(reader.read().root).map(({ geometry }) => geometry);
    const before = geometries();
    const scene = x3d.children[0];
    const text = scene?.children[0]?.children[0],
      style = text?.children[0];
    assert.ok(text && style);
    reader.touch(text);
    assert.ok(geometries().every((geometry, i) => geometry === before[i]));
    text.attributes.set("string", '"c"');
    reader.touch(text);
    const [changed, other] = geometries();
    assert.ok(changed !== before[0] && changed?.glyphAtlas !== before[0]?.glyphAtlas && other === before[1]);
    style.attributes.set("size", "3");
    reader.touch(style);
    assert.deepEqual(
      geometries().map((geometry) => geometry?.patches[0]?.box?.max[1]?.toFixed(1)),
      ["2.4", "2.4"],
    );
  });

  test("has another atlas URL when its font has loaded, also in an inlined document", () => {
    const inlined = {
      url: "http://a/room.x3d",
      x3d: elementsOf(`<X3D><Scene><Shape><Text string='"b"'><FontStyle family="F"/></Text></Shape></Scene></X3D>`),
    };
    const x3d = elementsOf(`<X3D><Scene><Shape><Text string='"a"'><FontStyle family="F"/></Text></Shape>
      <Shape><Text string='"a"'/></Shape><Inline url="room.x3d"/></Scene></X3D>`);
    const requests: string[] = [];
    let edition = 0;
    const reader = new SceneReader(x3d, {
      inlined: () => inlined,
      text: textReader(measure, ({ family }, characters) => {
        requests.push(`${family}: ${characters}`);
        return family.includes("F") ? edition : 0;
      }),
    });
    const atlasUrls = () => shapesOf(reader.read().root).map(({ geometry }) => geometry?.glyphAtlas);
    const before = atlasUrls();
    assert.deepEqual(requests, ['"F", serif: a', "serif: a", '"F", serif: b']);
    reader.touchTexts();
    assert.deepEqual(atlasUrls(), before);
    edition = 1;
    reader.touchTexts();
    assert.deepEqual(
      atlasUrls().map((each, i) => each === before[i]),
      [false, true, false],
    );
  });

  test("is not drawn without a text reader", () => {
    const { root, warnings } = readScene(elementsOf(`<X3D><Scene>${hello}</Scene></X3D>`));
    assert.deepEqual([shapesOf(root)[0]?.geometry, warnings], [undefined, []]);
  });
});
