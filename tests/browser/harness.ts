// Starts one Chromium for the whole run and opens pages that record events, requests and errors.

import assert from "node:assert/strict";
import { after } from "node:test";
import type { Browser, Page } from "playwright-core";
import { launchTestChromium } from "./chromium.ts";
import { observe, type Observed, type ObservedEvent } from "./pageObserver.ts";
import { outputDirectory } from "./paths.ts";
import { decodePng, type Picture } from "./png.ts";
import { startServer, type TestServer } from "./server.ts";

let launched: Promise<Browser> | undefined;

/**
 * V8 without threads of its own, which take a tenth of the processor time of short-lived pages. The last list of
 * chromium.ts' and these flags counts, so --expose-gc is repeated. Workers still have threads.
 */
const quickPages = "--js-flags=--expose-gc,--single-threaded";

/** The browser of this run; started at first use, closed after the last test. */
export async function browser(): Promise<Browser> {
  launched ??= launchTestChromium(quickPages);
  return await launched;
}

after(async () => (await launched)?.close());

/** The size of most pictures: small, since drawing in software takes half of the time of these tests. */
export const pictureSize = { width: 480, height: 360 };
/** For pictures whose bounds hold where a pixel is a smaller part of the surface. */
export const largePictureSize = { width: 640, height: 480 };

export interface PageOptions {
  /** Path of the page; "" is the site's index.html. */
  path?: string;
  size?: { width: number; height: number };
  deviceScaleFactor?: number;
  hasTouch?: boolean;
  /** Animations are on; pictures are only comparable without them. */
  motion?: boolean;
  /** Runs in the page before its scripts; self-contained. */
  before?: (() => void) | { readonly content: string };
  /**
   * The view has its toolbar. Pictures are compared without it, because it appears while the mouse is over the view.
   */
  hasToolbar?: boolean;
  /** Sets up the server (rules, bodies) before the page sends requests. */
  server?: (server: TestServer) => void;
  /**
   * The rate that the page measures with its own files; unknown by default, so that what pages do first does not depend
   * on how busy the machine is.
   */
  lineBitsPerSecond?: number | undefined;
  /** The page may send requests to other servers. */
  isCrossOrigin?: boolean;
  /** Messages that this page may write to the console; every other error fails the test. */
  expectedErrors?: RegExp;
}

/** A page that has begun to load. */
export interface View {
  page: Page;
  server: TestServer;
  /** Console errors, uncaught exceptions and violations of the content policy. */
  errors: string[];
  /** Requests to anywhere but the test's server. */
  foreignRequests: string[];
  /**
   * Paths of requests without the first slash, in the order in which the page sent them; the network may change that
   * order.
   */
  requestedPaths: string[];
  /** Resolves when the promise of that name on the element does; throws after `seconds`. */
  promise: (name: "firstImage" | "complete", selector?: string, seconds?: number) => Promise<void>;
  observed: () => Promise<Observed>;
  events: (type: string, target?: string) => Promise<ObservedEvent[]>;
  /** The picture after the page has stopped drawing. */
  picture: () => Promise<Picture>;
}

type Device = Required<Pick<PageOptions, "deviceScaleFactor" | "hasTouch" | "motion">>;

const openers = new Map<string, Promise<Page>>();
/** Settles when the last popup has opened. */
let lastPopup: Promise<unknown> = Promise.resolve();

/**
 * Opens a blank page with these settings. A browser context of its own and two renderer processes (Chromium starts
 * one for the blank page and one for its first URL) would take longer than most tests; a page that another page opens
 * shares the opener's process. Each test's server has an origin of its own, so nothing else is shared.
 * Pages are opened one after the other, because the event of a popup does not say which call has opened it.
 */
async function openPage(device: Device): Promise<Page> {
  const key = JSON.stringify(device);
  const opener = await (openers.get(key) ?? newOpener(key, device));
  const popup = lastPopup.then(() => openPopup(opener));
  lastPopup = popup.catch(() => undefined);
  return popup;
}

/** One that fails to open is not kept: the next page of the device tries again. */
function newOpener(key: string, device: Device): Promise<Page> {
  const opener = openOpener(device);
  openers.set(key, opener);
  opener.catch(() => openers.delete(key));
  return opener;
}

async function openPopup(opener: Page): Promise<Page> {
  const [page] = await Promise.all([
    opener.waitForEvent("popup"),
    opener.evaluate(() => {
      window.open("about:blank");
    }),
  ]);
  return page;
}

