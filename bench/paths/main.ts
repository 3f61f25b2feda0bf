// Compares the ways in which vertices reach the GPU: images that the shader decodes (paper section 5.1), the same
// images decoded in workers (5.2), those of compact, and typed arrays (BG). Prints a Markdown table: the time from
// navigation to `load` and its processor time, the longest task of the page, the time of a frame while the scene
// turns, and the bytes of vertex data on the GPU. The table names the renderer; with a software renderer, whose frames
// run on the same cores, only the memory figures are meaningful.

import { execFileSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { cpus, tmpdir } from "node:os";
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import type { ViewElement } from "../../web/src/dom/imgeoView.ts";
import { launchChromium } from "../../tests/browser/chromium.ts";
import { writeShapes } from "../../tests/browser/generators/shapes.ts";
import { converter } from "../../tests/browser/paths.ts";
import { startServer } from "../../tests/browser/server.ts";
import { containers, prepareModels, type Container } from "../load/models.ts";
import { longestTaskMsOf, processorMsOf, traceCategories, type TraceEvent } from "../load/trace.ts";

const runs = Number(process.env.RUNS ?? 3);
const turningMs = 3000;
const timeout = 300_000;

interface Input {
  name: string;
  sites: Record<Container, string>;
}

const paths: Record<string, { container: Container; decode: string }> = {
  "SIG classic, in the shader": { container: "SIG classic", decode: "gpu" },
  "SIG classic, in workers": { container: "SIG classic", decode: "cpu" },
  "SIG compact": { container: "SIG compact", decode: "" },
  BG: { container: "BG", decode: "" },
};

/** A file of `count` different shapes; equal shapes would share files. */
function shapes(count: number, directory: string): Input {
  mkdirSync(directory, { recursive: true });
  const source = join(directory, "shapes.obj");
  writeShapes(count, source);
  const siteAs = (container: Container): string => {
    const site = join(directory, container.replaceAll(" ", "-"));
    execFileSync(converter, ["convert", source, "-o", site, ...containers[container]], {
      stdio: ["ignore", "ignore", "inherit"],
    });
    return site;
  };
  return {
    name: `${count} shapes`,
    sites: { "SIG classic": siteAs("SIG classic"), "SIG compact": siteAs("SIG compact"), BG: siteAs("BG") },
  };
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
      loadMs,
      processorMs: processorMsOf(traceEvents),
      longestTaskMs: longestTaskMsOf(traceEvents),
      frameMs: turningMs / frames,
      gpuBytes: statistics.textureBytes + statistics.bufferBytes,
      requests: statistics.requests,
    };
  } finally {
    await context.close();
    await server.close();
  }
}

/** Lets the scene rotate for `turningMs`; returns the number of frames drawn, and the statistics afterwards. */
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
  const scenes = process.argv.length > 2 ? process.argv.slice(2) : ["bunny", "dragon", "shapes"];
  const inputs = scenes.flatMap((name): Input[] =>
    name === "shapes" ? [shapes(500, join(work, name))] : prepareModels([name], work),
  );
  console.log("| scene | path | load | on processors | longest task | frame | vertex data on the GPU | requests |");
  console.log("|---|---|--:|--:|--:|--:|--:|--:|");
  for (const { name, sites } of inputs) {
    const results = new Map(Object.keys(paths).map((path) => [path, [] as Measured[]]));
    // Alternates between the paths, so that other load of the machine affects all of them equally.
    for (let run = 0; run < runs; ++run) {
      for (const [path, { container, decode }] of Object.entries(paths))
        results.get(path)?.push(await measure(browser, sites[container], decode));
    }
    for (const [path, all] of results) {
      const median = (of: keyof Measured): number =>
        all.map((each) => each[of]).sort((a, b) => a - b)[Math.floor(all.length / 2)]!;
      const ms = (of: keyof Measured): string => `${median(of).toFixed(0)} ms`;
      console.log(
        `| ${[
          name,
          path,
          ms("loadMs"),
          ms("processorMs"),
          ms("longestTaskMs"),
          ms("frameMs"),
          `${(median("gpuBytes") / 1e6).toFixed(2)} MB`,
          median("requests"),
        ].join(" | ")} |`,
      );
    }
  }
  const isSoftware = /swiftshader|llvmpipe|software/i.test(renderer);
  console.log(
    `\nMedians of ${runs}; ${renderer}, ${cpus().length} cores.${isSoftware ? " A software renderer: frame times are not meaningful." : ""}`,
  );
} finally {
  await browser.close();
  rmSync(work, { recursive: true, force: true });
}
