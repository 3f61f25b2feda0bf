// Tests viewpoints and navigation types, as the document specifies them and as users control them by keyboard, mouse,
// touch and menus.

import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { ViewElement } from "../../web/src/dom/imgeoView.ts";
import { assertSamePicture, difference } from "./compare.ts";
import { drag, focusView, touch } from "./gestures.ts";
import { finalPicture, pictureSize, settle, until, type View } from "./harness.ts";
import { isSoak, soakTest } from "./soak.ts";
import { viewEvents, recordViewEvents } from "./viewEvents.ts";
import type { Picture } from "./png.ts";
import { pageOf, siteOfGenerated, variantOf } from "./sites.ts";
import { withScene } from "./viewSites.ts";

const above =
  '<Viewpoint id="above" description="From above" position="0 12 0" orientation="1 0 0 -1.5707963"></Viewpoint>';
const side =
  '<Transform rotation="0 1 0 1.5707963"><Viewpoint id="side" description="Side" position="0 0 12"></Viewpoint></Transform>';

/** The site with viewpoints added after its own, and another NavigationInfo. */
function siteWith(name: string, viewpoints: string, navigation?: string): string {
  return variantOf(siteOfGenerated("trefoil-colors", "--profile", "classic"), name, (page) =>
    page
      .replace(/<\/Viewpoint>/i, (end) => `${end}${viewpoints}`)
      .replace(/<NavigationInfo[^>]*>/i, (own) => navigation ?? own),
  );
}

const threeViews = (): string => siteWith("views", above + side);

/** The picture of the page with this viewpoint as its only one. */
async function pictureFrom(viewpoint: string): Promise<Picture> {
  const site = variantOf(siteOfGenerated("trefoil-colors", "--profile", "classic"), "one-view", (page) =>
    page.replace(/<Viewpoint[\s\S]*<\/Viewpoint>/i, viewpoint),
  );
  return finalPicture(site, { before: recordViewEvents });
}

/** The picture without the menus, which are displayed over the scene. */
async function pictureWithoutMenus(view: View): Promise<Picture> {
  await view.page.evaluate(() => {
    document.querySelector("imgeo-view")!.shadowRoot!.querySelector<HTMLElement>(".controls")!.style.opacity = "0";
  });
  return view.picture();
}

const waysToBind: Record<string, (view: View) => Promise<void>> = {
  "the list": async ({ page }) => {
    await page.getByRole("combobox", { name: "Viewpoint" }).selectOption("Side");
  },
  set_bind: async ({ page }) => {
    await page.evaluate(() => {
      document.querySelector("#side")!.setAttribute("set_bind", "true");
    });
  },
  "X3DOM's bind": async ({ page }) => {
    await page.evaluate(() => {
      document.querySelector("#side")!.setAttribute("bind", "TRUE");
    });
  },
  "its name": async ({ page }) => {
    await page.evaluate(() => {
      document.querySelector<ViewElement>("x3d")!.bindViewpoint("Side");
    });
  },
  "its element": async ({ page }) => {
    await page.evaluate(() => {
      document.querySelector<ViewElement>("x3d")!.bindViewpoint(document.querySelector("#side")!);
    });
  },
};

