// Draws the picture of docs/decisions/lossless.md: the meshes that `build/bench/lossy MODEL --write DIRECTORY` wrote,
// from one viewpoint; and that of docs/sequences.md: the meshes of `build/bench/lossy_video --write DIRECTORY`, which
// has panels.json.
//
//   scripts/node bench/lossyPicture.ts DIRECTORY NAME_OF_MODEL [OUTPUT.png]
//   scripts/node bench/lossyPicture.ts DIRECTORY panels OUTPUT.png

import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Browser } from "playwright-core";
import { launchChromium } from "../tests/browser/chromium.ts";
import { converter, repository } from "../tests/browser/paths.ts";
import { startServer } from "../tests/browser/server.ts";

const [directory, model, output = join(repository, "docs/images/lossy.png")] = process.argv.slice(2);
if (directory === undefined || model === undefined)
  throw new Error("usage: lossyPicture.ts DIRECTORY NAME_OF_MODEL [OUTPUT.png]");

const panel = { width: 300, height: 280 };
interface Variant {
  readonly file: string;
  readonly bits?: number;
  readonly caption: string;
}
const ofModel: readonly Variant[] = [
  { file: "lossless", caption: "PNG, 16 bits" },
  { file: "JPEG80", caption: "JPEG 80, second byte only" },
  { file: "JPEG100-both", caption: "JPEG 100, both bytes" },
  { file: "lossless", bits: 12, caption: "PNG, 12 bits" },
  { file: "WebP80", caption: "WebP 80, second byte only" },
  { file: "WebP100-both", caption: "WebP 100, both bytes" },
];
const variants =
  model === "panels"
    ? (JSON.parse(readFileSync(join(directory, "panels.json"), "utf8")) as readonly Variant[])
    : ofModel.map((variant) => ({ ...variant, file: `${model}-${variant.file}` }));

const viewpointElement = /<Viewpoint[\s\S]*?<\/Viewpoint>/i;

const viewpoints = new RegExp(viewpointElement, "gi");

/** A picture of the site's page with its Viewpoint element replaced. */
async function picture(browser: Browser, site: string, viewpoint: string): Promise<Buffer> {
  const server = await startServer(site);
  const page = await browser.newPage({ viewport: panel, reducedMotion: "reduce" });
  try {
    const html = readFileSync(join(site, "index.html"), "utf8");
    const views = [viewpoint];
    server.put(
      "/index.html",
      html.replaceAll(viewpoints, () => views.pop() ?? ""), // several have a menu
    );
    await page.goto(`${server.origin}index.html`);
    await page.waitForFunction(() => "complete" in (document.querySelector("x3d") ?? {}));
    await page.evaluate(() => (document.querySelector("x3d") as unknown as { complete: Promise<void> }).complete);
    return await page.locator("canvas").screenshot();
  } finally {
    await page.close();
    await server.close();
  }
}

/** A PNG of all pictures in rows of three, each with its caption. */
async function contactSheetOf(browser: Browser, pictures: readonly Buffer[]): Promise<Buffer> {
  const page = await browser.newPage({ viewport: { width: 3 * panel.width, height: 2 * (panel.height + 26) } });
  await page.setContent(`<style>
      body { margin: 0; display: grid; grid-template-columns: repeat(3, 1fr); font: 14px sans-serif; background: #edf0f2 }
      figure { margin: 0 } img { display: block } figcaption { height: 26px; text-align: center }
    </style>${pictures
      .map(
        (png, i) =>
          `<figure><img src="data:image/png;base64,${png.toString("base64")}"><figcaption>${variants[i]!.caption}</figcaption></figure>`,
      )
      .join("")}`);
  return page.screenshot();
}

const sites = mkdtempSync(join(tmpdir(), "imgeo-lossy-"));
const browser = await launchChromium();
try {
  const pictures: Buffer[] = [];
  let viewpoint = "";
  for (const { file, bits, caption } of variants) {
    const site = join(sites, caption.replaceAll(/\W+/g, "-"));
    execFileSync(
      converter,
      [
        "convert",
        join(directory, `${file}.ply`),
        "-o",
        site,
        "--profile",
        "classic",
        "--effort",
        "0",
        ...(model === "panels" ? ["--up", "y"] : []),
        ...(bits === undefined ? [] : ["--position-bits", `${bits}`]),
      ],
      { stdio: "ignore" },
    );
    // The viewpoint of the first mesh for all: lossy compression widens the box of a mesh.
    viewpoint ||= viewpointElement.exec(readFileSync(join(site, "index.html"), "utf8"))?.[0] ?? "";
    pictures.push(await picture(browser, site, viewpoint));
  }
  writeFileSync(output, await contactSheetOf(browser, pictures));
} finally {
  await browser.close();
  rmSync(sites, { recursive: true, force: true });
}
