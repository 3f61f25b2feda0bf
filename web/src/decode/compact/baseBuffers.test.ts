// Compares the segments of base meshes with the plain numbers that the vectors state.

import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { Base } from "./baseBuffers.ts";
import { decodedOf } from "./typescriptDecoder.ts";
import { decodeVector, readVector } from "./vectors.testing.ts";

interface Expected {
  readonly positions: number[];
  readonly wedgePositions: number[];
  readonly corners: number[];
  readonly parts: number[];
  readonly partCount: number;
}

describe("the segments of a base mesh", () => {
  for (const name of ["base", "base-colors", "base-seams"]) {
    test(`in "${name}" have each triangle of the base mesh once, with vertices of their own`, () => {
      const {
        positions,
        wedgePositions,
        corners,
        parts: segments,
        partCount: segmentCount,
      } = (readVector(name) as Expected[])[0]!;
      const positionOf = (w: number) => positions.slice(3 * wedgePositions[w]!, 3 * wedgePositions[w]! + 3).join();
      const expected = Array.from({ length: segmentCount }, (_, segment) =>
        segments.flatMap((s, t) =>
          s === segment
            ? [
                corners
                  .slice(3 * t, 3 * t + 3)
                  .map(positionOf)
                  .join(" "),
              ]
            : [],
        ),
      );
      const buffers = new Base(decodedOf(decodeVector(name)[0]!)).segments;
      assert.equal(buffers.length, segmentCount);
      assert.deepEqual(
        buffers.map((segment) => {
          if (segment === undefined) return [];
          const {
            coord: { array, stride },
            vertexCount,
            attributes,
            others,
          } = segment;
          for (const vertices of [
            segment.coord,
            ...Object.values(attributes),
            ...others.map((other) => other.vertices),
          ])
            if (vertices) assert.equal(vertices.array.length, vertexCount * vertices.stride);
          const index = Array.from(segment.index!);
          assert.deepEqual(new Set(index), new Set(Array.from({ length: vertexCount }, (_, n) => n)));
          return Array.from({ length: index.length / 3 }, (_, t) =>
            index
              .slice(3 * t, 3 * t + 3)
              .map((n) => Array.from(array.subarray(n * stride, n * stride + 3)).join())
              .join(" "),
          );
        }),
        expected,
      );
    });
  }

  test("are joined in the whole base mesh", () => {
    const { corners, wedgePositions, positions } = (readVector("base-seams") as Expected[])[0]!;
    const { whole, segmentCount } = new Base(decodedOf(decodeVector("base-seams")[0]!));
    assert.deepEqual(Array.from(whole.index!), corners);
    const { array, stride } = whole.coord;
    const vertexPositions = Array.from({ length: whole.vertexCount }, (_, w) =>
      Array.from(array.subarray(stride * w, stride * w + 3)),
    );
    assert.deepEqual(
      vertexPositions,
      wedgePositions.map((v) => positions.slice(3 * v, 3 * v + 3)),
    );
    assert.ok(segmentCount > 1);
  });

  test("have one normal at each position, whatever seams the texture has", () => {
    const normals = new Map<string, string>();
    let seams = 0;
    for (const segment of new Base(decodedOf(decodeVector("base-seams")[0]!)).segments) {
      if (segment?.attributes.normal === undefined) continue;
      const { coord } = segment;
      const { normal } = segment.attributes;
      for (let n = 0; n < segment.vertexCount; ++n) {
        const at = ({ array, stride }: typeof coord) => array.subarray(n * stride, n * stride + 3).join();
        const known = normals.get(at(coord));
        if (known === undefined) normals.set(at(coord), at(normal));
        else assert.equal(at(normal), known);
        seams += Number(known !== undefined);
      }
    }
    assert.ok(seams > 10);
  });

  test("are refused in a patch that is no base mesh", () => {
    assert.throws(() => new Base(decodedOf(decodeVector("sphere")[0]!)), /a patch where a base should be/);
  });
});
