import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { Base } from "../../../decode/compact/baseBuffers.ts";
import { buffersOf } from "../../../decode/compact/patchBuffers.ts";
import { decodedOf } from "../../../decode/compact/typescriptDecoder.ts";
import { decodeVector, readVectorFile, vectorNames } from "../../../decode/compact/vectors.testing.ts";
import { pngWithTexels } from "../../../decode/png.testing.ts";
import { dequantizationOf } from "../../../document/dequantization.ts";
import { everything, geometryOf, deferredFile, record, siteOf, shortDelay } from "../../delivery.testing.ts";

/**
 * A geometry whose patches are those of test vectors, by file and patch index, as a document would describe them;
 * `changes` replaces fields.
 */
function geometryFor(
  patches: readonly (readonly [file: string, patchIndex: number])[],
  changes: Record<string, string> = {},
  base = "",
) {
  const patchAt = (file: string, patchIndex: number) => decodeVector(file)[patchIndex] ?? assert.fail("no such patch");
  const { header } = patchAt(...(patches[0] ?? assert.fail("no patches")));
  const markup = patches.map(([file, patchIndex]) => {
    const { index, vertexCount, topology } = buffersOf(patchAt(file, patchIndex));
    const fields = {
      recordCount: String(vertexCount),
      vertexCount: String(index?.length ?? vertexCount),
      primType: topology.toUpperCase(),
      data: `${file}.png#${patchIndex}`,
      ...changes,
    };
    return `<GeometryPatch ${Object.entries(fields)
      .map(([name, value]) => `${name}="${value}"`)
      .join(" ")}/>`;
  });
  return geometryOf(
    `<ImageGeometry profile="compact" positionBits="${changes.positionBits ?? header.positionBits}" base="${base}">${markup.join("")}</ImageGeometry>`,
  );
}

const isBase = (name: string) => decodeVector(name).some(({ segments }) => segments);
const filesOf = (...names: string[]) => Object.fromEntries(names.map((name) => [`${name}.png`, readVectorFile(name)]));

async function until(condition: () => boolean): Promise<void> {
  while (!condition()) await shortDelay();
}

