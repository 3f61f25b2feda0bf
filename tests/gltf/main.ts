// Converts every glTF file of the given folders, and samples of each extension of materials; verifies the sites, and
// draws each beside three.js' GLTFLoader. Prints the mean difference of each picture and writes
// build/gltf/sheet.png. Fails where a site does not equal its file, its page is not drawn, or a picture differs and
// explanations.ts does not say why.
//
//   scripts/gltf [FOLDER|FILE…]      default: assimp-testmodels, and the npm packages of `scripts/dependencies --soak`

import { spawnSync } from "node:child_process";
import { existsSync, mkdirSync, readdirSync, rmSync, statSync, writeFileSync } from "node:fs";
import { basename, dirname, join } from "node:path";
import { launchChromium } from "../browser/chromium.ts";
import { difference } from "../browser/compare.ts";
import { converter, repository } from "../browser/paths.ts";
import { decodePng } from "../browser/png.ts";
import { startServer } from "../browser/server.ts";
import { draw, serveThree, size, type Drawn } from "./compare.ts";
import { explanationOf, maxEqualMean } from "./explanations.ts";
import { materialSamples, sampleDocument } from "./samples.ts";

const output = join(repository, "build/gltf");

/** Folders of models that are installed. */
const installed = ["/usr/share/assimp/models", join(repository, "build/soak/node_modules")].filter((folder) =>
  existsSync(folder),
);

function filesIn(path: string): string[] {
  if (statSync(path).isFile()) return [path];
  return readdirSync(path, { recursive: true, encoding: "utf8" })
    .filter((file) => /\.(gltf|glb)$/i.test(file))
    .sort()
    .map((file) => join(path, file));
}

function run(...args: string[]): { status: number | null; message: string } {
  const { status, stderr, stdout } = spawnSync(converter, args, { encoding: "utf8", timeout: 120_000 });
  return { status, message: (status === 0 ? stdout : stderr).trim() };
}

/** A file's name with that of its folder: many models are called left.glb or scene.gltf. */
function labelOf(file: string): string {
  return join(basename(dirname(file)), basename(file));
}

rmSync(output, { recursive: true, force: true });
mkdirSync(join(output, "samples"), { recursive: true });
const samples = Object.entries(materialSamples).map(([name, materials]) => {
  const file = join(output, "samples", `${name}.gltf`);
  writeFileSync(file, sampleDocument(materials));
  return file;
});
const requested = process.argv.slice(2);
const files = [...samples, ...(requested.length > 0 ? requested : installed).flatMap(filesIn)];
const server = await startServer(output);
await serveThree(server);
const browser = await launchChromium();
const cells: string[] = [];
const failures: string[] = [];
const counts = { drawn: 0, refused: 0 };
try {
  for (const [i, file] of files.entries()) {
    const site = join(output, `site-${String(i)}`);
    const converted = run("convert", file, "-o", site);
    if (converted.status !== 0) {
      counts.refused += 1;
      console.log(`refused  ${file}: ${converted.message.split("\n").at(-1) ?? ""}`);
      if (converted.status !== 2 && converted.status !== 3)
        failures.push(`${file}: exit code ${String(converted.status)}`);
      continue;
    }
    const verified = run("verify", site, file);
    if (verified.status !== 0) failures.push(`${file}: its site does not equal it`);
    counts.drawn += 1;
    let drawn: Drawn;
    try {
      drawn = await draw(browser, server, file, site);
    } catch (error) {
      failures.push(`${file}: its page is not drawn: ${String(error).split("\n")[0] ?? ""}`);
      continue;
    }
    if ("threeError" in drawn) {
      console.log(`   none  ${file}: three.js draws nothing: ${drawn.threeError}`);
      continue;
    }
    const { imgeo, three } = drawn;
    const { mean } = difference(decodePng(imgeo), decodePng(three));
    const why = mean > maxEqualMean ? explanationOf(file) : "";
    console.log(`${mean.toFixed(2).padStart(7)}  ${file}${why === "" ? "" : `: ${why}`}`);
    if (mean > maxEqualMean && why === "") failures.push(`${file}: differs by ${mean.toFixed(2)}`);
    const picture = (png: Buffer) =>
      `<img width="${String(size.width / 2)}" src="data:image/png;base64,${png.toString("base64")}">`;
    cells.push(
      `<figure>${picture(imgeo)}${picture(three)}<figcaption>${labelOf(file)} ${mean.toFixed(2)}</figcaption></figure>`,
    );
  }
  const page = await browser.newPage({ viewport: { width: 4 * (size.width + 12), height: 600 } });
  await page.setContent(`<style>
    body { margin: 0; display: grid; grid-template-columns: repeat(4, auto); font: 11px/16px sans-serif }
    figure { margin: 2px 4px; white-space: nowrap; line-height: 0 } figcaption { line-height: 16px }
  </style>${cells.join("")}`);
  writeFileSync(join(output, "sheet.png"), await page.screenshot({ fullPage: true }));
} finally {
  await browser.close();
  await server.close();
}
console.log(
  `${String(counts.drawn)} files are drawn (imgeo left, three.js right in build/gltf/sheet.png), ${String(counts.refused)} refused`,
);
if (failures.length > 0) {
  console.error(failures.join("\n"));
  process.exitCode = 1;
}
