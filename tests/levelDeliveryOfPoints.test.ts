// Delivers a converted point cloud with levels of detail from a site in memory: the points of the cloud are drawn or are
// within the discs that are, whatever is open, within the GPU memory.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { compactPatches } from "../web/src/decode/compact/jobs.ts";
import type { Answer } from "../web/src/delivery/delivery.testing.ts";
import { everything, geometryOf, siteOf } from "../web/src/delivery/delivery.testing.ts";
import type { DeliveryError } from "../web/src/delivery/deliveryError.ts";
import { deliverLevels } from "../web/src/delivery/levels/levelDelivery.ts";
import type { GeometryDescription } from "../web/src/document/description.ts";
import { readLevelIndex } from "../web/src/levels/levelFiles.ts";
import type { LevelIndex } from "../web/src/levels/levelIndex.ts";
import { perspectiveView } from "../web/src/levels/levelViews.testing.ts";
import type { BufferStage, Stage } from "../web/src/stage/stage.ts";

type File = Uint8Array<ArrayBuffer>;
type Point = readonly [number, number, number];

const imgeo = join(import.meta.dirname, "../build/imgeo");
const directory = mkdtempSync(join(tmpdir(), "imgeo-point-level-delivery-"));
after(() => {
  rmSync(directory, { recursive: true });
});

let geometry: GeometryDescription;
let index: LevelIndex;
let files: Record<string, File>;
/** The points of level 0, in lattice steps. */
let points: Point[];

before(async () => {
  const [source, site] = [join(directory, "cloud.ply"), join(directory, "site")];
  execFileSync(imgeo, ["sample", "relief", "--points", "6000", "-o", source]);
  const options = ["--levels", "always", "--group-triangles", "400", "--position-bits", "14", "--no-pictures"];
  execFileSync(imgeo, ["convert", source, "-o", site, "--keep-attributes", "all", ...options]);
  const markup = /<ImageGeometry[^]*?<\/ImageGeometry>/.exec(readFileSync(join(site, "index.html"), "utf8"))?.[0] ?? "";
  const folder = /levels="([^"]*)levels\.png"/.exec(markup)?.[1] ?? assert.fail(markup);
  geometry = geometryOf(markup.replaceAll(folder, ""));
  const fileOf = (name: string) => Uint8Array.from(readFileSync(join(site, folder, name)));
  index = await readLevelIndex(fileOf("levels.png"));
  const names = ["levels.png", ...Array.from({ length: index.groupCount }, (_, group) => `0/${group}.png`)];
  files = Object.fromEntries(names.map((name) => [name, fileOf(name)]));
  points = [];
  for (let group = 0; group < index.groupCount; ++group) {
    if (index.level(group) > 0) continue;
    const [patch] = await compactPatches(files[`0/${group}.png`]!);
    const { array, stride } = patch!.coord;
    for (let n = 0; n < patch!.vertexCount; ++n)
      points.push([array[stride * n]!, array[stride * n + 1]!, array[stride * n + 2]!]);
  }
});

function deliver(answers: Record<string, Answer>) {
  const site = siteOf(answers);
  const displayed = new Map<number, BufferStage>();
  const errors: DeliveryError[] = [];
  const delivery = deliverLevels(geometry, geometry.levels ?? assert.fail(), site.pool, {
    onStage(group, stage: Stage | undefined) {
      if (stage?.kind === "buffers") displayed.set(group, stage);
      else displayed.delete(group);
    },
    onError: (error) => errors.push(error),
    onSettled: () => undefined,
  });
  const scene = {};
  /** Follows a view at this distance from the center, in sizes of the cloud. */
  const view = (distance: number, pixelsPerUnit: number, maxBytes: number): void => {
    const [x, y, z] = geometry.position;
    const eye = [x, y, z + distance * geometry.size[2]] as const;
    const { camera } = perspectiveView(eye, { near: 1e-3, far: 100, pixelsPerUnit });
    const instances = [{ sceneFromShape: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] }];
    delivery.followView?.({ views: [{ camera, isOrthographic: false }], instances }, maxBytes, scene);
    delivery.request(everything);
  };
  const storedBytes = (): number => Array.from(site.arrays.values()).reduce((sum, array) => sum + array.byteLength, 0);
  return { site, delivery, displayed, errors, view, storedBytes };
}

