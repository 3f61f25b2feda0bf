// The parts of a base against the vectors' plain numbers.

import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { Base } from "./baseBuffers.ts";
import { decodeVector, readVector } from "./vectors.testing.ts";

interface Expected {
  readonly positions: number[];
  readonly wedgePositions: number[];
  readonly corners: number[];
  readonly parts: number[];
  readonly partCount: number;
}

describe("the parts of a base", () => {
  for (const name of ["base", "base-colors", "base-seams"]) {
    test(`of "${name}" have the triangles of the whole, each once, over vertices of their own`, () => {
      const { positions, wedgePositions, corners, parts, partCount } = (readVector(name) as Expected[])[0]!;
      const placeOf = (w: number) => positions.slice(3 * wedgePositions[w]!, 3 * wedgePositions[w]! + 3).join();
      const expected = Array.from({ length: partCount }, (_, part) =>
        parts.flatMap((p, t) =>
          p === part
            ? [
                corners
                  .slice(3 * t, 3 * t + 3)
                  .map(placeOf)
                  .join(" "),
              ]
            : [],
        ),
      );
      const buffers = new Base(decodeVector(name)[0]!).segments;
      assert.equal(buffers.length, partCount);
      assert.deepEqual(
        buffers.map((part) => {
          if (part === undefined) return [];
          const {
            coord: { array, stride },
            vertexCount,
            normal,
            color,
            texCoord,
            others,
          } = part;
          for (const vertices of [part.coord, normal, color, texCoord, ...others.map((other) => other.vertices)])
            if (vertices) assert.equal(vertices.array.length, vertexCount * vertices.stride);
          const index = Array.from(part.index!);
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

  test("are all in one at first", () => {
    const { corners, wedgePositions, positions } = (readVector("base-seams") as Expected[])[0]!;
    const { whole, segmentCount: partCount } = new Base(decodeVector("base-seams")[0]!);
    assert.deepEqual(Array.from(whole.index!), corners);
    const { array, stride } = whole.coord;
    const places = Array.from({ length: whole.vertexCount }, (_, w) =>
      Array.from(array.subarray(stride * w, stride * w + 3)),
    );
    assert.deepEqual(
      places,
      wedgePositions.map((v) => positions.slice(3 * v, 3 * v + 3)),
    );
    assert.ok(partCount > 1);
  });

  test("have one normal at each place, whatever seams the texture has", () => {
    const normals = new Map<string, string>();
    let seams = 0;
    for (const part of new Base(decodeVector("base-seams")[0]!).segments) {
      if (part?.normal === undefined) continue;
      const { coord, normal } = part;
      for (let n = 0; n < part.vertexCount; ++n) {
        const at = ({ array, stride }: typeof coord) => array.subarray(n * stride, n * stride + 3).join();
        const known = normals.get(at(coord));
        if (known === undefined) normals.set(at(coord), at(normal));
        else assert.equal(at(normal), known);
        seams += Number(known !== undefined);
      }
    }
    assert.ok(seams > 10);
  });

  test("are not those of a patch", () => {
    assert.throws(() => new Base(decodeVector("sphere")[0]!), /a patch where a base should be/);
  });
});
