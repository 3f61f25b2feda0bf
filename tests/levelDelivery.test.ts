// Delivers a converted mesh with levels of detail from a site in memory whose files come in any order, late, damaged or
// not at all: what is displayed is closed after every turn, within the GPU memory, and each failure is told once.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, mock, test } from "node:test";
import { deflateSync } from "node:zlib";
import { payloadOf } from "../web/src/decode/compact/payload.ts";
import { TestRandom } from "../web/src/decode/compact/rangeEncoder.testing.ts";
import { chunkOf, pngOf } from "../web/src/decode/png.testing.ts";
import type { Answer } from "../web/src/delivery/delivery.testing.ts";
import { deferredFile, everything, geometryOf, siteOf } from "../web/src/delivery/delivery.testing.ts";
import type { DeliveryError } from "../web/src/delivery/deliveryError.ts";
import { deliverLevels } from "../web/src/delivery/levels/levelDelivery.ts";
import type { GeometryDescription } from "../web/src/document/description.ts";
import { readLevelIndex } from "../web/src/levels/levelFiles.ts";
import type { LevelIndex } from "../web/src/levels/levelIndex.ts";
import { pageCountOf, pagePayload } from "../web/src/levels/levels.testing.ts";
import type { TestGroup, TestLevels } from "../web/src/levels/levels.testing.ts";
import { perspectiveView } from "../web/src/levels/levelViews.testing.ts";
import type { Point } from "../web/src/scheduler/viewMetrics.ts";
import type { BufferStage, Stage } from "../web/src/stage/stage.ts";

const imgeo = join(import.meta.dirname, "../build/imgeo");
const identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
const noLimit = 2 ** 28;
const directory = mkdtempSync(join(tmpdir(), "imgeo-level-delivery-"));
after(() => {
  rmSync(directory, { recursive: true });
});

type File = Uint8Array<ArrayBuffer>;
type Site = ReturnType<typeof siteOf>;

let geometry: GeometryDescription;
let index: LevelIndex;
/** Beside the index. */
let groupFiles: File[];
let triangleCount: number;

before(async () => {
  const [source, site] = [join(directory, "relief.ply"), join(directory, "site")];
  execFileSync(imgeo, ["sample", "relief", "--triangles", "12000", "-o", source]);
  const options = ["--levels", "always", "--group-triangles", "512", "--position-bits", "14", "--no-pictures"];
  execFileSync(imgeo, ["convert", source, "-o", site, ...options]);
  triangleCount = Number(/element face (\d+)/.exec(readFileSync(source, "latin1"))?.[1]);
  const markup = /<ImageGeometry[^]*?<\/ImageGeometry>/.exec(readFileSync(join(site, "index.html"), "utf8"))?.[0] ?? "";
  const folder = /levels="([^"]*)levels\.png"/.exec(markup)?.[1] ?? assert.fail(markup);
  geometry = geometryOf(markup.replaceAll(folder, ""));
  const fileOf = (name: string) => Uint8Array.from(readFileSync(join(site, folder, name)));
  index = await readLevelIndex(fileOf("levels.png"));
  groupFiles = Array.from({ length: index.groupCount }, (_, group) => fileOf(`0/${group}.png`));
});

/** A gray PNG of these bytes, as one row. */
function grayPng(payload: Uint8Array): File {
  const header = pngOf({ width: payload.length, height: 1, colorType: 0 }).subarray(0, 33);
  const row = Buffer.concat([Buffer.of(0), payload]);
  const chunks = [header, chunkOf("IDAT", deflateSync(row)), chunkOf("IEND", new Uint8Array())];
  return new Uint8Array(Buffer.concat(chunks));
}