describe("a viewpoint", () => {
  soakTest("is bound in every way, and unbound again", async () => {
    const fromTheSide = await pictureFrom(side);
    await withScene(threeViews(), {}, async (view) => {
      const start = await pictureWithoutMenus(view);
      for (const [name, bind] of Object.entries(waysToBind)) {
        await bind(view);
        assertSamePicture(`viewpoint by ${name}`, await pictureWithoutMenus(view), fromTheSide, { mean: 0.001 });
        assert.equal(await view.page.getByRole("combobox").inputValue(), "Side", name);
        assert.deepEqual(await boundNames(view), ["Side"], name);
        await view.page.evaluate(() => {
          const viewpoint = document.querySelector("#side")!;
          viewpoint.setAttribute("set_bind", "false");
          // Else the next way may set the value that is there already.
          for (const attribute of ["set_bind", "bind"]) viewpoint.removeAttribute(attribute);
        });
        assertSamePicture(`unbound after ${name}`, await pictureWithoutMenus(view), start, { mean: 0.001 });
        assert.deepEqual(await boundNames(view), ["Start"], name);
      }
    });
  });

  soakTest("is bound by set_bind in the document", async () => {
    const site = siteWith("bound", above.replace("description", 'set_bind="true" description') + side);
    await withScene(site, {}, async (view) => {
      assertSamePicture("bound from the start", await pictureWithoutMenus(view), await pictureFrom(above), {
        mean: 0.001,
      });
    });
  });

  soakTest("gives way to the first viewpoint when it is removed", async () => {
    await withScene(threeViews(), {}, async (view) => {
      const start = await pictureWithoutMenus(view);
      await view.page.evaluate(() => {
        document.querySelector("#above")!.setAttribute("set_bind", "true");
      });
      await view.page.evaluate(() => {
        document.querySelector("#above")!.remove();
      });
      assertSamePicture("removed viewpoint", await pictureWithoutMenus(view), start, { mean: 0.001 });
      assert.equal(await view.page.getByRole("option").count(), 2);
    });
  });

  soakTest("has no menu if it is the only one", async () => {
    await withScene(siteOfGenerated("trefoil-colors", "--profile", "classic"), {}, async ({ page }) => {
      assert.equal(await page.getByRole("combobox").count(), 0);
    });
  });

  async function boundNames({ page }: View): Promise<string[]> {
    return page.evaluate(() =>
      document
        .querySelector<ViewElement>("x3d")!
        .viewpoints.filter(({ isBound }) => isBound)
        .map(({ description }) => description),
    );
  }
});

describe("the transition to a viewpoint", () => {
  const bindSide = async (view: View): Promise<{ frames: number; picture: Picture }> => {
    await settle(view.page);
    const before = (await viewEvents(view, "camera-change")).length;
    await waysToBind.set_bind!(view);
    const picture = await pictureWithoutMenus(view);
    return { frames: (await viewEvents(view, "camera-change")).length - before, picture };
  };

  soakTest("is an animation that ends at the viewpoint", async () => {
    await withScene(threeViews(), { motion: true }, async (view) => {
      const { frames, picture } = await bindSide(view);
      assert.ok(frames > 3, `${frames} frames`);
      assertSamePicture("end of a transition", picture, await pictureFrom(side), { mean: 0.001 });
    });
  });

  soakTest("is skipped with reduced motion and with TELEPORT", async () => {
    await withScene(threeViews(), {}, async (view) => {
      assert.equal((await bindSide(view)).frames, 1);
    });
    const teleporting = siteWith("teleport", above + side, '<NavigationInfo transitionType="TELEPORT">');
    await withScene(teleporting, { motion: true }, async (view) => {
      assert.equal((await bindSide(view)).frames, 1);
    });
  });
});

const walking = (): string => siteWith("walk", "", '<NavigationInfo type=\'"WALK" "FLY" "EXAMINE"\' speed="3">');

