// Bundles the runtime into the ES modules of web/dist: imgeo.js, which a page loads
// first, and which draws previews and loads the rest; imgeo-scene.js, the rest with
// three.js in it; imgeo-shared.js, which both import; imgeo-animation.js, which only documents with animation need; and
// imgeo-worker.js for workers.
// The `imgeo` executable contains them and copies them into every site.
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

/** The whole runtime in one module. */
export const runtimeBundle = { ...bundleOf("dom/index.ts"), plugins: [leanThree] };
export const workerBundle = bundleOf("workers/worker.ts");

/** The runtime in the modules of a site. */
export const siteBundle: BuildOptions & { write?: true } = {
  ...bundleOf("dom/page.ts"),
  entryPoints: {
    imgeo: join(sources, "dom/page.ts"),
    "imgeo-scene": join(sources, "dom/register.ts"),
    // Shares no code with the others, whose common code would otherwise be a second chunk.
    "imgeo-animation": join(sources, "animation/index.ts"),
  },
  splitting: true,
  chunkNames: "imgeo-shared", // a second chunk would have the same name, which is an error
  plugins: [leanThree],
};

if (import.meta.main) {
  const outdir = join(import.meta.dirname, "dist");
  await build({ ...siteBundle, outdir });
  await build({ ...workerBundle, outfile: join(outdir, "imgeo-worker.js") });
  for (const name of ["imgeo.js", "imgeo-shared.js", "imgeo-scene.js", "imgeo-animation.js", "imgeo-worker.js"]) {
    const bytes = await readFile(join(outdir, name));
    console.log(`web/dist/${name} ${bytes.byteLength} bytes, ${gzipSync(bytes, { level: 9 }).byteLength} gzipped`);
  }
}