/** The site's index as tests write it; `firstGroup` becomes the first root. */
function levelsFrom(firstGroup: number, pageGroups: number): TestLevels {
  const groups = Array.from({ length: index.groupCount - firstGroup }, (_, n): TestGroup => {
    const group = n + firstGroup;
    const center = [0, 1, 2].map((axis) => index.centerCode(group, axis)) as TestGroup["center"];
    return {
      ...{ level: index.level(group), center, radius: index.radiusCode(group) },
      error: index.level(group) === index.level(firstGroup) ? 255 : index.errorCode(group), // that of roots
      ...{ vertices: index.vertices(group), triangles: index.triangles(group), bytes: index.bytes(group) },
      children: Array.from(index.children(group), (child) => child - firstGroup),
    };
  });
  const rootCount = groups.filter(({ level }) => level === groups[0]!.level).length;
  const hasOwnSpheres = !index.hasNestedSpheres;
  return { positionBits: index.positionBits, pageGroups, rootCount, hasOwnSpheres, groups };
}

/** The files of an index, with the sizes of its pages. */
function indexFiles(levels: TestLevels): Record<string, File> {
  const pages = Array.from({ length: pageCountOf(levels) }, (_, page) => grayPng(pagePayload(levels, page)));
  const sizes = pages.slice(1).map(({ length }) => length);
  const first = grayPng(pagePayload(levels, 0, sizes));
  return Object.fromEntries(pages.map((file, n) => (n === 0 ? ["levels.png", first] : [`levels-${n}.png`, file])));
}

/** All files, from the group `firstGroup` on. */
function filesFrom(firstGroup = 0, pageGroups = 16): Record<string, File> {
  const groups = groupFiles.slice(firstGroup).map((file, n) => [`0/${n}.png`, file] as const);
  return { ...indexFiles(levelsFrom(firstGroup, pageGroups)), ...Object.fromEntries(groups) };
}

/** Edges of what the stages draw that no other triangle has in the other direction, and the number of triangles. */
function drawnSurface(
  site: Site,
  displayed: ReadonlyMap<number, BufferStage>,
): { openEdges: number; triangles: number } {
  const ids = new Map<number, number>();
  const edges = new Map<number, number>();
  let triangles = 0;
  for (const { coord, index: indices, draws } of displayed.values()) {
    const [points, corners] = [site.arrayOf(coord), site.arrayOf(indices)];
    const idAt = (at: number): number => {
      const first = coord.offset + coord.stride * corners[at]!;
      const point = (points[first]! * 65536 + points[first + 1]!) * 65536 + points[first + 2]!;
      const id = ids.get(point) ?? ids.size;
      ids.set(point, id);
      return id;
    };
    for (const { first, count } of draws)
      for (let at = first; at < first + count; at += 3) {
        triangles += 1;
        const ring = [idAt(at), idAt(at + 1), idAt(at + 2)] as const;
        for (const side of [0, 1, 2] as const) {
          const [from, to] = [ring[side], ring[((side + 1) % 3) as 0 | 1 | 2]];
          const key = Math.min(from, to) * 2 ** 24 + Math.max(from, to);
          const sum = (edges.get(key) ?? 0) + Math.sign(to - from);
          if (sum === 0) edges.delete(key);
          else edges.set(key, sum);
        }
      }
  }
  return { openEdges: edges.size, triangles };
}

/** Delivers the mesh. Each turn in which stages have changed is checked after it. */
function deliver(files: Record<string, Answer>, maxBytes = noLimit, order = everything) {
  const site = siteOf(files);
  const displayed = new Map<number, BufferStage>();
  const errors: DeliveryError[] = [];
  const faults: string[] = [];
  let settledCount = 0;
  let isCheckPending = false;
  const check = (): void => {
    isCheckPending = false;
    const { openEdges } = drawnSurface(site, displayed);
    if (openEdges > 0) faults.push(`${openEdges} open edges with the groups ${[...displayed.keys()].join(" ")}`);
  };
  const delivery = deliverLevels(geometry, geometry.levels ?? assert.fail(), site.pool, {
    onStage(group, stage: Stage | undefined) {
      if (stage === undefined) displayed.delete(group);
      else if (stage.kind === "buffers") displayed.set(group, stage);
      else faults.push(`a stage of the kind ${stage.kind}`);
      if (!isCheckPending) queueMicrotask(check);
      isCheckPending = true;
    },
    onError: (error) => errors.push(error),
    onSettled: () => void (settledCount += 1),
  });
  const scene = {};
  const storedBytes = (): number => Array.from(site.arrays.values()).reduce((sum, array) => sum + array.byteLength, 0);
  /** Follows a view at this distance from the center, in sizes of the mesh. */
  const view = (distance: number, pixelsPerUnit = 1000, bytes = maxBytes, focus?: Point): void => {
    const [x, y, z] = geometry.position;
    const eye = [x, y, z + distance * geometry.size[2]] as const;
    const { camera } = perspectiveView(eye, { near: 1e-3, far: 100, pixelsPerUnit });
    const instances = [{ sceneFromShape: identity }];
    delivery.followView?.({ views: [{ camera, isOrthographic: false }], instances, focus }, bytes, scene);
    delivery.request(order);
  };
  return { site, delivery, displayed, errors, faults, storedBytes, view, settledCount: () => settledCount };
}

