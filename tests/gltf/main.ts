// Converts every glTF file of the given folders, and samples of each extension of materials; verifies the sites, and
// draws each beside three.js' GLTFLoader. Prints the mean difference of each picture and writes
// build/gltf/sheet.png. Fails where a site does not equal its file, or a picture of a sample differs by more than
// its limit.
//
//   scripts/gltf [FOLDER|FILE…]      default: /usr/share/assimp/models

import { spawnSync } from "node:child_process";
import { mkdirSync, readdirSync, rmSync, statSync, writeFileSync } from "node:fs";
import { basename, join } from "node:path";
import { launchChromium } from "../browser/chromium.ts";
import { difference } from "../browser/compare.ts";
import { converter, repository } from "../browser/paths.ts";
import { decodePng } from "../browser/png.ts";
import { startServer } from "../browser/server.ts";
import { draw, serveThree, size } from "./compare.ts";
import { materialSamples, sampleDocument } from "./samples.ts";

/** Mean difference of a colour channel, 0 … 255, that a sample may have. */
const maxSampleMean = 8;

const output = join(repository, "build/gltf");

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

rmSync(output, { recursive: true, force: true });
mkdirSync(join(output, "samples"), { recursive: true });
const samples = Object.entries(materialSamples).map(([name, materials]) => {
  const file = join(output, "samples", `${name}.gltf`);
  writeFileSync(file, sampleDocument(materials));
  return file;
});
const requested = process.argv.slice(2);
const files = [...samples, ...(requested.length > 0 ? requested : ["/usr/share/assimp/models"]).flatMap(filesIn)];
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
    try {
      const { imgeo, three } = await draw(browser, server, file, site);
      const { mean } = difference(decodePng(imgeo), decodePng(three));
      console.log(`${mean.toFixed(2).padStart(7)}  ${file}`);
      if (samples.includes(file) && mean > maxSampleMean) failures.push(`${file}: differs by ${mean.toFixed(2)}`);
      const picture = (png: Buffer) =>
        `<img width="${String(size.width / 2)}" src="data:image/png;base64,${png.toString("base64")}">`;
      cells.push(
        `<figure>${picture(imgeo)}${picture(three)}<figcaption>${basename(file)} ${mean.toFixed(2)}</figcaption></figure>`,
      );
    } catch (error) {
      console.log(`   none  ${file}: three.js draws nothing: ${String(error).split("\n")[0] ?? ""}`);
    }
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
