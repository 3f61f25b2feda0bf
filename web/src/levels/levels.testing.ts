// Random graphs of groups for tests, with the triangles that each group holds, and the payloads of their indexes.
//
// A fake mesh is a number of items, the triangles of level 0. Each level divides them into groups along a curve that is
// another for each level. An item stands for itself on level 0, and above for its share of the coarse form of the group
// below, so that a group has as many parents as groups above hold its items. A cut draws each item once, or not legally.

import { TestRandom } from "../decode/compact/rangeEncoder.testing.ts";
import { LevelIndex } from "./levelIndex.ts";

export interface TestGroup {
  level: number;
  center: [number, number, number];
  radius: number;
  /** Without the children's spheres. */
  ownRadius?: number;
  error: number;
  vertices: number;
  triangles: number;
  bytes: number;
  children: number[];
  /** Columns, rows and bytes of its image. */
  chips?: [number, number, number];
}

export interface TestLevels {
  readonly positionBits: number;
  readonly pageGroups: number;
  readonly rootCount: number;
  readonly hasPoints?: boolean;
  /** Version 2. */
  readonly hasOwnSpheres?: boolean;
  readonly groups: readonly TestGroup[];
}

/** Items of each group in the order of its segments, and where the segments start. */
export interface TestSegments {
  readonly items: readonly number[];
  readonly segmentStarts: readonly number[];
}

export interface TestMesh {
  readonly levels: TestLevels;
  readonly itemCount: number;
  /** By group. */
  readonly segments: readonly TestSegments[];
}

/** A mesh of `itemCount` items with about `groupItems` in each group of level 0; each level has a quarter of the groups. */
export function randomMesh(seed: number, itemCount: number, groupItems: number, pageGroups = 16): TestMesh {
  const random = new TestRandom(seed);
  const rows: number[][][] = []; // by level: the items of each group
  for (let size = groupItems; ; size *= 4) {
    const isTop = size * 2 > itemCount;
    rows.push(isTop ? [Array.from({ length: itemCount }, (_, item) => item)] : divided(random, itemCount, size));
    if (isTop) break;
  }
  return meshOf(rows, itemCount, pageGroups, random);
}

/** Groups of about `size` consecutive items, of which one in eight is exchanged with another. */
function divided(random: TestRandom, itemCount: number, size: number): number[][] {
  const order = Array.from({ length: itemCount }, (_, item) => item);
  for (let n = 0; n < itemCount / 16; ++n) {
    const at = random.below(itemCount);
    const other = Math.min(itemCount - 1, at + random.below(2 * size));
    [order[at], order[other]] = [order[other]!, order[at]!];
  }
  const groups: number[][] = [];
  for (let first = 0; first < itemCount;) {
    const end = first === 0 ? 1 + random.below(size) : first + size - random.below(Math.ceil(size / 3));
    groups.push(order.slice(first, end));
    first = end;
  }
  return groups;
}

function meshOf(rows: readonly number[][][], itemCount: number, pageGroups: number, random: TestRandom): TestMesh {
  const firsts: number[] = []; // by level: the number of its first group
  let groupCount = 0;
  for (let level = rows.length - 1; level >= 0; --level) {
    firsts[level] = groupCount;
    groupCount += rows[level]!.length;
  }
  const groups: TestGroup[] = [];
  const segments: TestSegments[] = [];
  let groupOfItem: number[] = []; // on the level below
  for (const [level, row] of rows.entries()) {
    const own: number[] = [];
    for (const [i, items] of row.entries()) {
      const number = firsts[level]! + i;
      for (const item of items) own[item] = number;
      const below = (item: number) => (level === 0 ? number : groupOfItem[item]!);
      const sorted = items.toSorted((a, b) => below(a) - below(b));
      const children = level === 0 ? [] : [...new Set(sorted.map(below))];
      const starts = sorted.flatMap((item, at) => (at === 0 || below(item) !== below(sorted[at - 1]!) ? [at] : []));
      segments[number] = { items: sorted, segmentStarts: [...starts, items.length] };
      groups[number] = groupOf(level, level === rows.length - 1, items, children, groups, itemCount, random);
    }
    groupOfItem = own;
  }
  const levels = { positionBits: 16, pageGroups, rootCount: rows.at(-1)!.length, groups };
  return { levels, itemCount, segments };
}

