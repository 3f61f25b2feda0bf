// Tests the museum example (paper, figure 12): notes at positions of the statue, and a key that displays points or
// triangles.

import assert from "node:assert/strict";
import { test } from "node:test";
import { assertSamePicture, difference } from "./compare.ts";
import { museumSite } from "./exampleSites.ts";
import { focusView } from "./gestures.ts";
import { until, withPage } from "./harness.ts";
import { viewEvents, recordViewEvents } from "./viewEvents.ts";

test("the museum example has notes that are readable from everywhere, displays its points, and does not rotate with reduced motion", async () => {
  await withPage(museumSite(), { before: recordViewEvents }, async (view) => {
    const { page } = view;
    await view.promise("complete");
    const opacityOf = (name: string): Promise<string> =>
      page.evaluate((expectedText) => {
        const note = Array.from(document.querySelectorAll<HTMLElement>(".note")).find(
          ({ textContent }) => textContent === expectedText,
        );
        return getComputedStyle(note!).opacity;
      }, name);
    await until(
      "the note on the far side has faded",
      async () => (await opacityOf("Front")) === "1" && (await opacityOf("Back")) === "0.25",
    );

    await focusView(view);
    const focused = async (): Promise<string | undefined> => {
      await page.keyboard.press("Tab");
      return page.evaluate(() => document.activeElement?.textContent);
    };
    assert.deepEqual([await focused(), await focused()], ["Front", "Back"]); // the faded note as well
    await page.keyboard.press("Enter");
    assert.ok(await page.getByText("Its other side.").isVisible());
    await page.keyboard.press("Escape");
    assert.ok(!(await page.getByText("Its other side.").isVisible()));

    await page.evaluate(() => {
      document.querySelector("x3d")!.setAttribute("camera-orbit", "150deg 90deg auto");
    });
    await until(
      "the other note has faded",
      async () => (await opacityOf("Front")) === "0.25" && (await opacityOf("Back")) === "1",
    );

    await page.evaluate(() => {
      document.querySelector("imgeo-view")!.shadowRoot!.querySelector("canvas")!.focus();
    });
    const surface = await view.picture();
    await page.keyboard.press("p");
    assert.equal(await page.evaluate(() => document.querySelector("x3d")!.getAttribute("draw-as")), "points");
    const { offShare } = difference(surface, await view.picture());
    assert.ok(offShare > 0.02, `points and surface differ in ${offShare} of all pixels`);
    await page.keyboard.press("p");
    assertSamePicture("a surface again", await view.picture(), surface, { mean: 0.001 });
    assert.ok(
      (await viewEvents(view, "camera-change")).every(({ detail }) => detail.source !== "automatic"),
      "it rotates although reduced motion is preferred",
    );
  });
});
