import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { pngOf } from "../decode/png.testing.ts";
import {
  geometryOf,
  deferredFile,
  indices,
  record,
  records,
  sigFiles,
  sigGeometry,
  sigPatch,
  siteOf,
  shortDelay,
} from "./delivery.testing.ts";
import type { Transfer } from "./progress.ts";
import { noProgress, progressOf } from "./progress.ts";

describe("the order of requests", () => {
  test("is: the first coordinate byte of all patches, then index, normals, and further bytes", async () => {
    const site = siteOf(sigFiles(3), 1);
    await record(sigGeometry(3), site.pool).settled;
    assert.deepEqual(
      site.requested,
      ["a0", "a1", "a2", "i0", "i1", "i2", "n0", "n1", "n2", "b0", "b1", "b2"].map((name) => `${name}.png`),
    );
  });

  test("applies across shapes that begin together", async () => {
    const site = siteOf(sigFiles(2), 1);
    const [first, second] = [0, 1].map((n) =>
      record(geometryOf(`<ImageGeometry>${sigPatch(n)}</ImageGeometry>`), site.pool),
    );
    await Promise.all([first?.settled, second?.settled]);
    assert.deepEqual(site.requested.slice(0, 2), ["a0.png", "a1.png"]);
  });

  test("has each file once, however many patches and shapes use it", async () => {
    const site = siteOf(sigFiles(1));
    const twice = geometryOf(`<ImageGeometry>${sigPatch(0)}${sigPatch(0)}</ImageGeometry>`);
    const all = [record(twice, site.pool), record(sigGeometry(1), site.pool)];
    await Promise.all(all.map(({ settled }) => settled));
    assert.equal(site.requested.length, 4);
    assert.deepEqual(
      all.map(({ stages }) => stages.at(-1)?.stage.name),
      ["full", "full"],
    );
  });
});

describe("the stages of a patch of images", () => {
  test("are points, a surface, a shaded surface, and the full patch", async () => {
    const site = siteOf(sigFiles(1), 1);
    const { stages, settled } = record(sigGeometry(1), site.pool);
    await settled;
    assert.deepEqual(
      stages.map(({ stage }) => stage.name),
      ["points", "surface", "shaded", "full"],
    );
    const [points, surface, shaded, full] = stages.map(({ stage }) => stage);
    assert.ok(
      points?.kind === "textures" &&
        surface?.kind === "textures" &&
        shaded?.kind === "textures" &&
        full?.kind === "textures",
    );
    assert.deepEqual(points.draws, [{ primitive: "points", first: 0, count: 500 }]);
    assert.deepEqual(surface.draws, [{ primitive: "triangles", first: 0, count: 600 }]);
    assert.equal(surface.attributes.normal, undefined);
    assert.ok(shaded.attributes.normal);
    assert.deepEqual([shaded.coord.length, shaded.missingBytesMidpoint], [1, 127.5]);
    assert.deepEqual([full.coord.length, full.missingBytesMidpoint], [2, 0]);
  });

  test("use the files that have arrived, in any order", async () => {
    const first = deferredFile(records);
    const site = siteOf({ ...sigFiles(1), "a0.png": first.promise });
    const { stages, settled } = record(sigGeometry(1), site.pool);
    await shortDelay();
    assert.equal(stages.length, 0); // without the first byte nothing can be displayed
    first.release();
    await settled;
    assert.deepEqual(
      stages.map(({ stage }) => stage.name),
      ["full"],
    );
  });

  test("never use a byte plane whose higher plane is missing", async () => {
    const site = siteOf({ "0.png": records, "2.png": records });
    const { stages, errors, settled } = record(
      geometryOf(
        `<ImageGeometry recordCount="500" vertexCount="500" implicitMeshSize="256 2" coord='"0.png" "1.png" "2.png"'/>`,
      ),
      site.pool,
    );
    await settled;
    assert.equal(errors.length, 1);
    const last = stages.at(-1)?.stage;
    assert.ok(last?.kind === "textures");
    assert.equal(last.coord.length, 1);
    assert.equal(last.missingBytesMidpoint, (2 ** 16 - 1) / 2);
  });

  for (const [missing, name] of [
    ["i0.png", "points"],
    ["n0.png", "surface"],
    ["b0.png", "shaded"],
    ["a0.png", undefined],
  ] as const) {
    for (const status of [404, 500]) {
      test(`end with ${name ?? "nothing"} and one error when ${missing} answers ${status}`, async () => {
        const site = siteOf({ ...sigFiles(2), [missing]: status });
        const { stages, errors, settled } = record(sigGeometry(2), site.pool);
        await settled;
        assert.equal(stages.filter(({ patch }) => patch === 0).at(-1)?.stage.name, name);
        assert.equal(stages.filter(({ patch }) => patch === 1).at(-1)?.stage.name, "full");
        assert.deepEqual(
          errors.map(({ url, kind }) => [url, kind]),
          [[missing, "http"]],
        );
        assert.match(errors[0]?.message ?? "", new RegExp(`^${missing}: .*${status}`));
        assert.equal(site.scheduler.runningCount, 0);
      });
    }
  }
});

