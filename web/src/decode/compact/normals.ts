// Decodes normals: points of an octahedron, each predicted from the triangles around it (docs/formats/compact.md,
// "Normals").

import { DecodeError } from "../decodeError.ts";
import { exactModels, firstModels, flipModel, repeatModel, secondModels } from "./attributeModels.ts";
import type { AttributeType } from "./header.ts";
import type { DecodedShape } from "./neighbours.ts";
import { decodeRepeats } from "./neighbours.ts";
import { dominantAxis, NormalSums } from "./normalSums.ts";
import type { RangeDecoder } from "./rangeDecoder.ts";
import { bitLength, numberModelCount } from "./rangeDecoder.ts";

/** x, y, z of each wedge, |x| + |y| + |z| = 2^(bits - 1) - 1. Safe for untrusted bytes. Throws DecodeError. */
export function decodeNormals(decoder: RangeDecoder, type: AttributeType, shape: DecodedShape): Int32Array {
  return new NormalDecoder(decoder, type, shape, decodeRepeats(decoder, repeatModel, shape.wedges)).run();
}

/**
 * The same for normals that are not stored: each is its prediction. In a base mesh all wedges of a vertex share one
 * normal, predicted from all triangles around the vertex.
 */
export function deriveNormals(type: AttributeType, shape: DecodedShape): Int32Array {
  const previous = shape.header.segmentCount > 0 ? shape.wedges.seams?.previous : undefined;
  return new NormalDecoder(
    undefined,
    type,
    shape,
    Uint8Array.from(previous ?? [], (w) => Number(w >= 0)),
  ).run();
}

class NormalDecoder {
  /** Undefined: each normal is its prediction. */
  readonly #decoder: RangeDecoder | undefined;
  readonly #radius: number;
  readonly #repeats: Uint8Array;
  readonly #previous: Int32Array | undefined;
  readonly #normals: Int32Array;
  /**
   * x, y, z of the predicted direction of each wedge. Undefined in points and lines, where the previous normal is the
   * prediction.
   */
  readonly #sums: Int32Array | undefined;
  /** 1 if the previous normal was its prediction. */
  #wasExact: 0 | 1 = 0;

  constructor(decoder: RangeDecoder | undefined, type: AttributeType, shape: DecodedShape, repeats: Uint8Array) {
    this.#decoder = decoder;
    this.#radius = 2 ** (type.bits - 1) - 1;
    this.#repeats = repeats;
    this.#previous = shape.wedges.seams?.previous;
    this.#normals = new Int32Array(3 * shape.header.wedgeCount);
    this.#sums = shape.header.topology === "triangles" ? sumsOf(type, shape, repeats) : undefined;
  }

  run(): Int32Array {
    const normals = this.#normals;
    const repeats = this.#repeats;
    const sums = this.#sums;
    for (let w = 0; 3 * w < normals.length; ++w) {
      if (repeats.length > 0 && repeats[w] === 1) {
        const previous = 3 * this.#previous![w]!;
        normals.copyWithin(3 * w, previous, previous + 3);
      } else if (sums) {
        this.#decode(w, sums[3 * w]!, sums[3 * w + 1]!, sums[3 * w + 2]!);
      } else if (w > 0) {
        this.#decode(w, normals[3 * w - 3]!, normals[3 * w - 2]!, normals[3 * w - 1]!);
      } else {
        this.#decode(w, 0, 0, 0);
      }
    }
    return normals;
  }

  /** Decodes the normal of wedge w, predicted in the direction x, y, z of any length. */
  #decode(w: number, x: number, y: number, z: number): void {
    const decoder = this.#decoder;
    const normals = this.#normals;
    const axis = dominantAxis(x, y, z);
    let length = Math.abs(x) + Math.abs(y) + Math.abs(z);
    if (length === 0) length = z = 1;
    // u, v are the two components after the dominant one, in cyclic order.
    let u = this.#project(axis === 0 ? y : axis === 1 ? z : x, length);
    let v = this.#project(axis === 0 ? z : axis === 1 ? x : y, length);
    const isNegative = (axis === 0 ? x : axis === 1 ? y : z) < 0;
    let isFlipped = false;
    if (decoder && !this.#readIsExact(decoder)) {
      const residual = decoder.small(firstModels);
      u += residual;
      v += decoder.small(secondModels + numberModelCount * Math.min(bitLength(Math.abs(residual)), 7));
      const left = this.#radius - Math.abs(u) - Math.abs(v);
      if (left < 0) throw new DecodeError("malformed", "holds a normal outside of its octahedron");
      isFlipped = left > 0 && decoder.bit(flipModel) === 1;
    }
    const rest = this.#radius - Math.abs(u) - Math.abs(v);
    const first = 3 * w;
    normals[first + (axis === 2 ? 0 : axis + 1)] = u;
    normals[first + (axis === 0 ? 2 : axis - 1)] = v;
    normals[first + axis] = isNegative !== isFlipped ? -rest : rest;
  }

  /** Reads whether the normal is its prediction. */
  #readIsExact(decoder: RangeDecoder): boolean {
    this.#wasExact = decoder.bit(exactModels + this.#wasExact);
    return this.#wasExact === 1;
  }

  /** Projects a component of a vector with this L1 norm to the octahedron, rounded to the nearest integer. */
  #project(component: number, length: number): number {
    const magnitude = Math.floor((2 * this.#radius * Math.abs(component) + length) / (2 * length));
    return component < 0 ? -magnitude : magnitude;
  }
}

/**
 * The sum of the triangle normals around each wedge. Triangles of a wedge that repeats another one add to that one's
 * sum.
 */
function sumsOf(type: AttributeType, shape: DecodedShape, repeats: Uint8Array): Int32Array {
  const {
    header,
    connectivity: { vertex },
    wedges: { wedge, seams },
    coordinates,
    normalSums,
  } = shape;
  if (!type.isUniform && seams === undefined) return normalSums;
  const sums = new NormalSums(header.wedgeCount, coordinates, header.normalShift, type.isUniform);
  const target = new Int32Array(header.wedgeCount);
  for (let w = 0; w < target.length; ++w) target[w] = repeats[w] === 1 ? target[seams!.previous[w]!]! : w;
  // With weights by area, the sum of a wedge that is the only one of its vertex is that of the vertex.
  const isSplit = type.isUniform ? undefined : seams?.isSplit;
  for (let c = 0; c < vertex.length; c += 3) {
    const va = vertex[c]!;
    const vb = vertex[c + 1]!;
    const vc = vertex[c + 2]!;
    if (isSplit && (isSplit[va]! | isSplit[vb]! | isSplit[vc]!) === 0) continue;
    sums.add(va, vb, vc, target[wedge[c]!]!, target[wedge[c + 1]!]!, target[wedge[c + 2]!]!);
  }
  const all = sums.sums;
  for (let w = 0; isSplit && w < header.wedgeCount; ++w) {
    const v = vertex[seams!.corner[w]!]!;
    if (isSplit[v] === 0) for (let axis = 0; axis < 3; ++axis) all[3 * w + axis] = normalSums[3 * v + axis]!;
  }
  return all;
}
