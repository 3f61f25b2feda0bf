// Measures live streams: how many viewers one core serves at 30 Hz, directly and behind nginx; the age of frames on the
// screen of a page with a fast and with a slow line; a long run of cloth in a page. Prints Markdown tables.
//
//   scripts/bench live             after the table of bench/live.cpp
//   FRAMES=18000                   frames of the long run (default 2000; 18,000 take ten minutes; 0: no page)
//   VIEWERS=100,200                numbers of viewers; 0: none

import { spawn } from "node:child_process";
import { once } from "node:events";
import { readFileSync } from "node:fs";
import { createServer, connect, type Socket } from "node:net";
import type { AddressInfo } from "node:net";
import { setTimeout as pause } from "node:timers/promises";
import type { Browser, Page } from "playwright-core";
import type { ViewElement } from "../../web/src/dom/imgeoView.ts";
import { launchChromium } from "../../tests/browser/chromium.ts";
import { findNginx, startNginx } from "../../tests/live/nginx.ts";
import { startStream } from "../../tests/live/stream.ts";
import { startViewer } from "../../tests/live/viewers.ts";

const rate = 30;
const frameCount = Number(process.env.FRAMES ?? 2000);
const viewerCounts = (process.env.VIEWERS ?? "1,100,250,500,750,1000,1500")
  .split(",")
  .map(Number)
  .filter((count) => count > 0);
const secondsPerCount = 6;
/** Bytes per second of the slow line. */
const slowLine = 500_000;
const tool = process.env.IMGEO ?? "build/imgeo";
const viewersProgram = process.env.VIEWERS_PROGRAM ?? "build/bench/live_viewers";

interface Counts {
  readonly rate: number;
  readonly skipped: number;
  readonly frames: number;
  readonly torn: number;
  readonly refused: number;
  readonly medianAge: number;
  readonly age95: number;
}

/** Seconds that the workers of nginx have had on a processor. */
function workerSeconds(pid: number | undefined): number {
  if (pid === undefined) return 0;
  const workers = readFileSync(`/proc/${pid}/task/${pid}/children`, "utf8").trim().split(" ");
  return workers.reduce((sum, worker) => sum + processorSeconds(Number(worker)), 0);
}

/** Seconds that a process has had on a processor. */
function processorSeconds(pid: number): number {
  const fields = readFileSync(`/proc/${pid}/stat`, "utf8").split(") ")[1]?.split(" ") ?? [];
  return (Number(fields[11]) + Number(fields[12])) / 100;
}

async function output(program: string, words: readonly string[]): Promise<string> {
  const child = spawn(program, words, { stdio: ["ignore", "pipe", "inherit"] });
  let text = "";
  child.stdout.on("data", (chunk: Buffer) => (text += chunk.toString()));
  await once(child, "close");
  return text;
}

/** Prints a row of a Markdown table. */
function printRow(...cells: (string | number)[]): void {
  console.log(`| ${cells.join(" | ")} |`);
}

const gridName = (grid: number): string => `${grid} x ${grid}`;
const lineName = (isSlow: boolean): string => (isSlow ? "0.5 MB/s" : "unlimited");

