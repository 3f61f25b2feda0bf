// Intersects the ray through a pixel with a mesh (Möller and Trumbore 1997), over every triangle and in double
// precision, as the reference for picking.

import type { ReferenceScene } from "./reference.ts";
import type { PlainPatch } from "./siteDecoder.ts";
import { cross, dot, minus, unit, type Vec3 } from "./vectors.ts";

export interface RayHit {
  patch: number;
  /** Index of the triangle in its patch. */
  triangle: number;
  vertices: Vec3;
  barycentric: Vec3;
  position: Vec3;
  /** Interpolated from the vertices' normals; the triangle's normal where there are none. */
  normal: Vec3;
  distance: number;
}

export interface Ray {
  origin: Vec3;
  direction: Vec3;
}

/** The ray through the center of a pixel. */
export function rayThrough(
  { position, orientation, fieldOfView }: ReferenceScene["viewpoint"],
  { width, height }: { width: number; height: number },
  x: number,
  y: number,
): Ray {
  const scale = Math.tan(fieldOfView / 2) / Math.min(width, height);
  const inView: Vec3 = [(2 * x + 1 - width) * scale, (height - 2 * y - 1) * scale, -1];
  return { origin: position, direction: rotated(inView, orientation) };
}

/** Rotates `v` (Rodrigues' formula). */
function rotated(v: Vec3, [x, y, z, angle]: [number, number, number, number]): Vec3 {
  const length = Math.hypot(x, y, z) || 1;
  const axis: Vec3 = [x / length, y / length, z / length];
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  const turned = cross(axis, v);
  const along = dot(axis, v) * (1 - cos);
  return [0, 1, 2].map((i) => v[i]! * cos + turned[i]! * sin + axis[i]! * along) as Vec3;
}

/** The nearest triangle that faces the ray's origin. */
export function firstHit({ origin, direction }: Ray, patches: PlainPatch[]): RayHit | undefined {
  let found: RayHit | undefined;
  for (const [patch, mesh] of patches.entries()) {
    for (let t = 0; 3 * t < mesh.triangles.length; ++t) {
      const vertices = [...mesh.triangles.subarray(3 * t, 3 * t + 3)] as Vec3;
      const [a, b, c] = vertices.map((vertex) => vectorAt(mesh.positions, vertex)) as [Vec3, Vec3, Vec3];
      const [ab, ac] = [minus(b, a), minus(c, a)];
      const p = cross(direction, ac);
      const determinant = dot(ab, p);
      if (determinant <= 0) continue; // edge on, or seen from behind
      const toOrigin = minus(origin, a);
      const u = dot(toOrigin, p) / determinant;
      const q = cross(toOrigin, ab);
      const v = dot(direction, q) / determinant;
      const distance = dot(ac, q) / determinant;
      if (u < 0 || v < 0 || u + v > 1 || distance <= 0 || (found && found.distance <= distance)) continue;
      const barycentric: Vec3 = [1 - u - v, u, v];
      found = {
        patch,
        triangle: mesh.triangleIndices?.[t] ?? t,
        vertices,
        barycentric,
        distance,
        position: [0, 1, 2].map((i) => origin[i]! + distance * direction[i]!) as Vec3,
        normal: unit(mesh.normals ? mixed(mesh.normals, vertices, barycentric) : cross(ab, ac)),
      };
    }
  }
  return found;
}

function mixed(values: Float32Array, vertices: Vec3, barycentric: Vec3): Vec3 {
  return [0, 1, 2].map((i) =>
    barycentric.reduce((sum, share, corner) => sum + share * values[3 * vertices[corner]! + i]!, 0),
  ) as Vec3;
}

export function vectorAt(values: Float32Array, n: number): Vec3 {
  return [values[3 * n]!, values[3 * n + 1]!, values[3 * n + 2]!];
}
