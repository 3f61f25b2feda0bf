// Writes six files that stand for what people bring, converts each, verifies and serves its site, and draws the page on
// a desktop and on a phone: build/first-look/sheet.png. Fails where a site does not equal its file, a page writes an
// error to the console, is wider than its screen, or shows too little or too much of the model.
//
//   scripts/first-look [NAME…]

import { spawnSync } from "node:child_process";
import { copyFileSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import type { Browser } from "playwright-core";
import { launchChromium } from "../browser/chromium.ts";
import { vrml1City } from "../browser/generators/vrml1City.ts";
import { converter, repository } from "../browser/paths.ts";
import { decodePng, type Picture } from "../browser/png.ts";
import { startServer, type TestServer } from "../browser/server.ts";
import { assemblyInstances, assemblyParts, conveyor } from "./assembly.ts";
import { bakedInterior } from "./interior.ts";
import { zUpScan } from "./scan.ts";
import { prototypeWorld, worldLibrary } from "./world.ts";

const output = join(repository, "build/first-look");

interface Example {
  /** Options of convert, where the file does not say what they state. */
  readonly options?: readonly string[];
  /** The file to convert, beside the files that it names. */
  readonly file: string;
  readonly write: (folder: string) => void;
  /** What the summary of convert must say. */
  readonly summary: RegExp;
  /** How many Shapes with a name of their own the site has, where the file has an object for each. */
  readonly shapes?: number;
  /** The scene has no surroundings of its own, so the model must be seen whole: nothing of it at top and bottom. */
  readonly isModel: boolean;
}

const examples: Readonly<Record<string, Example>> = {
  scan: {
    file: "statue.ply",
    write: (folder) => {
      writeFileSync(join(folder, "statue.ply"), zUpScan());
    },
    summary: /^up +z/m,
    isModel: true,
  },
  interior: {
    file: "room.glb",
    write: (folder) => {
      writeFileSync(join(folder, "room.glb"), bakedInterior());
    },
    summary: /^up +y, as GLB has it/m,
    isModel: true,
  },
  city: {
    file: "city.wrl",
    write: (folder) => {
      writeFileSync(join(folder, "city.wrl"), vrml1City(12));
    },
    summary: /VRML 1/,
    isModel: false,
  },
  assembly: {
    file: "conveyor.obj",
    write: (folder) => {
      const { obj, mtl } = conveyor();
      writeFileSync(join(folder, "conveyor.obj"), obj);
      writeFileSync(join(folder, "conveyor.mtl"), mtl);
    },
    options: ["--up", "z", "--unit", "mm"],
    summary: new RegExp(`^instances +${assemblyInstances.toLocaleString("en")} shapes show the mesh of another`, "m"),
    shapes: assemblyParts,
    isModel: true,
  },
  ship: {
    file: "ship.x3d",
    write: (folder) => {
      copyFileSync(join(repository, "tests/conformance/nodes/Nurbs-ship.x3d"), join(folder, "ship.x3d"));
    },
    summary: /NURBS/i,
    isModel: false,
  },
  world: {
    file: "street.x3d",
    write: (folder) => {
      writeFileSync(join(folder, "street.x3d"), prototypeWorld());
      writeFileSync(join(folder, "library.x3d"), worldLibrary);
    },
    summary: /instances of 3 prototypes are written out/,
    isModel: false,
  },
};

const screens = {
  desktop: { viewport: { width: 1280, height: 800 } },
  phone: { viewport: { width: 390, height: 844 }, deviceScaleFactor: 2, hasTouch: true, isMobile: true },
} as const;

type Screen = keyof typeof screens;

function run(...args: string[]): { status: number | null; text: string } {
  const { status, stderr, stdout } = spawnSync(converter, args, { encoding: "utf8", timeout: 300_000 });
  return { status, text: `${stdout}${stderr}` };
}

const differs = (picture: Picture, a: number, b: number): boolean => {
  const channel = (pixel: number, i: number) => picture.data[pixel * picture.channels + i] ?? 0;
  return [0, 1, 2].some((i) => Math.abs(channel(a, i) - channel(b, i)) > 6);
};

/** The share of pixels, 0 … 1, that differ from the left end of their row: of all, and of the top or bottom row. */
function covered(picture: Picture): { all: number; ends: number } {
  const { width, height } = picture;
  const rowShare = (y: number): number => {
    let count = 0;
    for (let x = 0; x < width; ++x) if (differs(picture, y * width + x, y * width)) count += 1;
    return count / width;
  };
  let all = 0;
  for (let y = 0; y < height; ++y) all += rowShare(y) / height;
  return { all, ends: Math.max(rowShare(1), rowShare(height - 2)) };
}

/** Draws a page as a visitor finds it; returns its picture and what is wrong. */
async function visit(
  browser: Browser,
  server: TestServer,
  example: Example,
  path: string,
  screen: Screen,
): Promise<{ png: Buffer; faults: string[] }> {
  const context = await browser.newContext({ ...screens[screen], reducedMotion: "reduce" });
  const page = await context.newPage();
  const faults: string[] = [];
  page.on("console", (message) => {
    if (message.type() === "error" || /GL_INVALID|WebGL: INVALID/.test(message.text())) faults.push(message.text());
  });
  page.on("pageerror", (error) => faults.push(String(error)));
  await page.goto(`${server.origin}${path}/`);
  await page.waitForFunction(() => customElements.get("imgeo-view") !== undefined);
  await page.evaluate(async () => {
    await (document.querySelector("x3d") as unknown as { complete: Promise<void> }).complete;
  });
  await page.waitForTimeout(500);
  const overflow = await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
  if (overflow > 0) faults.push(`the page is ${overflow} pixels wider than the screen`);
  const png = await page.screenshot();
  const { all, ends } = covered(decodePng(png));
  if (all < 0.02) faults.push(`only ${(100 * all).toFixed(1)} % of the picture show the model`);
  if (example.isModel && ends > 0.02) faults.push("the model is cut");
  await context.close();
  return { png, faults };
}

async function drawSheet(browser: Browser, cells: readonly string[]): Promise<Buffer> {
  const page = await browser.newPage({ viewport: { width: 1280, height: 600 } });
  await page.setContent(`<style>
    body { margin: 0; display: grid; grid-template-columns: auto auto; justify-content: start; gap: 8px; font: 12px/18px sans-serif }
    figure { margin: 0; white-space: nowrap } img { height: 380px; margin-right: 4px }
  </style>${cells.join("")}`);
  return await page.screenshot({ fullPage: true });
}

const requested = process.argv.slice(2);
const failures: string[] = [];
const cells: string[] = [];
rmSync(output, { recursive: true, force: true });
mkdirSync(output, { recursive: true });
const server = await startServer(output);
const browser = await launchChromium();
try {
  for (const [name, example] of Object.entries(examples)) {
    if (requested.length > 0 && !requested.includes(name)) continue;
    const [folder, site] = [join(output, "sources", name), join(output, name)];
    mkdirSync(folder, { recursive: true });
    example.write(folder);
    const file = join(folder, example.file);
    const converted = run("convert", file, "-o", site, ...(example.options ?? []));
    if (converted.status !== 0) {
      failures.push(`${name}: ${converted.text}`);
      continue;
    }
    if (!example.summary.test(converted.text)) failures.push(`${name}: the summary lacks ${String(example.summary)}`);
    const named = readFileSync(join(site, "scene.x3d"), "utf8").match(/<Shape DEF=/g)?.length ?? 0;
    if (example.shapes !== undefined && named !== example.shapes)
      failures.push(`${name}: ${named} of ${example.shapes} shapes have a name`);
    const verified = run("verify", site, file);
    if (verified.status !== 0) failures.push(`${name}: ${verified.text}`);
    const pictures: string[] = [];
    for (const screen of Object.keys(screens) as Screen[]) {
      const { png, faults } = await visit(browser, server, example, name, screen);
      failures.push(...faults.map((fault) => `${name} on a ${screen}: ${fault}`));
      writeFileSync(join(output, `${name}-${screen}.png`), png);
      pictures.push(`<img src="data:image/png;base64,${png.toString("base64")}">`);
    }
    cells.push(`<figure>${pictures.join("")}<figcaption>${name}: ${example.file}</figcaption></figure>`);
    console.log(name);
  }
  writeFileSync(join(output, "sheet.png"), await drawSheet(browser, cells));
} finally {
  await browser.close();
  await server.close();
}
if (failures.length > 0) {
  console.error(failures.join("\n"));
  process.exitCode = 1;
}
