// Polygons, lines and points as X3D's geometry nodes state them -> arrays to draw.
// The same as src/import/x3d/faces.h, for what stands in a page.

import { triangulate } from "./earClipping.ts";

/** Values by number, three a vector or colour. */
export interface VertexData {
  readonly positions: readonly number[];
  readonly normals: readonly number[];
  /** Two each. */
  readonly texCoords: readonly number[];
  /** 3 or 4 a colour. */
  readonly colors: readonly number[];
  readonly colorComponents: 3 | 4;
}

/** Numbers of values; -1 where there are none. */
export interface Corner {
  readonly position: number;
  readonly normal: number;
  readonly texCoord: number;
  readonly color: number;
}

export interface VertexArrays {
  readonly primitive: "triangles" | "lines" | "points";
  /** A record for each corner, which are drawn in order. */
  readonly positions: Float32Array;
  readonly normals: Float32Array | undefined;
  readonly texCoords: Float32Array | undefined;
  readonly colors: Uint8Array | undefined;
  readonly colorComponents: 3 | 4;
}

/** Polygons as fans about their first corner. */
export function fansOf(faces: readonly (readonly Corner[])[]): Corner[] {
  return faces.flatMap((face) =>
    face.slice(2).flatMap((corner, i) => {
      const [first, second] = [face[0], face[i + 1]];
      return first && second ? [first, second, corner] : [];
    }),
  );
}

/** Polygons that may be concave. */
export function trianglesOf(positions: readonly number[], faces: readonly (readonly Corner[])[]): Corner[] {
  return faces.flatMap((face) => {
    const ring = face.map(({ position }): readonly [number, number, number] => [
      positions[3 * position] ?? 0,
      positions[3 * position + 1] ?? 0,
      positions[3 * position + 2] ?? 0,
    ]);
    return triangulate(ring).flatMap((place) => face[place] ?? []);
  });
}

/** The lines of runs. */
export function linesOf(runs: readonly (readonly Corner[])[]): Corner[] {
  return runs.flatMap((run) =>
    run.slice(1).flatMap((corner, i) => {
      const before = run[i];
      return before ? [before, corner] : [];
    }),
  );
}

/**
 * Normals for faces without: each corner has the mean of the faces around its
 * position that are turned from its own by no more than `creaseAngle`, in radians.
 */
export function withCreasedNormals(
  data: VertexData,
  faces: readonly (readonly Corner[])[],
  creaseAngle: number,
): { data: VertexData; faces: Corner[][] } {
  const faceNormals = faces.map((face) => newellNormal(data.positions, face));
  const around = new Map<number, number[]>();
  faces.forEach((face, number) => {
    for (const { position } of face) around.set(position, [...(around.get(position) ?? []), number]);
  });
  const least = Math.cos(Math.min(creaseAngle, Math.PI)) - 1e-9;
  const normals: number[] = [];
  const creased = faces.map((face, number) =>
    face.map((corner) => {
      const own = faceNormals[number] ?? [0, 0, 0];
      const sum = [0, 0, 0];
      for (const other of around.get(corner.position) ?? []) {
        const normal = faceNormals[other] ?? [0, 0, 0];
        if (other === number || dot(own, normal) >= least)
          normal.forEach((value, axis) => {
            sum[axis] = (sum[axis] ?? 0) + value;
          });
      }
      normals.push(...unit(sum));
      return { ...corner, normal: normals.length / 3 - 1 };
    }),
  );
  return { data: { ...data, normals }, faces: creased };
}

/** Where the document has no texture coordinates: over the box, s along its longest side and t along the next (ISO/IEC 19775-1, 13.3.6). */
export function withDefaultTexCoords(
  data: VertexData,
  faces: readonly (readonly Corner[])[],
): { data: VertexData; faces: Corner[][] } {
  const along = (axis: number) => {
    let [least, most] = [Infinity, -Infinity];
    for (let at = axis; at < data.positions.length; at += 3) {
      least = Math.min(least, data.positions[at] ?? 0);
      most = Math.max(most, data.positions[at] ?? 0);
    }
    return { axis, least, extent: most - least };
  };
  const [s, t] = [0, 1, 2].map(along).sort((a, b) => b.extent - a.extent || a.axis - b.axis);
  const texCoords: number[] = [];
  for (let first = 0; s && t && first < data.positions.length; first += 3) {
    for (const { axis, least } of [s, t])
      texCoords.push(((data.positions[first + axis] ?? 0) - least) / (s.extent || 1));
  }
  return {
    data: { ...data, texCoords },
    faces: faces.map((face) => face.map((corner) => ({ ...corner, texCoord: corner.position }))),
  };
}

function newellNormal(positions: readonly number[], face: readonly Corner[]): number[] {
  const at = (corner: Corner | undefined, axis: number) => positions[3 * (corner?.position ?? 0) + axis] ?? 0;
  const sum = [0, 0, 0];
  face.forEach((corner, i) => {
    const next = face[(i + 1) % face.length];
    for (const axis of [0, 1, 2]) {
      const [b, c] = [(axis + 1) % 3, (axis + 2) % 3];
      sum[axis] = (sum[axis] ?? 0) + at(corner, b) * at(next, c) - at(corner, c) * at(next, b);
    }
  });
  return unit(sum);
}

function dot(a: readonly number[], b: readonly number[]): number {
  return a.reduce((sum, value, axis) => sum + value * (b[axis] ?? 0), 0);
}

function unit(vector: readonly number[]): number[] {
  const length = Math.hypot(...vector);
  return length > 0 ? vector.map((value) => value / length) : [0, 0, 1];
}

/** Undefined where a corner names what there is not. */
export function vertexArraysOf(
  primitive: VertexArrays["primitive"],
  data: VertexData,
  corners: readonly Corner[],
): VertexArrays | undefined {
  const { colorComponents } = data;
  const take = (values: readonly number[], size: number, number: (corner: Corner) => number): number[] | undefined => {
    const taken: number[] = [];
    for (const corner of corners) {
      const first = number(corner) * size;
      if (first < 0 || first + size > values.length) return undefined;
      for (let i = 0; i < size; ++i) taken.push(values[first + i] ?? 0);
    }
    return taken;
  };
  const positions = take(data.positions, 3, ({ position }) => position);
  const normals = data.normals.length > 0 ? take(data.normals, 3, ({ normal }) => normal) : [];
  const texCoords = data.texCoords.length > 0 ? take(data.texCoords, 2, ({ texCoord }) => texCoord) : [];
  const colors = data.colors.length > 0 ? take(data.colors, colorComponents, ({ color }) => color) : [];
  if (positions === undefined || normals === undefined || texCoords === undefined || colors === undefined)
    return undefined;
  return {
    primitive,
    colorComponents,
    positions: Float32Array.from(positions),
    normals: normals.length > 0 ? Float32Array.from(normals) : undefined,
    texCoords: texCoords.length > 0 ? Float32Array.from(texCoords) : undefined,
    colors:
      colors.length > 0
        ? Uint8Array.from(colors, (value) => Math.round(255 * Math.min(Math.max(value, 0), 1)))
        : undefined,
  };
}