type Delivered = ReturnType<typeof deliver>;

const turn = () => new Promise((resolve) => setImmediate(resolve));

/** Waits until the delivery says that nothing is missing; `everyTurn` is called after each turn before. */
async function settled({ delivery }: Delivered, everyTurn: () => void = () => undefined): Promise<void> {
  const deadline = Date.now() + 60_000; // other threads inflate files, at any speed
  while (Date.now() < deadline) {
    await turn();
    everyTurn();
    if (delivery.isSettled) return;
  }
  assert.fail("did not settle");
}

/** A file that is cut, or whose payload is cut or has other bits in a PNG that is whole. */
async function damagedCopy(file: File, random: TestRandom): Promise<File> {
  if (random.below(3) === 0) return file.slice(0, random.below(file.length));
  const payload = await payloadOf(file);
  const cut = random.below(4) === 0 ? payload.slice(0, 1 + random.below(payload.length)) : payload.slice();
  for (let n = random.below(3); n >= 0; --n) cut[random.below(cut.length)]! ^= 1 << random.below(8);
  return grayPng(cut);
}

test("levels are closed and within the GPU memory at every moment while files arrive in any order", async () => {
  for (const [seed, maxBytes] of [noLimit, 150_000, 60_000, 30_000].entries()) {
    const random = new TestRandom(seed);
    const late = Object.entries(filesFrom()).map(([name, file]) => [name, deferredFile(file)] as const);
    const waiting = new Set(late.map(([name]) => name));
    const delivered = deliver(Object.fromEntries(late.map(([name, { promise }]) => [name, promise])), maxBytes);
    const { site, faults, errors, storedBytes, view, displayed } = delivered;
    view(0.8);
    let largest = 0;
    await settled(delivered, () => {
      largest = Math.max(largest, storedBytes());
      const asked = late.filter(([name]) => waiting.has(name) && site.requested.includes(name));
      const chosen = asked[random.below(Math.max(1, asked.length))];
      if (!chosen) return;
      waiting.delete(chosen[0]);
      chosen[1].release();
    });
    assert.deepEqual([faults, errors], [[], []]);
    const { bytes, openGroups, errorInPixels } = delivered.delivery.levelStatistics?.() ?? assert.fail();
    assert.deepEqual([bytes, openGroups], [storedBytes(), displayed.size]);
    assert.equal(errorInPixels <= 1, maxBytes === noLimit, `${errorInPixels} pixels`);
    assert.ok(largest <= maxBytes, `${largest} of ${maxBytes} bytes`);
    assert.equal(new Set(site.requested).size, site.requested.length, "a file was requested twice");
    const { triangles } = drawnSurface(site, displayed);
    if (maxBytes === noLimit) assert.equal(triangles, triangleCount);
    else assert.ok(triangles > 100 && triangles < triangleCount, `${triangles} triangles`);
  }
});

test("levels of a mesh with several roots and pages of four groups are delivered whole", async () => {
  const roots = levelsFrom(1, 4).rootCount;
  assert.ok(roots > 1);
  const delivered = deliver(filesFrom(1, 4));
  delivered.view(0.8);
  await settled(delivered);
  assert.deepEqual(delivered.errors, []);
  assert.ok(delivered.faults.length < roots, "only before all roots are there");
  assert.deepEqual(drawnSurface(delivered.site, delivered.displayed), { openEdges: 0, triangles: triangleCount });
  assert.ok(delivered.site.requested.includes("levels-3.png"));
});

