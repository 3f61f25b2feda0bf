// Pages of several shapes, composed from sites of one shape each.

import assert from "node:assert/strict";
import { cpSync, mkdirSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { outputDirectory } from "./paths.ts";
import { ranksOfFiles } from "./siteDecoder.ts";
import { pageOf } from "./sites.ts";

/** The Shape of a site with its files in `folder`; `attributes` go into its tag. */
export function shapeInFolder(site: string, folder: string, attributes = ""): string {
  const html = pageOf(site);
  const shape = /<Shape[\s\S]*<\/Shape>/i.exec(html)?.[0].replace(/<Shape/i, () => `<Shape ${attributes}`);
  assert.ok(shape);
  return [...ranksOfFiles(html).keys()].reduce((text, url) => text.replaceAll(url, `${folder}/${url}`), shape);
}

/** A directory with each site in the folder of its name, and a page with `scene`. */
export function sceneOf(name: string, sites: Record<string, string>, scene: string, x3dAttributes = ""): string {
  const directory = join(outputDirectory, "sites", name);
  rmSync(directory, { recursive: true, force: true });
  mkdirSync(directory, { recursive: true });
  const [first] = Object.values(sites);
  assert.ok(first);
  // The runtime and the style sheet come from the first site; its preload hints do not apply to this scene.
  cpSync(first, directory, { recursive: true });
  for (const [folder, site] of Object.entries(sites)) cpSync(site, join(directory, folder), { recursive: true });
  const page = pageOf(first)
    .replaceAll(/<link rel="preload"[^>]*>\s*/g, "")
    .replace(
      /<X3D([^>]*)>[\s\S]*<\/X3D>/i,
      (_, own: string) => `<X3D${own} ${x3dAttributes}><Scene>${scene}</Scene></X3D>`,
    );
  writeFileSync(join(directory, "index.html"), page);
  return directory;
}

/** The ranks of ranksOfFiles for a site whose files are in `folder`. */
export function ranksIn(site: string, folder: string): Map<string, number> {
  return new Map([...ranksOfFiles(pageOf(site))].map(([url, rank]) => [`${folder}/${url}`, rank]));
}

/** A ROUTE between two fields, each given as `NODE.field`. */
export function route(from: string, to: string): string {
  const [[fromNode, fromField], [toNode, toField]] = [from.split("."), to.split(".")];
  return `<ROUTE fromNode="${fromNode}" fromField="${fromField}" toNode="${toNode}" toField="${toField}"></ROUTE>`;
}
