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

/**
 * A camera at the origin that looks along -z, with a field of view of 90 degrees and 1000 pixels in both directions.
 */
const camera: Camera = {
  position: [0, 0, 0],
  pixelsPerUnit: 500,
  near: 1e-3,
  planes: planesOf([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, -1, 0, 0, -2e-3, 0]),
};

/** The matrix of a shape at a distance in front of the camera. */
const matrixAt = (distance: number, right = 0): Matrix => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, right, 0, -distance, 1];

function priorityAt(geometry: GeometryDescription, matrix: Matrix, content = 1): FilePriority {
  return filePriorityFor([geometryInstance(geometry, matrix, content)], { camera, weights: defaultChunkWeights });
}

/** The required files of the first patch, by role and plane, most important first. */
function requiredFiles(geometry: GeometryDescription, filePriority: FilePriority): string[] {
  const [patch] = geometry.patches;
  return (patch ? deliveryOf(geometry).patchFilesOf(geometry, patch, 4096) : [])
    .map((file) => ({ name: `${file.role}${file.plane || ""}`, priority: filePriority(0, file) }))
    .filter(({ priority }) => priority !== undefined)
    .sort((a, b) => (b.priority ?? 0) - (a.priority ?? 0))
    .map(({ name }) => name);
}

function firstFile(geometry: GeometryDescription): PatchFile {
  const [file] = geometry.patches.flatMap((described) => deliveryOf(geometry).patchFilesOf(geometry, described, 4096));
  assert.ok(file);
  return file;
}

const cube = 'position="0 0 0" size="1 1 1"';
const patch = (fields: string) =>
  `<GeometryPatch bboxSize="1 1 1" recordCount="9" vertexCount="9" coord='"a" "b" "c"' ${fields}/>`;
const lit = geometryOf(`<ImageGeometry ${cube}>${patch('index="i" normal="n"')}</ImageGeometry>`);

describe("a byte plane", () => {
  // At a distance of 2 a pixel covers 1/250 units. The first byte's step is 1/256 of the cube, about as much.
  test("is required when the planes above it leave visible steps", () => {
    assert.deepEqual(requiredFiles(lit, priorityAt(lit, matrixAt(2))), ["coord", "index", "normal", "coord1"]);
  });

  test("is not required while a step is less than half a pixel", () => {
    assert.deepEqual(requiredFiles(lit, priorityAt(lit, matrixAt(6))), ["coord", "index", "normal"]);
  });

  test("is required only when the step of the plane above it is visible", () => {
    assert.deepEqual(requiredFiles(lit, priorityAt(lit, matrixAt(0.51))), [
      "coord",
      "index",
      "normal",
      "coord1",
      "coord2",
    ]);
  });

  test("is required where the shape is scaled up", () => {
    const large = [4, 0, 0, 0, 0, 4, 0, 0, 0, 0, 4, 0, 0, 0, -10, 1];
    assert.ok(requiredFiles(lit, priorityAt(lit, large)).includes("coord1"));
  });

  test("is required next to the view, since the camera turns faster than files arrive", () => {
    assert.ok(requiredFiles(lit, priorityAt(lit, matrixAt(-2))).includes("coord1"));
  });

  test("is required where the slope between vertices shades the surface", () => {
    const bare = geometryOf(`<ImageGeometry ${cube}>${patch('index="i"')}</ImageGeometry>`);
    assert.deepEqual(requiredFiles(bare, priorityAt(bare, matrixAt(500))), ["coord", "index", "coord1", "coord2"]);
  });

  test("is not required for points without normals, which are not shaded", () => {
    const cloud = geometryOf(`<ImageGeometry ${cube}>${patch('primType="POINTS"')}</ImageGeometry>`);
    assert.deepEqual(requiredFiles(cloud, priorityAt(cloud, matrixAt(500))), ["coord"]);
  });

  test("is required as long as there is no camera", () => {
    const filePriority = filePriorityFor([geometryInstance(lit, matrixAt(500), 1)], {
      camera: undefined,
      weights: defaultChunkWeights,
    });
    assert.equal(requiredFiles(lit, filePriority).length, 5);
  });
});

describe("a shape", () => {
  test("has a larger priority when it is nearer, and when it is in the view", () => {
    const file = firstFile(lit);
    const at = (matrix: Matrix) => priorityAt(lit, matrix)(0, file) ?? 0;
    assert.ok(at(matrixAt(3)) > at(matrixAt(9)));
    assert.ok(at(matrixAt(9)) > at(matrixAt(9, 20)));
    assert.ok(at(matrixAt(9, 20)) > at(matrixAt(9, 40)));
    assert.ok(at(matrixAt(9)) > at(matrixAt(-3)));
  });

  test("has a priority in proportion to the factor of the author", () => {
    const file = firstFile(lit);
    assert.equal(priorityAt(lit, matrixAt(5), 4)(0, file), 4 * (priorityAt(lit, matrixAt(5))(0, file) ?? NaN));
  });
});

