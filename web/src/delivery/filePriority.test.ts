import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { GeometryDescription } from "../document/description.ts";
import { defaultChunkWeights } from "../scheduler/priority.ts";
import type { Camera, Matrix } from "../scheduler/viewMetrics.ts";
import { planesOf } from "../scheduler/viewMetrics.ts";
import type { FilePriority } from "./geometryDelivery.ts";
import { filePriorityFor, geometryInstance } from "./filePriority.ts";
import {
  everything,
  geometryOf,
  deferredFile,
  record,
  records,
  sigFiles,
  sigGeometry,
  siteOf,
  shortDelay,
} from "./delivery.testing.ts";
import type { PatchFile } from "./patchFiles.ts";
import { deliveryOf } from "./encodings/encodings.ts";

/** At the origin, looking along -z with 90 degrees and 1000 pixels both ways. */
const camera: Camera = {
  position: [0, 0, 0],
  pixelsPerUnit: 500,
  near: 1e-3,
  planes: planesOf([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, -1, 0, 0, -2e-3, 0]),
};

const away = (distance: number, right = 0): Matrix => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, right, 0, -distance, 1];

function demandAt(geometry: GeometryDescription, matrix: Matrix, content = 1): FilePriority {
  return filePriorityFor([geometryInstance(geometry, matrix, content)], { camera, weights: defaultChunkWeights });
}

/** The parts of the first patch that are wanted, most important first. */
function wanted(geometry: GeometryDescription, demand: FilePriority): string[] {
  const [patch] = geometry.patches;
  return (patch ? deliveryOf(geometry).patchFilesOf(geometry, patch, 4096) : [])
    .map((part) => ({ name: `${part.role}${part.plane || ""}`, priority: demand(0, part) }))
    .filter(({ priority }) => priority !== undefined)
    .sort((a, b) => (b.priority ?? 0) - (a.priority ?? 0))
    .map(({ name }) => name);
}

function firstPart(geometry: GeometryDescription): PatchFile {
  const [part] = geometry.patches.flatMap((each) => deliveryOf(geometry).patchFilesOf(geometry, each, 4096));
  assert.ok(part);
  return part;
}

const cube = 'position="0 0 0" size="1 1 1"';
const patch = (fields: string) =>
  `<GeometryPatch bboxSize="1 1 1" recordCount="9" vertexCount="9" coord='"a" "b" "c"' ${fields}/>`;
const lit = geometryOf(`<ImageGeometry ${cube}>${patch('index="i" normal="n"')}</ImageGeometry>`);

describe("a byte plane", () => {
  // One pixel at a distance of 2 is 1/250: the first byte's step is 1/256 of the cube, which is about a pixel.
  test("is fetched when the planes above it leave steps that can be seen", () => {
    assert.deepEqual(wanted(lit, demandAt(lit, away(2))), ["coord", "index", "normal", "coord1"]);
  });

  test("waits while a step is less than half a pixel", () => {
    assert.deepEqual(wanted(lit, demandAt(lit, away(6))), ["coord", "index", "normal"]);
  });

  test("waits for its own step, not for the one above", () => {
    assert.deepEqual(wanted(lit, demandAt(lit, away(0.51))), ["coord", "index", "normal", "coord1", "coord2"]);
  });

  test("is needed where a shape is drawn larger", () => {
    const large = [4, 0, 0, 0, 0, 4, 0, 0, 0, 0, 4, 0, 0, 0, -10, 1];
    assert.ok(wanted(lit, demandAt(lit, large)).includes("coord1"));
  });

  test("does not wait beside the view: the head turns faster than files come", () => {
    assert.ok(wanted(lit, demandAt(lit, away(-2))).includes("coord1"));
  });

  test("does not wait where the slope between vertices is what shades the surface", () => {
    const bare = geometryOf(`<ImageGeometry ${cube}>${patch('index="i"')}</ImageGeometry>`);
    assert.deepEqual(wanted(bare, demandAt(bare, away(500))), ["coord", "index", "coord1", "coord2"]);
  });

  test("of points without normals waits: nothing is shaded", () => {
    const cloud = geometryOf(`<ImageGeometry ${cube}>${patch('primType="POINTS"')}</ImageGeometry>`);
    assert.deepEqual(wanted(cloud, demandAt(cloud, away(500))), ["coord"]);
  });

  test("does not wait while there is no picture", () => {
    const demand = filePriorityFor([geometryInstance(lit, away(500), 1)], {
      camera: undefined,
      weights: defaultChunkWeights,
    });
    assert.equal(wanted(lit, demand).length, 5);
  });
});

describe("a shape", () => {
  test("comes sooner when it is nearer, and when it is in the view", () => {
    const part = firstPart(lit);
    const at = (matrix: Matrix) => demandAt(lit, matrix)(0, part) ?? 0;
    assert.ok(at(away(3)) > at(away(9)));
    assert.ok(at(away(9)) > at(away(9, 20)));
    assert.ok(at(away(9, 20)) > at(away(9, 40)));
    assert.ok(at(away(9)) > at(away(-3)));
  });

  test("comes sooner when its author says so", () => {
    const part = firstPart(lit);
    assert.equal(demandAt(lit, away(5), 4)(0, part), 4 * (demandAt(lit, away(5))(0, part) ?? NaN));
  });
});