/** The group's sphere and error contain those of its children. */
function groupOf(
  level: number,
  isRoot: boolean,
  items: readonly number[],
  children: readonly number[],
  groups: readonly TestGroup[],
  itemCount: number,
  random: TestRandom,
): TestGroup {
  const along = (item: number) => Math.round((65535 * item) / itemCount);
  const coordinates = items.map(along).sort((a, b) => a - b);
  const center: TestGroup["center"] = [coordinates[coordinates.length >> 1]!, 30000 + random.below(2000), 32768];
  const ownRadius = Math.ceil((coordinates.at(-1)! - coordinates[0]!) / 4) + 500;
  let radius = ownRadius;
  let error = 8 * level + random.below(6);
  for (const number of children) {
    const child = groups[number]!;
    const distance = Math.hypot(...center.map((value, axis) => value - child.center[axis]!));
    radius = Math.max(radius, child.radius + Math.ceil(distance / 4));
    error = Math.max(error, child.error + 1);
  }
  return {
    ...{ level, center, radius: Math.min(radius, 65535), ownRadius, error: isRoot ? 255 : error },
    vertices: 100 + random.below(900),
    triangles: Math.max(children.length, 200 + random.below(1800)),
    bytes: 1000 + random.below(9000),
    children: [...children],
  };
}

/** The payload of a page, after docs/formats/levels.md. `pageBytes`: the sizes of the files of pages 1 and up. */
export function pagePayload(
  levels: TestLevels,
  page: number,
  pageBytes: readonly number[] = [],
): Uint8Array<ArrayBuffer> {
  const { groups, pageGroups, rootCount, positionBits, hasPoints = false, hasOwnSpheres = false } = levels;
  const out: number[] = [...Buffer.from("IGL"), hasOwnSpheres ? 2 : 1, hasPoints ? 1 : 0];
  const number = (value: number): void => {
    for (; value >= 128; value >>>= 7) out.push((value & 127) | 128);
    out.push(value);
  };
  number(page);
  const pages = Math.ceil(groups.length / pageGroups);
  if (page === 0) {
    for (const value of [groups.length, pageGroups, rootCount]) number(value);
    out.push(positionBits);
    for (let other = 1; other < pages; ++other) number(pageBytes[other - 1] ?? 1);
  }
  const first = page * pageGroups;
  const own = groups.slice(first, first + pageGroups);
  for (const group of own) out.push(group.level);
  for (let axis = 0; axis < 3; ++axis) {
    const differences = own.map((group, i) => group.center[axis]! - (own[i - 1]?.center[axis] ?? 0));
    for (const shift of [0, 8]) for (const difference of differences) out.push((difference >> shift) & 255);
  }
  const radii = own.map(({ radius, ownRadius = radius }) => (hasOwnSpheres ? ownRadius : radius));
  for (const shift of [0, 8]) for (const radius of radii) out.push((radius >> shift) & 255);
  for (const group of own) out.push(group.error);
  for (const column of ["vertices", "triangles", "bytes"] as const)
    if (!hasPoints || column !== "triangles") for (const group of own) number(group[column]);
  for (const group of own) number(group.children.length);
  for (const [i, { children }] of own.entries())
    for (const [n, child] of children.entries()) number(child - (children[n - 1] ?? first + i));
  return Uint8Array.from(out);
}

export function pageCountOf({ groups, pageGroups }: TestLevels): number {
  return Math.ceil(groups.length / pageGroups);
}

/** The index with all pages. */
export function indexOf(levels: TestLevels): LevelIndex {
  const index = new LevelIndex(pagePayload(levels, 0));
  for (let page = 1; page < pageCountOf(levels); ++page) index.addPage(page, pagePayload(levels, page));
  return index;
}

/** Undefined if the open set is legal, else what is wrong. Empty sets are legal before the roots have come. */
export function illegalityOf({ groups, rootCount }: TestLevels, open: ReadonlySet<number>): string | undefined {
  if (open.size === 0) return undefined;
  for (let root = 0; root < rootCount; ++root) if (!open.has(root)) return `root ${root} is closed`;
  for (const [parent, { children }] of groups.entries())
    for (const child of children)
      if (open.has(child) && !open.has(parent)) return `group ${child} is open and its parent ${parent} is not`;
  return undefined;
}

/** Numbers in [0, 1). */
export function fraction(random: TestRandom): number {
  return random.below(2 ** 20) / 2 ** 20;
}