type Delivered = ReturnType<typeof deliver>;

async function settled({ delivery }: Delivered): Promise<void> {
  for (const deadline = Date.now() + 60_000; Date.now() < deadline;) {
    await new Promise((resolve) => setImmediate(resolve));
    if (delivery.isSettled) return;
  }
  assert.fail("did not settle");
}

interface Disc {
  readonly center: Point;
  readonly radius: number;
}

/** What the stages draw, in lattice steps. */
function discsOf({ site, displayed }: Delivered): Disc[] {
  const discs: Disc[] = [];
  for (const { coord, index: indices, draws } of displayed.values()) {
    assert.equal(indices, undefined);
    const array = site.arrayOf(coord);
    for (const { primitive, first, count, spacing } of draws) {
      assert.equal(primitive, "points");
      for (let n = first; n < first + count; ++n) {
        const at = coord.offset + coord.stride * n;
        discs.push({ center: [array[at]!, array[at + 1]!, array[at + 2]!], radius: (spacing ?? 0) / 2 });
      }
    }
  }
  return discs;
}

/** The number of points outside of all discs. */
function uncovered(discs: readonly Disc[]): number {
  const isWithin = (point: Point) => (disc: Disc) =>
    Math.hypot(...point.map((value, axis) => value - disc.center[axis]!)) <= disc.radius + 1e-6;
  return points.filter((point) => !discs.some(isWithin(point))).length;
}

test("a near view gets every point once, with sizes that close the gaps", async () => {
  const delivered = deliver(files);
  delivered.view(0.8, 1e5, 2 ** 28);
  await settled(delivered);
  assert.deepEqual(delivered.errors, []);
  const discs = discsOf(delivered);
  const keyOf = (point: Point) => point.join(" ");
  assert.deepEqual(discs.map(({ center }) => keyOf(center)).sort(), points.map(keyOf).sort());
  assert.ok(discs.every(({ radius }) => radius > 0));
  delivered.delivery.cancel();
  assert.equal(delivered.site.arrays.size, 0);
});

test("the discs of coarse groups cover the points that they stand for, within any memory", async () => {
  let before = 0;
  for (const maxBytes of [10_000, 30_000, 60_000]) {
    const delivered = deliver(files);
    delivered.view(0.8, 1000, maxBytes);
    await settled(delivered);
    assert.deepEqual(delivered.errors, []);
    assert.ok(delivered.storedBytes() <= maxBytes, `${delivered.storedBytes()} of ${maxBytes} bytes`);
    const discs = discsOf(delivered);
    assert.ok(discs.length > before && discs.length < points.length, `${discs.length} points`);
    before = discs.length;
    assert.equal(uncovered(discs), 0);
    assert.equal(new Set(delivered.site.requested).size, delivered.site.requested.length);
    delivered.delivery.cancel();
  }
});

test("a far view gets the root alone, and a damaged group is one error that leaves coarse points in its place", async () => {
  const far = deliver(files);
  far.view(400, 10, 2 ** 28);
  await settled(far);
  assert.deepEqual([...far.displayed.keys()], [0]);
  assert.equal(discsOf(far).length, index.vertices(0));

  const other = Array.from(index.children(0))[0]!;
  const broken = deliver({ ...files, [`0/${other}.png`]: files["0/0.png"]! });
  broken.view(0.8, 1e5, 2 ** 28);
  await settled(broken);
  assert.equal(broken.errors.length, 1);
  assert.match(broken.errors[0]!.message, /other than the index of levels states|segments/);
  assert.equal(uncovered(discsOf(broken)), 0);
});
