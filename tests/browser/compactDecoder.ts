// Decodes sites of the encoding compact into plain float buffers, in the page's drawing order. It uses the runtime's
// own decoder, which vectors/ and the C++ reader verify; the tests that use it verify how its values are drawn.

import { readFileSync } from "node:fs";
import { join } from "node:path";
import { decodePatches } from "../../web/src/decode/compact/patch.ts";
import { buffersOf } from "../../web/src/decode/compact/patchBuffers.ts";
import type { VertexArray } from "../../web/src/stage/vertexArray.ts";
import { decodePng } from "./png.ts";
import { numbersOf, tagsOf, type PlainPatch } from "./siteDecoder.ts";

/** All patches of the only geometry of the site. */
export function decodeCompactSite(directory: string): PlainPatch[] {
  const tags = tagsOf(readFileSync(join(directory, "index.html"), "utf8"));
  const node = tags.find(({ name }) => name === "imagegeometry")?.attributes ?? {};
  const bits = Number(node.positionbits ?? 16);
  const bytes = Math.ceil(bits / 8);
  const position = numbersOf(node.position, [0, 0, 0]);
  const size = numbersOf(node.size, [1, 1, 1]);
  const coordinate = (stored: number, axis: number): number =>
    position[axis]! - size[axis]! / 2 + (stored * 2 ** (8 * bytes - bits) * size[axis]!) / (256 ** bytes - 1);
  return tags
    .filter(({ attributes }) => attributes.data !== undefined)
    .map(({ attributes }) => {
      const [url, patchIndex] = attributes.data!.split("#");
      const { data } = decodePng(readFileSync(join(directory, url!)));
      const buffers = decodePatches(data, buffersOf)[Number(patchIndex ?? 0)]!;
      const { topology, coord, index, vertexCount } = buffers;
      const { normal } = buffers.attributes;
      const elementsOf = (kind: typeof topology): Uint32Array =>
        Uint32Array.from(topology === kind ? (index ?? indicesBelow(vertexCount)) : []);
      return {
        positions: Float32Array.from({ length: 3 * vertexCount }, (_, i) => coordinate(numberAt(coord, i), i % 3)),
        ...(normal && {
          normals: unitVectors(Float32Array.from({ length: 3 * vertexCount }, (_, i) => numberAt(normal, i))),
        }),
        triangles: elementsOf("triangles"),
        lines: elementsOf("lines"),
        points: elementsOf("points"),
      };
    });
}

function indicesBelow(count: number): number[] {
  return Array.from({ length: count }, (_, n) => n);
}

function numberAt({ array, stride, offset }: VertexArray, i: number): number {
  return array[Math.floor(i / 3) * stride + offset + (i % 3)]!;
}

function unitVectors(vectors: Float32Array<ArrayBuffer>): Float32Array<ArrayBuffer> {
  return vectors.map((component, i) => {
    const first = i - (i % 3);
    return component / Math.hypot(vectors[first]!, vectors[first + 1]!, vectors[first + 2]!);
  });
}
