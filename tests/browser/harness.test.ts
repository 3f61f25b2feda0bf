// Tests the tools of the browser tests, because a comparison that cannot fail proves nothing.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdirSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { describe, test } from "node:test";
import type { Page } from "playwright-core";
import { assertSamePicture, boundsOfInput, difference, holesIn, silhouette } from "./compare.ts";
import { settle, withPage } from "./harness.ts";
import {
  areaWeightedNormals,
  pointSpiral,
  readPly,
  sphere,
  trefoil,
  withColors,
  writePly,
  type PlainMesh,
} from "./meshes.ts";
import { outputDirectory } from "./paths.ts";
import { decodePng, encodePng, type Picture } from "./png.ts";
import { gate } from "./server.ts";

function noise(width: number, height: number, channels: number): Picture {
  return {
    width,
    height,
    channels,
    data: Uint8Array.from({ length: width * height * channels }, (_, i) => (i * 2654435761) >>> 24),
  };
}

const grey: Picture = { width: 100, height: 100, channels: 3, data: new Uint8Array(30000).fill(100) };

function changed(picture: Picture, change: (data: Uint8Array) => void): Picture {
  const data = Uint8Array.from(picture.data);
  change(data);
  return { ...picture, data };
}

describe("pictures", () => {
  test("a PNG is read as it was written", () => {
    for (const channels of [1, 2, 3, 4]) {
      const picture = noise(37, 11, channels);
      assert.deepEqual(decodePng(encodePng(picture)), picture);
    }
  });

  test("the difference counts every channel, and pixels that are off by more than 16", () => {
    const other = changed(grey, (data) => {
      data.set([116, 100, 83], 0);
    });
    assert.deepEqual(difference(grey, other), { mean: 33 / 30000, offShare: 1 / 10000, largest: 17 });
  });

  test("a comparison fails outside of its bounds and writes pictures", () => {
    const other = changed(grey, (data) => data.fill(200, 0, 6));
    assert.throws(() => assertSamePicture("harness", grey, other, boundsOfInput), /mean difference 0\.0200/);
    assert.deepEqual(assertSamePicture("harness", grey, grey, boundsOfInput).largest, 0);
    rmSync(join(outputDirectory, "harness.actual.png"));
  });

  test("a hole in a silhouette is found, a bay is not", () => {
    const disc = new Uint8Array(30 * 30).map((_, i) =>
      Math.hypot((i % 30) - 15, Math.floor(i / 30) - 15) < 10 ? 1 : 0,
    );
    assert.equal(holesIn(disc, 30), 0);
    disc[15 * 30 + 15] = 0;
    assert.equal(holesIn(disc, 30), 1);
    disc.fill(0, 15 * 30 + 15, 15 * 30 + 30);
    assert.equal(holesIn(disc, 30), 0);
    assert.deepEqual(silhouette(grey, grey), new Uint8Array(10000));
  });
});

describe("meshes", () => {
  const volume = ({ positions, triangles }: PlainMesh): number => {
    const at = (corner: number, axis: number): number => positions[3 * triangles[corner]! + axis]!;
    let sum = 0;
    for (let t = 0; t < triangles.length; t += 3) {
      for (let axis = 0; axis < 3; ++axis) {
        const [y, z] = [(axis + 1) % 3, (axis + 2) % 3];
        sum += (at(t, axis) * (at(t + 1, y) * at(t + 2, z) - at(t + 1, z) * at(t + 2, y))) / 6;
      }
    }
    return sum;
  };

  test("generated meshes are closed, oriented outwards, and their normals agree", () => {
    for (const mesh of [trefoil(), sphere()]) {
      const edges = new Set<string>();
      for (let t = 0; t < mesh.triangles.length; t += 3) {
        const [a, b, c] = mesh.triangles.subarray(t, t + 3);
        for (const [from, to] of [
          [a, b],
          [b, c],
          [c, a],
        ])
          edges.add(`${from}>${to}`);
      }
      assert.equal(edges.size, mesh.triangles.length);
      for (const edge of edges) assert.ok(edges.has(edge.split(">").reverse().join(">")));
      assert.ok(volume(mesh) > 0);
      const computed = areaWeightedNormals(mesh);
      const cosines = Array.from({ length: computed.length / 3 }, (_, i) =>
        [0, 1, 2].reduce((sum, axis) => sum + computed[3 * i + axis]! * mesh.normals![3 * i + axis]!, 0),
      );
      assert.ok(Math.min(...cosines) > 0.9, `smallest cosine ${Math.min(...cosines)}`);
    }
  });

  test("a PLY file is read as it was written", () => {
    for (const mesh of [withColors(trefoil(8, 4)), sphere(3), pointSpiral(10)])
      assert.deepEqual(readPly(writePly(mesh)), mesh);
  });
});

