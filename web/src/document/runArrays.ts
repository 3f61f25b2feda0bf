// Makes vertex arrays of runs of corners. Polygons become triangles, with normals and texture coordinates where the
// document has none.

import type { Corner, VertexArrays, VertexData } from "../tessellate/faces.ts";
import {
  fansOf,
  linesOf,
  trianglesOf,
  vertexArraysOf,
  withCreasedNormals,
  withDefaultTexCoords,
} from "../tessellate/faces.ts";
import type { Runs } from "./cornerRuns.ts";
import type { VertexLayout } from "./movingGeometry.ts";

/** How runs are drawn; for polygons also whether they are counter-clockwise and convex, and have hard edges. */
export interface RunStyle {
  readonly primitive: VertexArrays["primitive"];
  readonly ccw: boolean;
  readonly convex: boolean;
  /** Polygons without normals have hard edges where they meet at more than this angle, in radians. */
  readonly creaseAngle: number;
}

export interface RunArrays {
  /** Undefined where a corner names a value that the data lack. */
  readonly arrays: VertexArrays | undefined;
  readonly layout: Omit<VertexLayout, "nodes">;
}

export function arraysOfRuns(vertexData: VertexData, runs: Runs, style: RunStyle): RunArrays {
  const { primitive, ccw, convex, creaseAngle } = style;
  const made = (
    data: VertexData,
    corners: readonly Corner[],
    creasedNormals?: VertexLayout["creasedNormals"],
  ): RunArrays => ({
    arrays: vertexArraysOf(primitive, data, corners),
    layout: { corners, creasedNormals },
  });
  if (primitive === "points") return made(vertexData, runs.flat());
  if (primitive === "lines") return made(vertexData, linesOf(runs));
  const oriented = ccw ? runs : runs.map((run) => run.toReversed());
  const { data, faces } =
    vertexData.texCoords.length > 0
      ? { data: vertexData, faces: oriented }
      : withDefaultTexCoords(vertexData, oriented);
  const cornersOf = convex ? fansOf : (polygons: Runs) => trianglesOf(data.positions, polygons);
  if (data.normals.length > 0) return made(data, cornersOf(faces));
  const creased = withCreasedNormals(data, faces, creaseAngle);
  return made(creased.data, cornersOf(creased.faces), creased.normals);
}
