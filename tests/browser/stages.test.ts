// Tests the pictures while files are still loading, and the order in which files are requested.

import assert from "node:assert/strict";
import { describe, test } from "node:test";
import {
  assertSamePicture,
  boundsOfQuantised,
  difference,
  holesIn,
  silhouette,
  silhouetteDifference,
} from "./compare.ts";
import { finalPicture, pictureSize, until, withPage, type View } from "./harness.ts";
import { decodePng, encodePng, type Picture } from "./png.ts";
import { referencePicture } from "./reference.ts";
import { gate, type TestServer } from "./server.ts";
import { decodeSite, ranksOfFiles } from "./siteDecoder.ts";
import { pageOf, siteOfGenerated } from "./sites.ts";
import { soakTest } from "./soak.ts";

/** Holds the files of these ranks until the gate opens. */
function holding(site: string, ranks: (rank: number) => boolean, hold: Promise<unknown>): (server: TestServer) => void {
  const held = pathsOf(site, ranks);
  return (server) => server.when((path) => held.includes(path), { hold });
}

function pathsOf(site: string, ranks: (rank: number) => boolean): string[] {
  return [...ranksOfFiles(pageOf(site))].filter(([, rank]) => ranks(rank)).map(([url]) => `/${url}`);
}

/** Waits until the shapes display the content of these files. */
async function untilReady(view: View, paths: string[]): Promise<void> {
  await until("every file that is not held has arrived", async () => {
    const states = await view.page.evaluate(() =>
      Array.from(document.querySelectorAll("x3d shape"), (shape) =>
        Array.from(
          (shape as unknown as { resources?: Iterable<{ url: string; state: string }> }).resources ?? [],
          ({ url, state }) => [url, state] as const,
        ),
      ).flat(),
    );
    const stateOf = new Map(states);
    return paths.every((path) => stateOf.get(path.replace(/^\//, "")) === "ready");
  });
}

describe("the first coordinate byte", () => {
  const site = (): string => siteOfGenerated("trefoil-colors", "--profile", "classic", "--patch-vertices", "1000");

  /** Without its shape: requests for its files that wait would take all connections from the runtime's modules. */
  async function blankPicture(): Promise<Picture> {
    const withoutShape = (html: string): string => html.replace(/<Shape[^]*<\/Shape>/i, "");
    const replace = (html: Buffer): string => withoutShape(html.toString()).replace(/<link rel="preload"[^>]*>/g, "");
    return finalPicture(site(), { server: (server) => server.when(/^\/$/, { replace }) });
  }

  test("displays the whole shape before other files have arrived, and they refine it", async () => {
    const blank = await blankPicture();
    const { closed, open } = gate();
    await withPage(site(), { server: holding(site(), (rank) => rank > 3, closed) }, async (view) => {
      await view.promise("firstImage");
      await untilReady(
        view,
        pathsOf(site(), (rank) => rank <= 3),
      );
      const coarse = await view.picture();
      assert.equal((await view.events("first-image", "x3d")).length, 1);
      assert.equal((await view.events("first-image", "shape")).length, 1);
      assert.deepEqual(await view.events("load"), []);
      const planes = await referencePicture(pageOf(site()), decodeSite(site(), 1));
      assertSamePicture("coarse", withoutBar(coarse), withoutBar(planes), boundsOfQuantised);

      open();
      await view.promise("complete");
      const final = await view.picture();
      assert.equal((await view.events("load", "x3d")).length, 1);
      assert.ok(difference(blank, coarse).mean > 1, "the coarse stage is not drawn");
      assert.ok(difference(coarse, final).mean > 0.02, "the last bytes do not change the picture");
      const shapes = [coarse, final].map((picture) => silhouette(withoutBar(picture), withoutBar(blank)));
      const differingShare = silhouetteDifference(shapes[0]!, shapes[1]!);
      assert.ok(differingShare < 0.03, `silhouettes differ in ${(differingShare * 100).toFixed(1)} % of the pixels`);
    });
  });

  soakTest("displays points without the index, and a surface without the normals", async () => {
    const blank = await blankPicture();
    const { closed: noIndex, open: sendIndex } = gate();
    const { closed: noNormal } = gate();
    const server = (server: TestServer): void => {
      holding(site(), (rank) => rank === 1, noIndex)(server);
      holding(site(), (rank) => rank > 1, noNormal)(server);
    };
    await withPage(site(), { server }, async (view) => {
      await view.promise("firstImage");
      const points = silhouette(withoutBar(await view.picture()), withoutBar(blank));
      sendIndex();
      await untilReady(
        view,
        pathsOf(site(), (rank) => rank === 1),
      );
      const surface = silhouette(withoutBar(await view.picture()), withoutBar(blank));
      const pixelCount = (mask: Uint8Array): number => mask.reduce((sum, pixel) => sum + pixel, 0);
      assert.ok(pixelCount(points) > 500, `${pixelCount(points)} pixels of points`);
      assert.ok(
        pixelCount(surface) > 1.2 * pixelCount(points),
        `${pixelCount(points)} pixels of points, ${pixelCount(surface)} of surface`,
      );
    });
  });
});

/** The progress bar covers the topmost rows while files are loading. */
function withoutBar({ width, height, channels, data }: Picture): Picture {
  const rows = 8;
  return { width, height: height - rows, channels, data: data.subarray(rows * width * channels) };
}

describe("borders between patches are watertight", () => {
  /** A white emissive surface on black: any gap is dark. */
  const glowing = (html: string): string =>
    html
      .replace(/<Material[^>]*>/i, `<Material diffuseColor="0 0 0" emissiveColor="1 1 1">`)
      .replace(/skyColor="[^"]*"/i, `skyColor="0 0 0"`);
  /**
   * A camera inside the sphere. Second bytes, which are held, are requested after the first bytes of patches behind it.
   */
  const fromInside = (html: string): string =>
    glowing(html)
      .replace(/<X3D/i, `<X3D chunkPriority="refinement: 0"`)
      .replace(/<Viewpoint[^>]*>/i, `<Viewpoint position="0 0 0" orientation="0.6 0.8 0 0.7" fieldOfView="1.8">`)
      .replace(/<ImageGeometry/i, `<ImageGeometry solid="false"`);

  const site = (): string => siteOfGenerated("sphere", "--profile", "classic", "--patch-vertices", "1000");

  function litPixels({ width, height, channels, data }: Picture): Uint8Array {
    return new Uint8Array(width * height).map((_, i) => (data[i * channels]! > 250 ? 1 : 0));
  }

  function assertClosed(mask: Uint8Array): void {
    const covered = mask.reduce((sum, pixel) => sum + pixel, 0) / mask.length;
    assert.ok(covered > 0.1, `the sphere covers ${covered} of the picture`);
    assert.equal(holesIn(mask, pictureSize.width), 0);
  }

  for (const { from, change } of [
    { from: "outside", change: glowing },
    { from: "inside", change: fromInside },
  ]) {
    (from === "outside" ? test : soakTest)(`seen from ${from}, coarse and final`, async () => {
      assert.ok(decodeSite(site()).length > 8);
      const { closed, open } = gate();
      const server = (server: TestServer): void => {
        holding(site(), (rank) => rank > 3, closed)(server);
        server.when(/^\/$/, { replace: (html) => change(html.toString()) });
      };
      await withPage(site(), { server }, async (view) => {
        await untilReady(
          view,
          pathsOf(site(), (rank) => rank <= 3),
        );
        const coarse = litPixels(withoutBar(await view.picture()));
        open();
        await view.promise("complete");
        for (const mask of [coarse, litPixels(withoutBar(await view.picture()))]) {
          assertClosed(mask);
          if (from === "inside")
            assert.ok(
              mask.every((pixel) => pixel === 1),
              "the background is visible",
            );
        }
      });
    });
  }

  test("and a patch that is off by a fraction of a coarse step is detected", async () => {
    const [path] = pathsOf(site(), (rank) => rank > 3);
    const flattened = (png: Buffer): Buffer => {
      const image = decodePng(png);
      return encodePng({ ...image, data: image.data.fill(0) });
    };
    const server = (server: TestServer): void => {
      server.when((requestedPath) => requestedPath === path, { replace: flattened });
      server.when(/^\/$/, { replace: (html) => fromInside(html.toString()) });
    };
    await withPage(site(), { server }, async (view) => {
      await view.promise("complete");
      assert.ok(
        litPixels(await view.picture()).some((pixel) => pixel === 0),
        "no gap is visible",
      );
    });
  });
});

describe("files are requested", () => {
  const site = (): string => siteOfGenerated("trefoil", "--profile", "classic", "--patch-vertices", "300");

  test("once each, first coordinate bytes first, then index, normals and the rest, and nothing else", async () => {
    await withPage(site(), {}, async (view) => {
      await view.promise("complete");
      const ranks = ranksOfFiles(pageOf(site()));
      const requested = view.server.requests.map(({ path }) => path.slice(1)).filter((path) => ranks.has(path));
      assert.deepEqual([...requested].sort(), [...ranks.keys()].sort());
      // Requests sent at the same time over several connections may arrive in any order.
      const connections = 6;
      const order = requested.map((path) => ranks.get(path)!);
      order.forEach((rank, index) => {
        const late = order.findIndex((other, later) => later >= index + connections && other < rank);
        assert.equal(late, -1, `rank ${rank} was requested well before rank ${order[late]}: ${order.join(" ")}`);
      });

      const others = view.server.requests
        .map(({ path }) => path)
        .filter((path) => !ranksOfFiles(pageOf(site())).has(path.slice(1)));
      const strange = others.filter(
        (path, index) =>
          !/^\/(imgeo\.css|icon\.png|runtime\/imgeo[\w-]*-[0-9a-f]{16}\.js)?$/.test(path) ||
          others.indexOf(path) < index,
      );
      assert.deepEqual(strange, []); // other than the page, its icon, modules and style sheet, each once
      assert.ok(view.server.requests.every(({ status }) => status === 200));
    });
  });

  test("while the runtime is still loading", async () => {
    const { closed, open } = gate();
    await withPage(site(), { server: (server) => server.when(/\.js$/, { hold: closed }) }, async (view) => {
      const first = pathsOf(site(), (rank) => rank === 0);
      await until("the first coordinate bytes arrive before the runtime", () =>
        first.every((path) =>
          view.server.requests.some((request) => request.path === path && request.state === "answered"),
        ),
      );
      open();
      await view.promise("complete");
      for (const path of first) {
        assert.equal(
          view.server.requests.filter((request) => request.path === path).length,
          1,
          `${path} is requested twice`,
        );
      }
    });
  });
});