test("levels follow the view and the memory that they are given", async () => {
  const delivered = deliver(filesFrom());
  const { view, site, faults, errors, storedBytes, displayed, delivery } = delivered;
  view(40, 10);
  await settled(delivered);
  assert.deepEqual([...displayed.keys()], [0], "far away the root suffices");
  view(0.8);
  await settled(delivered);
  assert.equal(drawnSurface(site, displayed).triangles, triangleCount);
  const all = storedBytes();
  view(0.8, 1000, all / 3);
  assert.ok(storedBytes() <= all / 3, "memory that is taken away is freed at once");
  assert.ok(storedBytes() > all / 10);
  await settled(delivered);
  assert.deepEqual([faults, errors], [[], []]);
  assert.equal(delivery.storedBytes, storedBytes());
  delivery.cancel();
  assert.equal(site.arrays.size, 0);
});

test("levels are refined around a focus, whatever its size in the view, and by the view again without", async () => {
  const delivered = deliver(filesFrom());
  const { view, displayed, faults, errors } = delivered;
  const [x, y, z] = geometry.position;
  view(40, 10, noLimit, [x, y, z + geometry.size[2] / 2]);
  await settled(delivered);
  const lowest = [...displayed.keys()].filter((group) => index.level(group) === 0);
  const all = Array.from({ length: index.groupCount }, (_, group) => group).filter((group) => index.level(group) === 0);
  assert.ok(lowest.length > 0 && lowest.length < all.length / 2, `${lowest.length} of ${all.length}`);
  view(40, 10);
  await settled(delivered);
  for (let n = 0; n < 300 && displayed.size > 1; ++n) await new Promise((resolve) => setTimeout(resolve, 10));
  assert.deepEqual([...displayed.keys()], [0], "the others are closed after a second");
  assert.deepEqual([faults, errors], [[], []]);
  delivered.delivery.cancel();
});

/** Runs with a clock that only `later` moves on. */
async function withClock(use: (later: (milliseconds: number) => void) => Promise<void>): Promise<void> {
  let now = 1000;
  const clock = mock.method(performance, "now", () => now);
  try {
    await use((milliseconds) => void (now += milliseconds));
  } finally {
    clock.mock.restore();
  }
}

test("levels that a moving camera will need are requested, once, and not opened before", async () => {
  await withClock(async (later) => {
    const delivered = deliver(filesFrom());
    const { view, site, displayed, faults, errors, storedBytes, delivery } = delivered;
    const groupFilesOf = (at: Site) => at.requested.filter((name) => name.startsWith("0/"));
    const step = async (distance: number): Promise<void> => {
      view(distance);
      later(100);
      await settled(delivered);
    };
    await step(90);
    await step(90);
    assert.deepEqual(groupFilesOf(site), ["0/0.png"], "a camera at rest needs the root alone");
    const rootBytes = storedBytes();
    await step(80);
    assert.equal(groupFilesOf(site).length, 1, "one step is a jump");
    await step(70); // and at 20 in half a second
    for (const end = Date.now() + 60_000; storedBytes() === rootBytes && Date.now() < end;) await turn();
    assert.ok(storedBytes() > rootBytes);
    assert.deepEqual([...displayed.keys()], [0]);
    const other = deliver(filesFrom());
    other.view(20);
    await settled(other);
    const requested = groupFilesOf(site);
    const needed = groupFilesOf(other.site);
    assert.deepEqual(
      requested.filter((name) => !needed.includes(name)),
      [],
    );
    later(1000);
    await step(20);
    assert.deepEqual(groupFilesOf(site).sort(), needed.sort(), "what has been requested before is not requested again");
    assert.deepEqual([faults, errors], [[], []]);
    delivery.cancel();
    other.delivery.cancel();
  });
});

