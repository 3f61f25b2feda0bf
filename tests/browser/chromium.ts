// Launches Debian's Chromium, headless, with WebGL2 in software and without network requests of its own. The
// environment variable CHROMIUM names another binary. With IMGEO_GPU=1 it draws on the machine's GPU by EGL, which
// needs no display; tests compare pictures with WebGL in software only. Not Debian's chromium-headless-shell: it begins
// each page with a pointer over the top left corner, so that views count as visited.

import { chromium, type Browser } from "playwright-core";

/** SwiftShader is part of Chromium; Mesa's llvmpipe is what EGL has where LIBGL_ALWAYS_SOFTWARE is set. */
type Renderer = "swiftshader" | "llvmpipe" | "gpu";

const rendererFlags: Record<Renderer, string> = {
  // With compositing on the GPU, it takes half of SwiftShader's time.
  swiftshader: "--use-gl=angle --use-angle=swiftshader --enable-unsafe-swiftshader --disable-gpu-compositing",
  llvmpipe: "--use-gl=angle --use-angle=gl-egl --disable-gpu-compositing",
  gpu: "--use-gl=angle --use-angle=gl-egl",
};

/**
 * Chromium loads the pages of its own address bar with every window, which takes more than half a second of a core. The
 * last list of a command line counts, so those that Playwright disables for pages are repeated.
 */
const disabledFeatures = [
  "WebUIOmniboxPopup,WebUIOmniboxAimPopup",
  "AvoidUnnecessaryBeforeUnloadCheckSync,DestroyProfileOnBrowserClose,HttpsUpgrades,HttpsFirstBalancedModeAutoEnable",
  "LensOverlay,MediaRouter,PaintHolding,ThirdPartyStoragePartitioning,AvoidCorsURLLoaderRestartOnRedirect",
  "OptimizationHints,NetworkTimeServiceQuerying,AimEnabled,PreconnectToSearch",
].join(",");

const flags = [
  "--no-sandbox --disable-quic --no-first-run --disable-background-networking --disable-component-update",
  "--disable-sync --disable-extensions --mute-audio --hide-scrollbars",
  "--ignore-gpu-blocklist --force-device-scale-factor=1 --force-color-profile=srgb",
  `--disable-features=${disabledFeatures}`,
  "--js-flags=--expose-gc", // lets tests collect garbage
].flatMap((line) => line.split(" "));

function launch(renderer: Renderer, moreFlags: readonly string[]): Promise<Browser> {
  const args = [...flags, ...rendererFlags[renderer].split(" "), ...moreFlags];
  const env = { ...process.env, ...(renderer === "llvmpipe" ? { LIBGL_ALWAYS_SOFTWARE: "1" } : {}) };
  return chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", headless: true, args, env });
}

/** Draws as Chromium does on machines without a GPU, by SwiftShader, or on the GPU with IMGEO_GPU=1. */
export function launchChromium(...moreFlags: string[]): Promise<Browser> {
  return launch(process.env.IMGEO_GPU === undefined ? "swiftshader" : "gpu", moreFlags);
}

/**
 * For tests, of which most take a few frames of small scenes: draws by llvmpipe, which takes half of SwiftShader's time
 * for them because it keeps compiled shaders on disk; by SwiftShader where Mesa has no WebGL2, or where the environment
 * variable IMGEO_TEST_RENDERER names it.
 */
export async function launchTestChromium(...moreFlags: string[]): Promise<Browser> {
  if (process.env.IMGEO_GPU !== undefined) return launch("gpu", moreFlags);
  if (process.env.IMGEO_TEST_RENDERER !== "swiftshader") {
    const browser = await launch("llvmpipe", moreFlags);
    if (await hasWebGL2(browser)) return browser;
    await browser.close();
  }
  return launch("swiftshader", moreFlags);
}

async function hasWebGL2(browser: Browser): Promise<boolean> {
  const page = await browser.newPage();
  const found = await page.evaluate(() => document.createElement("canvas").getContext("webgl2") !== null);
  await page.close();
  return found;
}
