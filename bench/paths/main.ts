// Compares the ways in which vertices reach the GPU: images that the shader decodes (paper section 5.1), the same
// images decoded in workers (5.2), those of compact, and typed arrays (BG). Prints a Markdown table: the time from
// navigation to `load` and its processor time, the longest task of the page, percentiles of the time of a frame while
// the scene turns without waiting for a display, and the bytes of vertex data on the GPU. The scenes are the bunny, the
// dragon, 500 different shapes and 10,000 instances of a mesh. The table names the renderer; with a software renderer,
// whose frames run on the same cores, frame times compare the paths with each other and say nothing about GPUs.
//
//   scripts/bench paths [bunny|horse|dragon|shapes|instances...]      RUNS=5: medians of five
//   IMGEO_GPU=1 scripts/bench paths                                  on the machine's GPU (EGL, no display needed)

import { execFileSync } from "node:child_process";
import { cpSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { cpus, tmpdir } from "node:os";
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import type { ViewElement } from "../../web/src/dom/imgeoView.ts";
import { launchChromium } from "../../tests/browser/chromium.ts";
import { writeShapes } from "../../tests/browser/generators/shapes.ts";
import { converter } from "../../tests/browser/paths.ts";
import { startServer } from "../../tests/browser/server.ts";
import { pageOf, siteOfGenerated, withShapes } from "../../tests/browser/sites.ts";
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

/** `count` instances of the mesh `sphere-small`, which fill a cube. */
function instances(count: number, directory: string): Input {
  const edge = Math.ceil(Math.cbrt(count));
  const positionOf = (n: number): string =>
    [n % edge, Math.floor(n / edge) % edge, Math.floor(n / edge / edge)]
      .map((index) => 2.5 * (index - edge / 2))
      .join(" ");
  const siteAs = (container: Container): string => {
    const original = siteOfGenerated("sphere-small", ...containers[container]);
    const site = join(directory, container.replaceAll(" ", "-"));
    cpSync(original, site, { recursive: true });
    const page = pageOf(original).replace(/<Viewpoint[^>]*>/i, `<Viewpoint position="0 0 ${4 * edge}">`);
    const moved = withShapes(page, (shape) =>
      Array.from(
        { length: count },
        (_, n) =>
          `<Transform translation="${positionOf(n)}">${n === 0 ? shape.replace(/<Shape/i, '$& DEF="ball"') : '<Shape USE="ball"></Shape>'}</Transform>`,
      ).join("\n"),
    );
    writeFileSync(join(site, "index.html"), moved);
    return site;
  };
  return {
    name: `${count} instances`,
    sites: { "SIG classic": siteAs("SIG classic"), "SIG compact": siteAs("SIG compact"), BG: siteAs("BG") },
  };
}

interface Measured {
  loadMs: number;
  processorMs: number;
  longestTaskMs: number;
  /** Durations of frames of which 50, 95 and 99 % take no longer. */
  frameMs: number;
  frameMs95: number;
  frameMs99: number;
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
    const { statistics, frameTimes } = await turn(page);
    frameTimes.sort((a, b) => a - b);
    const percentile = (share: number): number =>
      frameTimes[Math.min(frameTimes.length - 1, Math.floor(share * frameTimes.length))] ?? turningMs;
    return {
      loadMs,
      processorMs: processorMsOf(traceEvents),
      longestTaskMs: longestTaskMsOf(traceEvents),
      frameMs: percentile(0.5),
      frameMs95: percentile(0.95),
      frameMs99: percentile(0.99),
      gpuBytes: statistics.textureBytes + statistics.bufferBytes,
      requests: statistics.requests,
    };
  } finally {
    await context.close();
    await server.close();
  }
}

/** Lets the scene rotate for `turningMs`; returns the durations of the frames, and the statistics afterwards. */
async function turn(page: Page) {
  return page.evaluate(async (ms) => {
    const x3d = document.querySelector<ViewElement>("x3d")!;
    x3d.play();
    const frameTimes: number[] = [];
    const end = performance.now() + ms;
    let drawn = x3d.statistics!.frames;
    let before = performance.now();
    while (performance.now() < end) {
      await new Promise(requestAnimationFrame);
      if (x3d.statistics!.frames === drawn) continue;
      const now = performance.now();
      drawn = x3d.statistics!.frames;
      frameTimes.push(now - before);
      before = now;
    }
    return { statistics: x3d.statistics!, frameTimes };
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
// Frames follow each other as fast as they are drawn.
const browser = await launchChromium("--disable-gpu-vsync", "--disable-frame-rate-limit");
try {
  const renderer = await rendererOf(browser);
  const scenes = process.argv.length > 2 ? process.argv.slice(2) : ["bunny", "dragon", "shapes", "instances"];
  const inputs = scenes.flatMap((name): Input[] => {
    if (name === "shapes") return [shapes(500, join(work, name))];
    if (name === "instances") return [instances(10_000, join(work, name))];
    return prepareModels([name], work);
  });
  console.log(
    "| scene | path | load | on processors | longest task | frame: 50 % / 95 % / 99 % | vertex data on the GPU | requests |",
  );
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
          `${median("frameMs").toFixed(1)} / ${median("frameMs95").toFixed(1)} / ${median("frameMs99").toFixed(1)} ms`,
          `${(median("gpuBytes") / 1e6).toFixed(2)} MB`,
          median("requests"),
        ].join(" | ")} |`,
      );
    }
  }
  const isSoftware = /swiftshader|llvmpipe|software/i.test(renderer);
  console.log(
    `\nMedians of ${runs}; ${renderer}, ${cpus().length} cores.${isSoftware ? " A software renderer: its frame times say nothing about GPUs." : ""}`,
  );
} finally {
  await browser.close();
  rmSync(work, { recursive: true, force: true });
}
