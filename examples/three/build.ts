// Builds the app and the site of a model in build/three-app, for any server. Here `imgeo` is bundled from the sources
// in web/; an app of yours imports the npm package.
//
//   node examples/three/build.ts [SITE [OUTPUT]]

import { build } from "esbuild";
import { cpSync, mkdirSync, rmSync } from "node:fs";
import { join } from "node:path";

const here = import.meta.dirname;
const repository = join(here, "../..");
const [site = join(repository, "build/demo/dragon_vrip"), output = join(repository, "build/three-app")] =
  process.argv.slice(2);

rmSync(output, { recursive: true, force: true });
mkdirSync(output, { recursive: true });
for (const file of ["index.html", "app.css"]) cpSync(join(here, file), join(output, file));
cpSync(site, join(output, "model"), { recursive: true });
await build({
  entryPoints: [join(here, "app.ts")],
  outfile: join(output, "app.js"),
  alias: { "imgeo/loader": join(repository, "web/src/loader/index.ts") },
  bundle: true,
  format: "esm",
  target: "es2022",
  minify: true,
  logLevel: "warning",
});
for (const file of ["imgeo-worker.js", "imgeo-decoder.wasm"])
  cpSync(join(repository, "web/dist", file), join(output, file));
