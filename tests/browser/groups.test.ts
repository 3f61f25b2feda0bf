// Tests Billboard and Anchor.

import assert from "node:assert/strict";
import { test } from "node:test";
import { until, withPage, type View } from "./harness.ts";
import { sceneOf } from "./scenes.ts";
import { siteOfGenerated } from "./sites.ts";

const size = { width: 320, height: 240 };
const paint = (color: string): string =>
  `<Appearance><UnlitMaterial emissiveColor="${color}"></UnlitMaterial></Appearance>`;
/** A flat panel: invisible when seen from its side. */
const panel = `<Shape>${paint("1 0 0")}<IndexedFaceSet solid="false" coordIndex="0 1 2 3"><Coordinate point="-1 -1 0 1 -1 0 1 1 0 -1 1 0"></Coordinate></IndexedFaceSet></Shape>`;
const box = `<Shape>${paint("0 0 1")}<Box size="0.8 0.8 0.8"></Box></Shape>`;
const views = { ahead: 0, aside: 1.5708, behind: 2.5 };
const scene = `<NavigationInfo transitionType="TELEPORT"></NavigationInfo><Background skyColor="0 0 0"></Background>
  ${Object.entries(views)
    .map(
      ([name, angle]) =>
        `<Viewpoint description="${name}" position="${8 * Math.sin(angle)} 0 ${8 * Math.cos(angle)}" orientation="0 1 0 ${angle}"></Viewpoint>`,
    )
    .join("")}
  <Viewpoint DEF="there" description="there" position="0 0 9"></Viewpoint>
  <Anchor id="viewpoint" url='"javascript:document.title=1" "#there"' description="Go there"><Transform translation="-1.5 2.3 0">${box}</Transform></Anchor>
  <Anchor id="section" url="#section" description="Read on"><Transform translation="1.5 2.3 0">${box}</Transform></Anchor>
  <Anchor id="script" url="javascript:document.title=1"><Transform translation="0 2.3 0">${box}</Transform></Anchor>
  <Transform id="around" rotation="0 1 0 0.7"><Billboard>${panel}</Billboard></Transform>`;

async function redPixels(view: View): Promise<number> {
  const { data, channels } = await view.picture();
  let count = 0;
  for (let at = 0; at < data.length; at += channels) if (data[at]! > 128 && data[at + 1]! < 64) count += 1;
  return count;
}

/** Clicks on the box at `x` as displayed by the viewpoint ahead. */
const clickAt = (view: View, x: number): Promise<void> => {
  const unit = size.height / 2 / Math.tan(0.7854 / 2) / 8;
  return view.page.mouse.click(size.width / 2 + x * unit, size.height / 2 - 2.3 * unit);
};

const boundIn = (view: View): Promise<string | undefined> =>
  view.page.evaluate(
    () =>
      (
        document.querySelector("x3d") as unknown as { viewpoints: { description: string; isBound: boolean }[] }
      ).viewpoints.find(({ isBound }) => isBound)?.description,
  );

async function bind(view: View, name: string): Promise<void> {
  await view.page.evaluate((description) => {
    (document.querySelector("x3d") as unknown as { bindViewpoint: (name: string) => void }).bindViewpoint(description);
  }, name);
  await view.picture();
}

/** Tests clicks on shapes in Anchors, and their links for the keyboard. */
async function assertLinks(view: View): Promise<void> {
  const { page } = view;
  const hash = (): Promise<string> => page.evaluate(() => location.hash);
  await bind(view, "ahead");
  await page.evaluate(() => {
    document.querySelector("#section")!.addEventListener(
      "click",
      (event) => {
        event.preventDefault();
      },
      { once: true },
    );
  });
  await clickAt(view, 1.5);
  await clickAt(view, 0);
  assert.equal(await hash(), "", "a prevented click and a script URL are not followed");
  await clickAt(view, 1.5);
  await until("the page is at its section", async () => (await hash()) === "#section");
  await clickAt(view, -1.5);
  await until("the viewpoint is bound", async () => (await boundIn(view)) === "there");
  assert.equal(await hash(), "#section");
  await bind(view, "ahead");
  const links = page.locator("imgeo-view nav a");
  assert.deepEqual(await links.allTextContents(), ["Go there", "Read on"]);
  await links.first().focus();
  await page.keyboard.press("Enter");
  await until("the viewpoint is bound by the keyboard", async () => (await boundIn(view)) === "there");
  await page.evaluate(() => {
    document.querySelector("#viewpoint")!.removeAttribute("url");
  });
  await until("the link is removed with its url", async () => (await links.allTextContents()).join() === "Read on");
  assert.notEqual(await page.title(), "1");
}

test("a billboard faces every viewpoint, drawn alone and in a batch, and anchors follow their links", async () => {
  const site = sceneOf("groups", { trefoil: siteOfGenerated("trefoil", "--profile", "classic") }, scene);
  await withPage(site, { size }, async (view) => {
    await view.promise("complete");
    // Two units at a distance of 8, in 240 pixels of a field of view of 45 degrees.
    const whole = ((size.height / 2 / Math.tan(0.7854 / 2) / 8) * 2) ** 2;
    const assertSeen = async (how: string): Promise<void> => {
      for (const name of Object.keys(views)) {
        await bind(view, name);
        const seen = await redPixels(view);
        assert.ok(Math.abs(seen / whole - 1) < 0.03, `${how}, ${name}: ${seen} pixels instead of ${whole.toFixed(0)}`);
      }
    };
    await assertSeen("alone");
    await assertLinks(view);
    await view.page.evaluate(() => {
      const others = Array.from(
        { length: 16 },
        () => "<Shape><Appearance><Material></Material></Appearance><Box size='0.01 0.01 0.01'></Box></Shape>",
      );
      document.querySelector("billboard")!.insertAdjacentHTML("beforeend", others.join(""));
    });
    await assertSeen("in a batch");
    await view.page.evaluate(() => {
      document.querySelector("billboard")!.setAttribute("axisOfRotation", "0 0 1");
    });
    const unturned = await redPixels(view);
    assert.ok(unturned < 0.97 * whole, `${unturned} pixels of a panel that cannot turn`);
  });
});
