// What each way of vertices to the screen costs a page: images that the shader
// decodes (paper section 5.1), the same images decoded in workers (5.2), and typed
// arrays (BG). Prints a Markdown table: the time from navigation to `load` and what
// of it is spent on processors, the longest task of the page, the time of a frame
// while the scene turns, and the bytes of vertex data on the GPU. The renderer is
// named; on a software renderer, whose frames run on the same processors, the
// table tells what is allocated and decides nothing else.
//
//   scripts/bench paths [MODEL...]

import { execFileSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { cpus, tmpdir } from "node:os";
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import type { ViewElement } from "../../web/src/dom/imgeoView.ts";
import { launchChromium } from "../../tests/browser/chromium.ts";
import { sphere } from "../../tests/browser/meshes.ts";
import { converter } from "../../tests/browser/paths.ts";
import { startServer } from "../../tests/browser/server.ts";
import { prepareModels } from "../load/models.ts";
import { longestTaskMsOf, processorMsOf, traceCategories, type TraceEvent } from "../load/trace.ts";

const runs = Number(process.env.RUNS ?? 3);
const turningMs = 3000;
const timeout = 300_000;

interface Input {
  name: string;
  /** Of images, and of arrays. */
  sites: { sig: string; bg: string };
}

const paths: Record<string, { container: "sig" | "bg"; decode: string }> = {
  "GPU": { container: "sig", decode: "gpu" },
  "CPU": { container: "sig", decode: "cpu" },
  "BG": { container: "bg", decode: "" },
};

/** So many shapes, each with bumps of its own: what is the same would be one file. As an OBJ's objects. */
function shapes(count: number, directory: string): Input {
  mkdirSync(directory, { recursive: true });
  const { positions, triangles } = sphere(6);
  const side = Math.ceil(Math.sqrt(count));
  const lines: string[] = [];
  for (let n = 0; n < count; ++n) {
    const [x, y] = [3 * (n % side), 3 * Math.floor(n / side)];
    lines.push(`o shape${n}`);
    for (let i = 0; i < positions.length; i += 3) {
      const radius = 1 + 0.2 * Math.sin(n + i * (1 + n / count));
      lines.push(`v ${x + radius * positions[i]!} ${y + radius * positions[i + 1]!} ${radius * positions[i + 2]!}`);
    }
    const first = (n * positions.length) / 3 + 1;
    for (let i = 0; i < triangles.length; i += 3) lines.push(`f ${[0, 1, 2].map((corner) => first + triangles[i + corner]!).join(" ")}`);
  }
  const source = join(directory, "shapes.obj");
  writeFileSync(source, lines.join("\n"));
  const siteOf = (container: string, ...options: string[]): string => {
    const site = join(directory, container);
    execFileSync(converter, ["convert", source, "-o", site, "--container", container, ...options], { stdio: ["ignore", "ignore", "inherit"] });
    return site;
  };
  return { name: `${count} shapes`, sites: { sig: siteOf("sig", "--profile", "classic"), bg: siteOf("bg") } };
}

interface Measured {
  loadMs: number;
  processorMs: number;
  longestTaskMs: number;
  frameMs: number;
  gpuBytes: number;
  requests: number;
}

async function measure(browser: Browser, site: string, decode: string): Promise<Measured> {
  const server = await startServer(site);
  if (decode !== "") {
    const page = readFileSync(join(site, "index.html"), "utf8");
    server.put("/", page.replaceAll(/<ImageGeometry/gi, `$& decode="${decode}"`));
  }
  const context = await browser.newContext({ viewport: { width: 1280, height: 720 } });
  try {
    const page = await context.newPage();
    await browser.startTracing(page, { categories: traceCategories });
    const begin = performance.now();
    await page.goto(server.origin, { waitUntil: "commit" });
    await page.waitForFunction(() => "complete" in (document.querySelector("x3d") ?? {}), undefined, { timeout });
    await page.evaluate(() => (document.querySelector("x3d") as unknown as { complete: Promise<void> }).complete);
    const loadMs = performance.now() - begin;
    const { traceEvents } = JSON.parse((await browser.stopTracing()).toString()) as { traceEvents: TraceEvent[] };
    const { statistics, frames } = await turn(page);
    return {
      loadMs, processorMs: processorMsOf(traceEvents), longestTaskMs: longestTaskMsOf(traceEvents),
      frameMs: turningMs / frames, gpuBytes: statistics.textureBytes + statistics.bufferBytes, requests: statistics.requests,
    };
  } finally {
    await context.close();
    await server.close();
  }
}

/** Frames while the scene turns by itself. */
async function turn(page: Page) {
  return page.evaluate(async (ms) => {
    const x3d = document.querySelector<ViewElement>("x3d")!;
    x3d.play();
    const before = x3d.statistics!.frames;
    await new Promise((resolve) => setTimeout(resolve, ms));
    const statistics = x3d.statistics!;
    return { statistics, frames: Math.max(1, statistics.frames - before) };
  }, turningMs);
}

async function rendererOf(browser: Browser): Promise<string> {
  const page = await browser.newPage();
  const name = await page.evaluate(() => {
    const gl = document.createElement("canvas").getContext("webgl2");
    const info = gl?.getExtension("WEBGL_debug_renderer_info");
    return gl && info ? String(gl.getParameter(info.UNMASKED_RENDERER_WEBGL)) : "unknown";
  });
  await page.close();
  return name;
}

const work = mkdtempSync(join(tmpdir(), "imgeo-paths-"));
const browser = await launchChromium();
try {
  const renderer = await rendererOf(browser);
  const models = prepareModels(process.argv.length > 2 ? process.argv.slice(2) : ["bunny", "dragon"], work);
  const inputs: Input[] = [
    ...models.map(({ name, sites }) => ({ name, sites: { sig: sites["SIG classic"], bg: sites.BG } })),
    ...(process.argv.length > 2 ? [] : [shapes(500, join(work, "shapes"))]),
  ];
  console.log("| scene | path | load | on processors | longest task | frame | vertex data on the GPU | requests |");
  console.log("|---|---|--:|--:|--:|--:|--:|--:|");
  for (const { name, sites } of inputs) {
    const results = new Map(Object.keys(paths).map((path) => [path, [] as Measured[]]));
    // One after the other, so that what else the machine does befalls all alike.
    for (let run = 0; run < runs; ++run) {
      for (const [path, { container, decode }] of Object.entries(paths)) results.get(path)?.push(await measure(browser, sites[container], decode));
    }
    for (const [path, all] of results) {
      const median = (of: keyof Measured): number => all.map((each) => each[of]).sort((a, b) => a - b)[Math.floor(all.length / 2)]!;
      const ms = (of: keyof Measured): string => `${median(of).toFixed(0)} ms`;
      console.log(`| ${[name, path, ms("loadMs"), ms("processorMs"), ms("longestTaskMs"), ms("frameMs"),
        `${(median("gpuBytes") / 1e6).toFixed(2)} MB`, median("requests")].join(" | ")} |`);
    }
  }
  const isSoftware = /swiftshader|llvmpipe|software/i.test(renderer);
  console.log(`\nMedians of ${runs}; ${renderer}, ${cpus().length} cores.${isSoftware ? " A software renderer: times of frames decide nothing." : ""}`);
} finally {
  await browser.close();
  rmSync(work, { recursive: true, force: true });
}
