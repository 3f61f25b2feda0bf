// Tests the example app of docs/three.md.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { join } from "node:path";
import { test } from "node:test";
import { until, withPage } from "./harness.ts";
import { outputDirectory, repository } from "./paths.ts";
import { decodePng, type Picture } from "./png.ts";
import { siteOfGenerated } from "./sites.ts";

/** Number of pixels that are as red as the mark. */
function redIn({ data, channels }: Picture): number {
  let count = 0;
  for (let i = 0; i < data.length; i += channels)
    if (data[i]! > 150 && data[i + 1]! < 90 && data[i + 2]! < 90) count += 1;
  return count;
}

/** Pixels of the floor that are much darker than the rest of it. */
function shadowIn({ data, width, height, channels }: Picture): number {
  const brightness = (x: number, y: number): number =>
    data[(y * width + x) * channels]! + data[(y * width + x) * channels + 1]!;
  const lit = brightness(20, height - 60);
  let count = 0;
  for (let y = Math.floor(height * 0.6); y < height; ++y) {
    for (let x = 0; x < width; ++x) if (brightness(x, y) < 0.75 * lit) count += 1;
  }
  return count;
}

test("the three.js app displays a model with its shadow, and marks the point of a click", async () => {
  const directory = join(outputDirectory, "three-app");
  execFileSync(
    process.execPath,
    ["examples/three/build.ts", siteOfGenerated("trefoil", "--profile", "compact"), directory],
    { cwd: repository },
  );
  await withPage(directory, {}, async ({ page, server }) => {
    await until(
      "the model is complete",
      async () => (await page.textContent("#status"))?.startsWith("Complete") === true,
    );
    // Its last frame may not have been drawn yet.
    await until("the model casts a shadow", async () => shadowIn(decodePng(await page.screenshot())) > 2000);
    assert.equal(redIn(decodePng(await page.screenshot())), 0);
    await page.mouse.click(310, 190); // beside the center, which is a hole
    await until("a mark is displayed", async () => redIn(decodePng(await page.screenshot())) > 20);
    const workers = server.requestsOf(/imgeo-worker\.js$/).filter(({ method }) => method === "GET");
    assert.equal(workers.length, 1);
  });
});
