// Tests the display of compact: first the base mesh, which has no holes together with any subset of the patches; then
// patches in the order of their visibility; and damaged files, which affect only their own patch.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { describe, test } from "node:test";
import { assertSamePicture, boundsOfCompact, difference } from "./compare.ts";
import { largePictureSize, until, withPage, type View } from "./harness.ts";
import { readPly } from "./meshes.ts";
import type { Picture } from "./png.ts";
import { patchOfInput, referencePicture } from "./reference.ts";
import { gate, type Behaviour } from "./server.ts";
import { tagsOf } from "./siteDecoder.ts";
import { meshFile, pageOf, siteOfGenerated } from "./sites.ts";
import { soakTest } from "./soak.ts";

/** A closed surface of 136,000 triangles in several patches, with a base. */
const site = (): string => siteOfGenerated("trefoil-large", "--profile", "compact", "--patch-vertices", "20000");

function filesOf(directory: string): { base: string; patches: string[] } {
  const tags = tagsOf(pageOf(directory));
  const base = tags.find(({ name }) => name === "imagegeometry")?.attributes.base;
  assert.ok(base, "there is a base");
  return { base, patches: tags.flatMap(({ attributes: { data } }) => (data ? [data] : [])) };
}

const isPath =
  (url: string) =>
  (path: string): boolean =>
    path === `/${url}`;

/** For each pixel whether it differs from the background. */
function foreground({ width, height, channels, data }: Picture): boolean[] {
  const background = [0, 1, 2].map((channel) => data[(height - 2) * width * channels + channel]!);
  return Array.from({ length: width * height }, (_, pixel) =>
    background.some((shade, channel) => Math.abs(data[pixel * channels + channel]! - shade) > 12),
  );
}

/** Pixels whose neighbourhood of `margin` pixels to all sides is covered by the mesh. */
function inner(isMesh: readonly boolean[], margin: number): number[] {
  const { width, height } = largePictureSize;
  return isMesh.flatMap((_, pixel) => {
    const [x, y] = [pixel % width, Math.floor(pixel / width)];
    for (let dy = -margin; dy <= margin; ++dy) {
      for (let dx = -margin; dx <= margin; ++dx) {
        const [ax, ay] = [x + dx, y + dy];
        if (ax < 0 || ay < 0 || ax >= width || ay >= height || !isMesh[ay * width + ax]) return [];
      }
    }
    return [pixel];
  });
}

/** The picture of the whole shape, set by the first test. */
let wholePicture: Picture | undefined;

/** Asserts that all inner pixels of the whole shape are covered. */
function assertNoHoles(picture: Picture, full: Picture | undefined, what: string): void {
  assert.ok(full, "the test of subsets runs first");
  const inside = inner(foreground(full), 4);
  assert.ok(inside.length > 5000, `${inside.length} inner pixels`);
  const isMesh = foreground(picture);
  assert.equal(inside.filter((pixel) => !isMesh[pixel]).length, 0, `${what} has holes`);
}

function shuffled<Value>(values: Value[]): Value[] {
  return values
    .map((value) => ({ value, rank: Math.random() }))
    .sort((a, b) => a.rank - b.rank)
    .map(({ value }) => value);
}

const stages = async (view: View): Promise<unknown[]> =>
  [...(await view.events("first-image", "x3d")), ...(await view.events("refine", "x3d"))].map(
    ({ detail }) => detail.stage,
  );

describe("a base", () => {
  test("displays the whole shape, without holes together with any subset of the patches", async () => {
    const { base, patches } = filesOf(site());
    assert.ok(
      patches.length >= 4 && patches.length <= 6,
      `${patches.length} patches, all of which are requested at once`,
    );
    const gates = patches.map(gate);
    const server = (server: View["server"]): void => {
      patches.forEach((url, index) => {
        server.when(isPath(url), { hold: gates[index]!.closed });
      });
    };
    await withPage(site(), { server, size: largePictureSize }, async (view) => {
      await view.promise("firstImage");
      assert.deepEqual(await stages(view), ["base"]);
      const mixtures = [await view.picture()];
      // A random order in each run, which a failure names.
      const order = shuffled([...patches.keys()]);
      for (const index of order.slice(0, -1)) {
        gates[index]!.open();
        await until("the patch has arrived", () =>
          view.server.requests.some(({ path, status }) => isPath(patches[index]!)(path) && status === 200),
        );
        const seen = mixtures.at(-1)!;
        await until("the patch is displayed", async () => {
          const picture = await view.picture();
          if (difference(picture, seen).mean === 0) return false;
          mixtures.push(picture);
          return true;
        });
      }
      for (const { open } of gates) open();
      await view.promise("complete");
      assert.ok(view.page.workers().length > 0, "patches are decoded by workers");
      const full = await view.picture();
      assert.equal((await stages(view)).at(-1), "full");
      assert.equal(view.server.requestsOf(new RegExp(base)).length, 1);
      const input = patchOfInput(readPly(readFileSync(meshFile("trefoil-large"))));
      assertSamePicture(
        "input compact",
        full,
        await referencePicture(pageOf(site()), [input], largePictureSize),
        boundsOfCompact,
      );
      for (const [count, mixture] of mixtures.entries()) {
        const what = `a base with patches ${order.slice(0, count).join(", ")}`;
        assertNoHoles(mixture, full, what);
        assert.ok(difference(mixture, full).mean > 0, `${what} is complete`);
      }
      wholePicture = full;
    });
  });
});

