// Tests what a view shows around its canvas, on a phone and with a mouse: its toolbar and help, labels that give way
// to one another, menus with long and empty names, and its landmarks for screen readers.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { describe, test } from "node:test";
import { gestureRows } from "../../web/src/dom/overlayLabels.ts";
import type { ViewElement } from "../../web/src/dom/imgeoView.ts";
import { difference } from "./compare.ts";
import { settle, until, withPage, type View } from "./harness.ts";
import { decodePng } from "./png.ts";
import { siteOfGenerated, variantOf } from "./sites.ts";
import { soakTest } from "./soak.ts";

const phone = { width: 390, height: 844 };

const longName = "The view from the gallery over the nave towards the choir, in the evening light of a day in June";

/**
 * A knot with notes and viewpoints. Two notes are about one direction, 0.1 apart; one is about a shape that may be
 * hidden.
 */
const site = (): string =>
  variantOf(siteOfGenerated("trefoil", "--profile", "classic"), "controls", (page) =>
    page
      .replace(/<X3D/i, '<X3D alt="A knot" camera-orbit="0deg 90deg 12m" camera-target="0 0 0"')
      .replace(/<Viewpoint/, `<Viewpoint description="${longName}" position="0 0 14"></Viewpoint>$&`)
      .replace(/<Viewpoint/, '<Viewpoint description="  " position="0 0 14"></Viewpoint>$&')
      .replace(/<\/Scene>/i, '<Shape DEF="ball"><Sphere radius="0.3"></Sphere></Shape>$&')
      .replace(
        /<\/X3D>/i,
        `<button slot="hotspot-far" data-position="0 1 1">A far note</button>
        <button slot="hotspot-near" data-position="0.1 1 2">A near note</button>
        <button slot="hotspot-ball" data-position="0 -3.5 0" data-shape="ball" data-visibility-attribute="visible">A ball</button>$&`,
      ),
  );

const opacityOf = (view: View, name: string): Promise<string> =>
  view.page.evaluate((text) => {
    const button = Array.from(document.querySelectorAll("button")).find(({ textContent }) => textContent === text);
    return getComputedStyle(button!).opacity;
  }, name);

/** Roles and names in the browser's accessibility tree, "region: 3D view". */
async function accessibleNodes({ page }: View): Promise<string[]> {
  const session = await page.context().newCDPSession(page);
  const { nodes } = await session.send("Accessibility.getFullAXTree");
  await session.detach();
  return nodes
    .filter(({ ignored }) => !ignored)
    .map(({ role, name }) => `${String(role?.value)}: ${String(name?.value ?? "")}`);
}

