import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { VertexArray } from "../../stage/vertexArray.ts";
import { buffersOf } from "./patchBuffers.ts";
import { decodeVector, vectorNames } from "./vectors.testing.ts";

function at({ array, components, stride, offset }: VertexArray, n: number): number[] {
  return Array.from(array.subarray(stride * n + offset, stride * n + offset + components));
}

/** The vertices of each element as text, in sorted order. */
function elementsOf(corners: ArrayLike<number>, perElement: number, textOf: (wedge: number) => string): string[] {
  return Array.from({ length: corners.length / perElement }, (_, element) =>
    Array.from({ length: perElement }, (_, i) => textOf(corners[perElement * element + i]!)).join(" | "),
  ).sort();
}

describe("buffers", () => {
  for (const name of vectorNames()) {
    test(`of "${name}" draw the elements of the patch at its positions`, () => {
      const patch = decodeVector(name)[0]!;
      const {
        header,
        wedges: { wedge, seams },
        connectivity: { vertex },
        coordinates,
      } = patch;
      const buffers = buffersOf(patch);
      const perElement = { points: 1, lines: 2, triangles: 3 }[header.topology];
      const identity = Array.from({ length: header.wedgeCount }, (_, n) => n);
      const positionOf = (w: number) => {
        const v = seams ? vertex[seams.corner[w]!]! : w;
        return coordinates.subarray(3 * v, 3 * v + 3);
      };
      assert.deepEqual(
        elementsOf(buffers.index ?? identity, perElement, (w) => `${w}: ${at(buffers.coord, w).join()}`),
        elementsOf(
          header.topology === "points" ? identity : wedge,
          perElement,
          (w) => `${w}: ${Array.from(positionOf(w), Math.fround).join()}`,
        ),
      );
      assert.equal(buffers.vertexCount, header.wedgeCount);
      const { BYTES_PER_ELEMENT } = buffers.coord.array;
      assert.equal(BYTES_PER_ELEMENT, header.positionBits <= 8 ? 1 : header.positionBits <= 16 ? 2 : 4);
    });

    test(`of "${name}" hold its normals and colours, rounded to half a step`, () => {
      const patch = decodeVector(name)[0]!;
      const buffers = buffersOf(patch);
      for (const [attributeIndex, { kind, bits, components }] of patch.header.attributes.entries()) {
        if (kind === "other" || patch.header.attributes.findIndex((type) => type.kind === kind) < attributeIndex)
          continue;
        const buffer = buffers.attributes[kind];
        assert.ok(buffer);
        const maxOutput = kind === "normal" ? 1 : buffer.array.BYTES_PER_ELEMENT === 1 ? 255 : 65535;
        const maxStored = kind === "normal" ? 1 : 2 ** bits - 1;
        for (let n = 0; n < buffers.vertexCount; ++n) {
          at(buffer, n).forEach((value, i) => {
            const exact = (patch.attributes[attributeIndex]![components * n + i]! * maxOutput) / maxStored;
            assert.ok(Math.abs(value - exact) <= 0.5, `${kind} ${n}: ${value} for ${exact}`);
          });
        }
      }
    });
  }

  test("have 16-bit indices up to 65,535 vertices", () => {
    const patch = decodeVector("triangle")[0]!;
    const indexOf = (wedgeCount: number) =>
      buffersOf({
        ...patch,
        header: { ...patch.header, wedgeCount, attributes: [] },
        coordinates: new Int32Array(3 * wedgeCount),
      }).index;
    assert.ok(indexOf(65535) instanceof Uint16Array);
    assert.ok(indexOf(65536) instanceof Uint32Array);
  });
});
