import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { pngWithTexels } from "../../../decode/png.testing.ts";
import { deliveryOf } from "../encodings.ts";
import { bufferStageBuilder } from "./classicBufferStage.ts";
import { geometryOf, deferredFile, record, records, sigPatch, siteOf, shortDelay } from "../../delivery.testing.ts";

describe("images that are decoded on the CPU", () => {
  const coordAt = (first: number) => pngWithTexels(256, 2, 3, (n, channel) => first + ((n + channel) % 100));
  const files = () => ({
    "i0.png": pngWithTexels(256, 4, 3, (n, channel) => [n % 200, 0, 0][channel] ?? 0),
    "a0.png": coordAt(1),
    "b0.png": coordAt(100),
    "n0.png": records,
  });

  for (const [why, attribute, readsTextures] of [
    ["the document requests it", 'decode="cpu"', true],
    ["vertex shaders read textures wrongly", "", false],
  ] as const) {
    test(`become stages of buffers if ${why}`, async () => {
      const site = siteOf(files(), 6, readsTextures);
      const { stages, errors, settled } = record(
        geometryOf(`<ImageGeometry ${attribute}>${sigPatch(0)}</ImageGeometry>`),
        site.pool,
      );
      await settled;
      assert.deepEqual(errors, []);
      assert.equal(site.images.open, 0);
      const full = stages.at(-1)?.stage;
      assert.ok(full?.kind === "buffers");
      assert.deepEqual([full.name, full.draws], ["full", [{ primitive: "triangles", first: 0, count: 600 }]]);
      assert.deepEqual(
        [site.arrayOf(full.coord)[4], site.arrayOf(full.index)[201], full.normalFormat.kind],
        [2 * 256 + 101, 1, "byteVector"],
      );
    });
  }

  test("become textures if the document requires the GPU", async () => {
    const site = siteOf(files(), 6, false);
    const { stages, settled } = record(
      geometryOf(`<ImageGeometry decode="gpu">${sigPatch(0)}</ImageGeometry>`),
      site.pool,
    );
    await settled;
    assert.equal(stages.at(-1)?.stage.kind, "textures");
  });

  test("become buffers if they are larger than a texture may be", async () => {
    const site = siteOf({ "c.png": pngWithTexels(16, 8, 3, (n, channel) => n + channel) });
    const patch = (width: number) =>
      `<ImageGeometry primType="POINTS" vertexCount="20" implicitMeshSize="${width} 2" coord="c.png"/>`;
    for (const [width, kind] of [
      [16, "textures"],
      [5000, "buffers"],
    ] as const) {
      const { stages, errors, settled } = record(geometryOf(patch(width)), site.pool);
      await settled;
      // The file itself is narrower than the rows that the document states.
      if (width > 16) assert.match(errors[0]?.message ?? "", /is 16 texels wide/);
      else assert.equal(stages.at(-1)?.stage.kind, kind);
    }
  });

  test("grow from points to a surface in any order of their files", async () => {
    for (const [late, expected] of [
      ["a0.png", undefined],
      ["i0.png", "points"],
      ["b0.png", "shaded"],
    ] as const) {
      const all = files();
      const { promise, release } = deferredFile(all[late]);
      const site = siteOf({ ...all, [late]: promise });
      const { stages, errors, settled } = record(
        geometryOf(`<ImageGeometry decode="cpu">${sigPatch(0)}</ImageGeometry>`),
        site.pool,
      );
      while (stages.at(-1)?.stage.name !== expected) await shortDelay();
      release();
      await settled;
      assert.deepEqual([errors, stages.at(-1)?.stage.name], [[], "full"]);
    }
  });

  test("replace normals and positions of a grid together, whichever job ends first", async () => {
    const files = ["a.png", "b.png"].map((_, plane) =>
      pngWithTexels(8, 8, 3, (n, channel) => (plane ? 40 * n * n : 9 * n + 70 * channel) % 256),
    );
    const geometry = geometryOf(
      '<ImageGeometry implicitMeshMode="geometryImage" implicitMeshSize="8 8" coord=\'"a.png" "b.png"\' decode="cpu"/>',
    );
    const patch = geometry.patches[0] ?? assert.fail("no patch");
    const arraysAfter = async (order: readonly number[]): Promise<unknown> => {
      const site = siteOf({});
      const jobStarts = files.map(() => deferredFile(new Uint8Array(0)));
      let jobCount = 0;
      const builder = bufferStageBuilder(geometry, patch, {
        storeBytes: site.pool.storeBytes,
        runJob: (name, input, signal) =>
          (jobStarts[jobCount++] ?? assert.fail("a third job")).promise.then(() =>
            site.pool.runJob(name, input, signal),
          ),
      });
      const { signal } = new AbortController();
      const accepted = deliveryOf(geometry)
        .patchFilesOf(geometry, patch, 4096)
        .map((file) =>
          builder.accept(file, { kind: "bytes", bytes: files[file.plane] ?? assert.fail("no such plane") }, signal),
        );
      for (const job of order) {
        jobStarts[job]?.release();
        await accepted[job];
      }
      const stage = builder.stage() ?? assert.fail("no stage");
      builder.sweep();
      assert.equal(site.arrays.size, 3, "only index, positions and normals are stored");
      return [
        stage.kind === "buffers" &&
          [stage.coord, stage.attributes.normal, stage.index].map((stored) => site.arrayOf(stored)),
      ];
    };
    assert.deepEqual(await arraysAfter([1, 0]), await arraysAfter([0, 1]));
  });

  test("have 16-bit normals of two images, and the upper bytes of both until the second image arrives", async () => {
    const images = ["normal", "low"].map((url) => `<ImageTexture containerField="normal" url="${url}.png"/>`).join("");
    const texels = (first: number) => pngWithTexels(16, 1, 3, (n, channel) => first + n + 20 * channel);
    const { promise, release } = deferredFile(texels(7));
    const site = siteOf({ "c.png": texels(0), "normal.png": texels(150), "low.png": promise });
    const { stages, errors, settled } = record(
      geometryOf(
        `<ImageGeometry primType="POINTS" vertexCount="16" implicitMeshSize="16 1" coord="c.png">${images}</ImageGeometry>`,
      ),
      site.pool,
    );
    while (stages.at(-1)?.stage.name !== "shaded") await shortDelay();
    const normalOf = () => {
      const stage = stages.at(-1)?.stage;
      assert.ok(stage?.kind === "buffers");
      assert.equal(stage.normalFormat.kind, "vector");
      return [stage.name, site.arrayOf(stage.attributes.normal)[5]];
    };
    const wordOf = (high: number, low: number) => Math.round(((2 * (256 * high + low)) / 65535) * 32767 - 32767);
    // Element 5 is y of the second record.
    assert.deepEqual(normalOf(), ["shaded", wordOf(171, 171)]);
    release();
    await settled;
    assert.deepEqual([errors, normalOf()], [[], ["full", wordOf(171, 28)]]);
  });

  test("draw fans, loops and clockwise triangles, which shaders do not draw from images", async () => {
    const site = siteOf({ "c.png": pngWithTexels(16, 1, 3, (n, channel) => n + channel) });
    for (const [attributes, indices] of [
      ['primType="TRIANGLEFAN" vertexCount="4"', [0, 1, 2, 0, 2, 3]],
      ['primType="LINELOOP" vertexCount="3"', [0, 1, 2, 0]],
      ['ccw="false" vertexCount="3"', [0, 2, 1]],
    ] as const) {
      const geometry = geometryOf(`<ImageGeometry ${attributes} implicitMeshSize="16 1" coord="c.png"/>`);
      const { stages, errors, settled } = record(geometry, site.pool);
      await settled;
      const full = stages.at(-1)?.stage;
      assert.ok(full?.kind === "buffers");
      assert.deepEqual([errors, Array.from(site.arrayOf(full.index))], [[], indices], attributes);
    }
  });

  test("report the damaged file, whichever file triggered its decoding", async () => {
    const site = siteOf({ ...files(), "i0.png": pngWithTexels(256, 4, 3, () => 255) });
    const { stages, errors, settled } = record(
      geometryOf(`<ImageGeometry decode="cpu">${sigPatch(0)}</ImageGeometry>`),
      site.pool,
    );
    await settled;
    assert.deepEqual(
      errors.map(({ url, kind }) => [url, kind]),
      [["i0.png", "malformed"]],
    );
    assert.equal(stages.at(-1)?.stage.name, "points");
  });
});
