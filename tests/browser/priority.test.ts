// Tests the order in which files are requested (paper section 5.4), from outside the runtime.

import assert from "node:assert/strict";
import { createHash } from "node:crypto";
import { describe, test } from "node:test";
import { settle, until, withPage, type View } from "./harness.ts";
import { ranksIn, sceneOf, shapeInFolder } from "./scenes.ts";
import { gate } from "./server.ts";
import { siteOfGenerated } from "./sites.ts";
import { soakTest } from "./soak.ts";

const knot = (): string => siteOfGenerated("trefoil", "--profile", "classic", "--patch-vertices", "1000");
const ball = (): string => siteOfGenerated("sphere", "--profile", "classic", "--patch-vertices", "2000");

/** The knot on the left and the ball on the right, about 6 and 2 wide. */
function twoShapes(viewpoint: string, { knotAttributes = "", ballAttributes = "", x3dAttributes = "" } = {}): string {
  const scene = `<Viewpoint ${viewpoint}></Viewpoint>
    <Transform translation="-30 0 0">${shapeInFolder(knot(), "knot", `id="knot" ${knotAttributes}`)}</Transform>
    <Transform translation="30 0 0">${shapeInFolder(ball(), "ball", `id="ball" ${ballAttributes}`)}</Transform>`;
  const name = createHash("sha256")
    .update(scene + x3dAttributes)
    .digest("hex")
    .slice(0, 12);
  return sceneOf(`priority-${name}`, { knot: knot(), ball: ball() }, scene, x3dAttributes);
}

const atKnot = 'position="-30 0 12"';
const atBall = 'position="30 0 6"';
const atBoth = 'position="0 0 80" fieldOfView="1"';

/** The requested files of both shapes, in order: "knot0" is a first byte of the knot, "ball2" normals of the ball. */
function requestedNames(view: View): string[] {
  const ranks = new Map([...ranksIn(knot(), "knot"), ...ranksIn(ball(), "ball")]);
  return view.requestedPaths
    .filter((url) => ranks.has(url))
    .map((url) => `${url.split("/")[0] ?? ""}${ranks.get(url) ?? ""}`);
}

const isOf =
  (shape: string) =>
  (name: string): boolean =>
    name.startsWith(shape);

function assertBefore(names: string[], early: (name: string) => boolean, late: (name: string) => boolean): void {
  assert.ok(names.some(early) && names.some(late), names.join(" "));
  assert.ok(names.findLastIndex(early) < names.findIndex(late), names.join(" "));
}

async function requestOrderOf(directory: string): Promise<string[]> {
  let names: string[] = [];
  await withPage(directory, {}, async (view) => {
    await view.promise("complete");
    names = requestedNames(view);
  });
  return names;
}

