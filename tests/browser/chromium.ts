// Debian's Chromium, headless, drawing WebGL2 in software, and asking the network
// for nothing of its own. CHROMIUM names another binary.

import { chromium, type Browser } from "playwright-core";

const flags = [
  "--no-sandbox --disable-quic --no-first-run --disable-background-networking --disable-component-update",
  "--disable-sync --disable-extensions --mute-audio --hide-scrollbars --use-gl=angle --use-angle=swiftshader",
  "--enable-unsafe-swiftshader --ignore-gpu-blocklist --force-device-scale-factor=1 --force-color-profile=srgb",
  // Chromium's own layers are put together without SwiftShader: half its work is for WebGL then.
  "--disable-gpu-compositing",
  "--js-flags=--expose-gc", // to see what is let go of
].flatMap((line) => line.split(" "));

export async function launchChromium(...moreFlags: string[]): Promise<Browser> {
  const args = [...flags, ...moreFlags];
  return chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", headless: true, args });
}
