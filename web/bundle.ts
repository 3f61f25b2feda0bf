// Bundles the runtime into the ES modules of web/dist: what a page loads first,
// imgeo.js, which draws what it can and brings the rest, with three.js in it,
// imgeo-scene.js; what both need, imgeo-shared.js; and what workers run,
// imgeo-worker.js. The `imgeo` tool carries them inside itself and copies them into
// every site.
import { build, type BuildOptions } from "esbuild";
import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { gzipSync } from "node:zlib";
import { leanThree } from "./leanThree.ts";

const sources = join(import.meta.dirname, "src");

function bundleOf(entry: string): BuildOptions & { write?: true } {
  return {
    entryPoints: [join(sources, entry)],
    bundle: true,
    format: "esm",
    target: "es2022",
    minify: true,
    sourcemap: false,
    legalComments: "inline",
    logLevel: "warning",
  };
}

/** All of it in one module. */
export const runtimeBundle = { ...bundleOf("dom/index.ts"), plugins: [leanThree] };
export const workerBundle = bundleOf("workers/worker.ts");

/** As sites have it, in as many modules as it takes to come in parts. */
export const siteBundle: BuildOptions & { write?: true } = {
  ...bundleOf("dom/page.ts"),
  entryPoints: { imgeo: join(sources, "dom/page.ts"), "imgeo-scene": join(sources, "dom/register.ts") },
  splitting: true,
  chunkNames: "imgeo-shared", // there is one: two would be two files of this name, which is an error
  plugins: [leanThree],
};

if (import.meta.main) {
  const outdir = join(import.meta.dirname, "dist");
  await build({ ...siteBundle, outdir });
  await build({ ...workerBundle, outfile: join(outdir, "imgeo-worker.js") });
  for (const name of ["imgeo.js", "imgeo-shared.js", "imgeo-scene.js", "imgeo-worker.js"]) {
    const bytes = await readFile(join(outdir, name));
    console.log(`web/dist/${name} ${bytes.byteLength} bytes, ${gzipSync(bytes, { level: 9 }).byteLength} gzipped`);
  }
}
