import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { pngOf } from "../decode/png.testing.ts";
import type { TextureDescription, TextureRole } from "../document/description.ts";
import { priorityOf } from "../scheduler/priority.ts";
import { unknownViewMetrics } from "../scheduler/viewMetrics.ts";
import type { Answer } from "./delivery.testing.ts";
import { deferredFile, record, sigFiles, sigGeometry, siteOf, shortDelay } from "./delivery.testing.ts";
import { requestWithinBudget } from "./requestWithinBudget.ts";
import { GeometryDeliveries } from "./geometryDeliveries.ts";
import { RoleTextures } from "./roleTextures.ts";
import type { TexturePriority } from "./textureDeliveries.ts";
import { TextureDeliveries } from "./textureDeliveries.ts";

const [small, large] = [pngOf({ width: 8, height: 8 }), pngOf({ width: 256, height: 256 })];
const bytesOnGpu = (edge: number) => (edge * edge * 4 * 4) / 3;

function textureOf(url: string, preview = "", role: TextureDescription["role"] = "color"): TextureDescription {
  const sampling = {
    isData: false,
    wrapS: "repeat",
    wrapT: "repeat",
    isSmooth: true,
    hasMipmaps: true,
    anisotropy: 1,
  } as const;
  return { role, urls: [url], preview, sampling, transform: [1, 0, 0, 0, 1, 0, 0, 0, 1], mapping: "", texCoordSet: 0 };
}

const everyTexture: TexturePriority = (_, chunk) => priorityOf(1, { type: chunk, plane: 0 }, unknownViewMetrics);

/**
 * A shape with these textures. `eventsWithin` requests them within a budget and returns, by role, the widths of the
 * images that are then displayed, and errors.
 */
function shapeWith(textures: readonly TextureDescription[], files: Record<string, Answer>, slots = 6) {
  const site = siteOf(files, slots);
  const deliveries = { geometries: new GeometryDeliveries(site.pool), textures: new TextureDeliveries(site.pool) };
  const events: string[] = [];
  const shape = new RoleTextures<TextureRole>(deliveries.textures, {
    onTextureImage: (role, image) => events.push(`${role} ${image?.image.width ?? "none"}`),
    onError: ({ url }) => events.push(`no ${url}`),
    onSettled: () => undefined,
  });
  shape.follow(textures);
  const eventsWithin = async (maxBytes = Infinity, priority = everyTexture) => {
    for (let round = 0; round < 3; ++round) {
      await shortDelay(); // listeners are called in the next microtask
      requestWithinBudget(deliveries, () => () => undefined, priority, maxBytes);
      do await shortDelay();
      while (!shape.isSettled);
    }
    return events.splice(0);
  };
  return { site, shape, deliveries, eventsWithin };
}

describe("a texture", () => {
  test("displays its preview until the full image arrives", async () => {
    const { promise, release } = deferredFile(large);
    const { site, shape, eventsWithin } = shapeWith([textureOf("full.png", "small.png")], {
      "full.png": promise,
      "small.png": small,
    });
    const end = eventsWithin();
    while (site.textureImages.open === 0) await shortDelay();
    assert.deepEqual(site.requested, ["small.png", "full.png"]);
    release();
    assert.deepEqual(await end, ["color 8", "color 256"]);
    shape.cancel();
    await shortDelay();
    assert.equal(site.textureImages.open, 0);
  });

  test("keeps its preview if the full image fails; a preview that fails is no error", async () => {
    const missing = shapeWith([textureOf("full.png", "small.png")], { "small.png": small }, 1);
    assert.deepEqual(await missing.eventsWithin(), ["color 8", "no full.png"]);
    const plain = shapeWith([textureOf("full.png", "small.png")], { "full.png": large }, 1);
    assert.deepEqual(await plain.eventsWithin(), ["color 256"]);
  });

  test("is evicted before its preview when the budget shrinks, and fetched again when it grows", async () => {
    const { site, eventsWithin } = shapeWith([textureOf("full.png", "small.png")], {
      "full.png": large,
      "small.png": small,
    });
    assert.deepEqual(await eventsWithin(), ["color 8", "color 256"]);
    const both = bytesOnGpu(256) + bytesOnGpu(8);
    assert.deepEqual(await eventsWithin(both), []);
    assert.deepEqual(await eventsWithin(both - 1), ["color 8"]);
    assert.equal(site.textureImages.open, 1);
    assert.deepEqual(await eventsWithin(bytesOnGpu(8) - 1), ["color none"]);
    assert.equal(site.textureImages.open, 0);
    assert.deepEqual(await eventsWithin(), ["color 8", "color 256"]);
  });

  test("is not requested for an invisible shape, but stays once it has loaded", async () => {
    const { site, eventsWithin } = shapeWith([textureOf("full.png", "small.png")], {
      "full.png": large,
      "small.png": small,
    });
    assert.deepEqual(await eventsWithin(Infinity, () => undefined), []);
    assert.deepEqual(site.requested, []);
    await eventsWithin();
    assert.deepEqual(await eventsWithin(Infinity, () => undefined), []);
    assert.equal(site.textureImages.open, 2);
  });

  test("is fetched from the next URL where one fails, and is an error where all do", async () => {
    const texture = (...urls: string[]) => ({ ...textureOf(""), urls });
    const second = shapeWith([texture("missing.png", "broken.png", "b.png")], {
      "broken.png": new Uint8Array(8),
      "b.png": large,
    });
    assert.deepEqual(await second.eventsWithin(), ["color 256"]);
    assert.deepEqual(second.site.requested, ["missing.png", "broken.png", "b.png"]);
    const none = shapeWith([texture("missing.png", "absent.png")], {});
    assert.deepEqual(await none.eventsWithin(), ["no missing.png"]);
    assert.deepEqual(none.site.requested, ["missing.png", "absent.png"]);
  });

  test("is fetched once for several roles, and replaced for one of them", async () => {
    const files = { "a.png": large, "b.png": large };
    const { site, shape, eventsWithin } = shapeWith(
      [textureOf("a.png", "", "occlusion"), textureOf("a.png", "", "metallicRoughness")],
      files,
    );
    assert.deepEqual(await eventsWithin(), ["occlusion 256", "metallicRoughness 256"]);
    shape.follow([textureOf("a.png", "", "occlusion"), textureOf("b.png", "", "metallicRoughness")]);
    assert.deepEqual(await eventsWithin(), ["metallicRoughness none", "metallicRoughness 256"]);
    assert.deepEqual(site.requested, ["a.png", "b.png"]);
    shape.follow([]);
    await shortDelay();
    assert.equal(site.textureImages.open, 0);
  });
});

test("textures are the last files that a scene requests, and their previews come with its coordinates", async () => {
  const { site, shape, deliveries } = shapeWith(
    [textureOf("full.png", "small.png")],
    { ...sigFiles(2), "full.png": large, "small.png": small },
    1,
  );
  const { settled } = record(sigGeometry(2), site.pool);
  deliveries.textures.request(everyTexture);
  await settled;
  while (!shape.isSettled) await shortDelay();
  // The first letter of a file name tells its content.
  const contents = site.requested.map(
    (name) => ({ a: "coord", s: "preview", i: "index", n: "normal", b: "refinement", f: "texture" })[name[0] ?? ""],
  );
  assert.deepEqual(contents, [
    "coord",
    "coord",
    "preview",
    "index",
    "index",
    "normal",
    "normal",
    "refinement",
    "refinement",
    "texture",
  ]);
});