test("a phone has a button for everything that has a key, and a list of gestures and keys", async () => {
  await withPage(site(), { size: phone, hasTouch: true, hasToolbar: true }, async (view) => {
    const { page } = view;
    await view.promise("complete");
    await page.touchscreen.tap(phone.width / 2, 100);
    const toolbar = page.getByRole("toolbar", { name: "Tools of the view" });
    const buttons = toolbar.getByRole("button");
    const names = ["Points", "Full screen", "Save picture", "Help"];
    assert.deepEqual(
      await Promise.all((await buttons.all()).map((button) => button.getAttribute("aria-label"))),
      names,
    );
    const boxes = await Promise.all((await buttons.all()).map((button) => button.boundingBox()));
    for (const [i, box] of boxes.entries()) {
      assert.ok(box!.width >= 44 && box!.height >= 44, "as large as a finger");
      assert.ok(box!.x >= 0 && box!.x + box!.width <= phone.width && box!.y + box!.height <= phone.height);
      assert.ok(i === 0 || box!.x >= boxes[i - 1]!.x + boxes[i - 1]!.width);
    }
    await until("the tools are visible", () => toolbar.evaluate((bar) => getComputedStyle(bar).opacity === "1"));

    const surface = await view.picture();
    await buttons.nth(0).tap();
    assert.equal(await page.evaluate(() => document.querySelector("x3d")!.getAttribute("draw-as")), "points");
    assert.equal(await buttons.nth(0).getAttribute("aria-pressed"), "true");
    assert.ok(difference(surface, await view.picture()).mean > 1);
    await buttons.nth(0).tap();
    assert.equal(await buttons.nth(0).getAttribute("aria-pressed"), "false");

    const [download] = await Promise.all([page.waitForEvent("download"), buttons.nth(2).tap()]);
    assert.equal(download.suggestedFilename(), "a-knot.png");
    const saved = decodePng(readFileSync(await download.path()));
    assert.deepEqual([saved.width, saved.height], [phone.width, phone.height]);
    assert.ok(new Set(saved.data).size > 20, "the picture is of one colour");

    await buttons.nth(1).tap();
    await until("the view fills the screen", () =>
      page.evaluate(() => document.fullscreenElement?.localName === "imgeo-view"),
    );
    await until("its button is pressed", async () => (await buttons.nth(1).getAttribute("aria-pressed")) === "true");
    await buttons.nth(1).tap();
    await until("it is in the page again", () => page.evaluate(() => document.fullscreenElement === null));

    await buttons.nth(3).tap();
    const help = page.getByRole("dialog", { name: "How to turn the scene" });
    const rows = await help.getByRole("row").all();
    assert.deepEqual(
      await Promise.all(
        rows.map(async (row) => [await row.locator("th").textContent(), await row.locator("td").textContent()]),
      ),
      gestureRows("examine"),
    );
    const box = await help.boundingBox();
    assert.ok(box!.x >= 0 && box!.x + box!.width <= phone.width && box!.height <= phone.height);
    await help.getByRole("button", { name: "Close" }).tap();
    assert.equal(await help.count(), 0);

    // Menus fit, and name no viewpoint that has no name.
    const menu = page.getByRole("combobox", { name: "Viewpoint" });
    assert.deepEqual(await menu.locator("option").allTextContents(), [longName, "Start"]);
    const menuBox = await menu.boundingBox();
    assert.ok(menuBox!.x >= 0 && menuBox!.width <= phone.width / 1.5, `${menuBox!.width} pixels wide`);
  });
});

soakTest("with a mouse the menu is in the corner, and the tools appear beside or above it", async () => {
  for (const direction of ["ltr", "rtl"] as const)
    for (const width of [280, 640])
      await withPage(site(), { size: { width, height: 300 }, hasToolbar: true }, async (view) => {
        const { page } = view;
        await view.promise("complete");
        await page.evaluate((dir) => (document.documentElement.dir = dir), direction);
        const menu = await page.getByRole("combobox", { name: "Viewpoint" }).boundingBox();
        const tools = await page.getByRole("toolbar").boundingBox();
        assert.equal(menu!.y + menu!.height, 288);
        assert.equal(direction === "ltr" ? menu!.x + menu!.width : width - menu!.x, width - 12);
        const isAbove = tools!.y + tools!.height <= menu!.y;
        const isBeside = direction === "ltr" ? tools!.x + tools!.width <= menu!.x : tools!.x >= menu!.x + menu!.width;
        assert.equal(isAbove, width === 280);
        assert.equal(isBeside, width === 640);
      });
});