/** The server, and nginx where it is in front, run on the first core, the viewers on the others. */
async function measureViewers(isBehindNginx: boolean): Promise<number> {
  const nginx = findNginx();
  if (isBehindNginx && nginx === undefined) {
    console.log("nginx is not installed");
    return 0;
  }
  let reached = 0;
  /** What the simulation and one viewer take of a core. */
  let base: number | undefined;
  for (const count of viewerCounts) {
    const stream = await startStream(["cloth", "--grid", "64", "--rate", `${rate}`], ["taskset", "-c", "0", tool]);
    const front = isBehindNginx ? await startNginx(nginx ?? "", stream.port, false) : undefined;
    const before = processorSeconds(stream.pid);
    const workersBefore = workerSeconds(front?.pid);
    const text = await output("taskset", [
      ...["-c", "1", viewersProgram, `${front?.port ?? stream.port}`, "cloth"],
      ...[`${count}`, `${secondsPerCount}`],
    ]);
    const load = (processorSeconds(stream.pid) - before) / secondsPerCount;
    const nginxSeconds = workerSeconds(front?.pid) - workersBefore;
    const passed = front?.counts();
    await front?.stop();
    await stream.stop();
    if (text === "") break;
    const counts = JSON.parse(text) as Counts;
    base ??= load;
    // Viewers receive frames before the measured ones, too.
    const sent = (counts.frames * secondsPerCount) / (secondsPerCount - 1);
    const seconds = secondsPerCount * (load - base) + nginxSeconds;
    const microseconds = count > 1 ? ((1e6 * seconds) / sent).toFixed(0) : "";
    const requests = passed && (passed.passed / (secondsPerCount * rate)).toFixed(2);
    printRow(
      count,
      isBehindNginx ? "behind nginx" : "directly",
      counts.rate.toFixed(1),
      counts.skipped,
      counts.torn,
      `${counts.medianAge} / ${counts.age95} ms`,
      `${(100 * load).toFixed(0)} %`,
      microseconds,
      requests ?? count,
    );
    if (counts.torn > 0) throw new Error("a frame is torn");
    if (counts.rate < 0.97 * rate) break;
    reached = count;
  }
  return reached;
}

/** A line of so many bytes per second in front of a port; all connections share it. Resolves with its port. */
async function startLine(port: number, bytesPerSecond: number): Promise<{ port: number; close: () => void }> {
  const sockets = new Set<Socket>();
  let freeAt = 0;
  const server = createServer((viewer) => {
    const upstream = connect({ port, host: "127.0.0.1" });
    for (const socket of [viewer, upstream]) {
      socket.setNoDelay(true);
      sockets.add(socket);
      socket.on("error", () => undefined);
      socket.on("close", () => {
        viewer.destroy();
        upstream.destroy();
      });
    }
    viewer.pipe(upstream);
    void (async () => {
      try {
        for await (const chunk of upstream as AsyncIterable<Buffer>) {
          // Small packets take turns.
          for (let at = 0; at < chunk.length; at += 1460) {
            const packet = chunk.subarray(at, at + 1460);
            const now = performance.now();
            freeAt = Math.max(freeAt, now) + (1000 * packet.length) / bytesPerSecond;
            if (freeAt > now + 1) await pause(freeAt - now);
            if (!viewer.write(packet)) await once(viewer, "drain");
          }
        }
      } catch {
        viewer.destroy();
      }
    })();
  });
  server.listen(0, "127.0.0.1");
  await once(server, "listening");
  return {
    port: (server.address() as AddressInfo).port,
    close: () => {
      for (const socket of sockets) socket.destroy();
      server.close();
    },
  };
}

/** In the page: notes the age of each frame when the picture that has it is presented. */
function recordAges(): void {
  const ages: number[] = [];
  let skipped = 0;
  Object.assign(window, { ages, skippedCount: () => skipped });
  addEventListener(
    "frame",
    (event) => {
      const { detail } = event as CustomEvent<{ time: number; skipped: number }>;
      skipped += detail.skipped;
      // The event precedes the drawing of the next picture; after that one, and a task, it is presented.
      requestAnimationFrame(() => {
        setTimeout(() => ages.push(Date.now() - 1000 * detail.time));
      });
    },
    true,
  );
}

async function openPage(browser: Browser, port: number): Promise<Page> {
  const page = await browser.newPage({ viewport: { width: 640, height: 480 } });
  await page.addInitScript(recordAges);
  await page.goto(`http://127.0.0.1:${port}/`);
  return page;
}

const agesOf = (page: Page): Promise<number[]> =>
  page.evaluate(() => (window as unknown as { ages: number[] }).ages.slice());

function quantile(sorted: readonly number[], share: number): number {
  return sorted[Math.floor(share * (sorted.length - 1))] ?? NaN;
}

/** Quantiles of sorted times. */
function quantiles(sorted: number[], ...shares: number[]): string {
  return `${shares.map((share) => quantile(sorted, share).toFixed(0)).join(" / ")} ms`;
}

