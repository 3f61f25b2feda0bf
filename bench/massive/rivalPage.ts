// The page that displays a tileset by 3d-tiles-renderer, as its users write it: with preload hints.

import { cpSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { build } from "esbuild";
import { repository } from "../../tests/browser/paths.ts";
import { laxPolicy, type BenchPage } from "../load/pages.ts";
import type { Camera } from "./sites.ts";

/** `loadsAll`: with the siblings and ancestors of displayed tiles, which is the library's default. */
export async function rivalPage(
  name: string,
  tileset: string,
  directory: string,
  camera: Camera,
  loadsAll: boolean,
): Promise<BenchPage> {
  mkdirSync(directory, { recursive: true });
  // In a folder of its own: with tiles at a host's root the library asks for `//NAME`.
  cpSync(tileset, join(directory, "tiles"), { recursive: true });
  await build({
    entryPoints: [join(repository, "bench/massive/pages/tiles.ts")],
    outfile: join(directory, "page.js"),
    bundle: true,
    format: "esm",
    target: "es2022",
    minify: true,
    logLevel: "warning",
  });
  const { root } = JSON.parse(readFileSync(join(tileset, "tileset.json"), "utf8")) as {
    root: { content: { uri: string } };
  };
  // With default settings the root is loaded first.
  const hints = ["tileset.json", ...(loadsAll ? [root.content.uri] : [])].map(
    (url) => `<link rel="preload" as="fetch" crossorigin="anonymous" href="tiles/${url}">`,
  );
  writeFileSync(
    join(directory, "index.html"),
    `<!doctype html><html><head><meta charset="utf-8"><title>${name}</title>
<link rel="modulepreload" href="page.js">${hints.join("")}
<script>window.settings = ${JSON.stringify({ ...camera, loadsAll })}</script><script type="module" src="page.js"></script>
<style>html, body { margin: 0; height: 100% } canvas { display: block }</style></head><body></body></html>`,
  );
  return { name, directory, contentPolicy: laxPolicy, announcesCompletion: true };
}
