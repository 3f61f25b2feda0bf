// Tests the reader of the index with the files of vectors/levels-1, which src/containers/levels reads as well: both
// return the same numbers, and refuse the same bytes with the same kind of error.
import assert from "node:assert/strict";
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, test } from "node:test";
import { payloadOf } from "../decode/compact/payload.ts";
import { TestRandom } from "../decode/compact/rangeEncoder.testing.ts";
import { DecodeError } from "../decode/decodeError.ts";
import { refused } from "../decode/decodeError.testing.ts";
import { addPageFile, groupUrl, levelPageUrl, readLevelIndex } from "./levelFiles.ts";
import { LevelIndex } from "./levelIndex.ts";
import type { TestLevels } from "./levels.testing.ts";
import { indexOf, pageCountOf, pagePayload, randomMesh } from "./levels.testing.ts";

const directory = join(import.meta.dirname, "../../../vectors/levels-1");
const names = readdirSync(directory)
  .filter((name) => existsSync(join(directory, name.replace(/\.png$/, ".json"))) && name.endsWith(".png"))
  .map((name) => name.replace(/\.png$/, ""));
const fileOf = (name: string) => Uint8Array.from(readFileSync(join(directory, name)));
const jsonOf = (name: string) => JSON.parse(readFileSync(join(directory, name), "utf8")) as unknown;

function levelsOf(index: LevelIndex): TestLevels {
  const { positionBits, pageGroups, rootCount, hasPoints, groupCount } = index;
  const groups = Array.from({ length: groupCount }, (_, group): TestLevels["groups"][number] => ({
    level: index.level(group),
    center: [index.centerCode(group, 0), index.centerCode(group, 1), index.centerCode(group, 2)],
    radius: index.radiusCode(group),
    error: index.errorCode(group),
    vertices: index.vertices(group),
    triangles: index.triangles(group),
    bytes: index.bytes(group),
    children: [...index.children(group)],
    ...(index.hasChips && { chips: chipsOf(index, group) }),
  }));
  return { positionBits, pageGroups, rootCount, hasPoints, groups };
}

function chipsOf(index: LevelIndex, group: number): [number, number, number] {
  const [columns, rows] = index.chipSize(group);
  return [columns, rows, index.chipBytes(group)];
}

/** FNV-1a over all numbers in the order of the JSON, four little-endian bytes each. */
function sumOf({ positionBits, pageGroups, rootCount, hasPoints, groups }: TestLevels): number {
  const numbers = [positionBits, pageGroups, rootCount, Number(hasPoints)];
  for (const { level, center, radius, error, vertices, triangles, bytes, children, chips = [] } of groups)
    numbers.push(level, ...center, radius, error, vertices, triangles, bytes, ...children, ...chips);
  let hash = 2166136261;
  for (const number of numbers)
    for (let shift = 0; shift < 32; shift += 8) hash = Math.imul(hash ^ ((number >>> shift) & 255), 16777619);
  return hash >>> 0;
}

/** The kind of refusal or the sum of all numbers. An absent page is `truncated`. */
function verdictOn(payloads: readonly Uint8Array[]): number | string {
  try {
    const index = new LevelIndex(payloads[0]!);
    for (let page = 1; page < index.pageCount; ++page) {
      const payload = payloads[page];
      if (payload === undefined) return "truncated";
      index.addPage(page, payload);
    }
    return sumOf(levelsOf(index));
  } catch (error) {
    if (error instanceof DecodeError) return error.kind;
    throw error;
  }
}

async function payloadsOf(name: string): Promise<Uint8Array[]> {
  const payloads: Uint8Array[] = [];
  for (let page = 0; existsSync(join(directory, levelPageUrl(`${name}.png`, page))); ++page)
    payloads.push(await payloadOf(fileOf(levelPageUrl(`${name}.png`, page))));
  return payloads;
}

interface Edit {
  readonly name: string;
  readonly page: number;
  readonly edits: readonly [number, number][];
  readonly length?: number;
  readonly verdict: number | string;
}