describe("the browser", () => {
  const directory = join(outputDirectory, "harness");
  mkdirSync(directory, { recursive: true });
  writeFileSync(join(directory, "index.html"), `<!doctype html><script src="/script.js"></script><p>page`);
  writeFileSync(join(directory, "script.js"), "document.title = 'script ran';");

  test("runs the page's own scripts and no others", async () => {
    await withPage(directory, { expectedErrors: /Content Security Policy/ }, async ({ page, errors }) => {
      await page.waitForLoadState();
      assert.equal(await page.title(), "script ran");
      await page.evaluate(() => {
        const script = document.createElement("script");
        script.textContent = "document.title = 'inline ran'";
        document.body.append(script);
      });
      assert.equal(await page.title(), "script ran");
      assert.equal(errors.length, 1);
    });
  });

  test("draws with WebGL2, counted", async () => {
    await withPage(directory, {}, async ({ page, observed, picture }) => {
      await page.waitForLoadState();
      await page.evaluate(() => {
        const canvas = document.createElement("canvas");
        canvas.style.cssText = "position: fixed; inset: 0; width: 100%; height: 100%";
        document.body.append(canvas);
        const gl = canvas.getContext("webgl2");
        gl?.clearColor(1, 0.5, 0, 1);
        gl?.deleteTexture(gl.createTexture());
        gl?.createBuffer();
        gl?.clear(gl.COLOR_BUFFER_BIT);
      });
      const { draws, live } = await observed();
      assert.deepEqual([draws, live.textures, live.buffers], [1, 0, 1]);
      const { data, channels } = await picture();
      assert.deepEqual([...data.subarray(50 * channels, 50 * channels + 3)], [255, 128, 0]);
      // An endless animation is an error.
      await page.evaluate(() => {
        const gl = document.querySelector("canvas")?.getContext("webgl2");
        const draw = (): void => {
          gl?.clear(gl.COLOR_BUFFER_BIT);
          requestAnimationFrame(draw);
        };
        draw();
      });
      await assert.rejects(
        settle(page, 0.2),
        /has not finished drawing after 0\.2 s: it is still drawing \(\d+ draws so far\)/,
      );
    });
  });

  test("a failing page fails its test", async () => {
    const failing = withPage(directory, {}, async ({ page }) => {
      await page.evaluate(() => fetch("/missing.png"));
    });
    await assert.rejects(failing, /404/);
  });

  test("pages that are opened at once are different ones", async () => {
    const pages: Page[] = [];
    const origins: string[] = [];
    const everyPageIsOpen = gate();
    const open = (): Promise<void> =>
      withPage(directory, {}, async ({ page, server }) => {
        pages.push(page);
        if (pages.length === 3) everyPageIsOpen.open();
        await everyPageIsOpen.closed;
        assert.equal(`${await page.evaluate(() => location.origin)}/`, server.origin);
        origins.push(server.origin);
      });
    await Promise.all([open(), open(), open()]);
    assert.deepEqual([new Set(pages).size, new Set(origins).size], [3, 3]);
  });
});

describe("the server", () => {
  const directory = join(outputDirectory, "harness");

  test("does not keep a run from ending that did not close it", () => {
    const run = `import { startServer } from "${import.meta.resolve("./server.ts")}"; await startServer(".");`;
    execFileSync(process.execPath, ["--input-type=module", "--eval", run], { timeout: 60_000, stdio: "inherit" });
  });

  test("fails, holds, truncates and replaces what a rule names, and keeps the order", async () => {
    const held = gate();
    await withPage(directory, { expectedErrors: /404|503/ }, async ({ page, server }) => {
      server.put("/a", "0123456789");
      const answer = (path: string): Promise<string> =>
        page.evaluate(async (url) => {
          const response = await fetch(url);
          return `${response.status} ${await response.text()}`;
        }, path);
      assert.equal(await answer("/a"), "200 0123456789");
      assert.equal(await answer("/b"), "404 ");
      server.when(/^\/a$/, { truncateTo: 3 });
      assert.equal(await answer("/a"), "200 012");
      const undo = server.when(/^\/a$/, { status: 503 });
      assert.equal(await answer("/a"), "503 ");
      undo();
      server.when(/^\/a$/, { replace: (body) => `${body.toString()}!`, hold: held.closed });
      const waiting = answer("/a?x");
      await page.evaluate(() => new Promise((resolve) => setTimeout(resolve, 100)));
      assert.equal(server.requests.at(-1)?.state, "waiting");
      held.open();
      assert.equal(await waiting, "200 0123456789!");
      assert.deepEqual(
        server.requestsOf(/^\/[ab]$/).map(({ path, status }) => `${path} ${status}`),
        ["/a 200", "/b 404", "/a 200", "/a 503", "/a 200"],
      );
    });
  });
});
