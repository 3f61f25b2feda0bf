// Builds the page of a terrain in build/terrain, for any server.
//
//   node examples/terrain/build.ts --dem FILE.tif     writes the elevation model
//   node examples/terrain/build.ts SITE [OUTPUT]      makes the page of its site

import { cpSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { geoTiffOf, readElevationModel } from "./dem.ts";
import { terrainPage } from "./page.ts";

const here = import.meta.dirname;
const [first, second] = process.argv.slice(2);
if (first === undefined) throw new Error("usage: node examples/terrain/build.ts --dem FILE.tif | SITE [OUTPUT]");

if (first === "--dem") {
  if (second === undefined) throw new Error("--dem needs the name of a file");
  mkdirSync(dirname(second), { recursive: true });
  writeFileSync(second, geoTiffOf(readElevationModel()));
} else {
  const output = second ?? join(here, "../../build/terrain");
  rmSync(output, { recursive: true, force: true });
  cpSync(first, output, { recursive: true });
  for (const file of ["terrain.css", "terrain.js"]) cpSync(join(here, file), join(output, file));
  const page = terrainPage(
    readFileSync(join(first, "index.html"), "utf8"),
    "Jacksboro fault",
    "A valley along a fault in Tennessee, 30 km wide, from SRTM's heights. Drag to turn it, pinch or scroll to come near.",
    [240, 1070],
  );
  writeFileSync(join(output, "index.html"), page);
}
