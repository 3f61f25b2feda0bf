// The levels of a site as 3D Tiles: the same triangles, compressed by meshopt, a GLB a tile.
//
// Groups are a graph: a group's coarse form is spread over several parents, so that borders move from level to level.
// 3D Tiles are trees: a tile is replaced by all of its children. So the triangles of each level are cut anew: the root
// tile has the highest level, and the children of a tile are the triangles of the level below whose centroids lie in the
// tile's cell, cut by a k-d tree into as few cells of at most 32,768 triangles as there can be. There are as many
// triangles on each level, and about as many and as large tiles, as there are groups. Borders of neighbouring tiles of
// two levels do not fit together, as in other tilesets without skirts: nothing is added against these cracks, which
// would take bytes.
//
// A tile's geometric error is the largest that the index states of the groups of the level below whose centres are in
// its cell: how far the tile is from what replaces it. Positions have the steps that the site has: on level 0 those of its
// lattice, above a sixteenth of the mean edge; normals have 8 bits.

import { execFile } from "node:child_process";
import { mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { promisify } from "node:util";
import { GlbWriter } from "../../tests/browser/glb.ts";
import { readPly, type PlainMesh } from "../../tests/browser/meshes.ts";
import { repository } from "../../tests/browser/paths.ts";
import { pageOf } from "../../tests/browser/sites.ts";
import { addPageFile, levelPageUrl, readLevelIndex } from "../../web/src/levels/levelFiles.ts";
import type { LevelIndex } from "../../web/src/levels/levelIndex.ts";
import { imgeo } from "./sites.ts";

const maxTileTriangles = 32_768;

type Point = readonly [number, number, number];
interface Box {
  low: [number, number, number];
  high: [number, number, number];
}

interface Tile {
  boundingVolume: { box: number[] };
  geometricError: number;
  refine: "REPLACE";
  content: { uri: string };
  children: Tile[];
}

/** A level's mesh, the centroid of each triangle, and the step that its positions need. */
interface Level {
  mesh: PlainMesh & { normals: Float32Array };
  centroids: Float32Array;
  step: number;
}

/** A group that the index states, in coordinates of the scene. */
interface StatedError {
  level: number;
  center: Point;
  error: number;
}

/** Writes `tileset.json` and its GLB files; returns the number of tiles. */
export async function writeTileset(site: string, directory: string): Promise<number> {
  mkdirSync(directory, { recursive: true });
  const { index, errors, step } = await statedErrors(site);
  const levels = Array.from({ length: index.levelCount }, (_, level) => levelOf(site, level, step, directory));
  const jobs: (() => Promise<void>)[] = [];
  const tileOf = (level: number, cell: Box, triangles: Uint32Array): { tile: Tile; bounds: Box } => {
    const own = levels[level]!;
    const name = `${level}-${jobs.length}`;
    const part = partOf(own.mesh, triangles);
    jobs.push(() => writeGlb(part, own.step, join(directory, name)));
    const children =
      level === 0
        ? []
        : cut(levels[level - 1]!, trianglesIn(levels[level - 1]!, cell), cell).map((each) =>
            tileOf(level - 1, each.cell, each.triangles),
          );
    const bounds = children.map((child) => child.bounds).reduce(union, boundsOf(part.positions));
    const error = level === 0 ? 0 : errorIn(errors, level - 1, cell, bounds);
    const tile: Tile = {
      boundingVolume: { box: obbOf(bounds) },
      geometricError: Math.max(error, ...children.map((child) => child.tile.geometricError)),
      refine: "REPLACE",
      content: { uri: `${name}.glb` },
      children: children.map((child) => child.tile),
    };
    return { tile, bounds };
  };
  const top = levels.length - 1;
  const everywhere: Box = { low: [-Infinity, -Infinity, -Infinity], high: [Infinity, Infinity, Infinity] };
  const { tile: root } = tileOf(top, everywhere, trianglesIn(levels[top]!, everywhere));
  const tileset = { asset: { version: "1.0", gltfUpAxis: "Z" }, geometricError: root.geometricError, root };
  writeFileSync(join(directory, "tileset.json"), JSON.stringify(tileset, rounded));
  const count = jobs.length;
  const work = async (): Promise<void> => {
    for (let job = jobs.pop(); job !== undefined; job = jobs.pop()) await job();
  };
  await Promise.all([work(), work()]);
  return count;
}

/** Six digits: coordinates of more would take bytes for nothing. */
function rounded(_: string, value: unknown): unknown {
  return typeof value === "number" ? Number(value.toPrecision(6)) : value;
}

async function statedErrors(site: string): Promise<{ index: LevelIndex; errors: StatedError[]; step: number }> {
  const page = pageOf(site);
  const word = (name: string): string => new RegExp(`\\b${name}="([^"]*)"`).exec(geometryIn(page))?.[1] ?? "";
  const url = join(site, word("levels").replaceAll("'", "").replaceAll('"', ""));
  const fileOf = (path: string) => Uint8Array.from(readFileSync(path));
  const index = await readLevelIndex(fileOf(url));
  for (let p = 1; p < index.pageCount; ++p) await addPageFile(index, p, fileOf(levelPageUrl(url, p)));
  const size = Math.max(...word("size").split(" ").map(Number));
  const bytes = Math.ceil(index.positionBits / 8);
  const step = (size * 2 ** (8 * bytes - index.positionBits)) / (256 ** bytes - 1);
  const low = word("position")
    .split(" ")
    .map((center) => Number(center) - size / 2);
  const bounds = { x: 0, y: 0, z: 0, radius: 0, reach: 0, error: 0 };
  const errors = Array.from({ length: index.groupCount }, (_, group) => {
    index.readBounds(group, bounds);
    const center = [low[0]! + step * bounds.x, low[1]! + step * bounds.y, low[2]! + step * bounds.z] as const;
    return { level: index.level(group), center, error: step * bounds.error };
  });
  return { index, errors, step };
}

function geometryIn(page: string): string {
  const element = /<ImageGeometry[^>]*>/i.exec(page)?.[0];
  if (element === undefined) throw new Error("the page has no ImageGeometry");
  return element;
}

function levelOf(site: string, level: number, latticeStep: number, directory: string): Level {
  const file = join(directory, "level.ply");
  imgeo("export", site, "--level", String(level), "-o", file);
  const { normals, ...mesh } = readPly(readFileSync(file));
  rmSync(file);
  if (normals === undefined) throw new Error("the site has no normals");
  const { positions, triangles } = mesh;
  const centroids = new Float32Array(triangles.length);
  let edges = 0;
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [3 * triangles[t]!, 3 * triangles[t + 1]!, 3 * triangles[t + 2]!];
    let square = 0;
    for (let axis = 0; axis < 3; ++axis) {
      centroids[t + axis] = (positions[a + axis]! + positions[b + axis]! + positions[c + axis]!) / 3;
      square += (positions[a + axis]! - positions[b + axis]!) ** 2;
    }
    edges += Math.sqrt(square);
  }
  const step = level === 0 ? latticeStep : Math.max(latticeStep, edges / (triangles.length / 3) / 16);
  return { mesh: { ...mesh, normals }, centroids, step };
}