describe("the vectors of levels", () => {
  for (const name of names)
    test(`${name} is read to its numbers`, async () => {
      const index = await readLevelIndex(fileOf(`${name}.png`));
      for (let page = 1; page < index.pageCount; ++page)
        await addPageFile(index, page, fileOf(levelPageUrl(`${name}.png`, page)));
      assert.deepEqual(levelsOf(index), jsonOf(`${name}.json`));
    });

  test("damaged payloads have the verdicts of the C++ reader", async () => {
    const edits = jsonOf("edits.json") as readonly Edit[];
    const samples = new Map<string, Uint8Array[]>();
    for (const name of names) samples.set(name, await payloadsOf(name));
    for (const entry of edits) {
      const payloads = [...samples.get(entry.name)!];
      const edited = payloads[entry.page]!.slice();
      for (const [byte, value] of entry.edits) edited[byte] = value;
      payloads[entry.page] = edited.subarray(0, entry.length);
      assert.equal(verdictOn(payloads), entry.verdict, JSON.stringify(entry));
    }
    assert.ok(edits.length > 1000);
  });

  test("wrong payloads are refused as by the C++ reader", () => {
    const entries = jsonOf("refused.json") as readonly { name: string; pages: readonly string[]; verdict: string }[];
    for (const { name, pages, verdict } of entries)
      assert.equal(verdictOn(pages.map((page) => Buffer.from(page, "hex"))), verdict, name);
    assert.ok(entries.length > 30);
  });
});

/** By group. */
function parentsOf({ groups }: TestLevels): number[][] {
  const parents: number[][] = groups.map(() => []);
  for (const [parent, { children }] of groups.entries()) for (const child of children) parents[child]!.push(parent);
  return parents;
}

test("pages in any order give the same index", () => {
  const { levels } = randomMesh(3, 1500, 10, 12);
  const random = new TestRandom(4);
  const expected = levelsOf(indexOf(levels));
  assert.ok(pageCountOf(levels) > 10);
  const parents = parentsOf(levels);
  for (let run = 0; run < 6; ++run) {
    const order = Array.from({ length: pageCountOf(levels) - 1 }, (_, i) => i + 1);
    for (let i = order.length - 1; i > 0; --i) {
      const other = random.below(i + 1);
      [order[i], order[other]] = [order[other]!, order[i]!];
    }
    const index = new LevelIndex(pagePayload(levels, 0));
    for (const page of order) {
      assert.equal(index.hasPage(page), false);
      index.addPage(page, pagePayload(levels, page));
      index.addPage(page, new Uint8Array()); // is here already
      // A group without missing pages has all its parents.
      for (let group = 0; group < levels.groups.length; ++group) {
        if (index.missingPages(group).length > 0) continue;
        assert.deepEqual(index.parents(group), parents[group]);
      }
    }
    assert.deepEqual(levelsOf(index), expected);
    assert.equal(Array.from({ length: index.groupCount }, (_, group) => index.missingPages(group)).flat().length, 0);
  }
});

test("a group needs its page and the pages that may hold its parents, but no others", () => {
  const { levels } = randomMesh(5, 6000, 10, 20);
  const index = new LevelIndex(pagePayload(levels, 0));
  const last = pageCountOf(levels) - 1;
  const group = levels.groups.length - 1;
  assert.deepEqual(index.missingPages(group), [last]);
  index.addPage(last, pagePayload(levels, last));
  // Pages after one that ends on level 0 have no parents.
  const ground = Array.from({ length: last }, (_, page) => page).filter(
    (page) => levels.groups[20 * page + 19]!.level === 0,
  );
  assert.ok(ground.length > 3);
  assert.deepEqual(
    index.missingPages(group),
    Array.from({ length: last - 1 }, (_, i) => last - 1 - i),
  );
  index.addPage(ground[0]!, pagePayload(levels, ground[0]!));
  assert.deepEqual(
    index.missingPages(group),
    Array.from({ length: ground[0]! - 1 }, (_, i) => ground[0]! - 1 - i),
  );
  for (let page = 1; page < ground[0]!; ++page) {
    index.addPage(page, pagePayload(levels, page));
  }
  assert.deepEqual(index.missingPages(group), []);
  assert.deepEqual(index.parents(group), parentsOf(levels)[group]);
});