describe("an image that does not match its document", () => {
  const wrongImages: Record<string, Uint8Array<ArrayBuffer>> = {
    "is too small for the records": pngOf({ width: 256, height: 1 }),
    "has 16 bits": pngOf({ width: 256, height: 2, bitDepth: 16 }),
    "is gray": pngOf({ width: 256, height: 2, colorType: 0 }),
    "is cut short": records.slice(0, -1),
    "is a web page": new TextEncoder().encode("<!DOCTYPE html>"),
  };
  for (const [what, bytes] of Object.entries(wrongImages)) {
    test(`is an error if it ${what}, and the other files are used`, async () => {
      const site = siteOf({ ...sigFiles(1), "b0.png": bytes });
      const { stages, errors, settled } = record(sigGeometry(1), site.pool);
      await settled;
      assert.deepEqual(
        errors.map(({ url }) => url),
        ["b0.png"],
      );
      assert.notEqual(errors[0]?.kind, "http");
      assert.equal(stages.at(-1)?.stage.name, "shaded");
    });
  }

  test("is an error if an index has narrower or fewer rows than the draws need", async () => {
    for (const size of [
      { width: 128, height: 8 },
      { width: 256, height: 2 },
    ]) {
      const site = siteOf({ ...sigFiles(1), "i0.png": pngOf(size) });
      const { stages, errors, settled } = record(sigGeometry(1), site.pool);
      await settled;
      assert.deepEqual(
        errors.map(({ url, kind }) => [url, kind]),
        [["i0.png", "malformed"]],
      );
      assert.equal(stages.at(-1)?.stage.name, "points");
    }
  });

  test("is an error if half of an image of normal pairs has too few texels", async () => {
    const pairs = (fields: string) =>
      geometryOf(`<ImageGeometry normalEncoding="octahedral" ${fields}>${sigPatch(0)}</ImageGeometry>`);
    const gray = (height: number) => pngOf({ width: 256, height, colorType: 0 });
    const good = siteOf({ ...sigFiles(1), "n0.png": gray(4) });
    const full = record(pairs(""), good.pool);
    await full.settled;
    const stage = full.stages.at(-1)?.stage;
    assert.ok(stage?.kind === "textures");
    assert.deepEqual([full.errors, stage.name, stage.normalFormat], [[], "full", { kind: "octahedral", bits: 8 }]);
    const short = siteOf({ ...sigFiles(1), "n0.png": gray(3) });
    const { errors, settled } = record(pairs(""), short.pool);
    await settled;
    assert.deepEqual(
      errors.map(({ url, kind }) => [url, kind]),
      [["n0.png", "malformed"]],
    );
  });

  test("is an error if the patch begins too late in it", async () => {
    const site = siteOf(sigFiles(1));
    const { errors, settled } = record(
      geometryOf(`<ImageGeometry><GeometryPatch recordCount="500" vertexCount="600"
      implicitMeshSize="256 4" index="i0.png" coord='"a0.png#13"'/></ImageGeometry>`),
      site.pool,
    );
    await settled;
    assert.deepEqual(
      errors.map(({ url }) => url),
      ["a0.png"],
    );
  });
});