function trianglesIn({ centroids }: Level, { low, high }: Box): Uint32Array {
  const found: number[] = [];
  for (let t = 0; t < centroids.length; t += 3) {
    const isIn = [0, 1, 2].every((axis) => centroids[t + axis]! >= low[axis]! && centroids[t + axis]! < high[axis]!);
    if (isIn) found.push(t / 3);
  }
  return Uint32Array.from(found);
}

/** Cells of at most `maxTileTriangles` triangles: across the longest axis, at a share of the triangles. */
function cut(level: Level, triangles: Uint32Array, cell: Box): { cell: Box; triangles: Uint32Array }[] {
  const parts = Math.ceil(triangles.length / maxTileTriangles);
  if (triangles.length === 0) return [];
  if (parts === 1) return [{ cell, triangles }];
  const { centroids } = level;
  const extent = (axis: number): number => {
    let [low, high] = [Infinity, -Infinity];
    for (const t of triangles) {
      low = Math.min(low, centroids[3 * t + axis]!);
      high = Math.max(high, centroids[3 * t + axis]!);
    }
    return high - low;
  };
  const extents = [0, 1, 2].map(extent);
  const axis = extents.indexOf(Math.max(...extents));
  const along = Float32Array.from(triangles, (t) => centroids[3 * t + axis]!);
  const at = along.toSorted()[Math.round((triangles.length * Math.floor(parts / 2)) / parts)]!;
  const below: Box = { low: [...cell.low], high: [...cell.high] };
  const above: Box = { low: [...cell.low], high: [...cell.high] };
  below.high[axis] = above.low[axis] = at;
  return [
    ...cut(
      level,
      triangles.filter((t) => centroids[3 * t + axis]! < at),
      below,
    ),
    ...cut(
      level,
      triangles.filter((t) => centroids[3 * t + axis]! >= at),
      above,
    ),
  ];
}

