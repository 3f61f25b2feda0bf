// What visitors download to see a scene, beside other viewers': bytes minified,
// and compressed as hosts do. Prints a Markdown table.
//
//   scripts/bench sizes

import { readFileSync } from "node:fs";
import { join } from "node:path";
import { brotliCompressSync, constants, gzipSync } from "node:zlib";
import { build, transform, type Plugin } from "esbuild";
import { repository } from "../../tests/browser/paths.ts";
import { runtimeBundle, siteBundle, workerBundle } from "../../web/bundle.ts";
import { leanThree } from "../../web/leanThree.ts";

/** three.js itself is left to the app, but not its add-ons. */
const withoutThree: Plugin = {
  name: "without three.js",
  setup(bundle) {
    bundle.onResolve({ filter: /^three$/ }, () => ({ path: "three", external: true }));
  },
};

async function bundled(source: string, ...plugins: Plugin[]): Promise<Buffer> {
  const { outputFiles } = await build({
    ...runtimeBundle,
    plugins,
    write: false,
    entryPoints: [],
    stdin: { contents: source, resolveDir: repository, loader: "ts" },
  });
  return Buffer.from(outputFiles[0]!.contents);
}

/** What a page of `imgeo convert` loads, in its modules: those that draw a base, and all. */
async function ofSite(): Promise<{ first: Buffer[]; all: Buffer[] }> {
  const { outputFiles } = await build({ ...siteBundle, outdir: "dist", write: false });
  const modules = outputFiles.map(({ path, contents }) => ({ path, bytes: Buffer.from(contents) }));
  return {
    first: modules.filter(({ path }) => !path.endsWith("-scene.js")).map(({ bytes }) => bytes),
    all: modules.map(({ bytes }) => bytes),
  };
}

async function worker(): Promise<Buffer> {
  const { outputFiles } = await build({ ...workerBundle, write: false });
  return Buffer.from(outputFiles[0]!.contents);
}

/** What another viewer's package ships for pages, minified where it is not so already. */
async function shipped(path: string): Promise<Buffer> {
  const { code } = await transform(readFileSync(join(repository, "node_modules", path)), {
    minify: true,
    legalComments: "inline",
  });
  return Buffer.from(code);
}

const site = await ofSite();
const element = `import "./web/src/dom/index.ts";`;
const loader = `export { ImgeoLoader } from "./web/src/loader/index.ts";`;
// What an app that shows a mesh uses of three.js, as bench/load's pages do.
const app = `export { Scene, WebGLRenderer, PerspectiveCamera, DirectionalLight, Mesh, MeshStandardMaterial } from "three";`;

type Files = Buffer | Buffer[];

const rows: [name: string, withThree: Files | undefined, without: Files | undefined][] = [
  ["imgeo, what a page loads before its first image", site.first, undefined],
  ["imgeo, all that it loads", site.all, undefined],
  ["imgeo, the element `<x3d>` in one module", await bundled(element, leanThree), await bundled(element, withoutThree)],
  ["imgeo, `ImgeoLoader`", await bundled(app + loader), await bundled(loader, withoutThree)],
  ["imgeo's worker, for compact", undefined, await worker()],
  ["three.js itself, in an app", await bundled(app), undefined],
  [
    "three.js' GLTFLoader and MeshoptDecoder",
    undefined,
    await bundled(
      `export { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
     export { MeshoptDecoder } from "three/examples/jsm/libs/meshopt_decoder.module.js";`,
      withoutThree,
    ),
  ],
  [
    "model-viewer",
    await shipped("@google/model-viewer/dist/model-viewer.min.js"),
    await shipped("@google/model-viewer/dist/model-viewer-module.min.js"),
  ],
  ["X3DOM", undefined, await shipped("x3dom-1.8/x3dom.js")],
];

/** Files are compressed each for itself. */
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
