// X3D's 2D geometry (ISO/IEC 19775-1, clause 14): points, lines and faces in the plane z = 0, whose front is towards
// +z.

import type { Corner, Surface, VertexArrays } from "./faces.ts";

/** Segments of a full circle: steps of 7.5 degrees, as for round solids. */
const segmentCount = 48;

/** Each run of corners in `faces` is a polygon that is a fan about its first corner, a polyline, or a point. */
export interface PlaneGeometry extends Surface {
  readonly primitive: VertexArrays["primitive"];
}

type Point = readonly [x: number, y: number];

/** `texCoords` has one pair for each point, or is empty. */
function planeGeometry(
  primitive: VertexArrays["primitive"],
  points: readonly Point[],
  runs: readonly (readonly number[])[],
  texCoords: readonly Point[] = [],
): PlaneGeometry {
  const isSurface = primitive === "triangles";
  const cornerOf = (position: number): Corner => ({
    position,
    normal: isSurface ? 0 : -1,
    texCoord: texCoords.length > 0 ? position : -1,
    color: -1,
  });
  return {
    primitive,
    data: {
      positions: points.flatMap(([x, y]) => [x, y, 0]),
      normals: isSurface ? [0, 0, 1] : [],
      texCoords: texCoords.flat(),
      colors: [],
      colorComponents: 3,
    },
    faces: runs.map((run) => run.map(cornerOf)),
  };
}

function indices(count: number, first = 0): number[] {
  return Array.from({ length: count }, (_, i) => first + i);
}

function pointsOf(numbers: readonly number[]): Point[] {
  return indices(Math.floor(numbers.length / 2)).map((i) => [numbers[2 * i] ?? 0, numbers[2 * i + 1] ?? 0]);
}

/** The points of an arc, both ends included, counter-clockwise from `startAngle`; angles in radians. */
function arcPoints(radius: number, startAngle: number, sweep: number): Point[] {
  const segments = Math.max(1, Math.ceil((sweep / (2 * Math.PI)) * segmentCount - 1e-6));
  return indices(segments + 1).map((i) => {
    const angle = startAngle + (sweep * i) / segments;
    return [radius * Math.cos(angle), radius * Math.sin(angle)];
  });
}

/** The angle from start to end, counter-clockwise: equal angles, and those a full turn apart, are a full circle. */
function sweepOf(startAngle: number, endAngle: number): number {
  const difference = endAngle - startAngle;
  if (difference === 0 || Math.abs(difference) >= 2 * Math.PI) return 2 * Math.PI;
  return difference > 0 ? difference : difference + 2 * Math.PI;
}

/** The square around a circle of this radius shows the whole texture. */
function texCoordsInSquare(points: readonly Point[], radius: number): Point[] {
  return points.map(([x, y]) => [0.5 + x / (2 * radius), 0.5 + y / (2 * radius)]);
}

export interface ArcFields {
  readonly startAngle: number;
  readonly endAngle: number;
  readonly radius: number;
}

export function arc({ startAngle, endAngle, radius }: ArcFields): PlaneGeometry {
  const points = arcPoints(Math.abs(radius), startAngle, sweepOf(startAngle, endAngle));
  return planeGeometry("lines", points, [indices(points.length)]);
}

/** `closureType` CHORD closes the arc by a straight line, every other by two lines to the centre. */
export function closedArc({
  startAngle,
  endAngle,
  radius,
  closureType,
}: ArcFields & { readonly closureType: string }): PlaneGeometry {
  const rim = arcPoints(Math.abs(radius), startAngle, sweepOf(startAngle, endAngle));
  const points: Point[] = closureType.toUpperCase() === "CHORD" ? rim : [[0, 0], ...rim];
  return planeGeometry("triangles", points, [indices(points.length)], texCoordsInSquare(points, Math.abs(radius)));
}

export function circle({ radius }: { readonly radius: number }): PlaneGeometry {
  return arc({ startAngle: 0, endAngle: 2 * Math.PI, radius });
}

/** A disk, a ring, or, where both radii are equal, a circle. */
export function disk(fields: { readonly innerRadius: number; readonly outerRadius: number }): PlaneGeometry {
  const radii = [Math.abs(fields.innerRadius), Math.abs(fields.outerRadius)];
  const [inner, outer] = [Math.min(...radii), Math.max(...radii)];
  if (inner === outer) return circle({ radius: outer });
  if (inner === 0) return closedArc({ startAngle: 0, endAngle: 2 * Math.PI, radius: outer, closureType: "PIE" });
  const points = [inner, outer].flatMap((radius) => arcPoints(radius, 0, 2 * Math.PI));
  const ring = segmentCount + 1;
  const quads = indices(segmentCount).map((i) => [i, ring + i, ring + i + 1, i + 1]);
  return planeGeometry("triangles", points, quads, texCoordsInSquare(points, outer));
}

export function rectangle({ size: [width, height] }: { readonly size: readonly [number, number] }): PlaneGeometry {
  const texCoords: Point[] = [
    [0, 0],
    [1, 0],
    [1, 1],
    [0, 1],
  ];
  const points = texCoords.map(([s, t]): Point => [width * (s - 0.5), height * (t - 0.5)]);
  return planeGeometry("triangles", points, [indices(4)], texCoords);
}

/** `numbers`: x and y of each point. */
export function polyline(numbers: readonly number[]): PlaneGeometry {
  const points = pointsOf(numbers);
  return planeGeometry("lines", points, [indices(points.length)]);
}

/** `numbers`: x and y of each point. */
export function polypoint(numbers: readonly number[]): PlaneGeometry {
  const points = pointsOf(numbers);
  return planeGeometry(
    "points",
    points,
    indices(points.length).map((i) => [i]),
  );
}

/** `numbers`: x and y of each corner, three corners for each triangle. */
export function triangles2d(numbers: readonly number[]): PlaneGeometry {
  const points = pointsOf(numbers);
  return planeGeometry(
    "triangles",
    points,
    indices(Math.floor(points.length / 3)).map((triangle) => indices(3, 3 * triangle)),
  );
}
