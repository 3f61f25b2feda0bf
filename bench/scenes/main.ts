// Measures scenes of many shapes with two cameras each: the document's share of their bytes, what a page requests
// until it displays something and until it displays everything, and the order of its requests. Prints Markdown tables;
// writes pictures to build/scenes and, if no scene is missing, all of them together to docs/images/scenes.png.
//
//   scripts/bench scenes [NAME...]

import { execFileSync } from "node:child_process";
import { mkdirSync, mkdtempSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { launchWarm } from "../load/measure.ts";
import { converter, repository } from "../../tests/browser/paths.ts";
import { fileOf, inputs, sitesOf, type Input } from "./inputs.ts";
import { loadScene, type RequestedFile, type SceneLoad } from "./sceneLoad.ts";

const connection = { bitsPerSecond: 20e6, roundTripMs: 40 };
const output = join(repository, "build/scenes");

interface SiteInfo {
  readonly triangles: number;
  readonly documentBytes: number;
  readonly containerBytes: number;
  readonly textureBytes: number;
}

interface Measured {
  readonly input: Input;
  readonly info: SiteInfo;
  readonly visits: readonly SceneLoad[];
}

function print(...cells: (string | number)[]): void {
  console.log(`| ${cells.join(" | ")} |`);
}

const integerText = (value: number): string => Math.round(value).toLocaleString("en-US");
const share = (part: number, of: number): string => `${((100 * part) / of).toFixed(1)} %`;

async function measure(input: Input, work: string): Promise<Measured | undefined> {
  const file = fileOf(input, work);
  if (file === undefined) return undefined;
  const sites = sitesOf(input, file, work);
  const info = JSON.parse(execFileSync(converter, ["info", "--json", sites[0]], { encoding: "utf8" })) as SiteInfo;
  const visits: SceneLoad[] = [];
  for (const site of sites) visits.push(await loadScene(browser, site, connection));
  visits.forEach(({ picture }, camera) => {
    writeFileSync(join(output, `${input.name}-${camera + 1}.png`), picture);
  });
  // The size of the first copy's document: the second copy has additional camera attributes.
  return { input, info: { ...info, documentBytes: statSync(join(sites[0], "index.html")).size }, visits };
}

/** Prints the document's size raw and with brotli; geometry and textures are not compressed further. */
function printBytes({ input, info, visits }: Measured): void {
  const { shapes, triangles, documentBytes, runtimeBytes } = visits[0]!;
  const { containerBytes, textureBytes } = info;
  // Bytes of the containers if every instance of a mesh were stored separately.
  const unsharedBytes = (containerBytes * triangles) / info.triangles;
  const page = runtimeBytes + containerBytes + textureBytes;
  print(
    input.name,
    integerText(shapes),
    integerText(triangles),
    integerText(info.triangles),
    integerText(info.documentBytes),
    integerText(documentBytes),
    integerText(containerBytes),
    integerText(textureBytes),
    share(documentBytes, documentBytes + page),
    share(documentBytes, documentBytes + containerBytes + textureBytes),
    share(info.documentBytes, info.documentBytes + unsharedBytes + textureBytes),
  );
}

function printLoad({ input, visits }: Measured, camera: number): void {
  const { requests, bytes, firstBytes, firstSeconds, finalSeconds, drawCalls } = visits[camera]!;
  print(
    input.name,
    input.cameras[camera]!.name,
    requests,
    drawCalls,
    `${integerText(firstBytes / 1000)} kB, ${firstSeconds.toFixed(2)} s`,
    `${integerText(bytes / 1000)} kB, ${finalSeconds.toFixed(2)} s`,
  );
}

function textOf({ role, names, bytes }: RequestedFile): string {
  const some = names
    .slice(0, 3)
    .map((name) => (name.length > 24 ? `${name.slice(0, 23)}…` : name))
    .join(", ");
  return `${role} (${(bytes / 1000).toFixed(bytes < 10_000 ? 1 : 0)} kB) of ${some}${names.length > 3 ? ` and ${names.length - 3} more` : ""}`;
}

/** Prints the order of requests without previews, which are requested together and would fill the list. */
function printOrder({ input, visits }: Measured, camera: number): void {
  const steps = visits[camera]!.requestedFiles.filter(({ role }) => role !== "preview").map(textOf);
  console.log(
    `- **${input.name}, ${input.cameras[camera]!.name}**: ${steps.slice(0, 8).join("; ")}${steps.length > 8 ? `; ${steps.length - 8} more` : ""}`,
  );
}

/** A PNG with a column per scene and a row per camera. */
async function contactSheetOf(all: readonly Measured[]): Promise<Buffer> {
  const width = 200;
  const page = await browser.newPage({ viewport: { width: width * all.length, height: 300 } });
  const pictures = [0, 1].flatMap((camera) => all.map(({ visits }) => visits[camera]!.picture.toString("base64")));
  await page.setContent(
    `<style>body { margin: 0; line-height: 0 }</style>${pictures
      .map((png) => `<img width="${width}" src="data:image/png;base64,${png}">`)
      .join("")}`,
  );
  return page.screenshot();
}

const sceneNames = process.argv.slice(2);
mkdirSync(output, { recursive: true });
const work = mkdtempSync(join(tmpdir(), "imgeo-scenes-"));
const browser = await launchWarm();
try {
  const all: Measured[] = [];
  for (const input of inputs) {
    if (sceneNames.length > 0 && !sceneNames.includes(input.name)) continue;
    const measured = await measure(input, work);
    if (measured) all.push(measured);
  }
  print(
    "scene",
    "shapes",
    "triangles displayed",
    "triangles stored",
    "document",
    "brotli",
    "geometry",
    "textures",
    "document's share of the page",
    "of the scene's files",
    "if nothing were shared",
  );
  print("---", ...Array.from({ length: 10 }, () => "--:"));
  all.forEach(printBytes);
  console.log();
  print(
    "scene",
    "camera",
    "requests",
    "draw calls",
    "received until the first picture",
    "received until everything is displayed",
  );
  print("---", "---", "--:", "--:", "--:", "--:");
  for (const measured of all) for (const camera of [0, 1]) printLoad(measured, camera);
  console.log();
  for (const measured of all) for (const camera of [0, 1]) printOrder(measured, camera);
  if (all.length === inputs.length)
    writeFileSync(join(repository, "docs/images/scenes.png"), await contactSheetOf(all));
} finally {
  await browser.close();
  rmSync(work, { recursive: true, force: true });
}
