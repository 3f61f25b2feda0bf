// Launches Debian's Chromium, headless, with WebGL2 in software and without network requests of its own. The
// environment variable CHROMIUM names another binary. With IMGEO_GPU=1 it draws on the machine's GPU by EGL, which
// needs no display; tests compare pictures with WebGL in software only. Not Debian's chromium-headless-shell: it begins
// each page with a pointer over the top left corner, so that views count as visited.

import { chromium, type Browser } from "playwright-core";

const rendererFlags =
  process.env.IMGEO_GPU !== undefined
    ? "--use-gl=angle --use-angle=gl-egl"
    : // With compositing on the GPU, it takes half of SwiftShader's time.
      "--use-gl=angle --use-angle=swiftshader --enable-unsafe-swiftshader --disable-gpu-compositing";

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
  rendererFlags,
  `--disable-features=${disabledFeatures}`,
  "--js-flags=--expose-gc", // lets tests collect garbage
].flatMap((line) => line.split(" "));

export async function launchChromium(...moreFlags: string[]): Promise<Browser> {
  const args = [...flags, ...moreFlags];
  return chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", headless: true, args });
}