describe("a geometry in several places", () => {
  const viewing = { camera, weights: defaultChunkWeights };

  test("is wanted as much as where it is wanted most", () => {
    const places = [away(50), away(3), away(9)].map((matrix) => geometryInstance(lit, matrix, 1));
    const part = firstPart(lit);
    assert.equal(filePriorityFor(places, viewing)(0, part), demandAt(lit, away(3))(0, part));
    assert.ok(wanted(lit, filePriorityFor(places, viewing)).includes("coord1"));
  });

  test("is not wanted where it is seen in none", () => {
    assert.deepEqual(wanted(lit, filePriorityFor([], viewing)), []);
  });
});

describe("a delivery", () => {
  const withoutSecondByte: FilePriority = (place, part) => (part.plane > 0 ? undefined : everything(place, part));

  test("asks for nothing before it is told to, and then for what is wanted", async () => {
    const site = siteOf(sigFiles(1));
    const { delivery, settled, stages } = record(sigGeometry(1), site.pool, () => undefined);
    await shortDelay();
    assert.deepEqual(site.requested, []);
    assert.equal(delivery.isExhausted, false);
    delivery.request(withoutSecondByte);
    await settled;
    assert.deepEqual(site.requested.toSorted(), ["a0.png", "i0.png", "n0.png"]);
    assert.equal(stages.at(-1)?.stage.name, "shaded");
    assert.deepEqual([delivery.isSettled, delivery.isExhausted], [true, false]);
  });

  test("settles again when a later demand has brought more", async () => {
    const site = siteOf(sigFiles(1));
    const { delivery, settled, stages } = record(sigGeometry(1), site.pool, withoutSecondByte);
    await settled;
    delivery.request(everything);
    assert.equal(delivery.isSettled, false);
    await shortDelay();
    assert.equal(stages.at(-1)?.stage.name, "full");
    assert.deepEqual([delivery.isSettled, delivery.isExhausted], [true, true]);
  });

  test("aborts what is no longer wanted, keeps what has come, and can want it again", async () => {
    const late = deferredFile(records);
    const site = siteOf({ ...sigFiles(1), "b0.png": late.promise });
    const { delivery, errors, stages } = record(sigGeometry(1), site.pool);
    await shortDelay();
    delivery.request(() => undefined);
    assert.deepEqual(
      site.aborted.filter((name) => name === "b0.png"),
      ["b0.png"],
    );
    assert.equal(delivery.isSettled, true);
    assert.equal(site.images.open, 3);
    late.release();
    await shortDelay();
    assert.equal(stages.at(-1)?.stage.name, "shaded");
    delivery.request(everything);
    await shortDelay();
    assert.equal(stages.at(-1)?.stage.name, "full");
    assert.deepEqual(errors, []);
    assert.equal(site.requested.filter((name) => name === "b0.png").length, 2);
    assert.equal(site.scheduler.runningCount, 0);
  });

  test("that is no longer wanted while it waits never asks", async () => {
    const first = deferredFile(records);
    const site = siteOf({ ...sigFiles(1), "a0.png": first.promise }, 1);
    const { delivery } = record(sigGeometry(1), site.pool);
    await shortDelay();
    delivery.request((place, part) => (part.role === "coord" ? everything(place, part) : undefined));
    first.release();
    await shortDelay();
    assert.deepEqual(site.requested, ["a0.png", "b0.png"]);
  });

  test("sends what waits in its newest order", async () => {
    const first = deferredFile(records);
    const site = siteOf({ ...sigFiles(3), "a0.png": first.promise }, 1);
    const { delivery } = record(sigGeometry(3), site.pool);
    await shortDelay();
    delivery.request((place, part) => (everything(place, part) ?? 0) * (place === 2 ? 1000 : 1));
    first.release();
    await shortDelay();
    assert.deepEqual(
      site.requested,
      ["a0", "a2", "i2", "n2", "b2", "a1", "i0", "i1", "n0", "n1", "b0", "b1"].map((name) => `${name}.png`),
    );
  });

  test("shares a file with another at the larger of both priorities", async () => {
    const first = deferredFile(records);
    const site = siteOf({ ...sigFiles(2), "a0.png": first.promise }, 1);
    const files = (names: string) =>
      geometryOf(`<ImageGeometry recordCount="500" vertexCount="500" implicitMeshSize="256 2" coord='${names}'/>`);
    record(files('"a0.png"'), site.pool, () => 99);
    await shortDelay();
    record(files('"b1.png"'), site.pool, () => 5);
    const low = record(files('"a1.png"'), site.pool, () => 1);
    const high = record(files('"a1.png"'), site.pool, () => 9);
    record(files('"b0.png"'), site.pool, () => 7);
    low.delivery.request(() => 2);
    first.release();
    await high.settled;
    await shortDelay();
    assert.deepEqual(site.requested, ["a0.png", "a1.png", "b0.png", "b1.png"]);
  });

  test("gives back the room of what waits for its decoder, whatever becomes of it", async () => {
    const large = new Uint8Array(9 * 2 ** 20); // more than all the room, and no image
    const site = siteOf({ ...sigFiles(3), "a0.png": large, "a1.png": large, "i2.png": 404 });
    const { settled, errors, stages } = record(sigGeometry(3), site.pool);
    await settled;
    assert.deepEqual(errors.map(({ url }) => url).toSorted(), ["a0.png", "a1.png", "i2.png"]);
    assert.equal(stages.at(-1)?.stage.name, "points");
  });
});