describe("walking and flying", () => {
  soakTest("continue while a key is held, and end with the key or with the focus", async () => {
    await withScene(walking(), {}, async (view) => {
      await focusView(view);
      for (const end of [
        async () => view.page.keyboard.up("ArrowUp"),
        async () =>
          view.page.evaluate(() => {
            (document.activeElement as HTMLElement).blur();
          }),
      ]) {
        const before = (await viewEvents(view, "camera-change")).length;
        await view.page.keyboard.down("ArrowUp");
        await until(
          "the camera keeps moving",
          async () => (await viewEvents(view, "camera-change")).length > before + 3,
        );
        await end();
        await settle(view.page);
        const { length } = await viewEvents(view, "camera-change");
        await view.page.evaluate(() => new Promise((resolve) => setTimeout(resolve, 200)));
        assert.equal((await viewEvents(view, "camera-change")).length, length);
        await view.page.keyboard.up("ArrowUp");
      }
      assert.ok(
        (await viewEvents(view, "camera-change")).slice(1).every(({ detail }) => detail.source === "user-interaction"),
      );
    });
  });

  async function orbitOf({ page }: View): Promise<{ theta: number; phi: number; radius: number }> {
    return page.evaluate(() => {
      const { theta, phi, radius } = document.querySelector<ViewElement>("x3d")!.getCameraOrbit();
      return { theta, phi, radius };
    });
  }

  soakTest("dragging turns the camera, and its position stays", async () => {
    await withScene(walking(), {}, async (view) => {
      const before = await orbitOf(view);
      await drag(view, 80, 0);
      const after = await orbitOf(view);
      assert.ok(Math.abs(after.radius - before.radius) < 1e-6);
      // Turning to the left is like an orbit to the right around a center ahead.
      assert.ok(after.theta > before.theta + 0.05, `${before.theta} to ${after.theta}`);
    });
  });

  soakTest("by touch: one finger turns the camera, two fingers move it", async () => {
    await withScene(walking(), { hasTouch: true }, async (view) => {
      const start = await view.picture();
      await touch(view, [[[0, 0]], [[60, 0]], [[90, 10]]]);
      const looked = await view.picture();
      assert.ok(difference(start, looked).mean > 1, "one finger does not turn the camera");
      await touch(view, [
        [
          [-40, 0],
          [40, 0],
        ],
        [
          [-40, 40],
          [40, 40],
        ],
        [
          [-40, 90],
          [40, 90],
        ],
      ]);
      const walked = await view.picture();
      assert.ok(difference(looked, walked).mean > 1, "two fingers do not move the camera in WALK");
      await focusView(view);
      await view.page.keyboard.press("f");
      await touch(view, [
        [
          [-40, 0],
          [40, 0],
        ],
        [
          [-40, -40],
          [40, -40],
        ],
        [
          [-40, -90],
          [40, -90],
        ],
      ]);
      assert.ok(difference(walked, await view.picture()).mean > 1, "two fingers do not move the camera in FLY");
    });
  });

  test("are chosen by menu or by key, and announced", async () => {
    await withScene(walking(), {}, async (view) => {
      const list = view.page.getByRole("combobox", { name: "Way to move" });
      assert.deepEqual(await list.getByRole("option").allTextContents(), ["Walk", "Fly", "Examine"]);
      await focusView(view);
      await view.page.keyboard.press("e");
      assert.equal(await list.inputValue(), "Examine");
      await until("it is announced", async () => (await announcement(view)).includes("Examining"));
      await list.selectOption("Fly");
      await until("it is announced", async () => (await announcement(view)).includes("Flying"));
    });
  });

  test("walking by keyboard moves the camera, and R resets it", async () => {
    await withScene(walking(), {}, async (view) => {
      await focusView(view);
      const start = await pictureWithoutMenus(view);
      const more = isSoak ? ["Shift+ArrowUp", "Shift+ArrowLeft", "r", "e", "ArrowLeft", "+", "w", "ArrowDown"] : [];
      for (const key of ["ArrowUp", "ArrowRight", "f", "PageUp", ...more]) {
        await view.page.keyboard.press("r"); // on a slow host a key is held for long, and leads past the model
        const before = await pictureWithoutMenus(view);
        await hold(view, key);
        if (!/^[efwr]$/.test(key))
          assert.ok(difference(before, await pictureWithoutMenus(view)).mean > 0.2, `${key} does nothing`);
      }
      await view.page.keyboard.press("r");
      assertSamePicture("back from a walk", await pictureWithoutMenus(view), start, { mean: 0.001 });
    });
  });

  /** Holds a key for at least a quarter of a second and some frames. */
  async function hold({ page }: View, key: string): Promise<void> {
    const keys = key.split("+").filter((part) => part !== "");
    for (const part of keys.length ? keys : ["+"]) await page.keyboard.down(part);
    await page.evaluate(async () => {
      const end = performance.now() + 250;
      for (let frames = 0; frames < 8 || performance.now() < end; ++frames) await new Promise(requestAnimationFrame);
    });
    for (const part of (keys.length ? keys : ["+"]).reverse()) await page.keyboard.up(part);
  }
});

