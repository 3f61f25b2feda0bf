// Launches Debian's Chromium, headless, with WebGL2 in software and without network requests of its own. The
// environment variable CHROMIUM names another binary.

import { chromium, type Browser } from "playwright-core";

const flags = [
  "--no-sandbox --disable-quic --no-first-run --disable-background-networking --disable-component-update",
  "--disable-sync --disable-extensions --mute-audio --hide-scrollbars --use-gl=angle --use-angle=swiftshader",
  "--enable-unsafe-swiftshader --ignore-gpu-blocklist --force-device-scale-factor=1 --force-color-profile=srgb",
  // Without this, compositing takes half of SwiftShader's time.
  "--disable-gpu-compositing",
  "--js-flags=--expose-gc", // lets tests collect garbage
].flatMap((line) => line.split(" "));

export async function launchChromium(...moreFlags: string[]): Promise<Browser> {
  const args = [...flags, ...moreFlags];
  return chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", headless: true, args });
}
