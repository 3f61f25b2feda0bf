// Measures the bytes that visitors download to display a scene with imgeo and with other viewers, minified and
// compressed as by hosts. Prints Markdown tables: module by module, and in all beside other viewers. Modules of another
// version come from a folder: web/dist of that version, or `imgeo` of a site that it converted.
//
//   scripts/bench sizes [FOLDER of the previous version's modules]

import { mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { brotliCompressSync, constants, gzipSync } from "node:zlib";
import { transform } from "esbuild";
import { repository } from "../../tests/browser/paths.ts";
import { bundleModule, bundleSite, bundleWithThree, bundleWorker } from "../../web/bundle.ts";

const work = mkdtempSync(join(repository, "build/sizes-"));

/** Bundles a module's text, which three.js or another package is not part of if it is `external`. */
async function bundleOf(source: string, external?: readonly string[]): Promise<Buffer> {
  const entry = join(work, "entry.ts");
  writeFileSync(entry, source);
  return Buffer.from(await (external ? bundleModule(entry, external) : bundleWithThree(entry)));
}

/** The file of another viewer's package that pages load, minified. */
async function packagedFile(path: string): Promise<Buffer> {
  const { code } = await transform(readFileSync(join(repository, "node_modules", path)), {
    minify: true,
    legalComments: "inline",
  });
  return Buffer.from(code);
}

type Files = Buffer | readonly Buffer[];

/** Bytes minified, with gzip, and with brotli; each file is compressed separately. */
function sizesOf(files: Files): readonly [number, number, number] {
  const all = Buffer.isBuffer(files) ? [files] : files;
  const sum = (pack: (bytes: Buffer) => Buffer) => all.reduce((bytes, file) => bytes + pack(file).length, 0);
  return [
    sum((bytes) => bytes),
    sum((bytes) => gzipSync(bytes, { level: 9 })),
    sum((bytes) => brotliCompressSync(bytes, { params: { [constants.BROTLI_PARAM_SIZE_HINT]: bytes.length } })),
  ];
}

function cellOf(files: Files | undefined): string {
  if (files === undefined || (!Buffer.isBuffer(files) && files.length === 0)) return "";
  return sizesOf(files)
    .map((bytes) => (bytes / 1000).toFixed(1))
    .join(" / ");
}

/** The modules in a folder by their names without hashes. */
function modulesIn(folder: string): Map<string, Buffer> {
  const files = readdirSync(folder).filter((file) => /^imgeo.*\.(js|wasm)$/.test(file));
  const isHashed = files.some((file) => /-[0-9a-f]{16}\./.test(file));
  // Beside modules with hashes, imgeo.js is the one that other pages load.
  const named = isHashed ? files.filter((file) => /-[0-9a-f]{16}\./.test(file)) : files;
  return new Map(
    named.map((file) => [file.replace(/(-[0-9a-f]{16})?\.\w+$/, ""), readFileSync(join(folder, file))] as const),
  );
}

/** What a page loads before its first image, and what it loads to display a mesh with one material. */
const firstModules = ["imgeo", "imgeo-shared"];
const statueModules = [...firstModules, "imgeo-scene"];

const modules = new Map<string, Buffer>();
for (const [name, code] of await bundleSite()) modules.set(name, Buffer.from(code));
modules.set("imgeo-worker", Buffer.from(await bundleWorker()));
modules.set("imgeo-decoder", readFileSync(join(repository, "web/dist/imgeo-decoder.wasm")));
const previousFolder = process.argv[2];
const previous = previousFolder === undefined ? new Map<string, Buffer>() : modulesIn(previousFolder);

function these(of: ReadonlyMap<string, Buffer>, names: readonly string[]): Buffer[] {
  return names.flatMap((name) => of.get(name) ?? []);
}

function scriptsOf(of: ReadonlyMap<string, Buffer>): Buffer[] {
  return Array.from(of).flatMap(([name, bytes]) => (/-(worker|decoder)$/.test(name) ? [] : [bytes]));
}

console.log("| kB minified / gzip / brotli | this version | previous version |\n|---|--:|--:|");
for (const name of new Set([...modules.keys(), ...previous.keys()]))
  console.log(`| ${name} | ${cellOf(modules.get(name))} | ${cellOf(previous.get(name))} |`);
const totals: [string, readonly Buffer[], readonly Buffer[]][] = [
  ["a statue's page before its first image", these(modules, firstModules), these(previous, firstModules)],
  ["a statue's page in all", these(modules, statueModules), these(previous, statueModules)],
  ["all modules", scriptsOf(modules), scriptsOf(previous)],
];
for (const [name, now, before] of totals) console.log(`| **${name}** | ${cellOf(now)} | ${cellOf(before)} |`);

const element = `import "../../web/src/dom/index.ts";`;
const loader = `export { ImgeoLoader } from "../../web/src/loader/index.ts";`;
// The modules of three.js that an app uses to display a mesh, as bench/load's pages do.
const app = `export { Scene, WebGLRenderer, PerspectiveCamera, DirectionalLight, Mesh, MeshStandardMaterial } from "three";`;
const notThree = ["three"];

const rows: [name: string, withThree: Files | undefined, without: Files | undefined][] = [
  ["imgeo, a statue's page in all", these(modules, statueModules), undefined],
  ["imgeo, the element `<x3d>` in one module", await bundleOf(element), await bundleOf(element, notThree)],
  ["imgeo, `ImgeoLoader`", await bundleOf(app + loader, []), await bundleOf(loader, notThree)],
  ["three.js itself, in an app", await bundleOf(app, []), undefined],
  [
    "three.js' GLTFLoader and MeshoptDecoder",
    undefined,
    await bundleOf(
      `export { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
     export { MeshoptDecoder } from "three/examples/jsm/libs/meshopt_decoder.module.js";`,
      notThree,
    ),
  ],
  [
    "model-viewer",
    await packagedFile("@google/model-viewer/dist/model-viewer.min.js"),
    await packagedFile("@google/model-viewer/dist/model-viewer-module.min.js"),
  ],
  ["X3DOM", undefined, await packagedFile("x3dom-1.8/x3dom.js")],
];
rmSync(work, { recursive: true });

console.log("\n| kB minified / gzip / brotli | with three.js | without |\n|---|--:|--:|");
for (const [name, withThree, without] of rows) console.log(`| ${name} | ${cellOf(withThree)} | ${cellOf(without)} |`);