async function announcement({ page }: View): Promise<string> {
  return page.evaluate(
    () => document.querySelector("imgeo-view")!.shadowRoot!.querySelector("[role=status]")!.textContent,
  );
}

soakTest("reset buttons display the scene again on a touch screen", async () => {
  const size = { width: pictureSize.width, height: 844 }; // `touch` uses the center of the default picture
  await withScene(siteOfGenerated("trefoil", "--profile", "classic"), { size, hasTouch: true }, async (view) => {
    const { page } = view;
    const start = await view.picture();
    const buttons = page.getByRole("button");
    assert.equal(await buttons.count(), 0);
    await touch(view, [[[0, 0]], [[60, 0]], [[90, 10]]]);
    await touch(view, [
      [
        [-20, 0],
        [20, 0],
      ],
      [
        [-60, 0],
        [60, 0],
      ],
      [
        [-150, 0],
        [150, 0],
      ],
    ]);
    await until(
      "the reset buttons are displayed",
      async () => (await buttons.allTextContents()).join() === "Show all,Start",
    );
    const orbit = (): Promise<{ theta: number; radius: number }> =>
      page.evaluate(() => document.querySelector<ViewElement>("x3d")!.getCameraOrbit());
    const near = await orbit();
    await page.getByRole("button", { name: "Show all" }).tap();
    await settle(page);
    const all = await orbit();
    assert.ok(
      all.radius > 3 * near.radius && Math.abs(all.theta - near.theta) < 1e-6,
      "the whole scene is displayed from the same side",
    );
    await page.getByRole("button", { name: "Start" }).tap();
    assertSamePicture("found again", await view.picture(), start, { mean: 0.001 });
    assert.equal(await buttons.count(), 0);
  });
});

describe("navigation types that a document does not allow", () => {
  soakTest("cannot be chosen by key", async () => {
    await withScene(siteWith("only-walk", "", '<NavigationInfo type="WALK">'), {}, async (view) => {
      await focusView(view);
      await view.page.keyboard.press("e");
      const before = (await viewEvents(view)).length;
      await view.page.keyboard.down("ArrowUp"); // still in WALK: EXAMINE would move a single step
      await until("the camera keeps moving", async () => (await viewEvents(view)).length > before + 3);
      await view.page.keyboard.up("ArrowUp");
    });
  });

  soakTest("with NONE only the page moves the camera", async () => {
    await withScene(
      siteWith("none", above + side, '<NavigationInfo type="NONE">'),
      { hasTouch: true },
      async (view) => {
        const start = await pictureWithoutMenus(view);
        await drag(view, 90, 40);
        await view.page.mouse.wheel(0, 240);
        await touch(view, [[[0, 0]], [[60, 0]], [[90, 10]]]); // two fingers would zoom the page
        await view.page.evaluate(() => {
          document.querySelector("imgeo-view")!.shadowRoot!.querySelector("canvas")!.focus();
        });
        for (const key of ["ArrowLeft", "+", "r", "a", "w", "Escape"]) await view.page.keyboard.press(key);
        assertSamePicture("NONE", await pictureWithoutMenus(view), start, { mean: 0 });
        await waysToBind.set_bind!(view);
        assertSamePicture("NONE, bound", await pictureWithoutMenus(view), await pictureFrom(side), { mean: 0.001 });
      },
    );
  });
});

test("orbits keep the up axis of the page: a statue seen from above stays upright", async () => {
  await withScene(siteOfGenerated("trefoil-colors", "--profile", "classic"), {}, async (view) => {
    const orbit = async (): Promise<number> =>
      view.page.evaluate(() => document.querySelector<ViewElement>("x3d")!.getCameraOrbit().phi);
    const before = await orbit();
    assert.ok(before < Math.PI / 2 - 0.1, pageOf(siteOfGenerated("trefoil-colors", "--profile", "classic")));
    await drag(view, 150, 0);
    assert.ok(Math.abs((await orbit()) - before) < 1e-6);
  });
});