test("levels that a moving camera will need take a quarter of the memory at most", async () => {
  await withClock(async (later) => {
    const limit = 60_000;
    const delivered = deliver(filesFrom(), limit);
    const { view, site, displayed, delivery, storedBytes } = delivered;
    let rootBytes: number | undefined;
    for (const distance of [90, 80, 70]) {
      view(distance);
      later(100);
      await settled(delivered);
      rootBytes ??= storedBytes();
    }
    let largest = 0;
    for (let n = 0; n < 2000; ++n) {
      await turn();
      largest = Math.max(largest, storedBytes());
    }
    assert.deepEqual([...displayed.keys()], [0]);
    assert.ok(largest <= (rootBytes ?? 0) + limit / 4, `${largest} bytes`);
    assert.ok(site.requested.some((name) => name.startsWith("0/") && name !== "0/0.png"));
    delivery.cancel();
  });
});

test("levels withdraw what is requested when nothing is to be requested any more", async () => {
  const late = Object.fromEntries(
    groupFiles.map((_, n) => [`0/${n}.png`, new Promise<File>(() => undefined)] as const),
  );
  const delivered = deliver({ ...filesFrom(), ...late, "0/0.png": groupFiles[0]! });
  delivered.view(0.8);
  const requestedLate = () => delivered.site.requested.filter((name) => name in late && name !== "0/0.png");
  const deadline = Date.now() + 60_000;
  while (requestedLate().length < 2 && Date.now() < deadline) await turn();
  const waiting = requestedLate();
  assert.ok(waiting.length > 1);
  delivered.delivery.request(() => undefined);
  assert.deepEqual(delivered.site.aborted.filter((name) => waiting.includes(name)).sort(), waiting.sort());
  delivered.delivery.cancel();
  await turn();
  assert.deepEqual([delivered.site.arrays.size, delivered.errors], [0, []]);
});

test("a group whose file is missing leaves its coarser form: one error, and no open edge", async () => {
  for (let missing = 1; missing < groupFiles.length; missing += 5) {
    const delivered = deliver({ ...filesFrom(), [`0/${missing}.png`]: 404 });
    delivered.view(0.8);
    await settled(delivered);
    const { errors, faults, displayed, site } = delivered;
    assert.deepEqual([errors.map(({ url }) => url), faults], [[`0/${missing}.png`], []]);
    assert.ok(!displayed.has(missing) && drawnSurface(site, displayed).triangles > 100);
  }
});

test("a damaged group that is refused is one error, and its coarser form stays closed", async () => {
  const random = new TestRandom(7);
  let refused = 0;
  for (let n = 0; n < 30; ++n) {
    const group = random.below(groupFiles.length);
    const delivered = deliver({ ...filesFrom(), [`0/${group}.png`]: await damagedCopy(groupFiles[group]!, random) });
    delivered.view(0.8);
    await settled(delivered);
    assert.ok(delivered.errors.length <= 1);
    refused += delivered.errors.length;
    if (delivered.errors.length === 0) continue;
    assert.match(delivered.errors[0]!.message, /\S/);
    assert.deepEqual(delivered.faults, [], `group ${group}`);
    assert.ok(!delivered.displayed.has(group));
  }
  assert.ok(refused > 15, `${refused} of 30`);
});

test("a damaged index is refused, or leads to files that are missing or unlike it", async () => {
  const random = new TestRandom(11);
  const files = filesFrom(0, 8);
  const pages = Object.keys(files).filter((name) => name.startsWith("levels"));
  let told = 0;
  for (let n = 0; n < 30; ++n) {
    const page = pages[random.below(pages.length)]!;
    const delivered = deliver({ ...files, [page]: await damagedCopy(files[page]!, random) });
    delivered.view(0.8);
    await settled(delivered);
    told += Math.min(1, delivered.errors.length);
    assert.equal(new Set(delivered.errors.map(({ url }) => url)).size, delivered.errors.length, "told once each");
    delivered.delivery.cancel();
    assert.equal(delivered.site.arrays.size, 0);
  }
  assert.ok(told > 15, `${told} of 30`);
});
