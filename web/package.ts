// Makes what the npm package `imgeo` holds, web/lib: a module and its types for
// each source, for bundlers to take from what an app uses; and the worker in one
// file, which they copy as it is.
import { build } from "esbuild";
import { execFileSync } from "node:child_process";
import { rmSync } from "node:fs";
import { join } from "node:path";
import { workerBundle } from "./bundle.ts";

const web = import.meta.dirname;

rmSync(join(web, "lib"), { recursive: true, force: true });
execFileSync(
  process.execPath,
  [join(web, "../node_modules/typescript/bin/tsc"), "--project", join(web, "tsconfig.package.json")],
  { stdio: "inherit" },
);
await build({ ...workerBundle, outfile: join(web, "lib/workers/imgeo-worker.js") });
