import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { BufferAttribute } from "three";
import type { ElementArray, IndexArray } from "../../stage/vertexArray.ts";
import type { BufferStage, DrawRange, GpuArray } from "../../stage/stage.ts";
import type { BufferProvider } from "../uploads/bufferProvider.ts";
import { outlineTriangles } from "../shaders/wideLineChunk.ts";
import { wideLineGeometryOf } from "./wideLineGeometry.ts";
import { withWideLines } from "./wideLines.ts";

const contents = new Map<GpuArray, ElementArray>();

function stored(array: ElementArray): GpuArray {
  const bytes = { byteLength: array.byteLength, close: () => undefined };
  contents.set(bytes, array);
  return bytes;
}

const buffers: BufferProvider = {
  ownsBuffers: true,
  recordsOf: () => assert.fail(),
  indexAttributeOf: () => assert.fail(),
  dispose: () => undefined,
  read: (bytes, _, first, count = Infinity) => (contents.get(bytes) ?? assert.fail()).subarray(first, first + count),
};

/** Vertex n lies at (10 n, 10 n + 1, 10 n + 2) and its colour is n; records have two elements more than that. */
function stageOf(draws: readonly DrawRange[], index: IndexArray | undefined): BufferStage {
  const coord = stored(
    Int16Array.from(Array.from({ length: 8 }, (_, n) => [-1, 10 * n, 10 * n + 1, 10 * n + 2, -1]).flat()),
  );
  const color = stored(Uint8Array.from(Array.from({ length: 8 }, (_, n) => [n, n, n, 255]).flat()));
  return {
    kind: "buffers",
    vertexCount: 8,
    name: "full",
    draws,
    index: index && { bytes: stored(index), type: "Uint16" },
    coord: { bytes: coord, type: "Int16", components: 3, stride: 5, offset: 1 },
    attributes: { color: { bytes: color, type: "Uint8", components: 3, stride: 4, offset: 0 } },
    normalFormat: { kind: "vector" },
    value: undefined,
  };
}

function endsOf(
  draw: DrawRange,
  index?: IndexArray,
): { count: number; begins: number[]; ends: number[]; colors: number[] } {
  const geometry = wideLineGeometryOf(stageOf([draw], index), draw, buffers);
  const firsts = (name: string) => {
    const attribute = geometry.getAttribute(name) as BufferAttribute;
    return Array.from({ length: attribute.count }, (_, n) => attribute.getX(n));
  };
  return {
    count: geometry.instanceCount,
    begins: firsts("position"),
    ends: firsts("positionEnd"),
    colors: firsts("colorEnd").map((value) => Math.round(255 * value)),
  };
}

describe("wide lines in buffers", () => {
  test("have one instance per pair of indices from the draw's first index on, whatever the records' stride", () => {
    assert.deepEqual(
      endsOf({ primitive: "lines", first: 2, count: 4, isWide: true }, Uint16Array.from([0, 1, 5, 3, 3, 6])),
      { count: 2, begins: [50, 30], ends: [30, 60], colors: [3, 6] },
    );
  });

  test("share vertices along a strip, and use consecutive vertices where there is no index", () => {
    assert.deepEqual(endsOf({ primitive: "lineStrip", first: 1, count: 3, isWide: true }), {
      count: 2,
      begins: [10, 20],
      ends: [20, 30],
      colors: [2, 3],
    });
    assert.deepEqual(endsOf({ primitive: "lines", first: 0, count: 3, isWide: true }), {
      count: 1,
      begins: [0],
      ends: [10],
      colors: [1],
    });
  });

  test("are absent where a draw has too few vertices", () => {
    assert.equal(endsOf({ primitive: "lineStrip", first: 0, count: 1, isWide: true }).count, 0);
  });
});

describe("a stage with wide lines", () => {
  test("is the same object each time, and the original stage where it has no lines", () => {
    const lines = stageOf(
      [
        { primitive: "lines", first: 0, count: 2 },
        { primitive: "points", first: 0, count: 2 },
      ],
      undefined,
    );
    assert.equal(withWideLines(lines), withWideLines(lines));
    assert.deepEqual(
      withWideLines(lines).draws.map(({ isWide }) => isWide),
      [true, undefined],
    );
    const surface = stageOf([{ primitive: "triangles", first: 0, count: 3 }], undefined);
    assert.equal(withWideLines(surface), surface);
  });
});

test("the triangles of a line's outline cover it once", () => {
  const capSides = 8;
  const corners = Array.from({ length: 2 * capSides + 2 }, (_, n) => {
    const angle = Math.PI * (0.5 + (n > capSides ? n - 1 : n) / capSides);
    return [(n > capSides ? 3 : 0) + Math.cos(angle), Math.sin(angle)] as const;
  });
  let area = 0;
  for (let at = 0; at < outlineTriangles.length; at += 3) {
    const corner = (n: number) => corners[outlineTriangles[at + n] ?? -1] ?? assert.fail();
    const [a, b, c] = [corner(0), corner(1), corner(2)] as const;
    const twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    assert.ok(twice > 0, "all triangles turn left");
    area += twice / 2;
  }
  assert.ok(Math.abs(area - (3 * 2 + capSides * Math.sin(Math.PI / capSides))) < 1e-9, `${area}`);
});
