// Tests the example page that is written around the files of a sequence (`make sequence`): its clock plays, its slider
// scrubs, and its button shows a moment.

import assert from "node:assert/strict";
import { cpSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { sequencePage } from "../../examples/sequence/page.ts";
import { breathSite, frameCount, rate } from "./breath.ts";
import { savePicture } from "./compare.ts";
import { until, withPage } from "./harness.ts";
import { recordStream, type FrameDetail } from "./livePage.ts";
import { repository } from "./paths.ts";
import { variantOf } from "./sites.ts";

function exampleSite(): string {
  const site = variantOf(breathSite(), "by-hand", (page) => sequencePage(page, "A breathing ball"));
  for (const file of ["scrub.css", "scrub.js"]) cpSync(join(repository, "examples/sequence", file), join(site, file));
  return site;
}

test("the page around a sequence plays it, a slider scrubs, and a button shows a moment", async () => {
  await withPage(exampleSite(), { before: recordStream, motion: true }, async (view) => {
    await view.promise("complete");
    const { page } = view;
    const numbers = async (): Promise<number[]> =>
      (await page.evaluate(() => (window as unknown as { frames: FrameDetail[] }).frames)).map(({ number }) => number);
    const slider = (): Promise<number> =>
      page.evaluate(() => Number(document.querySelector<HTMLInputElement>(".scrub")!.value));
    await until("it plays", async () => (await numbers()).length > 3 && (await slider()) > 0);

    const shows = (number: number): Promise<void> =>
      until(`frame ${number} is displayed`, async () => (await numbers()).at(-1) === number);
    const scrubTo = (fraction: number): Promise<void> =>
      page.evaluate((value) => {
        const input = document.querySelector<HTMLInputElement>(".scrub")!;
        input.value = String(value);
        input.dispatchEvent(new Event("input"));
      }, fraction);
    for (const fraction of [0.5, 0.1, 0.83]) {
      await scrubTo(fraction);
      await shows(Math.floor(fraction * frameCount));
    }
    savePicture("sequence by hand", await view.picture());

    await page.click(".second");
    await shows(rate);
    assert.ok(Math.abs((await slider()) - rate / frameCount) < 0.001);
    const before = (await numbers()).length;
    await page.click(".play");
    await until("it plays on", async () => (await numbers()).length > before + 3);
  });
});