describe("a geometry with several instances", () => {
  const viewState = { camera, weights: defaultChunkWeights };

  test("has the largest priority of its instances", () => {
    const instances = [matrixAt(50), matrixAt(3), matrixAt(9)].map((matrix) => geometryInstance(lit, matrix, 1));
    const file = firstFile(lit);
    assert.equal(filePriorityFor(instances, viewState)(0, file), priorityAt(lit, matrixAt(3))(0, file));
    assert.ok(requiredFiles(lit, filePriorityFor(instances, viewState)).includes("coord1"));
  });

  test("is not required without visible instances", () => {
    assert.deepEqual(requiredFiles(lit, filePriorityFor([], viewState)), []);
  });
});

describe("a delivery", () => {
  const withoutSecondByte: FilePriority = (patch, file) => (file.plane > 0 ? undefined : everything(patch, file));

  test("requests nothing before the first call of `request`, and then the required files", async () => {
    const site = siteOf(sigFiles(1));
    const { delivery, settled, stages } = record(sigGeometry(1), site.pool, () => undefined);
    await shortDelay();
    assert.deepEqual(site.requested, []);
    assert.equal(delivery.isExhausted, false);
    delivery.request(withoutSecondByte);
    await settled;
    assert.deepEqual(site.requested.toSorted(), ["a0.png", "i0.png", "n0.png"]);
    assert.equal(stages.at(-1)?.stage.name, "shaded");
    assert.deepEqual([delivery.isSettled, delivery.isExhausted, delivery.followsView], [true, false, true]);
  });

  test("follows the view while that decides about a file, which it does not about texture coordinates without texture", async () => {
    const site = siteOf(sigFiles(1));
    const [own] = sigGeometry(1).patches;
    assert.ok(own);
    const textured = { ...sigGeometry(1), patches: [{ ...own, texCoord: { url: "t0.png", firstTexel: 0 } }] };
    const withoutTexture: FilePriority = (patch, file) =>
      file.role === "texCoord" ? undefined : everything(patch, file);
    const { delivery, settled } = record(textured, site.pool, withoutTexture);
    assert.equal(delivery.followsView, true);
    await settled;
    assert.deepEqual([delivery.isExhausted, delivery.followsView], [false, false]);
    delivery.request(everything);
    assert.equal(delivery.followsView, true, "while it is being loaded");
  });

  test("settles again after a later request for more files", async () => {
    const site = siteOf(sigFiles(1));
    const { delivery, settled, stages } = record(sigGeometry(1), site.pool, withoutSecondByte);
    await settled;
    delivery.request(everything);
    assert.equal(delivery.isSettled, false);
    await shortDelay();
    assert.equal(stages.at(-1)?.stage.name, "full");
    assert.deepEqual([delivery.isSettled, delivery.isExhausted], [true, true]);
  });

  test("aborts files that are no longer required, keeps arrived ones, and can request them again", async () => {
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

  test("never requests a file that is no longer required when its turn comes", async () => {
    const first = deferredFile(records);
    const site = siteOf({ ...sigFiles(1), "a0.png": first.promise }, 1);
    const { delivery } = record(sigGeometry(1), site.pool);
    await shortDelay();
    delivery.request((patch, file) => (file.role === "coord" ? everything(patch, file) : undefined));
    first.release();
    await shortDelay();
    assert.deepEqual(site.requested, ["a0.png", "b0.png"]);
  });

  test("sends waiting requests in the order of the latest priorities", async () => {
    const first = deferredFile(records);
    const site = siteOf({ ...sigFiles(3), "a0.png": first.promise }, 1);
    const { delivery } = record(sigGeometry(3), site.pool);
    await shortDelay();
    delivery.request((patch, file) => (everything(patch, file) ?? 0) * (patch === 2 ? 1000 : 1));
    first.release();
    await shortDelay();
    assert.deepEqual(
      site.requested,
      ["a0", "a2", "i2", "n2", "b2", "a1", "i0", "i1", "n0", "n1", "b0", "b1"].map((name) => `${name}.png`),
    );
  });

  test("shares a file with another delivery at the larger of both priorities", async () => {
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

  test("releases the memory limit of undecoded bytes whether decoding succeeds or fails", async () => {
    const large = new Uint8Array(9 * 2 ** 20); // larger than the whole limit, and no PNG
    const site = siteOf({ ...sigFiles(3), "a0.png": large, "a1.png": large, "i2.png": 404 });
    const { settled, errors, stages } = record(sigGeometry(3), site.pool);
    await settled;
    assert.deepEqual(errors.map(({ url }) => url).toSorted(), ["a0.png", "a1.png", "i2.png"]);
    assert.equal(stages.at(-1)?.stage.name, "points");
  });
});