test("the keyboard reaches all tools by one stop, and ? lists the keys", async () => {
  await withPage(site(), { hasToolbar: true }, async (view) => {
    const { page } = view;
    await view.promise("complete");
    await settle(page);
    const focused = () =>
      page.evaluate(() => {
        const active = document.activeElement;
        const inner = active?.shadowRoot?.activeElement ?? active;
        return inner?.ariaLabel ?? inner?.textContent;
      });
    const order: (string | null | undefined)[] = [];
    for (let i = 0; i < 6; ++i) {
      await page.keyboard.press("Tab");
      order.push(await focused());
    }
    assert.deepEqual(order, ["A knot", "A far note", "A near note", "A ball", "Viewpoint", "Points"]);
    await page.keyboard.press("Tab");
    assert.equal(await page.evaluate(() => document.activeElement?.localName), "body", "the focus has left the view");
    await page.keyboard.press("Shift+Tab");
    for (const [key, name] of [
      ["ArrowRight", "Full screen"],
      ["End", "Help"],
      ["ArrowRight", "Points"],
      ["ArrowLeft", "Help"],
      ["Home", "Points"],
    ] as const) {
      await page.keyboard.press(key);
      assert.equal(await focused(), name);
    }
    await page.evaluate(() => {
      document.querySelector("imgeo-view")!.shadowRoot!.querySelector("canvas")!.focus();
    });
    await page.keyboard.press("?");
    assert.equal(await page.getByRole("dialog").count(), 1);
    await page.keyboard.press("Escape");
    assert.equal(await page.getByRole("dialog").count(), 0);
    assert.equal(await focused(), "A knot", "the focus is back");

    const nodes = await accessibleNodes(view);
    for (const node of [
      "region: 3D view: A knot",
      "application: A knot",
      "list: Notes in the scene",
      "toolbar: Tools of the view",
      "combobox: Viewpoint",
    ])
      assert.ok(nodes.includes(node), `${node} is not among\n${nodes.join("\n")}`);
    assert.equal(nodes.filter((node) => node.startsWith("listitem")).length, 3);

    await page.evaluate(() => {
      document.querySelector("x3d")!.setAttribute("camera-controls", "false");
    });
    await until("a still picture has no tools", async () => (await page.getByRole("toolbar").count()) === 0);
  });
});

describe("labels of hotspots", () => {
  soakTest("give way to nearer ones and to those of higher priority, and hide with their shape", async () => {
    await withPage(site(), { size: phone }, async (view) => {
      const { page } = view;
      await view.promise("complete");
      await settle(page);
      const shown = async () => [await opacityOf(view, "A far note"), await opacityOf(view, "A near note")];
      await until("the nearer note stays", async () => (await shown()).join() === "0,1");
      await page.getByRole("button", { name: "A far note" }).focus();
      await until("the focus shows a note", async () => (await shown())[0] !== "0");
      await page.evaluate(() => {
        (document.activeElement as HTMLElement).blur();
        document.querySelector("[slot=hotspot-far]")!.setAttribute("data-priority", "1");
      });
      await until("the more important note stays", async () => (await shown())[1] === "0");

      const ball = page.getByRole("button", { name: "A ball" });
      assert.ok(await ball.isVisible());
      await page.evaluate(() => {
        document.querySelector("[DEF=ball]")!.setAttribute("visible", "false");
      });
      await until("the note is gone with its shape", async () => !(await ball.isVisible()));
      assert.equal(
        await page.evaluate(() => document.querySelector("[data-shape]")!.hasAttribute("data-visible")),
        false,
      );
      await page.evaluate(() => {
        const { bindViewpoint } = document.querySelector<ViewElement>("x3d")!;
        document.querySelector("[DEF=ball]")!.removeAttribute("visible");
        bindViewpoint("Start");
      });
      await until("the note is back", () => ball.isVisible());
    });
  });
});

test("a converted page brings its icon and its picture for previews of links, and asks for nothing that is not there", async () => {
  await withPage(siteOfGenerated("trefoil"), {}, async (view) => {
    await view.promise("complete");
    const sizes = await view.page.evaluate(async () => {
      const urls = [
        document.querySelector<HTMLLinkElement>("link[rel=icon]")!.href,
        document.querySelector<HTMLMetaElement>("meta[property='og:image']")!.content,
      ];
      return Promise.all(
        urls.map(async (url) => {
          const image = new Image();
          image.src = url;
          await image.decode();
          return [image.naturalWidth, image.naturalHeight];
        }),
      );
    });
    assert.deepEqual(sizes, [
      [64, 64],
      [1200, 630],
    ]);
    assert.deepEqual(
      view.server.requests.filter(({ status }) => status >= 400),
      [],
    );
    assert.deepEqual(view.errors, []);
  });
});