function errorIn(errors: readonly StatedError[], level: number, { low, high }: Box, bounds: Box): number {
  const own = errors.filter((each) => each.level === level);
  const inside = own.filter(({ center }) => center.every((value, axis) => value >= low[axis]! && value < high[axis]!));
  if (inside.length > 0) return Math.max(...inside.map(({ error }) => error));
  const distance = ({ center }: StatedError): number =>
    Math.hypot(...center.map((value, axis) => value - (bounds.low[axis]! + bounds.high[axis]!) / 2));
  return own.toSorted((a, b) => distance(a) - distance(b))[0]?.error ?? 0;
}

function partOf({ positions, normals, triangles }: Level["mesh"], chosen: Uint32Array): Level["mesh"] {
  const numbers = new Map<number, number>();
  const indices = new Uint32Array(3 * chosen.length);
  for (const [i, t] of chosen.entries())
    for (let corner = 0; corner < 3; ++corner) {
      const vertex = triangles[3 * t + corner]!;
      const number = numbers.get(vertex) ?? numbers.size;
      numbers.set(vertex, number);
      indices[3 * i + corner] = number;
    }
  const gather = (values: Float32Array): Float32Array => {
    const gathered = new Float32Array(3 * numbers.size);
    for (const [vertex, number] of numbers) gathered.set(values.subarray(3 * vertex, 3 * vertex + 3), 3 * number);
    return gathered;
  };
  return { positions: gather(positions), normals: gather(normals), triangles: indices };
}

function boundsOf(positions: Float32Array): Box {
  const box: Box = { low: [Infinity, Infinity, Infinity], high: [-Infinity, -Infinity, -Infinity] };
  for (const [i, value] of positions.entries()) {
    const axis = i % 3;
    box.low[axis] = Math.min(box.low[axis]!, value);
    box.high[axis] = Math.max(box.high[axis]!, value);
  }
  return box;
}

function union(a: Box, b: Box): Box {
  const each = (pick: typeof Math.min, x: Point, y: Point): [number, number, number] => [
    pick(x[0], y[0]),
    pick(x[1], y[1]),
    pick(x[2], y[2]),
  ];
  return { low: each(Math.min, a.low, b.low), high: each(Math.max, a.high, b.high) };
}

/** Centre and half axes. */
function obbOf({ low, high }: Box): number[] {
  const half = (axis: 0 | 1 | 2): number => (high[axis] - low[axis]) / 2;
  const center = ([0, 1, 2] as const).map((axis) => low[axis] + half(axis));
  return [...center, half(0), 0, 0, 0, half(1), 0, 0, 0, half(2)];
}

const run = promisify(execFile);

/** `path` is without extension. gltfpack's steps are the longest edge of the tile's box by a power of two. */
async function writeGlb(mesh: Level["mesh"], step: number, path: string): Promise<void> {
  const writer = new GlbWriter();
  const attributes = {
    POSITION: writer.attribute(Array.from(mesh.positions), 3),
    NORMAL: writer.attribute(Array.from(mesh.normals), 3),
  };
  const indices = writer.indices(Array.from(mesh.triangles));
  const plain = `${path}-plain.glb`;
  writeFileSync(
    plain,
    writer.file({
      asset: { version: "2.0" },
      scene: 0,
      scenes: [{ nodes: [0] }],
      nodes: [{ mesh: 0 }],
      meshes: [{ primitives: [{ attributes, indices }] }],
    }),
  );
  const { low, high } = boundsOf(mesh.positions);
  const extent = Math.max(...low.map((value, axis) => high[axis]! - value));
  const bits = Math.min(16, Math.max(1, Math.ceil(Math.log2(extent / step))));
  const words = ["-i", plain, "-o", `${path}.glb`, "-vp", String(bits), "-vn", "8", "-cz", "-ce", "khr"];
  await run(process.execPath, [join(repository, "node_modules/gltfpack/cli.js"), ...words]);
  rmSync(plain);
}

/** Bytes of all tiles as they are, for a note. */
export function tileBytes(directory: string): number {
  return readdirSync(directory)
    .filter((name) => name.endsWith(".glb"))
    .reduce((sum, name) => sum + readFileSync(join(directory, name)).length, 0);
}
