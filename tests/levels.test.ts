// Walks through cuts of a converted site with the runtime's index, cuts, transitions and decoder: what is drawn is closed
// after every step, within the budget after every frame, and in the end the mesh itself.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readdirSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { decodePatches } from "../web/src/decode/compact/patch.ts";
import { payloadOf } from "../web/src/decode/compact/payload.ts";
import { chooseCut, groupMemory } from "../web/src/levels/cut.ts";
import { drawRanges } from "../web/src/levels/drawRanges.ts";
import { addPageFile, groupUrl, levelPageUrl, readLevelIndex } from "../web/src/levels/levelFiles.ts";
import type { LevelIndex } from "../web/src/levels/levelIndex.ts";
import type { LevelView } from "../web/src/levels/projectedError.ts";
import { errorInPixels } from "../web/src/levels/projectedError.ts";
import { ResidentGroups, requestChanges } from "../web/src/levels/transition.ts";

const imgeo = join(import.meta.dirname, "../build/imgeo");
const positionBits = 14;
const bytesPerVertex = 12;
const directory = mkdtempSync(join(tmpdir(), "imgeo-levels-"));
after(() => {
  rmSync(directory, { recursive: true });
});

/** The triangles of a group's file, those of each segment together, and where the segments start. */
interface GroupTriangles {
  /** Three vertices each: numbers of lattice points. */
  readonly corners: readonly number[];
  readonly segmentStarts: readonly number[];
}

let index: LevelIndex;
const groups: GroupTriangles[] = [];
let triangleCount = 0;

before(async () => {
  const [source, site] = [join(directory, "relief.ply"), join(directory, "site")];
  execFileSync(imgeo, ["sample", "relief", "--triangles", "12000", "-o", source]);
  const options = ["--levels", "always", "--group-triangles", "512", "--position-bits", `${positionBits}`];
  execFileSync(imgeo, ["convert", source, "-o", site, ...options]);
  triangleCount = Number(/element face (\d+)/.exec(readFileSync(source, "latin1"))?.[1]);
  const folder = join(site, "geometry", readdirSync(join(site, "geometry"))[0]!);
  const indexUrl = join(folder, "levels.png");
  const fileOf = (url: string) => Uint8Array.from(readFileSync(url));
  index = await readLevelIndex(fileOf(indexUrl));
  for (let page = 1; page < index.pageCount; ++page)
    await addPageFile(index, page, fileOf(levelPageUrl(indexUrl, page)));
  const vertices = new Map<number, number>();
  for (let group = 0; group < index.groupCount; ++group) {
    const file = fileOf(groupUrl(indexUrl, group));
    assert.equal(file.length, index.bytes(group));
    groups.push(trianglesOf(await payloadOf(file), group, vertices));
  }
});

function trianglesOf(payload: Uint8Array, group: number, vertices: Map<number, number>): GroupTriangles {
  const [patch, ...others] = decodePatches(payload, (each) => each);
  assert.ok(patch !== undefined && others.length === 0);
  const { header, coordinates, connectivity, segments } = patch;
  assert.deepEqual(
    [header.positionBits, header.segmentCount, header.wedgeCount, header.elementCount],
    [positionBits, index.children(group).length, index.vertices(group), index.triangles(group)],
  );
  const idOf = (vertex: number): number => {
    const [x, y, z] = coordinates.subarray(3 * vertex, 3 * vertex + 3);
    const point = (x! * 2 ** positionBits + y!) * 2 ** positionBits + z!;
    const id = vertices.get(point) ?? vertices.size;
    vertices.set(point, id);
    return id;
  };
  const segmentOf = (triangle: number) => segments?.segment[triangle] ?? 0;
  const order = Array.from({ length: header.elementCount }, (_, i) => i).sort((a, b) => segmentOf(a) - segmentOf(b));
  const count = Math.max(1, header.segmentCount);
  const starts = Array.from({ length: count }, (_, i) => order.findIndex((triangle) => segmentOf(triangle) === i));
  return {
    corners: order.flatMap((triangle) => [0, 1, 2].map((i) => idOf(connectivity.vertex[3 * triangle + i]!))),
    segmentStarts: [...starts, order.length],
  };
}

