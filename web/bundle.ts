// Bundles the runtime and three.js into one ES module, web/dist/imgeo.js, and what
// its workers run into another, web/dist/imgeo-worker.js. The `imgeo` tool carries
// both inside itself and copies them into every site.
import { build } from "esbuild";
import { readFile } from "node:fs/promises";
import { gzipSync } from "node:zlib";
import { fileURLToPath } from "node:url";

const bundles = { "imgeo.js": "dom/index.ts", "imgeo-worker.js": "workers/worker.ts" };

for (const [name, entry] of Object.entries(bundles)) {
  const outfile = fileURLToPath(new URL(`dist/${name}`, import.meta.url));
  await build({
    entryPoints: [fileURLToPath(new URL(`src/${entry}`, import.meta.url))],
    outfile,
    bundle: true,
    format: "esm",
    target: "es2022",
    minify: true,
    sourcemap: false,
    legalComments: "inline",
    logLevel: "warning",
  });
  const bytes = await readFile(outfile);
  console.log(`web/dist/${name} ${bytes.byteLength} bytes, ${gzipSync(bytes, { level: 9 }).byteLength} gzipped`);
}
