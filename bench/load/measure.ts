// Measures cold loads of a page over a network link. All are in one browser, which has drawn before; each is in a
// context of its own, with an empty cache and without cached shaders.

import { readFileSync, readdirSync } from "node:fs";
import { extname, join } from "node:path";
import { brotliCompressSync, constants } from "node:zlib";
import type { Browser, BrowserContext, Page } from "playwright-core";
import { launchChromium } from "../../tests/browser/chromium.ts";
import type { LinkOptions } from "../../tests/browser/networkLink.ts";
import { startServer, type TestServer } from "../../tests/browser/server.ts";
import type { BenchPage } from "./pages.ts";
import { completeMessage, timesOf, recordFrames, type Times } from "./frameRecorder.ts";

export interface Load extends Times {
  bytes: number;
  /** Milliseconds between the page's first byte and its last in which the line carried nothing; 0 without a link. */
  idle: number;
}

/**
 * Draws of fewer vertices do not show the model: a background, or a test of the context. Every patch of a model has
 * more.
 */
const minModelVertices = 500;
export const timeoutMs = 180_000;
export const viewport = { width: 640, height: 480 };

/**
 * If the first image takes longer than this, the connection determines the times, and one load is as good as a median.
 */
const longLoadMs = 2500;

/** Time in which a browser on two cores has finished its own work for a new tab. */
const tabMs = 500;

/** Starts a server for the page. It sends files with brotli if that saves more than 5 %, as hosts do that compress. */
export async function serve({ directory, contentPolicy }: BenchPage): Promise<TestServer> {
  const server = await startServer(directory);
  server.contentPolicy = contentPolicy;
  for (const file of readdirSync(directory, { recursive: true, withFileTypes: true })) {
    if (!file.isFile() || extname(file.name) === ".png") continue;
    const path = join(file.parentPath, file.name).slice(directory.length);
    const body = readFileSync(join(directory, path));
    // Quality 9 saves 1 % more of compressed geometry than 5, and takes twenty times as long.
    const quality = extname(file.name) === ".glb" ? 5 : 9;
    const packed = brotliCompressSync(body, {
      params: { [constants.BROTLI_PARAM_QUALITY]: quality, [constants.BROTLI_PARAM_SIZE_HINT]: body.length },
    });
    if (packed.length > 0.95 * body.length) continue;
    server.putEncoded(path, "br", packed);
    if (path.endsWith("/index.html")) server.putEncoded(path.slice(0, -"index.html".length), "br", packed);
  }
  return server;
}

/** The median of each figure over `count` loads. */
export async function medianLoad(
  browser: Browser,
  page: BenchPage,
  server: TestServer,
  connection: LinkOptions | undefined,
  count: number,
): Promise<Load> {
  const loads: Load[] = [];
  server.useLink(connection);
  do loads.push(await coldLoad(browser, page, server));
  while (loads.length < count && loads.at(-1)!.first < longLoadMs);
  const median = (of: (load: Load) => number): number =>
    loads.map(of).sort((a, b) => a - b)[Math.floor(loads.length / 2)]!;
  return {
    first: median(({ first }) => first),
    nearlyFinal: median(({ nearlyFinal }) => nearlyFinal),
    final: median(({ final }) => final),
    bytes: median(({ bytes }) => bytes),
    idle: median(({ idle }) => idle),
  };
}

/** Launches a browser whose GPU process has started and has drawn. */
export async function launchWarm(): Promise<Browser> {
  const browser = await launchChromium("--disable-gpu-program-cache", "--disable-gpu-shader-disk-cache");
  const tab = await browser.newPage();
  await tab.evaluate(() => {
    document.createElement("canvas").getContext("webgl2")?.clear(0x4000);
  });
  await tab.close();
  return browser;
}

async function coldLoad(browser: Browser, page: BenchPage, server: TestServer): Promise<Load> {
  const context = await browser.newContext({ viewport });
  try {
    return await loadOnce(context, page, server);
  } finally {
    await context.close();
  }
}

async function loadOnce(context: BrowserContext, page: BenchPage, server: TestServer): Promise<Load> {
  const tab = await openTab(context, page, true);
  const sentBefore = server.bytesSent;
  server.takeLinkUsage();
  await load(tab, page, server);
  const idle = server.takeLinkUsage()?.idleMs ?? 0;
  await tab.waitForTimeout(100); // a last frame may follow
  return { ...(await tab.evaluate(timesOf, undefined)), bytes: server.bytesSent - sentBefore, idle };
}

/** Opens an idle tab that will record the page's frames. */
export async function openTab(
  context: BrowserContext,
  { announcesCompletion }: BenchPage,
  takesPictures: boolean,
): Promise<Page> {
  const tab = await context.newPage();
  await tab.addInitScript(recordFrames, { announcesCompletion, minModelVertices, takesPictures, completeMessage });
  await new Promise((resolve) => setTimeout(resolve, tabMs));
  return tab;
}

/** Resolves when the model is complete. Does not query the page until then. */
export async function load(tab: Page, { name }: BenchPage, server: TestServer): Promise<void> {
  const errors: string[] = [];
  tab.on("pageerror", (error) => errors.push(String(error)));
  const complete = tab.waitForEvent("console", {
    predicate: (message) => message.text() === completeMessage,
    timeout: timeoutMs,
  });
  await Promise.all([complete, tab.goto(server.origin, { waitUntil: "commit", timeout: timeoutMs })]).catch(
    (error: unknown) => {
      throw new Error(`${name} did not complete: ${String(error)}; ${errors.join("; ")}`);
    },
  );
}