/** The directed edges of what is drawn that no opposite edge cancels, and the number of triangles drawn. */
function drawnBorder(open: ReadonlySet<number>): { border: number; triangles: number } {
  const sums = new Map<number, number>();
  let triangles = 0;
  for (const group of open) {
    const { corners, segmentStarts } = groups[group]!;
    for (const { first, count } of drawRanges(index.children(group), segmentStarts, open)) {
      triangles += count;
      for (let corner = 3 * first; corner < 3 * (first + count); ++corner) {
        const [a, b] = [corners[corner]!, corners[corner % 3 === 2 ? corner - 2 : corner + 1]!];
        if (a === b) continue;
        const key = Math.min(a, b) * 2 ** 24 + Math.max(a, b);
        sums.set(key, (sums.get(key) ?? 0) + (a < b ? 1 : -1));
      }
    }
  }
  return { border: [...sums.values()].reduce((sum, each) => sum + Math.abs(each), 0), triangles };
}

/** A camera at a distance from the middle of one side of the mesh, in lattice steps. */
function viewFrom(distance: number): LevelView {
  const half = 2 ** (positionBits - 1);
  const camera = { position: [half, half, 2 * half + distance] as const, planes: [], pixelsPerUnit: 1000, near: 1 };
  const box = { min: [0, 0, 0], max: [2 * half, 2 * half, 2 * half] } as const;
  return { camera, isOrthographic: false, sceneFromLattice: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1], box };
}

test("every step of a flight towards a converted mesh and away draws a closed surface", () => {
  const resident = new ResidentGroups(index);
  const open = new Set<number>();
  const memory = (group: number) => groupMemory({ index, bytesPerVertex }, group);
  const all = groups.reduce((sum, _, group) => sum + memory(group), 0);
  let steps = 0;
  let opened = 0;
  let now = 0;
  for (const [distance, share] of [
    [2e6, 1],
    [2e5, 1],
    [3e4, 0.6],
    [100, 0.5],
    [1e5, 1],
    [100, 0.4],
    [2e6, 1],
  ] as const)
    for (let frame = 0; frame < 8; ++frame, now += 300) {
      const budget = share * all;
      const measure = errorInPixels(index, [viewFrom(distance)]);
      const mesh = { index, errorInPixels: measure, open: resident.open, absent: new Set<number>(), bytesPerVertex };
      const { target } = chooseCut([mesh], { tolerance: 1, budget }).meshes[0]!;
      const taken = resident.makeRoom(resident.bytes - budget, target);
      for (const group of requestChanges(index, target, resident, new Set(), 6).request) {
        taken.push(...resident.makeRoom(resident.bytes + memory(group) - budget, target));
        resident.add(group, memory(group));
      }
      taken.push(...resident.approach(target, now, 1000));
      assert.ok(resident.bytes <= budget);
      for (const { kind, group } of taken) {
        if (kind === "free") continue;
        if (kind === "open") open.add(group);
        else open.delete(group);
        ++steps;
        opened = Math.max(opened, open.size);
        if (open.size > 0) assert.equal(drawnBorder(open).border, 0, `${kind} ${group}`);
      }
      assert.deepEqual(open, new Set(resident.open));
    }
  assert.ok(steps > 40 && opened > 10, `${steps} steps, up to ${opened} groups open`);
});

test("with all groups open the mesh itself is drawn, and with the root alone its coarse form", () => {
  const whole = new Set(groups.keys());
  assert.deepEqual(drawnBorder(whole), { border: 0, triangles: triangleCount });
  const root = drawnBorder(new Set([0]));
  assert.equal(root.border, 0);
  assert.ok(root.triangles > 50 && root.triangles < triangleCount / 10, `${root.triangles}`);
});

test("a cut that is not legal has a border: the comparison notices cracks", () => {
  const child = Array.from({ length: index.groupCount }, (_, group) => group).find(
    (group) => index.parents(group).length > 1,
  );
  assert.ok(child !== undefined);
  assert.ok(drawnBorder(new Set([0, index.parents(child)[0]!, child])).border > 0);
});
