// Tests external disturbances: a slow host, a host that refuses other origins, a lost WebGL context, a hidden tab. In
// the end the picture is correct, and events have been correct throughout.

import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { assertSamePicture } from "./compare.ts";
import { pictureOfSite, settle, until, withPage, type View } from "./harness.ts";
import { sceneOf, shapeInFolder } from "./scenes.ts";
import { gate, startServer } from "./server.ts";
import { ranksOfFiles } from "./siteDecoder.ts";
import { pageOf, siteOfGenerated } from "./sites.ts";
import { isSoak, soakTest } from "./soak.ts";

const site = (): string => siteOfGenerated("trefoil", "--profile", "classic", "--patch-vertices", "1000");

function filesOf(ranks: (rank: number) => boolean): (path: string) => boolean {
  const paths = [...ranksOfFiles(pageOf(site()))].filter(([, rank]) => ranks(rank)).map(([url]) => `/${url}`);
  return (path) => paths.includes(path);
}

/** Asserts one first-image, then refine with rising stages, then one load. */
async function assertCorrectEvents(view: View): Promise<void> {
  for (const target of ["x3d", "shape"]) {
    const firstImageCount = (await view.events("first-image", target)).length;
    assert.equal(firstImageCount, 1, `${firstImageCount} first images of ${target}`);
    assert.equal((await view.events("load", target)).length, 1);
    const own = (await view.observed()).events.filter((event) => event.target === target && event.type !== "progress");
    assert.equal(own[0]?.type, "first-image");
    assert.equal(own.at(-1)?.type, "load");
    const ranks = own
      .slice(0, -1)
      .map(({ detail }) => ["points", "surface", "shaded", "full"].indexOf(String(detail.stage)));
    assert.deepEqual(
      ranks,
      ranks.toSorted((a, b) => a - b),
    );
  }
  assert.deepEqual(await view.events("error"), []);
}

describe("a slow host", () => {
  test("displays the first picture before any second byte has arrived, and then everything", async () => {
    const { closed, open } = gate();
    const isSecondByte = filesOf((rank) => rank === 4);
    const server = (server: View["server"]): void => {
      server.useLink({ bitsPerSecond: 2e6, roundTripMs: 100 });
      server.when(isSecondByte, { hold: closed });
    };
    await withPage(site(), { server }, async (view) => {
      await view.promise("firstImage"); // would not resolve if it waited for a second byte
      const answered = view.server.requests.filter(({ path, state }) => isSecondByte(path) && state === "answered");
      assert.deepEqual(answered, []);
      open();
      await view.promise("complete");
      await assertCorrectEvents(view);
      assertSamePicture("slow host", await view.picture(), await pictureOfSite(site()), { mean: 0 });
    });
  });

  test("that is busy for a second gets another request after Retry-After", async () => {
    const server = (server: View["server"]): void => {
      const recover = server.when(
        filesOf((rank) => rank === 2),
        { status: 503, headers: { "Retry-After": "1" } },
      );
      setTimeout(recover, 1000);
    };
    await withPage(site(), { server, expectedErrors: /503/ }, async (view) => {
      await view.promise("complete");
      await assertCorrectEvents(view);
      assertSamePicture("busy host", await view.picture(), await pictureOfSite(site()), { mean: 0 });
    });
  });
});

soakTest(
  "a host that refuses other origins affects only shapes with files on it, and the error says what it must allow",
  async () => {
    const other = await startServer(site());
    try {
      const [file = ""] = /geometry\/\w+\.png/.exec(pageOf(site())) ?? [];
      // The browser displays such an <img>, but gives its pixels to nobody.
      const ofImage = `<imagegeometry vertexcount="3"><img containerfield="coord" src="${other.origin}${file}"></imagegeometry>`;
      const scene =
        shapeInFolder(site(), "good", 'id="good"') +
        shapeInFolder(site(), "bad", 'id="bad"').replaceAll("bad/", other.origin) +
        `<shape id="image" bboxsize="1 1 1">${ofImage}</shape>`;
      const options = {
        isCrossOrigin: true,
        server: (server: View["server"]): void => {
          server.contentPolicy = "default-src 'self'; connect-src *; img-src *";
        },
        expectedErrors: /Access-Control-Allow-Origin|Failed to load resource|imgeo/,
      };
      await withPage(sceneOf("cross-origin", { good: site() }, scene), options, async (view) => {
        await view.promise("complete", "#good");
        await view.promise("complete");
        const errors = await view.events("error", "shape#bad");
        assert.ok(errors.length > 0);
        for (const { detail } of errors) {
          assert.equal(detail.type, "network");
          assert.match(String(detail.message), /another origin must allow it with Access-Control-Allow-Origin/);
        }
        const errorsOfImage = await view.events("error", "shape#image");
        assert.equal(errorsOfImage.length, 1);
        assert.match(String(errorsOfImage[0]?.detail.message), /another origin must allow it/);
        assert.deepEqual(await view.events("error", "shape#good"), []);
      });
    } finally {
      await other.close();
    }
  },
);

