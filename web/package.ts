// package.ts [OPTIONS OF TSC]: makes the contents of the npm package `imgeo`. web/lib holds a module with its types
// for each source, of which an app's bundler takes what the app uses, and the worker
// in one file, which the bundler copies, as the decoder in WebAssembly. Licence and notice come from the repository.
import { execFileSync } from "node:child_process";
import { copyFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { bundleWorker } from "./bundle.ts";

const web = import.meta.dirname;

rmSync(join(web, "lib"), { recursive: true, force: true });
execFileSync(
  process.execPath,
  [
    join(web, "../node_modules/typescript/bin/tsc"),
    "--project",
    join(web, "tsconfig.package.json"),
    ...process.argv.slice(2),
  ],
  { stdio: "inherit" },
);
writeFileSync(join(web, "lib/workers/imgeo-worker.js"), await bundleWorker());
copyFileSync(join(web, "dist/imgeo-decoder.wasm"), join(web, "lib/workers/imgeo-decoder.wasm"));
for (const name of ["LICENSE", "NOTICE"]) copyFileSync(join(web, "..", name), join(web, name));
