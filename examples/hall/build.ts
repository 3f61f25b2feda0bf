// Builds the walk through a hall in build/hall, for any server.
//
//   node examples/hall/build.ts SITE [OUTPUT]

import { cpSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { walkPage } from "./page.ts";

const here = import.meta.dirname;
const [site, output = join(here, "../../build/hall")] = process.argv.slice(2);
if (site === undefined) throw new Error("usage: node examples/hall/build.ts SITE [OUTPUT]");

rmSync(output, { recursive: true, force: true });
cpSync(site, output, { recursive: true });
cpSync(join(here, "hall.css"), join(output, "hall.css"));
const page = readFileSync(join(site, "index.html"), "utf8");
writeFileSync(
  join(output, "index.html"),
  walkPage(
    page,
    "A hall",
    "Walk with the arrow keys, or with two fingers; drag to look around. Press F to fly, W to walk.",
  ),
);