describe("typed arrays", () => {
  const geometry = (fields: string) => geometryOf(`<BinaryGeometry coordType="Uint16" normalType="Int8" ${fields}/>`);
  const coord = new Uint8Array(new Uint16Array(5 * 4).buffer);
  const normal = new Uint8Array(5 * 4);
  const index = new Uint8Array(Uint16Array.from([0, 1, 2, 3, 4, 2]).buffer);

  test("become stages of buffers in the same order", async () => {
    const site = siteOf({ "c.bin": coord, "n.bin": normal, "i.bin": index }, 1);
    const { stages, errors, settled } = record(
      geometry('recordCount="5" vertexCount="6" coord="c.bin#0+8" normal="n.bin#0+4" index="i.bin"'),
      site.pool,
    );
    await settled;
    assert.deepEqual(errors, []);
    assert.deepEqual(
      stages.map(({ stage }) => stage.name),
      ["points", "surface", "full"],
    );
    const full = stages.at(-1)?.stage;
    assert.ok(full?.kind === "buffers");
    assert.deepEqual(full.draws, [{ primitive: "triangles", first: 0, count: 6 }]);
    assert.deepEqual([full.coord.components, full.coord.stride, full.attributes.normal?.stride], [3, 4, 4]);
  });

  test("draw strips as triangles, after the triangles before them", async () => {
    const site = siteOf({
      "c.bin": coord,
      "i.bin": new Uint8Array(Uint16Array.from([0, 1, 2, 0, 1, 2, 3, 3, 4]).buffer),
    });
    const { stages, settled } = record(
      geometry(
        `recordCount="5" primType='"TRIANGLES" "TRIANGLESTRIP"' vertexCount="3 6" coord="c.bin#0+8" index="i.bin"`,
      ),
      site.pool,
    );
    await settled;
    const full = stages.at(-1)?.stage;
    assert.ok(full?.kind === "buffers");
    assert.deepEqual(full.draws, [
      { primitive: "triangles", first: 0, count: 3 },
      { primitive: "triangles", first: 3, count: 12 },
    ]);
    assert.deepEqual(Array.from(site.arrayOf(full.index)), [0, 1, 2, 0, 1, 2, 2, 1, 3, 2, 3, 3, 3, 3, 4]);
  });

  test("with spherical normals have them in the coordinate records", async () => {
    const site = siteOf({ "c.bin": coord });
    const { stages, settled } = record(
      geometry('normalAsSphericalCoordinates="true" primType="POINTS" vertexCount="5" coord="c.bin#0+8"'),
      site.pool,
    );
    await settled;
    const full = stages.at(-1)?.stage;
    assert.ok(full?.kind === "buffers");
    assert.equal(full.name, "full");
    assert.deepEqual(full.normalFormat, { kind: "spherical", bits: 8 });
    assert.equal(full.attributes.normal?.bytes, full.coord.bytes);
    assert.deepEqual(
      [full.attributes.normal.components, full.attributes.normal.stride, full.attributes.normal.offset],
      [1, 4, 3],
    );
  });

  test("with octahedral normals state how to read the two numbers", async () => {
    const site = siteOf({ "c.bin": coord, "n.bin": normal });
    const { stages, settled } = record(
      geometryOf(
        '<BinaryGeometry coordType="Uint16" normalType="Uint16" normalEncoding="octahedral" primType="POINTS" vertexCount="5" coord="c.bin#0+8" normal="n.bin"/>',
      ),
      site.pool,
    );
    await settled;
    const full = stages.at(-1)?.stage;
    assert.ok(full?.kind === "buffers");
    assert.deepEqual(full.normalFormat, { kind: "octahedral", bits: 16 });
    assert.deepEqual(
      [full.attributes.normal?.components, full.attributes.normal?.stride, full.attributes.normal?.offset],
      [2, 2, 0],
    );
  });

  test("that are interleaved in one file are views of the same bytes, fetched once", async () => {
    const site = siteOf({ "v.bin": new Uint8Array(5 * 16) });
    const { stages, settled } = record(
      geometryOf(
        '<BinaryGeometry coordType="Int16" normalType="Int16" primType="POINTS" vertexCount="5" coord="v.bin#0+16" normal="v.bin#8+16"/>',
      ),
      site.pool,
    );
    await settled;
    const full = stages.at(-1)?.stage;
    assert.ok(full?.kind === "buffers" && full.attributes.normal);
    assert.deepEqual(
      [full.coord.bytes, full.coord.bytes.byteLength, full.coord.offset],
      [full.attributes.normal.bytes, 80, 0],
    );
    assert.equal(full.attributes.normal.offset, 4);
    assert.equal(site.arrays.size, 1);
    assert.equal(site.requested.length, 1);
  });

  test("draw all indices where vertexCount is 0, as X3DOM does", async () => {
    const site = siteOf({ "c.bin": coord, "i.bin": index });
    const { stages, settled } = record(geometry('coord="c.bin#0+8" index="i.bin"'), site.pool);
    await settled;
    assert.deepEqual(stages.at(-1)?.stage.draws, [{ primitive: "triangles", first: 0, count: 6 }]);
  });

  for (const [what, files, url] of [
    ["coordinates that end early", { "c.bin": coord.slice(0, 30) }, "c.bin"],
    ["indices that end early", { "i.bin": index.slice(0, 10) }, "i.bin"],
    ["an index beyond the vertices", { "i.bin": new Uint8Array(Uint16Array.from([0, 1, 2, 3, 4, 5]).buffer) }, "i.bin"],
  ] as const) {
    test(`with ${what} are an error`, async () => {
      const site = siteOf({ "c.bin": coord, "i.bin": index, ...files });
      const { errors, settled } = record(
        geometry('recordCount="5" vertexCount="6" coord="c.bin#0+8" index="i.bin"'),
        site.pool,
      );
      await settled;
      assert.deepEqual(
        errors.map((error) => error.url),
        [url],
      );
    });
  }
});

