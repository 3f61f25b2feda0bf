// Draws the picture of the museum example: its surface with notes, and its points.
//
//   scripts/node bench/museum.ts SITE_OF_EXAMPLES_MUSEUM [OUTPUT.png]

import { join } from "node:path";
import { writeFileSync } from "node:fs";
import type { Browser, Page } from "playwright-core";
import { launchChromium } from "../tests/browser/chromium.ts";
import { repository } from "../tests/browser/paths.ts";
import { startServer } from "../tests/browser/server.ts";

const [site, output = join(repository, "docs/images/museum.png")] = process.argv.slice(2);
const size = { width: 480, height: 350 };
if (site === undefined) throw new Error("usage: museum.ts SITE_OF_EXAMPLES_MUSEUM [OUTPUT.png]");

/** Returns the picture once it has not changed for a second. */
async function stillPicture(page: Page): Promise<Buffer> {
  for (let last = Buffer.alloc(0) as Buffer; ;) {
    await page.waitForTimeout(1000);
    const next = await page.screenshot();
    if (next.equals(last)) return next;
    last = next;
  }
}

async function sideBySide(browser: Browser, pictures: readonly Buffer[]): Promise<Buffer> {
  const page = await browser.newPage({ viewport: { width: size.width * pictures.length, height: size.height } });
  await page.setContent(
    `<style>body { margin: 0; display: flex } img { display: block }</style>${pictures
      .map((png) => `<img src="data:image/png;base64,${png.toString("base64")}">`)
      .join("")}`,
  );
  return page.screenshot();
}

const server = await startServer(site);
const browser = await launchChromium();
try {
  const page = await browser.newPage({ viewport: size, reducedMotion: "reduce" });
  await page.goto(server.origin);
  await page.waitForFunction(
    () => document.querySelector("x3d")?.hasAttribute("alt") === true && "complete" in document.querySelector("x3d")!,
  );
  await page.evaluate(() => (document.querySelector("x3d") as unknown as { complete: Promise<void> }).complete);
  const surface = await stillPicture(page);
  await page.evaluate(() => {
    document.querySelector("x3d")!.setAttribute("draw-as", "points");
    document.querySelector("x3d")!.setAttribute("camera-orbit", "-10deg 70deg 45%");
    document.querySelector("x3d")!.setAttribute("camera-target", "-0.03m 0.155m 0m");
  });
  writeFileSync(output, await sideBySide(browser, [surface, await stillPicture(page)]));
} finally {
  await browser.close();
  await server.close();
}
