// Polygons, lines and points with indexed attributes, as X3D's geometry nodes have them, become vertex arrays.
// Crease normals are those of src/import/x3d/faces.cpp: vectors/tessellation/creaseNormals.json tests both.

import { CreasedNormals } from "./creasedNormals.ts";
import { triangulate } from "./earClipping.ts";
import type { Vec3 } from "./vectors.ts";

/** Attribute values that corners index; an empty list means that the geometry lacks the attribute. */
export interface VertexData {
  /** x, y and z of each. */
  readonly positions: readonly number[];
  /** x, y and z of each. */
  readonly normals: readonly number[];
  /** s and t of each. */
  readonly texCoords: readonly number[];
  /** Sets of texture coordinates beside the first, with the same indices. */
  readonly furtherTexCoords?: readonly (readonly number[])[];
  /** The names of all sets. */
  readonly texCoordMappings?: readonly string[];
  /** `colorComponents` numbers each, 0 … 1. */
  readonly colors: readonly number[];
  readonly colorComponents: 3 | 4;
  /** The depth in fog of each position; the last one is that of all further positions too. */
  readonly fogDepths?: readonly number[];
}

/** Indices into VertexData; -1 where the attribute is absent. */
export interface Corner {
  readonly position: number;
  readonly normal: number;
  readonly texCoord: number;
  readonly color: number;
}

/** A tessellated surface: attribute values, and polygons whose corners index them. */
export interface Surface {
  readonly data: VertexData;
  readonly faces: readonly (readonly Corner[])[];
}

export interface VertexArrays {
  readonly primitive: "triangles" | "lines" | "points";
  /** One vertex for each corner, drawn in order, without an index. */
  readonly positions: Float32Array<ArrayBuffer>;
  readonly normals: Float32Array<ArrayBuffer> | undefined;
  readonly texCoords: Float32Array<ArrayBuffer> | undefined;
  /** Sets of texture coordinates beside the first. */
  readonly furtherTexCoords?: readonly Float32Array<ArrayBuffer>[];
  readonly colors: Uint8Array<ArrayBuffer> | undefined;
  readonly colorComponents: 3 | 4;
  readonly fogDepths?: Float32Array<ArrayBuffer> | undefined;
}

/**
 * Cuts each polygon into a fan about its first corner, which is correct for convex polygons, and returns the triangles'
 * corners.
 */
export function fansOf(faces: readonly (readonly Corner[])[]): Corner[] {
  return faces.flatMap((face) =>
    face.slice(2).flatMap((corner, i) => {
      const [first, second] = [face[0], face[i + 1]];
      return first && second ? [first, second, corner] : [];
    }),
  );
}

/** Triangulates polygons, concave ones included, and returns the triangles' corners. */
export function trianglesOf(positions: readonly number[], faces: readonly (readonly Corner[])[]): Corner[] {
  return faces.flatMap((face) => {
    const ring = face.map(({ position }) => vectorAt(positions, position));
    return triangulate(ring).flatMap((index) => face[index] ?? []);
  });
}

/** The two ends of each segment of polylines. */
export function linesOf(polylines: readonly (readonly Corner[])[]): Corner[] {
  return polylines.flatMap((polyline) =>
    polyline.slice(1).flatMap((corner, i) => {
      const before = polyline[i];
      return before ? [before, corner] : [];
    }),
  );
}

/** Computes normals for each corner, as CreasedNormals says; `creaseAngle` in radians. */
export function withCreasedNormals(
  data: VertexData,
  faces: readonly (readonly Corner[])[],
  creaseAngle: number,
): { data: VertexData; faces: Corner[][]; normals: CreasedNormals } {
  const normals = new CreasedNormals(
    faces.map((face) => face.map(({ position }) => position)),
    creaseAngle,
  );
  let normal = 0;
  const creased = faces.map((face) => face.map((corner) => ({ ...corner, normal: normal++ })));
  return { data: { ...data, normals: Array.from(normals.compute(data.positions)) }, faces: creased, normals };
}

/**
 * Adds X3D's default texture coordinates: s runs along the longest side of the bounding box, t along the next (ISO/IEC
 * 19775-1, 13.3.6).
 */
export function withDefaultTexCoords(
  data: VertexData,
  faces: readonly (readonly Corner[])[],
): { data: VertexData; faces: Corner[][] } {
  const rangeAlong = (axis: number) => {
    let [min, max] = [Infinity, -Infinity];
    for (let i = axis; i < data.positions.length; i += 3) {
      min = Math.min(min, data.positions[i] ?? 0);
      max = Math.max(max, data.positions[i] ?? 0);
    }
    return { axis, min, extent: max - min };
  };
  const [s, t] = [0, 1, 2].map(rangeAlong).sort((a, b) => b.extent - a.extent || a.axis - b.axis);
  const texCoords: number[] = [];
  for (let first = 0; s && t && first < data.positions.length; first += 3) {
    for (const { axis, min } of [s, t]) texCoords.push(((data.positions[first + axis] ?? 0) - min) / (s.extent || 1));
  }
  return {
    data: { ...data, texCoords },
    faces: faces.map((face) => face.map((corner) => ({ ...corner, texCoord: corner.position }))),
  };
}

function vectorAt(numbers: readonly number[], index: number): Vec3 {
  return [numbers[3 * index] ?? 0, numbers[3 * index + 1] ?? 0, numbers[3 * index + 2] ?? 0];
}

/** The vertex arrays of the corners, in order; undefined where a corner names a value that `data` lacks. */
export function vertexArraysOf(
  primitive: VertexArrays["primitive"],
  data: VertexData,
  corners: readonly Corner[],
): VertexArrays | undefined {
  const { colorComponents } = data;
  const take = (values: readonly number[], size: number, indexOf: (corner: Corner) => number): number[] | undefined => {
    const taken: number[] = [];
    for (const corner of corners) {
      const first = indexOf(corner) * size;
      if (first < 0 || first + size > values.length) return undefined;
      for (let i = 0; i < size; ++i) taken.push(values[first + i] ?? 0);
    }
    return taken;
  };
  const positions = take(data.positions, 3, ({ position }) => position);
  const normals = data.normals.length > 0 ? take(data.normals, 3, ({ normal }) => normal) : [];
  const texCoords = data.texCoords.length > 0 ? take(data.texCoords, 2, ({ texCoord }) => texCoord) : [];
  const furtherTexCoords = (data.furtherTexCoords ?? []).map((each) => take(each, 2, ({ texCoord }) => texCoord));
  const colors = data.colors.length > 0 ? take(data.colors, colorComponents, ({ color }) => color) : [];
  if (positions === undefined || normals === undefined || texCoords === undefined || colors === undefined)
    return undefined;
  if (furtherTexCoords.includes(undefined)) return undefined;
  const { fogDepths = [] } = data;
  return {
    primitive,
    colorComponents,
    positions: Float32Array.from(positions),
    normals: normals.length > 0 ? Float32Array.from(normals) : undefined,
    texCoords: texCoords.length > 0 ? Float32Array.from(texCoords) : undefined,
    furtherTexCoords: furtherTexCoords.map((each) => Float32Array.from(each ?? [])),
    colors:
      colors.length > 0
        ? Uint8Array.from(colors, (value) => Math.round(255 * Math.min(Math.max(value, 0), 1)))
        : undefined,
    fogDepths:
      fogDepths.length > 0
        ? Float32Array.from(corners, ({ position }) => fogDepths[position] ?? fogDepths.at(-1) ?? 0)
        : undefined,
  };
}
