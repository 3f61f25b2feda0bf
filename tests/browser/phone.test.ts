// Tests the examples on a phone: the page fits, and fingers walk, turn the object and open a note.

import assert from "node:assert/strict";
import { describe } from "node:test";
import type { ViewElement } from "../../web/src/dom/imgeoView.ts";
import { difference } from "./compare.ts";
import { hallSite, museumSite } from "./exampleSites.ts";
import { touch } from "./gestures.ts";
import { until, withPage, type PageOptions, type View } from "./harness.ts";
import { soakTest } from "./soak.ts";

const phone: PageOptions = { size: { width: 390, height: 844 }, hasTouch: true, hasToolbar: true };

/** Asserts that nothing scrolls, and that the view and all its buttons are within the screen. */
async function assertFits({ page }: View): Promise<void> {
  const outside = await page.evaluate(() => {
    const view = document.querySelector("imgeo-view");
    const parts = [
      ...document.querySelectorAll("imgeo-view, .text, .note, h1, main > p"),
      ...(view?.shadowRoot?.querySelectorAll("button, select") ?? []),
    ];
    return parts
      .filter((part) => part.checkVisibility())
      .map((part) => ({ name: `${part.localName} ${part.textContent}`, box: part.getBoundingClientRect() }))
      .filter(({ box }) => box.left < 0 || box.top < 0 || box.right > innerWidth || box.bottom > innerHeight)
      .map(({ name }) => name);
  });
  assert.deepEqual(outside, []);
  const sizes = await page.evaluate(() => {
    const { scrollWidth, scrollHeight } = document.documentElement;
    return { scrollWidth, scrollHeight, viewWidth: document.querySelector("imgeo-view")?.clientWidth };
  });
  assert.deepEqual(sizes, { scrollWidth: 390, scrollHeight: 844, viewWidth: 390 });
}

describe("on a phone", () => {
  soakTest("one finger looks around in the hall, and two fingers walk into it", async () => {
    await withPage(hallSite(4), phone, async (view) => {
      await view.promise("complete");
      await assertFits(view);
      const eye = (): Promise<{ x: number; y: number; z: number }> =>
        view.page.evaluate(() => ({ ...document.querySelector<ViewElement>("x3d")!.getCameraPosition() }));
      const start = await eye();
      const before = await view.picture();
      await touch(view, [[[0, 0]], [[40, 0]], [[60, 0]]]);
      assert.ok(difference(before, await view.picture()).mean > 1, "one finger does not look around");
      const distance = async (): Promise<number> => {
        const { x, z } = await eye();
        return Math.hypot(x - start.x, z - start.z);
      };
      assert.ok((await distance()) < 0.01, "looking around moves the visitor");
      const fingers = (down: number): [number, number][] => [
        [-40, down],
        [40, down],
      ];
      await touch(view, [fingers(0), fingers(60), fingers(120)]);
      await until("the visitor has walked", async () => (await distance()) > 0.2);
      assert.ok(Math.abs((await eye()).y - start.y) < 0.5, "the visitor leaves the floor");
    });
  });

  soakTest("one finger turns the museum's object, and a tap opens a note", async () => {
    await withPage(museumSite(), phone, async (view) => {
      await view.promise("complete");
      await assertFits(view);
      const before = await view.picture();
      await touch(view, [[[0, 60]], [[20, 60]], [[30, 60]]]);
      assert.ok(difference(before, await view.picture()).mean > 0.5, "one finger does not turn the object");
      await view.page.getByRole("button", { name: "Front" }).tap();
      const note = view.page.getByText("Its face.");
      await note.waitFor({ state: "visible" });
      const box = await note.boundingBox();
      assert.ok(box && box.x >= 0 && box.x + box.width <= 390 && box.y + box.height <= 844, "the note is cut off");
    });
  });
});