describe("the order of requests", () => {
  test("follows the camera: visible shapes come first", async () => {
    assertBefore(await requestOrderOf(twoShapes(atKnot)), isOf("knot"), isOf("ball"));
    assertBefore(await requestOrderOf(twoShapes(atBall)), isOf("ball"), isOf("knot"));
  });

  soakTest("loads the first bytes of both visible shapes before further bytes, the larger shape first", async () => {
    const names = await requestOrderOf(twoShapes(atBoth));
    for (const rank of ["0", "1", "2"]) {
      assertBefore(
        names,
        (name) => name === `knot${rank}`,
        (name) => name === `ball${rank}`,
      );
    }
    assertBefore(
      names,
      (name) => name.endsWith("0"),
      (name) => name.endsWith("1"),
    );
  });

  soakTest("follows the author: by shape", async () => {
    const names = await requestOrderOf(twoShapes(atBoth, { ballAttributes: 'priority="1000"' }));
    assertBefore(names, isOf("ball"), isOf("knot"));
  });

  soakTest("follows the author: by chunk type", async () => {
    const names = await requestOrderOf(twoShapes(atBoth, { x3dAttributes: 'chunkPriority="normal: 100000"' }));
    assertBefore(
      names,
      (name) => name.endsWith("2"),
      (name) => !name.endsWith("2"),
    );
  });

  for (const [cause, change] of [
    [
      "the camera",
      () => {
        document.querySelector("viewpoint")!.setAttribute("position", "30 0 6");
      },
    ],
    [
      "the author",
      () => {
        document.querySelector("#ball")!.setAttribute("priority", "100000");
      },
    ],
  ] as const) {
    soakTest(`changes while files wait: ${cause}`, async () => {
      const { closed, open } = gate();
      await withPage(
        twoShapes(atKnot),
        { server: (server) => server.when(/^\/(knot|ball)\//, { hold: closed }) },
        async (view) => {
          await until("all slots are taken", () => requestedNames(view).length === 6);
          await view.page.evaluate(change);
          await settle(view.page);
          open();
          await view.promise("complete");
          const names = requestedNames(view);
          assert.ok(names.slice(0, 6).every(isOf("knot")), names.join(" "));
          assertBefore(names.slice(6), isOf("ball"), isOf("knot"));
        },
      );
    });
  }

  soakTest("changes while files wait: the user", async () => {
    const { closed, open } = gate();
    await withPage(
      twoShapes(atBoth),
      { server: (server) => server.when(/^\/(knot|ball)\//, { hold: closed }) },
      async (view) => {
        await until("all slots are taken", () => requestedNames(view).length === 6);
        await view.page.locator("imgeo-view canvas").focus();
        // Moves the scene to the left until only the ball is visible.
        for (let step = 0; step < 11; ++step) await view.page.keyboard.press("Shift+ArrowLeft");
        await settle(view.page);
        // The runtime updates priorities by a timer some times a second; a later timer of the test runs after it.
        await view.page.evaluate(() => new Promise((resolve) => setTimeout(resolve, 500)));
        open();
        await view.promise("complete");
        assertBefore(requestedNames(view).slice(6), isOf("ball"), isOf("knot"));
      },
    );
  });
});

describe("a shape that is hidden", () => {
  test("is not requested, and does not delay the scene's load", async () => {
    await withPage(twoShapes(atBoth, { ballAttributes: 'visible="false"' }), {}, async (view) => {
      await view.promise("complete");
      assert.ok(!requestedNames(view).some(isOf("ball")), requestedNames(view).join(" "));
      assert.deepEqual(await view.events("progress", "shape#ball"), []);

      await view.page.evaluate(() => {
        document.querySelector("#ball")!.setAttribute("visible", "true");
      });
      await view.promise("complete", "#ball");
      await view.promise("complete");
      assert.ok(requestedNames(view).some(isOf("ball")));
      assert.equal((await view.events("load", "x3d")).length, 2);
    });
  });

  soakTest("while it loads is no longer requested, and its requests are aborted", async () => {
    const { closed } = gate();
    const server = (server: View["server"]): void => void server.when(/^\/ball\//, { hold: closed });
    await withPage(twoShapes(atBall), { server }, async (view) => {
      await until("all slots are taken", () => view.server.requestsOf(/^\/ball\//).length === 6);
      await view.page.evaluate(() => {
        document.querySelector("#ball")!.setAttribute("visible", "false");
      });
      await view.promise("complete"); // the knot gets the request slots
      const requests = view.server.requestsOf(/^\/ball\//);
      assert.deepEqual(
        requests.map(({ state }) => state),
        Array.from({ length: 6 }, () => "aborted"),
      );
      assert.deepEqual(await view.events("error"), []);
    });
  });
});

describe("a byte whose effect is invisible", () => {
  const secondBytes = (view: View): number => requestedNames(view).filter((name) => name === "knot4").length;

  soakTest(
    "is not requested, the scene is complete without it, and it is requested when the camera comes near",
    async () => {
      await withPage(twoShapes('position="-30 0 900"'), {}, async (view) => {
        await view.promise("complete");
        assert.equal(secondBytes(view), 0);
        assert.deepEqual((await view.events("progress", "x3d")).at(-1)?.detail.totalProgress, 1);

        await view.page.evaluate(() => {
          document.querySelector("viewpoint")!.setAttribute("position", "-30 0 12");
        });
        const stages = async (): Promise<unknown[]> =>
          (await view.events("refine", "shape#knot")).map(({ detail }) => detail.stage);
        await until("the knot has full precision", async () => (await stages()).at(-1) === "full");
        assert.ok(secondBytes(view) > 0);
        assert.equal((await view.events("load", "shape#knot")).length, 1);
        assert.equal((await view.events("load", "x3d")).length, 1);
      });
    },
  );
});
