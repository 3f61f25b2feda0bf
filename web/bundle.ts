// Bundles the runtime and what it needs of three.js into one ES module, web/dist/imgeo.js, and what
// its workers run into another, web/dist/imgeo-worker.js. The `imgeo` tool carries
// both inside itself and copies them into every site.
import { build, type BuildOptions } from "esbuild";
import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { gzipSync } from "node:zlib";
import { leanThree } from "./leanThree.ts";

function bundleOf(entry: string): BuildOptions & { write?: true } {
  return {
    entryPoints: [join(import.meta.dirname, "src", entry)],
    bundle: true,
    format: "esm",
    target: "es2022",
    minify: true,
    sourcemap: false,
    legalComments: "inline",
    logLevel: "warning",
  };
}

export const runtimeBundle = { ...bundleOf("dom/index.ts"), plugins: [leanThree] };
export const workerBundle = bundleOf("workers/worker.ts");

if (import.meta.main) {
  for (const [name, options] of Object.entries({ "imgeo.js": runtimeBundle, "imgeo-worker.js": workerBundle })) {
    const outfile = join(import.meta.dirname, "dist", name);
    await build({ ...options, outfile });
    const bytes = await readFile(outfile);
    console.log(`web/dist/${name} ${bytes.byteLength} bytes, ${gzipSync(bytes, { level: 9 }).byteLength} gzipped`);
  }
}
