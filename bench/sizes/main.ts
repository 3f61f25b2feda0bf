// Measures the bytes that visitors download to display a scene with imgeo and with other viewers, minified and
// compressed as by hosts. Prints a Markdown table.
//
//   scripts/bench sizes

import { readFileSync } from "node:fs";
import { join } from "node:path";
import { brotliCompressSync, constants, gzipSync } from "node:zlib";
import { build, transform, type Plugin } from "esbuild";
import { repository } from "../../tests/browser/paths.ts";
import { runtimeBundle, siteBundle, workerBundle } from "../../web/bundle.ts";
import { leanThree } from "../../web/leanThree.ts";

/** Leaves out three.js itself, which the app brings, but keeps its add-ons. */
const withoutThree: Plugin = {
  name: "without three.js",
  setup(bundle) {
    bundle.onResolve({ filter: /^three$/ }, () => ({ path: "three", external: true }));
  },
};

async function bundleOf(source: string, ...plugins: Plugin[]): Promise<Buffer> {
  const { outputFiles } = await build({
    ...runtimeBundle,
    plugins,
    write: false,
    entryPoints: [],
    stdin: { contents: source, resolveDir: repository, loader: "ts" },
  });
  return Buffer.from(outputFiles[0]!.contents);
}

/**
 * The modules that a page of `imgeo convert` loads: those that draw the preview, all of a document that does not move,
 * and the one for documents that move.
 */
async function siteModules(): Promise<{ first: Buffer[]; all: Buffer[]; animation: Buffer[] }> {
  const { outputFiles } = await build({ ...siteBundle, outdir: "dist", write: false });
  const modules = outputFiles.map(({ path, contents }) => ({ path, bytes: Buffer.from(contents) }));
  const withoutEnds = (...ends: readonly string[]): Buffer[] =>
    modules.filter(({ path }) => !ends.some((end) => path.endsWith(end))).map(({ bytes }) => bytes);
  return {
    first: withoutEnds("-scene.js", "-animation.js"),
    all: withoutEnds("-animation.js"),
    animation: modules.filter(({ path }) => path.endsWith("-animation.js")).map(({ bytes }) => bytes),
  };
}

async function workerModule(): Promise<Buffer> {
  const { outputFiles } = await build({ ...workerBundle, write: false });
  return Buffer.from(outputFiles[0]!.contents);
}

/** The file of another viewer's package that pages load, minified. */
async function packagedFile(path: string): Promise<Buffer> {
  const { code } = await transform(readFileSync(join(repository, "node_modules", path)), {
    minify: true,
    legalComments: "inline",
  });
  return Buffer.from(code);
}

const site = await siteModules();
const element = `import "./web/src/dom/index.ts";`;
const loader = `export { ImgeoLoader } from "./web/src/loader/index.ts";`;
// The modules of three.js that an app uses to display a mesh, as bench/load's pages do.
const app = `export { Scene, WebGLRenderer, PerspectiveCamera, DirectionalLight, Mesh, MeshStandardMaterial } from "three";`;

const decoder = readFileSync(join(repository, "web/dist/imgeo-decoder.wasm"));

type Files = Buffer | Buffer[];

const rows: [name: string, withThree: Files | undefined, without: Files | undefined][] = [
  ["imgeo, what a page loads before its first image", site.first, undefined],
  ["imgeo, all that it loads", site.all, undefined],
  ["imgeo, in addition for documents that move", undefined, site.animation],
  [
    "imgeo, the element `<x3d>` in one module",
    await bundleOf(element, leanThree),
    await bundleOf(element, withoutThree),
  ],
  ["imgeo, `ImgeoLoader`", await bundleOf(app + loader), await bundleOf(loader, withoutThree)],
  ["imgeo's worker, for compact", undefined, await workerModule()],
  ["the decoder of compact in WebAssembly", undefined, decoder],
  ["three.js itself, in an app", await bundleOf(app), undefined],
  [
    "three.js' GLTFLoader and MeshoptDecoder",
    undefined,
    await bundleOf(
      `export { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
     export { MeshoptDecoder } from "three/examples/jsm/libs/meshopt_decoder.module.js";`,
      withoutThree,
    ),
  ],
  [
    "model-viewer",
    await packagedFile("@google/model-viewer/dist/model-viewer.min.js"),
    await packagedFile("@google/model-viewer/dist/model-viewer-module.min.js"),
  ],
  ["X3DOM", undefined, await packagedFile("x3dom-1.8/x3dom.js")],
];

/** Sums sizes; each file is compressed separately. */
function cellOf(files: Files | undefined): string {
  if (files === undefined) return "";
  const all: readonly Buffer[] = Buffer.isBuffer(files) ? [files] : files;
  const brotli = (bytes: Buffer): Buffer =>
    brotliCompressSync(bytes, { params: { [constants.BROTLI_PARAM_SIZE_HINT]: bytes.length } });
  const sums = [(bytes: Buffer) => bytes, (bytes: Buffer) => gzipSync(bytes, { level: 9 }), brotli].map((pack) =>
    all.reduce((sum, bytes) => sum + pack(bytes).length, 0),
  );
  return sums.map((sum) => (sum / 1000).toFixed(0)).join(" / ");
}

console.log("| kB minified / gzip / brotli | with three.js | without |\n|---|--:|--:|");
for (const [name, withThree, without] of rows) console.log(`| ${name} | ${cellOf(withThree)} | ${cellOf(without)} |`);
