// Vertex data lives on the GPU alone, and comes there in pieces.

import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { settle, withPage } from "./harness.ts";
import { siteOfGenerated } from "./sites.ts";

describe("a scene that has loaded", () => {
  test("keeps no decoded image", async () => {
    await withPage(siteOfGenerated("trefoil-colors", "--patch-vertices", "1000"), {}, async (view) => {
      await view.promise("complete");
      await settle(view.page);
      const { live } = await view.observed();
      assert.equal(live.bitmaps, 0);
      assert.ok(live.textures > 10);
    });
  });
});

test("an image of many texels comes to the GPU in strips", async () => {
  const before = (): void => {
    const uploads: number[] = [];
    (window as unknown as { uploads: number[] }).uploads = uploads;
    const gl = WebGL2RenderingContext.prototype as unknown as Record<string, (...args: unknown[]) => void>;
    const upload = gl.texSubImage2D;
    gl.texSubImage2D = function (...args) {
      uploads.push(Number(args[4]) * Number(args[5]) * 4);
      upload?.apply(this, args);
    };
  };
  // 36,864 vertices and 73,728 triangles: an index of 221,184 texels.
  await withPage(siteOfGenerated("sphere-large"), { before }, async (view) => {
    await view.promise("complete");
    const uploads = await view.page.evaluate(() => (window as unknown as { uploads: number[] }).uploads);
    assert.ok(Math.max(...uploads) <= 2 ** 18, `a piece of ${Math.max(...uploads)} bytes`);
    assert.ok(uploads.reduce((sum, bytes) => sum + bytes) > 221_184 * 4);
  });
});