describe("a damaged file of compact", () => {
  const flipped = (body: Buffer): Buffer => {
    const changed = Buffer.from(body);
    changed[changed.length >> 1]! ^= 0x10;
    return changed;
  };
  const faults: [string, Behaviour, RegExp][] = [
    ["missing", { status: 404 }, /http/],
    ["cut short", { truncateTo: 900 }, /truncated|malformed/],
    ["with a flipped bit", { replace: flipped }, /malformed/],
  ];

  test("affects only its patch, which the base mesh replaces, and is reported", async () => {
    const { patches } = filesOf(site());
    const server = (server: View["server"]): void => {
      faults.forEach(([, behaviour], index) => {
        server.when(isPath(patches[index]!), behaviour);
      });
    };
    await withPage(
      site(),
      { server, size: largePictureSize, expectedErrors: /Failed to load resource|imgeo/ },
      async (view) => {
        await until("all have been reported", async () => (await view.events("error", "x3d")).length === faults.length);
        await until("the scene is loaded", async () => (await view.events("load", "x3d")).length === 1);
        const errors = await view.events("error", "shape");
        for (const [index, [what, , kind]] of faults.entries()) {
          const error = errors.find(({ detail }) => detail.url === patches[index]);
          assert.match(String(error?.detail.type), kind, what);
        }
        assertNoHoles(await view.picture(), wholePicture, "the shape");
      },
    );
  });

  soakTest("affects no patch if it is the base mesh", async () => {
    const { base } = filesOf(site());
    const server = (server: View["server"]): void => {
      server.when(isPath(base), { status: 404 });
    };
    await withPage(site(), { server, expectedErrors: /Failed to load resource|imgeo/ }, async (view) => {
      await until("the scene is loaded", async () => (await view.events("load", "x3d")).length === 1);
      assert.deepEqual(
        (await view.events("error", "shape")).map(({ detail }) => detail.url),
        [base],
      );
      assert.equal((await stages(view)).at(-1), "full");
    });
  });
});

describe("patches of compact", () => {
  soakTest("are requested in the order of their visibility, after the base mesh", async () => {
    const { base, patches } = filesOf(site());
    // Close to one side: patches outside of the view are requested last.
    const near = (html: Buffer): string =>
      html
        .toString()
        .replace(
          /<Viewpoint[\s\S]*?<\/Viewpoint>/i,
          '<Viewpoint position="2.2 0 1.2" orientation="0 0 1 0" fieldOfView="0.6" centerOfRotation="2.2 0 0"></Viewpoint>',
        );
    await withPage(site(), { server: (server) => server.when(/^\/$/, { replace: near }) }, async (view) => {
      await view.promise("complete");
      const requested = view.requestedPaths.filter((path) => path === base || patches.includes(path));
      assert.equal(requested[0], base);
      assert.deepEqual(new Set(requested.slice(1)), new Set(patches));
      const seen = await view.page.evaluate(() =>
        Array.from(document.querySelectorAll("geometrypatch"), (patch) => {
          const [x = 0, y = 0, z = 0] = (patch.getAttribute("bboxCenter") ?? "").split(" ").map(Number);
          return { url: patch.getAttribute("data") ?? "", away: Math.hypot(x - 2.2, y, z - 1.2) };
        }),
      );
      const nearest = seen.reduce((a, b) => (b.away < a.away ? b : a));
      assert.ok(
        requested.indexOf(nearest.url) <= Math.ceil(patches.length / 2),
        `${nearest.url} is number ${requested.indexOf(nearest.url)}`,
      );
    });
  });

  soakTest("are freed when their shape is removed from the document", async () => {
    await withPage(site(), {}, async (view) => {
      await view.promise("complete");
      const count = (): Promise<{ geometries: number }> =>
        view.page.evaluate(
          () => (document.querySelector("imgeo-view") as unknown as { statistics: { geometries: number } }).statistics,
        );
      assert.ok((await count()).geometries >= filesOf(site()).patches.length);
      await view.page.evaluate(() => {
        document.querySelector("shape")?.remove();
      });
      await until("nothing is left", async () => (await count()).geometries === 0);
      assert.ok(!foreground(await view.picture()).includes(true));
    });
  });
});
