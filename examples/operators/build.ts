// Builds the page of image operators on geometry in build/operators, for any server.
//
//   node examples/operators/build.ts SITE GRIDSITE [OUTPUT]     of one mesh: --profile classic, --as geometry-image

import { cpSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { operatorsPage } from "./page.ts";

const here = import.meta.dirname;
const [site, gridSite, output = join(here, "../../build/operators")] = process.argv.slice(2);
if (site === undefined || gridSite === undefined)
  throw new Error("usage: node examples/operators/build.ts SITE GRIDSITE [OUTPUT]");

rmSync(output, { recursive: true, force: true });
cpSync(site, output, { recursive: true });
cpSync(join(gridSite, "geometry"), join(output, "geometry"), { recursive: true });
for (const file of ["operators.css", "operators.js"]) cpSync(join(here, file), join(output, file));
const pageOf = (folder: string) => readFileSync(join(folder, "index.html"), "utf8");
writeFileSync(join(output, "index.html"), operatorsPage(pageOf(site), pageOf(gridSite), "Image operators"));
