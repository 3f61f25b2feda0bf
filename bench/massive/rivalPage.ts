// The page that displays a tileset by 3d-tiles-renderer.

import { cpSync, mkdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { threePage, type BenchPage } from "../load/pages.ts";
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
  const { root } = JSON.parse(readFileSync(join(tileset, "tileset.json"), "utf8")) as {
    root: { content: { uri: string } };
  };
  // With default settings the root is loaded first.
  const preloads = ["tileset.json", ...(loadsAll ? [root.content.uri] : [])].map((url) => `tiles/${url}`);
  const settings = `<script>window.settings = ${JSON.stringify({ ...camera, loadsAll })}</script>`;
  return threePage(name, "bench/massive/pages/tiles.ts", preloads, directory, settings);
}