/**
 * Opens the page that opens all pages of a device. Its host is that of all test servers, so that pages which it opens
 * stay in its process.
 */
async function openOpener({ deviceScaleFactor, hasTouch, motion }: Device): Promise<Page> {
  // With reduced motion the progress bar does not fade while pictures are taken.
  const reducedMotion = motion ? "no-preference" : "reduce";
  const context = await (
    await browser()
  ).newContext({ viewport: pictureSize, deviceScaleFactor, hasTouch, reducedMotion });
  const page = await context.newPage();
  const server = await startServer(outputDirectory);
  server.put("/", "<!doctype html>");
  await page.goto(server.origin);
  await server.close();
  return page;
}

/** Opens a page of `directory`, calls `use`, closes everything, and asserts that there were no unexpected errors. */
export async function withPage(
  directory: string,
  options: PageOptions,
  use: (view: View) => Promise<void>,
): Promise<void> {
  const server = await startServer(directory);
  try {
    options.server?.(server);
    await usePage(server, options, use);
  } finally {
    await server.close();
  }
}

async function usePage(server: TestServer, options: PageOptions, use: (view: View) => Promise<void>): Promise<void> {
  const { size = pictureSize, deviceScaleFactor = 1, hasTouch = false, motion = false } = options;
  const page = await openPage({ deviceScaleFactor, hasTouch, motion });
  try {
    await page.setViewportSize(size);
    await page.addInitScript(observe);
    await page.addInitScript(setLineRate, options.lineBitsPerSecond);
    if (options.hasToolbar !== true) await page.addInitScript(hideToolbar);
    if (options.before) await page.addInitScript(options.before);
    const view = watch(page, server);
    await page.goto(server.origin + (options.path ?? ""), { waitUntil: "commit" });
    await use(view);
    assert.deepEqual(
      view.errors.filter((message) => options.expectedErrors?.test(message) !== true),
      [],
    );
    if (options.isCrossOrigin !== true) assert.deepEqual(view.foreignRequests, []);
  } finally {
    await page.close();
  }
}

/** Runs in the page: files that come from the cache, which have no transfer, say nothing of the line. */
function setLineRate(bitsPerSecond: number | undefined): void {
  const getters: Partial<Record<keyof PerformanceResourceTiming, (this: PerformanceResourceTiming) => number>> =
    bitsPerSecond === undefined
      ? { transferSize: () => 0 }
      : {
          responseEnd() {
            return this.responseStart + (8000 * this.encodedBodySize) / bitsPerSecond;
          },
        };
  for (const [name, get] of Object.entries(getters))
    Object.defineProperty(PerformanceResourceTiming.prototype, name, { get });
}

function hideToolbar(): void {
  const sheet = new CSSStyleSheet();
  sheet.replaceSync("imgeo-view::part(tools) { display: none }");
  document.adoptedStyleSheets.push(sheet);
}

function watch(page: Page, server: TestServer): View {
  const errors: string[] = [];
  const foreignRequests: string[] = [];
  const requestedPaths: string[] = [];
  page.on("console", (message) => {
    // Chromium reports invalid WebGL calls as warnings.
    if (message.type() === "error" || /GL_INVALID|WebGL: INVALID/.test(message.text())) errors.push(message.text());
  });
  page.on("pageerror", (error) => errors.push(String(error)));
  page.on("request", (request) => {
    if (request.url().startsWith(server.origin)) requestedPaths.push(request.url().slice(server.origin.length));
    // Blob URLs have the page's origin.
    else if (new URL(request.url()).origin !== new URL(server.origin).origin) foreignRequests.push(request.url());
  });
  const observed = (): Promise<Observed> => page.evaluate(() => window.observed);
  return {
    page,
    server,
    errors,
    foreignRequests,
    requestedPaths,
    observed,
    async promise(name, selector = "x3d", seconds = patienceSeconds) {
      const isResolved = await page.evaluate(awaitPromise, { name, selector, timeoutMs: 1000 * seconds });
      if (!isResolved)
        throw new Error(`${name} of ${selector} did not resolve within ${seconds} s; console: ${errors.join("; ")}`);
    },
    async events(type, target) {
      const { events } = await observed();
      return events.filter((event) => event.type === type && (target === undefined || event.target === target));
    },
    async picture() {
      await settle(page);
      return screenshotOf(page);
    },
  };
}

