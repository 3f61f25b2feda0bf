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

function shownFrom(geometry: GeometryDescription, site: Site) {
  const deliveries = { geometries: new GeometryDeliveries(site.pool), textures: new TextureDeliveries(site.pool) };
  const stages: (string | undefined)[] = [];
  const joined = deliveries.geometries.join(geometry, {
    onStage: (patch, stage) => {
      stages[patch] = stage?.name;
    },
    onError: ({ message }) => assert.fail(message),
    onSettled: () => undefined,
  });
  const rest = async () => {
    do await shortDelay();
    while (!joined.isSettled);
  };
  /** Steers a few times, as a view that stands still does. */
  const demand = async (priority: FilePriority, mostBytes: number) => {
    for (let turn = 0; turn < 4; ++turn) {
      requestWithinBudget(
        deliveries,
        () => priority,
        () => undefined,
        mostBytes,
      );
      await rest();
    }
    return stages.map((stage) => stage ?? "none").join(" ");
  };
  return { demand, joined };
}

/** A camera to which patch 0 is near, patch 1 far, and patch 2 lies behind. */
function seenFrom(order: readonly number[]): FilePriority {
  const near = { pixels: 1000, isInView: true, pixelsPerUnit: 1 };
  const views = [near, { ...near, pixels: 10 }, { ...near, isInView: false }];
  return (place, part) => priorityOf(1, part.chunk, views[order[place] ?? 0] ?? near);
}

describe("images within a budget", () => {
  // Of each patch: 3 images of 256 x 2 texels and an index of 256 x 4.
  const [image, index] = [256 * 2 * 4, 256 * 4 * 4];
  const patch = 3 * image + index;

  test("all come where there is room", async () => {
    const site = siteOf(sigFiles(3));
    assert.equal(await shownFrom(sigGeometry(3), site).demand(seenFrom([0, 1, 2]), 3 * patch), "full full full");
    assert.deepEqual([site.images.open, site.requested.length], [12, 12]);
  });

  test("give up the finest of what is behind and far first, then all of what is behind", async () => {
    const site = siteOf(sigFiles(3));
    const { demand } = shownFrom(sigGeometry(3), site);
    const view = seenFrom([0, 1, 2]);
    await demand(view, Infinity);
    assert.equal(await demand(view, 3 * patch - 1), "full full shaded");
    assert.equal(site.images.open, 11);
    assert.equal(await demand(view, 2 * patch), "full full none");
    assert.equal(await demand(view, 2 * patch - 1), "full shaded none");
    assert.equal(await demand(view, patch + image), "full points none");
    assert.equal(await demand(view, patch), "shaded points none");
    assert.equal(await demand(view, 0), "none none none");
    assert.equal(site.images.open, 0);
    assert.equal(site.requested.length, 12); // no file is requested again while the budget shrinks
  });

  test("are fetched again when the camera comes to them, and the others go", async () => {
    const site = siteOf(sigFiles(3));
    const { demand } = shownFrom(sigGeometry(3), site);
    assert.equal(await demand(seenFrom([0, 1, 2]), 2 * patch), "full full none");
    assert.equal(await demand(seenFrom([2, 1, 0]), 2 * patch), "none full full");
    const requestedCount = site.requested.length;
    assert.equal(await demand(seenFrom([2, 1, 0]), 2 * patch), "none full full");
    assert.equal(site.requested.length, requestedCount); // no file is dropped and requested again in turns
    assert.equal(await demand(seenFrom([0, 1, 2]), Infinity), "full full full");
  });

  test("take their room by what they are, not by what was expected", async () => {
    const large = pngWithTexels(256, 256, 3, () => 0);
    const site = siteOf({ ...sigFiles(2), "n1.png": large });
    const { demand } = shownFrom(sigGeometry(2), site);
    const [normalIsDenied, rest] = [2 * patch + 1000, 2 * patch];
    assert.equal(await demand(everything, normalIsDenied), "full surface");
    assert.equal(await demand(everything, rest), "full surface");
    // It was fetched once, to find out.
    assert.equal(site.requested.filter((name) => name === "n1.png").length, 1);
    assert.equal(await demand(everything, 2 * patch + 256 * 256 * 4), "full full");
  });

  test("that several patches share take it once", async () => {
    const site = siteOf(sigFiles(1));
    const shared = geometryOf(
      `<ImageGeometry>${Array.from(
        { length: 3 },
        () => `<GeometryPatch recordCount="500" vertexCount="600"
      implicitMeshSize="256 4" index="i0.png" coord='"a0.png" "b0.png"' normal="n0.png"/>`,
      ).join("")}</ImageGeometry>`,
    );
    assert.equal(await shownFrom(shared, site).demand(everything, patch), "full full full");
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

  test("go and come patch by patch", async () => {
    const site = siteOf(files);
    const { demand, joined } = shownFrom(geometry, site);
    const near =
      (nearest: number): FilePriority =>
      (place, part) =>
        priorityOf(1, part.chunk, { pixels: place === nearest ? 1000 : 10, isInView: true, pixelsPerUnit: 1 });
    assert.equal(await demand(near(0), 3600), "full full");
    assert.equal(site.arrays.size, 6);
    assert.equal(await demand(near(0), 3599), "full none");
    assert.equal(site.arrays.size, 3);
    assert.equal(await demand(near(1), 3599), "none full");
    assert.equal(
      Array.from(site.arrays.keys()).reduce((sum, { byteLength }) => sum + byteLength, 0),
      1800,
    );
    assert.equal(await demand(near(1), Infinity), "full full");
    joined.cancel();
    await shortDelay();
    assert.equal(site.arrays.size, 0);
  });
});