describe("a lost WebGL context", () => {
  const lose = (): void => {
    const context = document.querySelector("imgeo-view")!.shadowRoot!.querySelector("canvas")!.getContext("webgl2")!;
    (window as unknown as { loser: WEBGL_lose_context }).loser = context.getExtension("WEBGL_lose_context")!;
    (window as unknown as { loser: WEBGL_lose_context }).loser.loseContext();
  };
  const restore = (): void => {
    (window as unknown as { loser: WEBGL_lose_context }).loser.restoreContext();
  };

  test("is restored with the same picture, and without a second load event", async () => {
    await withPage(site(), {}, async (view) => {
      await view.promise("complete");
      const before = await view.picture();
      await view.page.evaluate(lose);
      await view.page.evaluate(() => new Promise((resolve) => setTimeout(resolve, 200)));
      const requestCount = view.server.requests.length;
      await view.page.evaluate(restore);
      await until("the files are requested again", () => view.server.requests.length > requestCount);
      await until("the picture is back", async () => {
        await settle(view.page);
        const statistics = await view.page.evaluate(() => {
          const { statistics } = document.querySelector("imgeo-view") as unknown as {
            statistics: { openRequests: number };
          };
          return statistics.openRequests;
        });
        return statistics === 0;
      });
      await settle(view.page);
      assertSamePicture("restored context", await view.picture(), before, { mean: 0 });
      await assertCorrectEvents(view);
      assert.equal((await view.observed()).live.bitmaps, 0);
    });
  });

  soakTest("during loading only delays it", async () => {
    const { closed, open } = gate();
    const server = (server: View["server"]): void =>
      void server.when(
        filesOf((rank) => rank > 0),
        { hold: closed },
      );
    await withPage(site(), { server }, async (view) => {
      await view.promise("firstImage");
      await view.page.evaluate(lose);
      open();
      await view.page.evaluate(() => new Promise((resolve) => setTimeout(resolve, 300)));
      assert.deepEqual(await view.events("load"), []);
      await view.page.evaluate(restore);
      await view.promise("complete");
      await assertCorrectEvents(view);
      assertSamePicture("context lost amid loading", await view.picture(), await pictureOfSite(site()), { mean: 0 });
    });
  });
});

soakTest(
  "thousands of shapes are all displayed except one whose files are missing, and the page follows the keyboard",
  async () => {
    const side = isSoak ? 100 : 50;
    const small = siteOfGenerated("sphere-small", "--profile", "classic");
    const [whole, broken] = [shapeInFolder(small, "small", 'id="NAME"'), shapeInFolder(small, "missing", 'id="NAME"')];
    const shapes = Array.from({ length: side * side }, (_, n) => {
      const shape = (n === 1234 ? broken : whole).replace("NAME", `s${n}`);
      return `<Transform translation="${2.5 * (n % side) - 125} ${2.5 * Math.floor(n / side) - 125} 0">${shape}</Transform>`;
    });
    const directory = sceneOf("thousands", { small }, `<Viewpoint position="0 0 320"></Viewpoint>${shapes.join("\n")}`);
    await withPage(directory, { expectedErrors: /Failed to load resource|imgeo/ }, async (view) => {
      await view.promise("complete", "x3d", 120);
      await settle(view.page);
      const { loaded, failed, draws } = await view.page.evaluate(() => {
        const targetsOf = (eventType: string) =>
          window.observed.events.filter(({ type, target }) => type === eventType && target !== "x3d");
        return {
          loaded: targetsOf("load").length,
          failed: targetsOf("error").map(({ target }) => target),
          draws: window.observed.draws,
        };
      });
      assert.equal(loaded, side * side - 1);
      assert.deepEqual([...new Set(failed)], ["shape#s1234"]);
      // One request per URL, and one console line per error.
      assert.ok(view.server.requests.length < 20, `${view.server.requests.length} requests`);
      assert.equal(view.errors.filter((line) => line.startsWith("imgeo:")).length, failed.length);
      await view.page.locator("imgeo-view canvas").press("ArrowLeft");
      await until("the view draws again", () => view.page.evaluate((before) => window.observed.draws > before, draws));
      // Each shape is written in full, but shapes with the same files are instances of one geometry.
      const perFrame = await view.page.evaluate(async () => {
        const before = window.observed.draws;
        await (document.querySelector("x3d") as unknown as { toBlob: () => Promise<Blob> }).toBlob();
        return window.observed.draws - before;
      });
      assert.ok(perFrame <= 4, `${perFrame} draws of a frame`);
    });
  },
);

describe("a hidden tab", () => {
  /** Simulates a hidden tab, which headless Chromium does not have: no animation frames, and document.hidden. */
  const hideAtFirst = (): void => {
    let isHidden = true;
    let waiting: FrameRequestCallback[] = [];
    const request = window.requestAnimationFrame.bind(window);
    window.requestAnimationFrame = (callback) => (isHidden ? -waiting.push(callback) : request(callback));
    Object.defineProperty(document, "hidden", { get: () => isHidden });
    Object.defineProperty(document, "visibilityState", { get: () => (isHidden ? "hidden" : "visible") });
    (window as unknown as { reveal: () => void }).reveal = () => {
      isHidden = false;
      for (const callback of waiting) request(callback);
      waiting = [];
      document.dispatchEvent(new Event("visibilitychange"));
    };
  };

  soakTest("loads files; pictures and their events wait until it is visible", async () => {
    await withPage(site(), { before: hideAtFirst }, async (view) => {
      const files = filesOf(() => true);
      const count = ranksOfFiles(pageOf(site())).size;
      await until(
        "all files have arrived",
        () => view.server.requests.filter(({ path, state }) => files(path) && state === "answered").length === count,
      );
      await view.page.evaluate(() => new Promise((resolve) => setTimeout(resolve, 1000)));
      for (const type of ["first-image", "refine", "load"]) assert.deepEqual(await view.events(type), []);
      await view.page.evaluate(() => {
        (window as unknown as { reveal: () => void }).reveal();
      });
      await view.promise("complete");
      await assertCorrectEvents(view);
      assertSamePicture("hidden tab", await view.picture(), await pictureOfSite(site()), { mean: 0 });
      assert.equal((await view.observed()).live.bitmaps, 0);
    });
  });
});