describe("a geometry of compact", () => {
  test("becomes one stage, full, of buffers, for every test vector", async () => {
    for (const name of vectorNames().filter((name) => !isBase(name))) {
      const site = siteOf(filesOf(name));
      const { stages, errors, settled } = record(geometryFor([[name, 0]]), site.pool);
      await settled;
      assert.deepEqual(errors, []);
      const [{ stage } = assert.fail("no stage")] = stages;
      assert.ok(stages.length === 1 && stage.kind === "buffers" && stage.name === "full");
      const { index, coord, attributes } = buffersOf(decodeVector(name)[0] ?? assert.fail());
      assert.deepEqual(
        [stage.index, stage.coord, stage.attributes.normal, stage.attributes.color].map(
          (stored) => stored && site.arrayOf(stored),
        ),
        [index, coord.array, attributes.normal?.array, attributes.color?.array],
      );
      const { type, components, stride, offset } = stage.coord;
      assert.deepEqual(
        [`${type}Array`, components, stride, offset],
        [coord.array.constructor.name, coord.components, coord.stride, coord.offset],
      );
    }
  });

  test("requests and decodes a file of several patches once", async () => {
    const site = siteOf(filesOf("alike"));
    const patchIndices = [3, 0, 8];
    const recordings = patchIndices.map((patchIndex) => record(geometryFor([["alike", patchIndex]]), site.pool));
    await Promise.all(recordings.map(({ settled }) => settled));
    assert.deepEqual([site.requested, site.jobs], [["alike.png"], ["compactPatches"]]);
    const patches = decodeVector("alike");
    for (const [
      recordingIndex,
      {
        stages: [only, ...others],
        errors,
      },
    ] of recordings.entries()) {
      assert.ok(only?.stage.kind === "buffers");
      assert.deepEqual([errors, others.length], [[], 0]);
      const { index, coord } = buffersOf(patches[patchIndices[recordingIndex] ?? 0] ?? assert.fail());
      assert.deepEqual(
        [only.stage.index, only.stage.coord].map((stored) => site.arrayOf(stored)),
        [index, coord.array],
      );
    }
    const both = record(
      geometryFor([
        ["cube", 0],
        ["cube", 0],
      ]),
      siteOf(filesOf("cube")).pool,
    );
    await both.settled;
    assert.deepEqual(
      both.stages.map(({ patch }) => patch),
      [0, 1],
    );
  });

  test("that shares a file is evicted and fetched again alone, and counts only its own bytes", async () => {
    const site = siteOf(filesOf("alike"));
    const recordings = [3, 0, 8].map((patchIndex) => record(geometryFor([["alike", patchIndex]]), site.pool));
    await Promise.all(recordings.map(({ settled }) => settled));
    const stored = () => Array.from(site.arrays.values()).reduce((sum, { byteLength }) => sum + byteLength, 0);
    const each = recordings.map(({ delivery }) => delivery.storedBytes);
    const all = each.reduce((sum, bytes) => sum + bytes);
    assert.equal(stored(), all);
    const [, { delivery, stages } = assert.fail()] = recordings;
    delivery.budgetRequests(everything);
    delivery.request(everything, new Set());
    assert.deepEqual([stored(), delivery.storedBytes], [all - (each[1] ?? 0), each[1]]);
    delivery.budgetRequests(everything);
    delivery.request(everything);
    await until(() => stages.length === 2);
    assert.deepEqual([stored(), recordings.map((recording) => recording.stages.length)], [all, [1, 2, 1]]);
    assert.deepEqual(site.requested, ["alike.png", "alike.png"]);
    for (const { delivery: one } of recordings) one.cancel();
    assert.equal(site.arrays.size, 0);
  });

  test("fails with a shared file, each geometry with its own error", async () => {
    const site = siteOf({ "alike.png": 404 });
    const recordings = [1, 2].map((patchIndex) => record(geometryFor([["alike", patchIndex]]), site.pool));
    await Promise.all(recordings.map(({ settled }) => settled));
    assert.deepEqual(
      recordings.map(({ errors, stages }) => [errors.length, errors[0]?.url, errors[0]?.kind, stages.length]),
      [
        [1, "alike.png", "http", 0],
        [1, "alike.png", "http", 0],
      ],
    );
    assert.deepEqual(site.requested, ["alike.png"]);
  });

  test("requests a shared file at the largest priority of its users, and aborts it with the last one", async () => {
    const { promise, release } = deferredFile(readVectorFile("sphere"));
    const site = siteOf({ ...filesOf("alike", "torus"), "sphere.png": promise }, 1);
    const withPriority = (priority: number) => () => priority;
    const first = record(geometryFor([["sphere", 0]]), site.pool, withPriority(9));
    const low = record(geometryFor([["alike", 4]]), site.pool, withPriority(1));
    const middle = record(geometryFor([["torus", 0]]), site.pool, withPriority(5));
    const high = record(geometryFor([["alike", 5]]), site.pool, withPriority(7));
    const totals = low.delivery.transfers.map(({ totalBytes }) => totalBytes);
    high.delivery.cancel();
    assert.ok(
      (low.delivery.transfers[0]?.totalBytes ?? 0) < (totals[0] ?? 0),
      "the expected bytes of a shared file are the sum over the deliveries that wait for it",
    );
    low.delivery.request(withPriority(8));
    release();
    await Promise.all([first.settled, low.settled, middle.settled]);
    assert.deepEqual(site.requested, ["sphere.png", "alike.png", "torus.png"]);
    const silent = siteOf({ "alike.png": new Promise(() => undefined) });
    const both = [1, 2].map((patchIndex) => record(geometryFor([["alike", patchIndex]]), silent.pool));
    await until(() => silent.requested.length === 1);
    both[0]?.delivery.cancel();
    assert.deepEqual(silent.aborted, []);
    both[1]?.delivery.cancel();
    assert.deepEqual(silent.aborted, ["alike.png"]);
  });

  test("stores the values that colour it, and no other values", async () => {
    const patch = decodeVector("others")[0] ?? assert.fail();
    const plain = geometryFor([["others", 0]]);
    const common = { fileCount: 0, min: [0], size: [1] };
    const [bits24, bits3] = [
      { ...common, name: "heat", components: 1, bits: 24 },
      { ...common, name: "flow", components: 4, bits: 3 },
    ] as const;
    for (const value of [bits24, bits3]) {
      const site = siteOf(filesOf("others"));
      const { stages, errors, settled, delivery } = record({ ...plain, attributes: [bits24, bits3], value }, site.pool);
      await settled;
      assert.deepEqual(errors, []);
      const stage = stages[0]?.stage;
      assert.ok(stage?.kind === "buffers" && stage.value);
      const { components, stride, offset, maxStored } = stage.value;
      assert.deepEqual([components, maxStored], [value.components, 2 ** value.bits - 1]);
      const array = site.arrayOf(stage.value);
      const values = Array.from(
        { length: patch.header.wedgeCount * components },
        (_, i) => array[Math.floor(i / components) * stride + offset + (i % components)],
      );
      assert.deepEqual(values, Array.from(patch.attributes[value === bits24 ? 2 : 3] ?? assert.fail()));
      delivery.cancel();
      assert.equal(site.arrays.size, 0);
    }
    for (const value of [
      { ...bits24, bits: 16 },
      { ...bits24, components: 2 as const },
    ]) {
      const { stages, errors, settled } = record(
        { ...plain, attributes: [value, bits3], value },
        siteOf(filesOf("others")).pool,
      );
      await settled;
      assert.deepEqual([stages.length, errors[0]?.kind], [0, "malformed"]);
    }
    const none = { ...plain, attributes: [bits24, bits3, bits24], value: { ...bits24, name: "cold" } };
    const { stages, errors, settled } = record(none, siteOf(filesOf("others")).pool);
    await settled;
    assert.deepEqual([stages.length, errors[0]?.kind], [0, "malformed"]);
  });

  for (const [what, changes] of Object.entries({
    "its position bits": { positionBits: "15" },
    "its number of vertices": { recordCount: "7" },
    "its number of corners": { vertexCount: "3" },
    "its primitive type": { primType: "LINES" },
    "its number of patches": { data: "torus.png#1" },
  })) {
    test(`refuses a file that differs from the document in ${what}`, async () => {
      const { stages, errors, settled } = record(geometryFor([["torus", 0]], changes), siteOf(filesOf("torus")).pool);
      await settled;
      assert.deepEqual([stages.length, errors.length, errors[0]?.url], [0, 1, "torus.png"]);
      assert.match(errors[0]?.kind ?? "", /malformed|truncated/);
    });
  }

  test("displays the other patches if a file is damaged, not gray, or missing", async () => {
    const damaged = readVectorFile("sphere");
    damaged[damaged.length >> 1] = (damaged[damaged.length >> 1] ?? 0) ^ 1;
    const geometry = geometryFor(
      [
        ["torus", 0],
        ["sphere", 0],
        ["cone", 0],
        ["cube", 0],
      ],
      { positionBits: "10" },
    );
    const site = siteOf({
      ...filesOf("cube"),
      "torus.png": 404,
      "sphere.png": damaged,
      "cone.png": pngWithTexels(9, 9, 3, () => 0),
    });
    const { stages, errors, settled } = record(geometry, site.pool);
    await settled;
    assert.deepEqual(
      stages.map(({ patch }) => patch),
      [3],
    );
    assert.deepEqual(errors.map(({ url, kind }) => `${url} ${kind}`).sort(), [
      "cone.png malformed",
      "sphere.png malformed",
      "torus.png http",
    ]);
  });

  test("displays the segments of its base mesh until the patches arrive", async () => {
    const sphere = deferredFile(readVectorFile("sphere"));
    const soup = deferredFile(readVectorFile("soup"));
    const site = siteOf({ ...filesOf("base"), "sphere.png": sphere.promise, "soup.png": soup.promise });
    const { stages, errors, settled } = record(
      geometryFor(
        [
          ["sphere", 0],
          ["soup", 0],
          ["soup", 0],
        ],
        {},
        "base.png#0",
      ),
      site.pool,
    );
    await until(() => stages.filter(({ stage }) => stage.name === "base").length === 3);
    soup.release();
    await until(() => stages.some(({ stage }) => stage.name === "full"));
    sphere.release();
    await settled;
    assert.deepEqual(errors, []);
    assert.deepEqual(site.requested, ["base.png", "sphere.png", "soup.png"]);
    const segments = new Base(decodedOf(decodeVector("base")[0] ?? assert.fail())).segments;
    for (const patch of [0, 1, 2]) {
      const [first, last, ...others] = stages.filter((one) => one.patch === patch).map(({ stage }) => stage);
      assert.deepEqual([first?.name, last?.name, others.length], ["base", "full", 0]);
      assert.ok(first?.kind === "buffers");
      assert.deepEqual(
        [first.index, first.coord, first.attributes.normal].map((stored) => site.arrayOf(stored)),
        [segments[patch]?.index, segments[patch]?.coord.array, segments[patch]?.attributes.normal?.array],
      );
      assert.deepEqual(first.draws, [{ primitive: "triangles", first: 0, count: segments[patch]?.index?.length }]);
    }
  });

  test("has the texture coordinates and values of its base mesh, with the bits of the base mesh", async () => {
    const site = siteOf({ ...filesOf("base-seams"), "sphere.png": 404 });
    const plain = geometryFor(
      [
        ["sphere", 0],
        ["sphere", 0],
        ["sphere", 0],
      ],
      {},
      "base-seams.png",
    );
    const value = { name: "flow", components: 2, bits: 16, fileCount: 0, min: [0, 0], size: [1, 1] } as const;
    const { stages, settled } = record({ ...plain, attributes: [value], value }, site.pool);
    await settled;
    const segments = new Base(decodedOf(decodeVector("base-seams")[0] ?? assert.fail())).segments;
    assert.deepEqual(
      new Set(stages.map(({ patch }) => patch)),
      new Set(segments.flatMap((segment, segmentIndex) => (segment ? [segmentIndex] : []))),
    );
    for (const { patch, stage } of stages) {
      assert.ok(stage.kind === "buffers" && stage.name === "base");
      assert.deepEqual(
        [site.arrayOf(stage.attributes.texCoord), site.arrayOf(stage.value)],
        [segments[patch]?.attributes.texCoord?.array, segments[patch]?.others[0]?.vertices.array],
      );
      assert.equal(stage.value?.maxStored, 2 ** 11 - 1);
    }
  });

  test("falls back to its base mesh if the budget does not allow a patch", async () => {
    const site = siteOf(filesOf("base", "sphere"));
    const { stages, delivery, settled } = record(
      geometryFor(
        [
          ["sphere", 0],
          ["sphere", 0],
          ["sphere", 0],
        ],
        {},
        "base.png",
      ),
      site.pool,
    );
    await settled;
    const arrayCount = site.arrays.size;
    const requestsByPatch = delivery.budgetRequests(everything);
    assert.deepEqual(
      requestsByPatch.map((each) => each.length),
      [2, 2, 2],
    );
    const all = requestsByPatch.flat();
    const bytes = all.reduce((sum, { bytes }) => sum + bytes, 0);
    assert.equal(
      bytes,
      Array.from(site.arrays.values(), (array) => array.byteLength).reduce((sum, length) => sum + length, 0),
    );
    stages.length = 0;
    delivery.request(everything, new Set(all.filter((request) => request !== requestsByPatch[1]?.[1])));
    assert.deepEqual(
      stages.map(({ patch, stage }) => [patch, stage.name]),
      [[1, "base"]],
    );
    assert.equal(site.arrays.size, arrayCount - 3);
    delivery.budgetRequests(everything);
    delivery.request(everything);
    await until(() => stages.length === 2);
    assert.deepEqual([stages[1]?.patch, stages[1]?.stage.name], [1, "full"]);
    delivery.cancel();
    assert.equal(site.arrays.size, 0);
  });

  test("ignores a base mesh that arrives after the patches", async () => {
    const { promise, release } = deferredFile(readVectorFile("base"));
    const site = siteOf({ ...filesOf("sphere"), "base.png": promise });
    const { stages, settled } = record(
      geometryFor(
        [
          ["sphere", 0],
          ["sphere", 0],
          ["sphere", 0],
        ],
        {},
        "base.png",
      ),
      site.pool,
    );
    await until(() => stages.length === 3);
    release();
    await settled;
    assert.deepEqual(
      stages.map(({ stage }) => stage.name),
      ["full", "full", "full"],
    );
  });

  test("does without a base mesh that is missing or belongs to another geometry", async () => {
    for (const [base, kind, patches] of [
      ["none.png", "http", 3],
      ["sphere.png", "malformed", 3],
      ["base.png", "malformed", 2],
      ["base-colors.png#7", "malformed", 3],
    ] as const) {
      const geometry = geometryFor(
        Array.from({ length: patches }, () => ["soup", 0] as const),
        {},
        base,
      );
      const { stages, errors, settled } = record(
        geometry,
        siteOf(filesOf("soup", "sphere", "base", "base-colors")).pool,
      );
      await settled;
      assert.deepEqual([errors.length, errors[0]?.kind, errors[0]?.url], [1, kind, base.replace(/#.*/, "")]);
      assert.deepEqual(
        stages.map(({ stage }) => stage.name),
        Array.from({ length: patches }, () => "full"),
      );
    }
  });

  test("refuses a base mesh where a patch should be", async () => {
    const { stages, errors, settled } = record(geometryFor([["base", 0]]), siteOf(filesOf("base")).pool);
    await settled;
    assert.deepEqual([stages.length, errors[0]?.kind], [0, "malformed"]);
  });

  test("does not call its listener after it is cancelled", async () => {
    const { promise, release } = deferredFile(readVectorFile("torus"));
    const { stages, errors, delivery } = record(geometryFor([["torus", 0]]), siteOf({ "torus.png": promise }).pool);
    await shortDelay();
    delivery.cancel();
    release();
    await shortDelay();
    assert.deepEqual([stages, errors], [[], []]);
  });

  test("has the lattice of classic, whose stored numbers fill whole bytes with the position in the upper bits", () => {
    for (const bits of [8, 10, 16, 20]) {
      const geometry = geometryOf(
        `<ImageGeometry profile="compact" position="1 2 3" size="4 4 4" positionBits="${bits}" data="x.png"/>`,
      );
      const classic = geometryOf(`<ImageGeometry position="1 2 3" size="4 4 4" vertexCount="3" positionBits="${bits}"
        coord='${Array.from({ length: Math.ceil(bits / 8) }, (_, plane) => `"${plane}.png"`).join(" ")}'/>`);
      const [compactFrame, classicFrame] = [geometry, classic].map((one) =>
        dequantizationOf(one, one.patches[0] ?? assert.fail()),
      );
      assert.deepEqual(compactFrame?.origin, classicFrame?.origin);
      const stepRatio = 2 ** (8 * Math.ceil(bits / 8) - bits);
      assert.ok(Math.abs((compactFrame?.step[0] ?? 0) - (classicFrame?.step[0] ?? 0) * stepRatio) < 1e-15);
    }
  });
});
