// Draws moments of animated glTF files by ImgeoLoader and by three.js' GLTFLoader, in one app with the same lights and
// shadows, and prints the mean difference of each. Samples are those of Debian's assimp-testmodels: two of glTF, and
// rigs of other formats as `imgeo export` writes them. Fails where a picture differs by more than maxMeanDifference.
//
//   scripts/gltf --animated

import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { basename, join } from "node:path";
import { launchChromium } from "../browser/chromium.ts";
import { bundleApp } from "../browser/appBundles.ts";
import { serveApp } from "../browser/appPage.ts";
import { difference } from "../browser/compare.ts";
import { converter, repository } from "../browser/paths.ts";
import { decodePng, encodePng, type Picture } from "../browser/png.ts";
import { startServer } from "../browser/server.ts";
import { animatedSamples } from "./animatedSamples.ts";

const models = "/usr/share/assimp/models";
const bundles = { "app.js": "tests/browser/riggedPage.ts", "worker.js": "web/src/workers/worker.ts" };
/** Seconds. */
const moments = [0, 0.4, 0.9];
/** Levels of 255. */
const maxMeanDifference = 0.05;
const precise = ["--container", "bg", "--coord-type", "float32", "--normal-bits", "16"];
const output = join(repository, "build/gltf-animated");

interface GltfDocument {
  buffers?: { uri?: string }[];
  materials?: unknown[];
  meshes?: { primitives: { material?: number }[] }[];
}

function run(...args: string[]): void {
  execFileSync(converter, args, { stdio: ["ignore", "ignore", "inherit"] });
}

/** A glTF or GLB file of a sample in the output folder, with a material, since loaders have different default ones. */
function fileOf(sample: string): string {
  const path = join(models, sample);
  if (!path.endsWith(".gltf")) {
    const site = join(output, `${basename(sample)}-source`);
    run("convert", path, "-o", site, "--force", ...precise);
    const file = join(output, `${basename(sample)}.glb`);
    run("export", site, "-o", file);
    return file;
  }
  const gltf = JSON.parse(readFileSync(path, "utf8")) as GltfDocument;
  gltf.materials = [{ pbrMetallicRoughness: { baseColorFactor: [0.8, 0.5, 0.2, 1], metallicFactor: 0 } }];
  for (const { primitives } of gltf.meshes ?? []) for (const primitive of primitives) primitive.material = 0;
  for (const buffer of gltf.buffers ?? [])
    if (buffer.uri !== undefined && !buffer.uri.startsWith("data:"))
      writeFileSync(join(output, buffer.uri), readFileSync(join(path, "..", buffer.uri)));
  const file = join(output, basename(sample));
  writeFileSync(file, JSON.stringify(gltf));
  return file;
}

rmSync(output, { recursive: true, force: true });
mkdirSync(output, { recursive: true });
await bundleApp(bundles, join(output, "app"));
const server = await startServer(output);
server.contentPolicy = "default-src 'self' data: blob:"; // simple_skin has its buffers in data URLs
serveApp(server, "/app.html", join(output, "app"), Object.keys(bundles));
const browser = await launchChromium();

/** The pictures of a GLB, or of the document of a site. `bounded`: the GLB whose bounds decide what is seen. */
async function picturesOf(url: string, bounded: string): Promise<Picture[]> {
  const page = await browser.newPage({ viewport: { width: 320, height: 240 } });
  try {
    await page.goto(new URL("app.html", server.origin).href);
    await page.waitForFunction(() => "loadModel" in window);
    await page.evaluate(
      async ([model, reference]) => {
        const { center, size } = await window.boundsOf(reference);
        await window.loadModel(model, "/worker.js", 2 * size, center);
      },
      [url, bounded] as const,
    );
    const pictures: Picture[] = [];
    for (const moment of moments) {
      await page.evaluate((seconds) => window.drawMoment(seconds), moment);
      pictures.push(decodePng(await page.screenshot()));
    }
    return pictures;
  } finally {
    await page.close();
  }
}

try {
  console.log(`| animated sample | ${moments.map((moment) => `${moment} s`).join(" | ")} |`);
  console.log(`|---|${moments.map(() => "--:|").join("")}`);
  for (const sample of animatedSamples) {
    const file = fileOf(sample);
    const site = join(output, `site-${basename(file)}`);
    run("convert", file, "-o", site, "--force", ...precise);
    const reference = await picturesOf(`/${basename(file)}`, `/${basename(file)}`);
    const pictures = await picturesOf(`/${basename(site)}/scene.x3d`, `/${basename(file)}`);
    for (const [i, picture] of pictures.entries())
      for (const [name, each] of Object.entries({ imgeo: picture, three: reference[i] ?? picture }))
        writeFileSync(join(output, `${basename(file)}-${i}-${name}.png`), encodePng(each));
    const means = pictures.map((picture, i) => difference(picture, reference[i] ?? picture).mean);
    console.log(`| ${basename(sample)} | ${means.map((mean) => mean.toFixed(3)).join(" | ")} |`);
    if (means.some((mean) => mean > maxMeanDifference)) process.exitCode = 1;
  }
} finally {
  await browser.close();
  await server.close();
}
