// Measures the cost of a frame in scenes of 1,000 shapes that differ in more than their colours: shapes coloured by
// values, each over a range of its own, lines of ten widths, and dashed lines. Prints a Markdown table of draw calls
// and of the processor time that the page's main thread takes for a frame while the scene turns.
//
//   scripts/bench batches          RUNTIME=folder: with the imgeo.js of another build

import { cpSync, mkdtempSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Browser } from "playwright-core";
import type { ViewElement } from "../../web/src/dom/imgeoView.ts";
import { launchChromium } from "../../tests/browser/chromium.ts";
import { startServer } from "../../tests/browser/server.ts";
import { pageOf, shapeIn, siteOfGenerated } from "../../tests/browser/sites.ts";
import { goUntilComplete } from "../completePage.ts";

const count = 1000;
const frames = 50;
const rounds = 5;
const timeout = 300_000;

const runtime = process.env.RUNTIME ?? "web/dist";
const site = siteOfGenerated("sphere-numbers", "--keep-attributes", "all", "--container", "bg");

function coloredByValues(n: number): string {
  const geometry = /<BinaryGeometry[\s\S]*<\/BinaryGeometry>/i.exec(shapeIn(pageOf(site)))?.[0] ?? "";
  return `<Shape colorBy="height" colorRange="${-1 - n / count} ${n / count}"><Appearance><Material></Material></Appearance>${geometry}</Shape>`;
}

function wideLines(fields: string): (n: number) => string {
  return (
    n,
  ) => `<Shape><Appearance><Material emissiveColor="${(n % 7) / 7} ${(n % 11) / 11} 0.5"></Material><LineProperties linewidthScaleFactor="${2 + (n % 10)}" ${fields}></LineProperties></Appearance>
    <IndexedLineSet coordIndex="0 1 2 3 -1"><Coordinate point="-0.5 -0.5 0 0 0.5 0 0.5 ${n / count} 0 0 0 0.5"></Coordinate></IndexedLineSet></Shape>`;
}

const scenes: Record<string, (n: number) => string> = {
  "coloured by values": coloredByValues,
  "wide lines": wideLines(""),
  "dashed lines": wideLines('linetype="2"'),
};

function pageText(shape: (n: number) => string): string {
  const shapes = Array.from(
    { length: count },
    (_, n) => `<Transform translation="${2 * (n % 32)} ${2 * Math.floor(n / 32)} ${n % 5}">${shape(n)}</Transform>`,
  );
  return `<!DOCTYPE html><title>batches</title><script type="module" src="imgeo.js"></script>
    <X3D style="width:64px;height:48px;display:block"><Scene>${shapes.join("\n")}</Scene></X3D>`;
}

async function row(browser: Browser, name: string, shape: (n: number) => string): Promise<string> {
  const directory = mkdtempSync(join(tmpdir(), "imgeo-batches-"));
  cpSync(site, directory, { recursive: true });
  for (const file of readdirSync(runtime)) cpSync(join(runtime, file), join(directory, file));
  writeFileSync(join(directory, "index.html"), pageText(shape));
  const server = await startServer(directory);
  const page = await browser.newPage();
  try {
    await goUntilComplete(page, server.origin, timeout);
    const metrics = await page.context().newCDPSession(page);
    await metrics.send("Performance.enable", { timeDomain: "threadTicks" });
    const taskSeconds = async () =>
      (await metrics.send("Performance.getMetrics")).metrics.find((metric) => metric.name === "TaskDuration")?.value ??
      0;
    const times: number[] = [];
    for (let round = 0; round < rounds; ++round) {
      const before = await taskSeconds();
      const drawn = await page.evaluate(async (frameCount) => {
        const x3d = document.querySelector<ViewElement>("x3d")!;
        const first = x3d.statistics!.frames;
        x3d.play();
        while (x3d.statistics!.frames < first + frameCount) await new Promise(requestAnimationFrame);
        x3d.pause();
        return x3d.statistics!.frames - first;
      }, frames);
      times.push((1000 * ((await taskSeconds()) - before)) / drawn);
    }
    const { drawCalls } = (await page.evaluate(() => document.querySelector<ViewElement>("x3d")!.statistics))!;
    times.sort((a, b) => a - b);
    return `| ${name} | ${drawCalls} | ${times[Math.floor(rounds / 2)]!.toFixed(1)} ms |`;
  } finally {
    await page.close();
    await server.close();
    rmSync(directory, { recursive: true });
  }
}

const browser = await launchChromium();
try {
  console.log(`| ${count} shapes | draws | frame |\n|---|--:|--:|`);
  for (const [name, shape] of Object.entries(scenes)) console.log(await row(browser, name, shape));
} finally {
  await browser.close();
}
