import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { DecodeError } from "../decode/decodeError.ts";
import { elementsOf } from "../document/elements.testing.ts";
import type { SceneElement } from "../document/element.ts";
import { SceneReader } from "../document/sceneReader.ts";
import { shapesOf } from "../document/description.ts";
import { deferredFile, siteOf, shortDelay, type Answer } from "./delivery.testing.ts";
import { Inlines } from "./inlines.ts";

const bytesOf = (text: string) => new TextEncoder().encode(text);
const shape = bytesOf("<X3D><Scene><Shape><Box/></Shape></Scene></X3D>");

/** A document, read again whenever the document of one of its Inlines has loaded. */
function sceneOf(markup: string, files: Record<string, Answer>) {
  const { pool, requested, aborted } = siteOf(files);
  const log: string[] = [];
  const nameOf = (inline: SceneElement) => inline.getAttribute("DEF") ?? "";
  const x3d = elementsOf(markup);
  const url = "https://site/main.x3d";
  const inlines: Inlines = new Inlines(
    {
      pool,
      ownDocument: { url, x3d },
      urlOf: (url) => {
        if (url.startsWith("data:")) throw new DecodeError("unsupported", "no file");
        return new URL(url, "https://site/").href;
      },
      parse: (bytes) => elementsOf(new TextDecoder().decode(bytes)),
    },
    {
      onBegin: (inline) => log.push(`begin ${nameOf(inline)}`),
      onEnd: (inline, error) => {
        log.push(`end ${nameOf(inline)}${error ? `: ${error.message}` : ""}`);
        reader.touch(inline);
        inlines.follow(reader.read().inlines);
      },
      onRemove: (inline) => log.push(`leave ${nameOf(inline)}`),
    },
  );
  const reader = new SceneReader(x3d, { url, inlined: (inline) => inlines.documentOf(inline) });
  inlines.follow(reader.read().inlines);
  const settled = async () => {
    while (!inlines.isSettled) await shortDelay();
  };
  return {
    inlines,
    log,
    requested,
    aborted,
    settled,
    shapes: () => shapesOf(reader.read().root).length,
    warnings: () => reader.read().warnings.map(({ message }) => message),
  };
}

const x3d = (...inlines: string[]) => `<X3D><Scene>${inlines.join("")}</Scene></X3D>`;

describe("documents that Inlines name", () => {
  test("are requested once each, including those inside of them, but not hidden ones", async () => {
    const scene = sceneOf(
      x3d(
        '<Inline DEF="a" url="part.x3d"/>',
        '<Inline DEF="b" url="part.x3d"/>',
        '<Group visible="false"><Inline DEF="c" url="hidden.x3d"/></Group>',
      ),
      { "part.x3d": bytesOf('<X3D><Scene><Inline DEF="inner" url="deep.x3d"/></Scene></X3D>'), "deep.x3d": shape },
    );
    assert.ok(!scene.inlines.isSettled);
    await scene.settled();
    assert.deepEqual(scene.requested, ["part.x3d", "deep.x3d"]);
    assert.deepEqual(scene.log, ["begin a", "begin b", "end a", "begin inner", "end b", "end inner"]);
    assert.ok(scene.inlines.isSettled);
    assert.equal(scene.shapes(), 2);
    assert.deepEqual(
      scene.inlines.transfers.map(({ state }) => state),
      ["ready", "ready", "ready"],
    );
  });

  test("come from the first of their URLs that loads; the error names all", async () => {
    const scene = sceneOf(
      x3d(`<Inline DEF="a" url='"data:," "lost.x3d" "part.x3d"'/>`, `<Inline DEF="b" url='"lost.x3d" "data:,"'/>`),
      { "part.x3d": shape },
    );
    await scene.settled();
    assert.equal(scene.shapes(), 1);
    assert.deepEqual(scene.log.filter((line) => line.startsWith("end")).toSorted(), [
      "end a",
      "end b: lost.x3d: the server answered 404; data:,: no file",
    ]);
    assert.ok(scene.inlines.isSettled);
  });

  test("that inline themselves or their own document are displayed once", async () => {
    const scene = sceneOf(x3d('<Inline DEF="a" url="circle.x3d"/>', '<Inline DEF="b" url="main.x3d"/>'), {
      "circle.x3d": bytesOf('<X3D><Scene><Shape><Box/></Shape><Inline url="circle.x3d"/></Scene></X3D>'),
    });
    await scene.settled();
    assert.equal(scene.shapes(), 1);
    assert.deepEqual(scene.requested, ["circle.x3d"]);
    assert.deepEqual(scene.warnings(), [
      "names https://site/circle.x3d, which contains it",
      "names https://site/main.x3d, which contains it",
    ]);
  });

  test("are aborted on disposal", async () => {
    const scene = sceneOf(x3d('<Inline DEF="a" url="part.x3d"/>'), { "part.x3d": deferredFile(shape).promise });
    while (scene.requested.length === 0) await shortDelay();
    scene.inlines.dispose();
    while (scene.aborted.length === 0) await shortDelay();
    assert.deepEqual(scene.aborted, ["part.x3d"]);
    assert.deepEqual(scene.log, ["begin a", "leave a"]);
    assert.deepEqual(scene.inlines.transfers, []);
  });
});
