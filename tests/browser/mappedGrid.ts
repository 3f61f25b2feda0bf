// The surface of a grid after operators, computed by hand, for reference pictures.

import { meshOf, surfaceOver, type GridExample } from "./generators/grids.ts";
import { decodePng } from "./png.ts";
import type { Vec3 } from "./vectors.ts";
import type { PlainPatch } from "./siteDecoder.ts";

/** The mapped point and the direction of its normal. */
export type Mapping = (point: Vec3, normal: Vec3) => readonly [point: Vec3, normal: Vec3];

/** The weighted mean of the neighbours of each vertex: as many on both sides, where the grid ends. */
function blurredPositions({ columns, rows }: GridExample, positions: Float32Array, radius: number): Float32Array {
  const reach = Math.ceil(radius);
  return positions.map((_, i) => {
    const [column, row] = [Math.floor(i / 3) % columns, Math.floor(i / 3 / columns)];
    const across = Math.min(reach, column, columns - 1 - column);
    const down = Math.min(reach, row, rows - 1 - row);
    let [sum, total] = [0, 0];
    for (let y = -down; y <= down; ++y)
      for (let x = -across; x <= across; ++x) {
        const weight = Math.exp((-2 * (x * x + y * y)) / radius ** 2);
        sum += weight * positions[i + 3 * (y * columns + x)]!;
        total += weight;
      }
    return sum / total;
  });
}

/** The surface of the example, blurred and then mapped. `isMirroring`: the mapping exchanges front and back. */
export function mappedMesh(example: GridExample, map: Mapping, isMirroring: boolean, blurRadius = 0): PlainPatch {
  const sharp = meshOf(
    example,
    [...example.files.values()].map((file) => decodePng(file)),
  );
  const plain = blurRadius > 0 ? surfaceOver(example, blurredPositions(example, sharp.positions, blurRadius)) : sharp;
  const { normals } = plain;
  const vectorAt = (array: ArrayLike<number>, n: number): Vec3 => [array[3 * n]!, array[3 * n + 1]!, array[3 * n + 2]!];
  const positions = new Float32Array(plain.positions.length);
  const mappedNormals = new Float32Array(plain.positions.length);
  for (let n = 0; n < positions.length / 3; ++n) {
    const [point, normal] = map(vectorAt(plain.positions, n), vectorAt(normals!, n));
    positions.set(point, 3 * n);
    mappedNormals.set(
      normal.map((part) => part / Math.hypot(...normal)),
      3 * n,
    );
  }
  const triangles = plain.triangles.slice();
  if (isMirroring) for (let n = 0; n < triangles.length; n += 3) triangles.subarray(n + 1, n + 3).reverse();
  return { ...plain, positions, normals: mappedNormals, triangles };
}
