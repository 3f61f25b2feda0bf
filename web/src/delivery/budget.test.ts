import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { pngWithTexels } from "../decode/png.testing.ts";
import type { GeometryDescription } from "../document/description.ts";
import { priorityOf } from "../scheduler/priority.ts";
import type { FilePriority } from "./geometryDelivery.ts";
import { everything, geometryOf, sigFiles, sigGeometry, siteOf, shortDelay } from "./delivery.testing.ts";
import { requestWithinBudget } from "./requestWithinBudget.ts";
import { TextureDeliveries } from "./textureDeliveries.ts";
import { GeometryDeliveries } from "./geometryDeliveries.ts";

type Site = ReturnType<typeof siteOf>;

/** Delivers a geometry; `stagesWithin` requests files within a budget and returns the stage of each patch. */
function deliver(geometry: GeometryDescription, site: Site) {
  const deliveries = { geometries: new GeometryDeliveries(site.pool), textures: new TextureDeliveries(site.pool) };
  const stages: (string | undefined)[] = [];
  const joined = deliveries.geometries.join(geometry, {
    onStage: (patch, stage) => {
      stages[patch] = stage?.name;
    },
    onError: ({ message }) => assert.fail(message),
    onSettled: () => undefined,
  });
  const settle = async () => {
    do await shortDelay();
    while (!joined.isSettled);
  };
  /** Requests several times, as a view without movement does. */
  const stagesWithin = async (priority: FilePriority, maxBytes: number) => {
    for (let round = 0; round < 4; ++round) {
      requestWithinBudget(
        deliveries,
        () => priority,
        () => undefined,
        maxBytes,
      );
      await settle();
    }
    return stages.map((stage) => stage ?? "none").join(" ");
  };
  return { stagesWithin, joined };
}

/** The priorities for a camera: patch n is near if order[n] is 0, far if it is 1, and behind the camera if it is 2. */
function priorityFrom(order: readonly number[]): FilePriority {
  const near = { pixels: 1000, isInView: true, pixelsPerUnit: 1 };
  const views = [near, { ...near, pixels: 10 }, { ...near, isInView: false }];
  return (patch, file) => priorityOf(1, file.chunk, views[order[patch] ?? 0] ?? near);
}

describe("images within a budget", () => {
  // Each patch has 3 images of 256 x 2 texels and an index of 256 x 4.
  const [image, index] = [256 * 2 * 4, 256 * 4 * 4];
  const patch = 3 * image + index;

  test("are all requested while there is room", async () => {
    const site = siteOf(sigFiles(3));
    assert.equal(
      await deliver(sigGeometry(3), site).stagesWithin(priorityFrom([0, 1, 2]), 3 * patch),
      "full full full",
    );
    assert.deepEqual([site.images.open, site.requested.length], [12, 12]);
  });

  test("are evicted from the finest to the coarsest, patches behind the camera and far ones first", async () => {
    const site = siteOf(sigFiles(3));
    const { stagesWithin } = deliver(sigGeometry(3), site);
    const view = priorityFrom([0, 1, 2]);
    await stagesWithin(view, Infinity);
    assert.equal(await stagesWithin(view, 3 * patch - 1), "full full shaded");
    assert.equal(site.images.open, 11);
    assert.equal(await stagesWithin(view, 2 * patch), "full full none");
    assert.equal(await stagesWithin(view, 2 * patch - 1), "full shaded none");
    assert.equal(await stagesWithin(view, patch + image), "full points none");
    assert.equal(await stagesWithin(view, patch), "shaded points none");
    assert.equal(await stagesWithin(view, 0), "none none none");
    assert.equal(site.images.open, 0);
    assert.equal(site.requested.length, 12); // no file is requested again while the budget shrinks
  });

  test("are fetched again when the camera approaches, and those of other patches are evicted", async () => {
    const site = siteOf(sigFiles(3));
    const { stagesWithin } = deliver(sigGeometry(3), site);
    assert.equal(await stagesWithin(priorityFrom([0, 1, 2]), 2 * patch), "full full none");
    assert.equal(await stagesWithin(priorityFrom([2, 1, 0]), 2 * patch), "none full full");
    const requestedCount = site.requested.length;
    assert.equal(await stagesWithin(priorityFrom([2, 1, 0]), 2 * patch), "none full full");
    assert.equal(site.requested.length, requestedCount); // no file is dropped and requested again in turns
    assert.equal(await stagesWithin(priorityFrom([0, 1, 2]), Infinity), "full full full");
  });

  test("count with their actual size, once it is known", async () => {
    const large = pngWithTexels(256, 256, 3, () => 0);
    const site = siteOf({ ...sigFiles(2), "n1.png": large });
    const { stagesWithin } = deliver(sigGeometry(2), site);
    // Both are less than what all files take, as one normal image is larger than expected.
    const [largerBudget, smallerBudget] = [2 * patch + 1000, 2 * patch];
    assert.equal(await stagesWithin(everything, largerBudget), "full surface");
    assert.equal(await stagesWithin(everything, smallerBudget), "full surface");
    // It was fetched once, which revealed its size.
    assert.equal(site.requested.filter((name) => name === "n1.png").length, 1);
    assert.equal(await stagesWithin(everything, 2 * patch + 256 * 256 * 4), "full full");
  });

  test("that several patches share count once", async () => {
    const site = siteOf(sigFiles(1));
    const shared = geometryOf(
      `<ImageGeometry>${Array.from(
        { length: 3 },
        () => `<GeometryPatch recordCount="500" vertexCount="600"
      implicitMeshSize="256 4" index="i0.png" coord='"a0.png" "b0.png"' normal="n0.png"/>`,
      ).join("")}</ImageGeometry>`,
    );
    assert.equal(await deliver(shared, site).stagesWithin(everything, patch), "full full full");
  });
});

describe("arrays within a budget", () => {
  const bytes = (length: number) => new Uint8Array(length);
  const geometry = geometryOf(
    `<BinaryGeometry coordType="Uint16" normalType="Int8">${[0, 1]
      .map(
        (n) =>
          `<GeometryPatch recordCount="100" vertexCount="300" coord="c${n}.bin#0+8" normal="n${n}.bin#0+4" index="i${n}.bin"/>`,
      )
      .join("")}</BinaryGeometry>`,
  );
  const files = Object.fromEntries(
    [0, 1].flatMap((n) => [
      [`c${n}.bin`, bytes(800)],
      [`n${n}.bin`, bytes(400)],
      [`i${n}.bin`, bytes(600)],
    ]),
  );

  test("are evicted and fetched patch by patch", async () => {
    const site = siteOf(files);
    const { stagesWithin, joined } = deliver(geometry, site);
    const near =
      (nearest: number): FilePriority =>
      (patch, file) =>
        priorityOf(1, file.chunk, { pixels: patch === nearest ? 1000 : 10, isInView: true, pixelsPerUnit: 1 });
    assert.equal(await stagesWithin(near(0), 3600), "full full");
    assert.equal(site.arrays.size, 6);
    assert.equal(await stagesWithin(near(0), 3599), "full none");
    assert.equal(site.arrays.size, 3);
    assert.equal(await stagesWithin(near(1), 3599), "none full");
    assert.equal(
      Array.from(site.arrays.keys()).reduce((sum, { byteLength }) => sum + byteLength, 0),
      1800,
    );
    assert.equal(await stagesWithin(near(1), Infinity), "full full");
    joined.cancel();
    await shortDelay();
    assert.equal(site.arrays.size, 0);
  });
});