/** In the page: whether the element's promise resolves in time. The runtime may still have to load. */
async function awaitPromise({
  name,
  selector,
  timeoutMs,
}: {
  name: string;
  selector: string;
  timeoutMs: number;
}): Promise<boolean> {
  const pause = (ms: number): Promise<boolean> =>
    new Promise((resolve) =>
      setTimeout(() => {
        resolve(false);
      }, ms),
    );
  const end = performance.now() + timeoutMs;
  for (; performance.now() < end; await pause(10)) {
    const promise = (
      document.querySelector(selector) as unknown as Record<string, Promise<unknown> | undefined> | null
    )?.[name];
    if (promise) return Promise.race([promise.then(() => true), pause(end - performance.now())]);
  }
  return false;
}

/**
 * How long tests wait for what a page should do at once. Long, because it only ends what would never happen: a shared
 * machine may stand still for many seconds.
 */
const patienceSeconds = 60;

/** The present picture. Chromium cannot capture a busy page that is just getting its first WebGL context; retries. */
export async function screenshotOf(page: Page): Promise<Picture> {
  for (const end = Date.now() + 1000 * patienceSeconds; ;) {
    try {
      return decodePng(await page.screenshot({ timeout: 1000 * patienceSeconds }));
    } catch (error) {
      if (Date.now() > end || !String(error).includes("Unable to capture screenshot")) throw error;
      await page.waitForTimeout(50);
    }
  }
}

/**
 * Waits until four frames in a row have drawn nothing, no view has a frame due, and no file is being decoded. Throws
 * after `seconds` with the list of pending work.
 */
export async function settle(page: Page, seconds = patienceSeconds): Promise<void> {
  const pendingWork = await page.evaluate(async (timeoutMs) => {
    const frame = (): Promise<number> => new Promise(requestAnimationFrame);
    const due = (): string[] =>
      Array.from(document.querySelectorAll("x3d")).flatMap((x3d) =>
        (x3d as { statistics?: { isFrameDue: boolean } }).statistics?.isFrameDue === true ? ["a frame is due"] : [],
      );
    const decoding = (): string[] =>
      Array.from(document.querySelectorAll("x3d shape")).flatMap((shape) =>
        Array.from((shape as { resources?: Iterable<{ state: string; url: string }> }).resources ?? []).flatMap(
          ({ state, url }) => (state === "decoding" ? [`${url} is being decoded`] : []),
        ),
      );
    let draws = -1;
    const findPendingWork = (): string[] => {
      const before = draws;
      draws = window.observed.draws;
      return [...(draws === before ? [] : [`it is still drawing (${draws} draws so far)`]), ...due(), ...decoding()];
    };
    const end = performance.now() + timeoutMs;
    for (let still = 0; still < 4; await frame()) {
      const pending = findPendingWork();
      still = pending.length === 0 ? still + 1 : 0;
      if (pending.length > 0 && performance.now() > end) return pending;
    }
    return [];
  }, 1000 * seconds);
  if (pendingWork.length > 0)
    throw new Error(
      `the page has not finished drawing after ${seconds} s: ${Array.from(new Set(pendingWork)).join(", ")}`,
    );
}

/** The picture of a page of `directory` after everything has loaded. */
export async function finalPicture(directory: string, options: PageOptions = {}): Promise<Picture> {
  let final: Picture | undefined;
  await withPage(directory, options, async ({ promise, picture }) => {
    await promise("complete");
    final = await picture();
  });
  assert.ok(final);
  return final;
}

const picturesOfSites = new Map<string, Promise<Picture>>();

/** The same of a site as it was converted: one page a run for all tests that compare theirs with it. */
export async function pictureOfSite(directory: string): Promise<Picture> {
  const known = picturesOfSites.get(directory) ?? finalPicture(directory);
  picturesOfSites.set(directory, known);
  return known;
}

/** Number of draw calls and clears of a frame, counted outside of the runtime. */
export async function drawsOfFrame({ page }: View): Promise<number> {
  return page.evaluate(async () => {
    const before = window.observed.draws;
    await (document.querySelector("x3d") as unknown as { toBlob: () => Promise<Blob> }).toBlob();
    return window.observed.draws - before;
  });
}

/** Polls a condition; throws with its description after a minute. */
export async function until(what: string, condition: () => boolean | Promise<boolean>): Promise<void> {
  const end = Date.now() + 1000 * patienceSeconds;
  for (; Date.now() < end; await new Promise((resolve) => setTimeout(resolve, 20))) {
    if (await condition()) return;
  }
  throw new Error(`timeout after ${patienceSeconds} s: ${what}`);
}
