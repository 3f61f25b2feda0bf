// Cold loads of a page over a line, each in a browser that has never seen it.

import { readFileSync, readdirSync } from "node:fs";
import { extname, join } from "node:path";
import { brotliCompressSync, constants } from "node:zlib";
import type { Browser } from "playwright-core";
import { launchChromium } from "../../tests/browser/chromium.ts";
import type { LineOptions } from "../../tests/browser/line.ts";
import { startServer, type TestServer } from "../../tests/browser/server.ts";
import type { BenchPage } from "./pages.ts";
import { watch } from "./watch.ts";

export interface Load {
  /** Milliseconds from navigation to the first frame that shows the model, and to the last change of it. */
  firstImage: number;
  complete: number;
  bytes: number;
}

/** A model's smallest patch has more vertices, a background or a test of the context fewer. */
export const leastVertices = 500;
export const timeoutMs = 180_000;
export const viewport = { width: 640, height: 480 };

/** A server for the page. What brotli makes smaller by a twentieth it sends so, as hosts that compress do. */
export async function serve({ directory, contentPolicy }: BenchPage): Promise<TestServer> {
  const server = await startServer(directory);
  server.contentPolicy = contentPolicy;
  for (const file of readdirSync(directory, { recursive: true, withFileTypes: true })) {
    if (!file.isFile() || extname(file.name) === ".png") continue;
    const path = join(file.parentPath, file.name).slice(directory.length);
    const body = readFileSync(join(directory, path));
    const packed = brotliCompressSync(body, { params: { [constants.BROTLI_PARAM_QUALITY]: 9, [constants.BROTLI_PARAM_SIZE_HINT]: body.length } });
    if (packed.length > 0.95 * body.length) continue;
    server.putEncoded(path, "br", packed);
    if (path.endsWith("/index.html")) server.putEncoded(path.slice(0, -"index.html".length), "br", packed);
  }
  return server;
}

/** The median of each figure over so many loads. */
export async function medianLoad(page: BenchPage, server: TestServer, line: LineOptions | undefined, count: number): Promise<Load> {
  const loads: Load[] = [];
  server.useLine(line);
  for (let i = 0; i < count; ++i) loads.push(await coldLoad(page, server));
  const median = (of: (load: Load) => number): number => loads.map(of).sort((a, b) => a - b)[Math.floor(count / 2)]!;
  return { firstImage: median((load) => load.firstImage), complete: median((load) => load.complete), bytes: median((load) => load.bytes) };
}

/** Runs in the page: whether there is nothing more to come. */
export function isDone({ isProgressive }: Pick<BenchPage, "isProgressive">): () => boolean {
  return isProgressive ? () => window.watched.complete > 0 : () => window.watched.firstImage > 0;
}

async function coldLoad(page: BenchPage, server: TestServer): Promise<Load> {
  const browser = await launchChromium();
  try {
    return await loadOnce(browser, page, server);
  } finally {
    await browser.close();
  }
}

async function loadOnce(browser: Browser, { name, draws, isProgressive }: BenchPage, server: TestServer): Promise<Load> {
  const tab = await browser.newPage({ viewport });
  const errors: string[] = [];
  tab.on("pageerror", (error) => errors.push(String(error)));
  await tab.addInitScript(watch, { vertices: leastVertices, draws, waitForGpu: true });
  const sentBefore = server.bytesSent;
  await tab.goto(server.origin, { waitUntil: "commit", timeout: timeoutMs });
  await tab.waitForFunction(isDone({ isProgressive }), undefined, { timeout: timeoutMs, polling: 50 }).catch((error: unknown) => {
    throw new Error(`${name} was not shown: ${String(error)}; ${errors.join("; ")}`);
  });
  const watched = await tab.evaluate(() => window.watched);
  return {
    firstImage: watched.firstImage,
    complete: Math.max(watched.firstImage, watched.complete),
    bytes: server.bytesSent - sentBefore,
  };
}
