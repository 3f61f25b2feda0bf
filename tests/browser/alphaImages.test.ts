// Tests textures with alpha in browsers whose ImageBitmap loses the colours of transparent texels.

import assert from "node:assert/strict";
import { before, describe, test } from "node:test";
import { alphaPage, files, hideDecoder, loseColors } from "./alphaScene.ts";
import { assertSamePicture, difference } from "./compare.ts";
import { withPage, type View } from "./harness.ts";
import type { Picture } from "./png.ts";

interface Seen {
  readonly picture: Picture;
  /** How often the files of textures were requested. */
  readonly requests: Readonly<Record<string, number>>;
  readonly moduleCount: number;
}

async function see(...changes: readonly (() => void)[]): Promise<Seen> {
  let seen: Seen | undefined;
  const script = { content: changes.map((change) => `(${change.toString()})();`).join("\n") };
  await withPage(alphaPage("alpha-images"), { before: script }, async (view: View) => {
    await view.promise("complete");
    const countOf = (file: string) => view.server.requestsOf(new RegExp(`/${file}$`)).length;
    seen = {
      picture: await view.picture(),
      requests: Object.fromEntries(Object.keys(files).map((file) => [file, countOf(file)])),
      moduleCount: view.server.requestsOf(/imgeo-alpha-/).length,
    };
  });
  assert.ok(seen);
  return seen;
}

describe("textures with alpha", () => {
  let expected: Seen;
  before(async () => {
    expected = await see();
  });
  const once = { ...Object.fromEntries(Object.keys(files).map((file) => [file, 1])), "gamma.png": 2 };

  test("are decoded without further code and requests where the browser keeps colours", async () => {
    assert.deepEqual([expected.moduleCount, expected.requests], [0, once]);
    const tested = await see(hideDecoder);
    assert.deepEqual([tested.moduleCount, tested.requests], [1, once]);
    assertSamePicture("colours kept", tested.picture, expected.picture, { mean: 0 });
  });

  test("have the same picture where the browser loses colours", async () => {
    const lossy = await see(loseColors);
    assert.ok(difference(lossy.picture, expected.picture).mean > 2, "the browser loses colours");
    const own = await see(loseColors, hideDecoder);
    assertSamePicture("colours of transparent texels", own.picture, expected.picture, { mean: 0 });
    assert.equal(own.moduleCount, 1);
    // What is decoded for an element is requested once more; of gamma.png the colours are.
    const further = { "deep.png": 2, "gamma.png": 3, "deep-gamma.png": 2, "soft.avif": 2 };
    assert.deepEqual(own.requests, { ...once, ...further });
  });
});
