// Writes a mesh in the formats that the decoders read, each with 16-bit positions and 8-bit normals.

import { execFileSync } from "node:child_process";
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { converter, repository } from "../../tests/browser/paths.ts";
import type { Model } from "../load/models.ts";

export type DecoderName = "typescript" | "wasm" | "draco" | "meshopt";

/** The files of one model, by the name of their decoder. */
export type Inputs = Record<DecoderName, Buffer[]>;

export function inputsOf(model: Model, directory: string): Inputs {
  const run = (program: string, ...words: string[]): void =>
    void execFileSync(program, words, { stdio: ["ignore", "ignore", "inherit"] });
  const site = join(directory, "compact");
  // The mesh has normals, which Draco and gltfpack must keep.
  run(converter, "convert", model.ply, "-o", site, "--profile", "compact", "--base", "0", "--force");
  const geometry = join(site, "geometry");
  const drc = join(directory, "mesh.drc");
  run("draco_encoder", "-i", model.ply, "-o", drc, "-qp", "16", "-qn", "8", "-cl", "10");
  const glb = join(directory, "meshopt.glb");
  run(
    process.execPath,
    join(repository, "node_modules/gltfpack/cli.js"),
    "-i",
    model.glb,
    "-o",
    glb,
    "-vp",
    "16",
    "-vn",
    "8",
    "-cc",
  );
  const patches = readdirSync(geometry).map((file) => readFileSync(join(geometry, file)));
  return {
    typescript: patches,
    wasm: patches,
    draco: [readFileSync(drc)],
    meshopt: [readFileSync(glb)],
  };
}