describe("a cancelled delivery", () => {
  test("aborts its requests, does not call its listener again, and closes its images", async () => {
    const late = deferredFile(records);
    const site = siteOf({ ...sigFiles(1), "b0.png": late.promise });
    const { stages, errors, delivery } = record(sigGeometry(1), site.pool);
    await shortDelay();
    assert.equal(site.images.open, 3);
    const before = stages.length;
    delivery.cancel();
    late.release();
    await shortDelay();
    assert.equal(stages.length, before);
    assert.deepEqual(errors, []);
    assert.ok(site.aborted.includes("b0.png"));
    assert.equal(site.images.open, 0);
    assert.deepEqual([site.scheduler.runningCount, site.scheduler.waitingCount], [0, 0]);
  });

  test("sends nothing if it is cancelled at once", async () => {
    const site = siteOf(sigFiles(1));
    record(sigGeometry(1), site.pool).delivery.cancel();
    await shortDelay();
    assert.deepEqual(site.requested, []);
  });

  test("does not abort files that another delivery uses", async () => {
    const site = siteOf(sigFiles(1));
    const cancelled = record(sigGeometry(1), site.pool);
    const remaining = record(sigGeometry(1), site.pool);
    cancelled.delivery.cancel();
    cancelled.delivery.cancel(); // a second time does nothing
    await remaining.settled;
    assert.equal(remaining.stages.at(-1)?.stage.name, "full");
    assert.deepEqual(cancelled.stages, []);
    assert.equal(site.images.open, 4);
  });
});

describe("progress", () => {
  const transfer = (loadedBytes: number, totalBytes: number, state: Transfer["state"] = "loading") => ({
    loadedBytes,
    totalBytes,
    state,
  });

  test("is the share of bytes", () => {
    assert.deepEqual(progressOf([transfer(10, 40), transfer(10, 40)], noProgress), {
      totalProgress: 0.25,
      loadedBytes: 20,
      totalBytes: 80,
    });
  });

  test("does not decrease when a server states a larger size than expected", () => {
    const before = progressOf([transfer(10, 20)], noProgress);
    assert.equal(progressOf([transfer(10, 100)], before).totalProgress, 0.5);
  });

  test("is 1 only when everything has loaded or failed", () => {
    assert.ok(progressOf([transfer(40, 40), transfer(0, 0)], noProgress).totalProgress < 1);
    assert.equal(progressOf([transfer(40, 40, "ready"), transfer(0, 0, "failed")], noProgress).totalProgress, 1);
    assert.equal(progressOf([], noProgress).totalProgress, 1);
  });

  test("of a delivery rises to 1 and ends with the loaded bytes", async () => {
    const site = siteOf({ ...sigFiles(2), "n1.png": 404 }, 2);
    const { delivery, settled } = record(sigGeometry(2), site.pool);
    let progress = progressOf(delivery.transfers, noProgress);
    const values = [progress.totalProgress];
    const timer = setInterval(() => {
      progress = progressOf(delivery.transfers, progress);
      values.push(progress.totalProgress);
    }, 0);
    await settled;
    clearInterval(timer);
    progress = progressOf(delivery.transfers, progress);
    assert.deepEqual(
      values,
      values.toSorted((a, b) => a - b),
    );
    assert.deepEqual(progress, {
      totalProgress: 1,
      loadedBytes: 5 * records.length + 2 * indices.length,
      totalBytes: 5 * records.length + 2 * indices.length,
    });
  });
});