/** The runtime's FrameSource without a page: frames are received and decoded. */
async function measureReceipt(grid: number, isSlow: boolean, url: string): Promise<void> {
  const viewer = startViewer({ url });
  await pause(12_000);
  viewer.stop();
  const ages = viewer.ages.slice(10).sort((a, b) => a - b);
  const rateReached = (viewer.shown.length / 12).toFixed(1);
  printRow(gridName(grid), lineName(isSlow), "received", rateReached, viewer.skipped, quantiles(ages, 0.5, 0.95, 1));
}

async function measurePage(browser: Browser, grid: number, isSlow: boolean, port: number): Promise<void> {
  const page = await openPage(browser, port);
  await page.waitForFunction(() => (window as unknown as { ages: number[] }).ages.length > 10, undefined, {
    timeout: 120_000,
  });
  const before = (await agesOf(page)).length;
  await pause(10_000);
  const ages = (await agesOf(page)).slice(before).sort((a, b) => a - b);
  const skipped = await page.evaluate(() => (window as unknown as { skippedCount: () => number }).skippedCount());
  printRow(
    gridName(grid),
    lineName(isSlow),
    "page",
    (ages.length / 10).toFixed(1),
    skipped,
    quantiles(ages, 0.5, 0.95, 1),
  );
  await page.close();
}

/** Prints rows for a fast line and for a slow line. */
async function measureAges(browser: Browser, grid: number): Promise<void> {
  for (const isSlow of [false, true]) {
    const stream = await startStream(["cloth", "--grid", `${grid}`, "--rate", `${rate}`], [tool]);
    const line = isSlow ? await startLine(stream.port, slowLine) : undefined;
    const port = line?.port ?? stream.port;
    await measureReceipt(grid, isSlow, `http://127.0.0.1:${port}/live/cloth`);
    await measurePage(browser, grid, isSlow, port);
    line?.close();
    await stream.stop();
  }
}

/** Heap after a collection, GPU memory and age along a run of cloth. */
async function measureLongRun(browser: Browser): Promise<void> {
  const stream = await startStream(["cloth", "--grid", "128", "--rate", `${rate}`], [tool]);
  const page = await openPage(browser, stream.port);
  const session = await page.context().newCDPSession(page);
  const parts = 6;
  let begun = 0;
  for (let part = 0; part <= parts; ++part) {
    const goal = part === 0 ? 30 : begun + Math.ceil(frameCount / parts);
    await page.waitForFunction((count) => (window as unknown as { ages: number[] }).ages.length >= count, goal, {
      timeout: 0,
      polling: 200,
    });
    const ages = await agesOf(page);
    const sorted = ages.slice(begun).sort((a, b) => a - b);
    begun = ages.length;
    await session.send("HeapProfiler.collectGarbage");
    const { usedSize } = (await session.send("Runtime.getHeapUsage")) as { usedSize: number };
    const { textureBytes, bufferBytes } = (await page.evaluate(
      () => document.querySelector<ViewElement>("x3d")!.statistics,
    ))!;
    const heap = `${(usedSize / 1024).toFixed(0)} KiB`;
    printRow(ages.length, heap, textureBytes + bufferBytes, quantiles(sorted, 0.5, 0.95));
  }
  await page.close();
  await stream.stop();
}

printRow(
  "viewers",
  "",
  "frames a second each",
  "skipped",
  "torn",
  "age, median / 19 of 20",
  "the server on its core",
  "µs for a frame sent",
  "requests to the server a frame",
);
console.log("|--:|---|--:|--:|--:|--:|--:|--:|--:|");
const direct = await measureViewers(false);
const behind = await measureViewers(true);
console.log(`\nViewers at ${rate} Hz on 64 x 64 vertices: ${direct} directly, ${behind} behind nginx.\n`);
if (frameCount === 0) process.exit();
const browser = await launchChromium();
try {
  printRow("vertices", "line", "viewer", "frames a second", "skipped", "age, median / 19 of 20 / oldest");
  console.log("|---|---|---|--:|--:|--:|");
  for (const grid of [64, 128]) await measureAges(browser, grid);
  console.log("\n| frames | heap | GPU bytes | age, median / 19 of 20 |\n|--:|--:|--:|--:|");
  await measureLongRun(browser);
} finally {
  await browser.close();
}
