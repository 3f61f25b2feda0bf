// A page that shows shapes in the layouts of X3DOM's tools side by side, and the parts of its picture.

import { mkdirSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { outputDirectory } from "../browser/paths.ts";
import type { Picture } from "../browser/png.ts";
import { files } from "./foreignFiles.ts";
import { layouts, type Layout } from "./foreignLayouts.ts";

/** Columns and rows of the shapes on the picture. */
const columns = 4;
const rows = 4;
const cell = 1.8;
const distance = 20;
/** Size of the picture in pixels, at which no byte of a coordinate is too fine to be visible. */
export const foreignSize = { width: 640, height: 640 };

/** The X3D element that shows the layouts for which `isShown` is true. */
export function sceneOf(isShown: (layout: Layout) => boolean): string {
  const shapes = layouts.map((layout, index) => {
    const x = cell * ((index % columns) - (columns - 1) / 2);
    const y = cell * ((rows - 1) / 2 - Math.floor(index / columns));
    return isShown(layout) ? `<Transform translation="${x} ${y} 0">${layout.markup}</Transform>` : "";
  });
  const angle = 2 * Math.atan((rows * cell) / 2 / distance);
  return (
    `<X3D width="${foreignSize.width}px" height="${foreignSize.height}px" showStat="false" showLog="false"><Scene>` +
    `<Background skyColor="0.1 0.1 0.15"></Background><NavigationInfo></NavigationInfo>` +
    `<Viewpoint position="0 0 ${distance}" fieldOfView="${angle}"></Viewpoint>${shapes.join("\n")}</Scene></X3D>`
  );
}

/** Writes the page and its files, and returns their folder. */
export function writeForeignSite(): string {
  const folder = join(outputDirectory, "foreign");
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(folder, { recursive: true });
  for (const [name, bytes] of files) writeFileSync(join(folder, name), bytes);
  const script = '<script src="https://www.x3dom.org/download/x3dom.js"></script>';
  const head = `<title>Old</title><meta charset="utf-8">${script}`;
  writeFileSync(
    join(folder, "index.html"),
    `<!doctype html><html><head>${head}</head><body>${sceneOf(() => true)}</body></html>`,
  );
  return folder;
}

/** The part of a picture that shows a layout. */
export function cellOf(picture: Picture, index: number): Picture {
  const width = Math.floor(picture.width / columns);
  const height = Math.floor(picture.height / rows);
  const left = width * (index % columns);
  const top = height * Math.floor(index / columns);
  const lines = Array.from({ length: height }, (_, line) => {
    const from = picture.channels * ((top + line) * picture.width + left);
    return picture.data.slice(from, from + picture.channels * width);
  });
  return { ...picture, width, height, data: Uint8Array.from(lines.flatMap((line) => Array.from(line))) };
}

/** A part of the picture's size that shows nothing but the background of its first pixel. */
export function emptyCell(picture: Picture): Picture {
  const cell = cellOf(picture, 0);
  return { ...cell, data: cell.data.map((_, index) => picture.data[index % picture.channels] ?? 0) };
}