test("a refused page leaves the index as it was", () => {
  const { levels } = randomMesh(6, 600, 10, 16);
  const index = new LevelIndex(pagePayload(levels, 0));
  const random = new TestRandom(7);
  let refusals = 0;
  for (let page = 1; page < pageCountOf(levels); ++page) {
    const payload = pagePayload(levels, page);
    for (let n = 0; n < 60; ++n) {
      const damaged = payload.slice();
      damaged[random.below(payload.length)] = random.below(256);
      const copy = indexUpTo(levels, page);
      try {
        copy.addPage(page, damaged);
      } catch (error) {
        assert.ok(error instanceof DecodeError, String(error));
        assert.throws(() => {
          index.addPage(page, damaged);
        }, DecodeError);
        ++refusals;
      }
    }
    index.addPage(page, payload);
  }
  assert.ok(refusals > 100, `${refusals}`);
  assert.deepEqual(levelsOf(index), levelsOf(indexOf(levels)));
  for (const [group, parents] of parentsOf(levels).entries()) assert.deepEqual(index.parents(group), parents);
});

function indexUpTo(levels: TestLevels, end: number): LevelIndex {
  const index = new LevelIndex(pagePayload(levels, 0));
  for (let page = 1; page < end; ++page) index.addPage(page, pagePayload(levels, page));
  return index;
}

test("a page that comes after later ones is compared with them", () => {
  const { levels } = randomMesh(8, 3000, 10, 40);
  const last = pageCountOf(levels) - 1;
  const index = new LevelIndex(pagePayload(levels, 0));
  for (let page = 2; page <= last; ++page) index.addPage(page, pagePayload(levels, page));
  const wrong = (change: (groups: TestLevels["groups"]) => void) => {
    const copy = structuredClone(levels);
    change(copy.groups);
    assert.throws(() => {
      index.addPage(1, pagePayload(copy, 1));
    }, refused("malformed"));
  };
  const parent = levels.groups.findIndex(({ children }, group) => group >= 40 && group < 80 && children.length > 1);
  assert.ok(parent >= 40);
  wrong((groups) => (groups[parent]!.error = 0));
  wrong((groups) => (groups[parent]!.radius = 0));
  wrong((groups) => groups[parent]!.children.push(levels.groups.length - 1));
  wrong((groups) => {
    for (const group of groups.slice(40, 80)) group.children = group.children.slice(0, 1);
  });
  index.addPage(1, pagePayload(levels, 1));
  assert.deepEqual(levelsOf(index), levelsOf(indexOf(levels)));
});

test("a further page of another size than stated is refused", async () => {
  const index = await readLevelIndex(fileOf("five-levels.png"));
  const file = fileOf("five-levels-1.png");
  await assert.rejects(addPageFile(index, 1, Uint8Array.from([...file, 0])), refused("malformed"));
  await addPageFile(index, 1, file);
  assert.equal(index.hasPage(1), true);
});

test("groups and pages have their urls", () => {
  assert.equal(groupUrl("geometry/9f/levels.png", 41234), "geometry/9f/41/234.png");
  assert.equal(groupUrl("levels.png", 0), "0/0.png");
  assert.equal(groupUrl("a/levels.png?v=2/3", 7), "a/0/7.png?v=2/3");
  assert.equal(levelPageUrl("a/levels.png", 0), "a/levels.png");
  assert.equal(levelPageUrl("a/levels.png?v=2", 3), "a/levels-3.png?v=2");
  assert.equal(levelPageUrl("a.b/levels", 1), "a.b/levels-1");
});

test("lengths are in lattice steps", () => {
  const { levels } = randomMesh(9, 100, 10);
  const index = indexOf({ ...levels, positionBits: 20 });
  const group = index.groupCount - 1;
  const stored = levels.groups[group]!;
  const bounds = { x: 0, y: 0, z: 0, radius: 0, reach: 0, error: 0 };
  index.readBounds(group, bounds);
  const [x, y, z] = stored.center.map((value) => 16 * value);
  const radius = 64 * stored.radius;
  assert.deepEqual(bounds, { x, y, z, radius, reach: radius, error: 2 ** (stored.error / 8) });
  index.readBounds(0, bounds);
  assert.equal(bounds.error, Infinity);
});
