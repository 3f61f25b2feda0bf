// Bundles the runtime and three.js into one ES module, web/dist/imgeo.js, which
// the `imgeo` tool carries inside itself and copies into every site.
import { build } from "esbuild";
import { stat } from "node:fs/promises";
import { gzipSync } from "node:zlib";
import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";

const outfile = fileURLToPath(new URL("dist/imgeo.js", import.meta.url));

await build({
  entryPoints: [fileURLToPath(new URL("src/dom/index.ts", import.meta.url))],
  outfile,
  bundle: true,
  format: "esm",
  target: "es2022",
  minify: true,
  sourcemap: false,
  legalComments: "inline",
  logLevel: "warning",
});

const { size } = await stat(outfile);
const gzipped = gzipSync(readFileSync(outfile), { level: 9 }).byteLength;
console.log(`web/dist/imgeo.js ${size} bytes, ${gzipped} gzipped`);
