// Reads geometry nodes whose numbers are in the document. Their arrays become BG in data: URLs, so that delivery treats
// them like files, and an unchanged geometry has the same URL.

import { geometryOfArrays } from "./arrayGeometry.ts";
import type { GeometryDescription, Warning } from "./description.ts";
import type { Resolve, SceneElement } from "./element.ts";
import { childrenOf, lowerNameOf } from "./element.ts";
import { elevationGrid } from "../tessellate/elevationGrid.ts";
import { extrusion } from "../tessellate/extrusion.ts";
import type { Corner, Surface, VertexArrays, VertexData } from "../tessellate/faces.ts";
import {
  vertexArraysOf,
  fansOf,
  linesOf,
  trianglesOf,
  withCreasedNormals,
  withDefaultTexCoords,
} from "../tessellate/faces.ts";
import { withGeneratedTexCoords } from "../tessellate/texCoordModes.ts";
import { texCoordModeOf, texCoordSetsOf } from "./readTexCoords.ts";
import type { PlaneGeometry } from "../tessellate/geometry2d.ts";
import { arc, circle, closedArc, disk, polyline, polypoint, rectangle, triangles2d } from "../tessellate/geometry2d.ts";
import type { Values } from "./nodes.ts";
import { nodeFields, readFields } from "./nodes.ts";
import { entryOf } from "./tables.ts";
import type { Solid } from "../tessellate/solids.ts";
import { box, cylinderOrCone, sphere } from "../tessellate/solids.ts";

type Fields = Values<typeof nodeFields.InlineGeometry>;

/** Runs of corners: a polygon, polyline or point each. */
type Runs = readonly (readonly Corner[])[];

const solids: Readonly<Record<string, (element: SceneElement, warnings: Warning[]) => Solid>> = {
  box: (element, warnings) => box(readFields(element, nodeFields.Box, warnings).size),
  sphere: (element, warnings) => sphere(readFields(element, nodeFields.Sphere, warnings).radius),
  cylinder: (element, warnings) => {
    const values = readFields(element, nodeFields.Cylinder, warnings);
    return cylinderOrCone(values.radius, values.radius, values.height, values);
  },
  cone: (element, warnings) => {
    const values = readFields(element, nodeFields.Cone, warnings);
    return cylinderOrCone(0, values.bottomRadius, values.height, { ...values, top: false });
  },
};

type PlaneReader = (
  element: SceneElement,
  warnings: Warning[],
) => { readonly geometry: PlaneGeometry; readonly solid: boolean };

/** A reader of the node's fields that makes geometry of them; lines and points have no `solid`. */
function planeReader<Fields extends Parameters<typeof readFields>[1]>(
  fields: Fields,
  geometryOf: (values: Values<Fields>) => PlaneGeometry,
): PlaneReader {
  return (element, warnings) => {
    const values = readFields(element, fields, warnings);
    return { geometry: geometryOf(values), solid: "solid" in values && values.solid === true };
  };
}

const planeReaders: Readonly<Record<string, PlaneReader>> = {
  arc2d: planeReader(nodeFields.Arc2D, arc),
  arcclose2d: planeReader(nodeFields.ArcClose2D, closedArc),
  circle2d: planeReader(nodeFields.Circle2D, circle),
  disk2d: planeReader(nodeFields.Disk2D, disk),
  polyline2d: planeReader(nodeFields.Polyline2D, ({ lineSegments }) => polyline(lineSegments)),
  polypoint2d: planeReader(nodeFields.Polypoint2D, ({ point }) => polypoint(point)),
  rectangle2d: planeReader(nodeFields.Rectangle2D, rectangle),
  triangleset2d: planeReader(nodeFields.TriangleSet2D, ({ vertices }) => triangles2d(vertices)),
};

const runReaders: Readonly<Record<string, (fields: Fields, data: VertexData) => Runs>> = {
  indexedfaceset: (fields, data) => indexedRuns(fields, data),
  indexedlineset: (fields, data) => indexedRuns(fields, data),
  triangleset: (fields, data) => runsByVertex(fields, data, tuplesOf(3, indicesTo(data.positions.length / 3))),
  indexedtriangleset: (fields, data) =>
    runsByVertex(
      fields,
      data,
      tuplesOf(
        3,
        fields.index.filter((vertex) => vertex >= 0),
      ),
    ),
  quadset: (fields, data) => runsByVertex(fields, data, tuplesOf(4, indicesTo(data.positions.length / 3))),
  indexedquadset: (fields, data) =>
    runsByVertex(
      fields,
      data,
      tuplesOf(
        4,
        fields.index.filter((vertex) => vertex >= 0),
      ),
    ),
  trianglestripset: (fields, data) => runsByVertex(fields, data, consecutiveRuns(fields.stripCount).flatMap(strip)),
  indexedtrianglestripset: (fields, data) =>
    runsByVertex(fields, data, runsBetweenNegatives(fields.index).flatMap(strip)),
  trianglefanset: (fields, data) => runsByVertex(fields, data, consecutiveRuns(fields.fanCount).flatMap(fan)),
  indexedtrianglefanset: (fields, data) => runsByVertex(fields, data, runsBetweenNegatives(fields.index).flatMap(fan)),
  lineset: (fields, data) => runsByVertex(fields, data, consecutiveRuns(fields.vertexCount)),
  pointset: (fields, data) =>
    runsByVertex(
      fields,
      data,
      indicesTo(data.positions.length / 3).map((vertex) => [vertex]),
    ),
};

/** Nodes whose vertices are computed from other fields. */
const surfaces: Readonly<
  Record<string, (element: SceneElement, childData: VertexData, warnings: Warning[]) => Surface | undefined>
> = {
  elevationgrid: (element, childData, warnings) =>
    elevationGrid(readFields(element, nodeFields.ElevationGrid, warnings), childData),
  extrusion: (element, _, warnings) => extrusion(readFields(element, nodeFields.Extrusion, warnings)),
};

const primitives: Readonly<Record<string, VertexArrays["primitive"]>> = {
  indexedlineset: "lines",
  lineset: "lines",
  pointset: "points",
};

export interface InlineGeometryReader {
  /** Whether it reads nodes of this lower-case name. */
  readonly reads: (name: string) => boolean;
  /** Reads a geometry node; undefined for other nodes and for empty geometry. */
  readonly read: (element: SceneElement, resolve: Resolve, warnings: Warning[]) => GeometryDescription | undefined;
}

export const inlineGeometryReader: InlineGeometryReader = {
  reads: (name) => [solids, planeReaders, runReaders, surfaces].some((readers) => Object.hasOwn(readers, name)),
  read: readInlineGeometry,
};

function readInlineGeometry(
  element: SceneElement,
  resolve: Resolve,
  warnings: Warning[],
): GeometryDescription | undefined {
  const name = lowerNameOf(element);
  const readSolid = entryOf(solids, name),
    readPlane = entryOf(planeReaders, name),
    readRuns = entryOf(runReaders, name),
    readSurface = entryOf(surfaces, name);
  if (readPlane) return planeGeometryOf(readPlane, element, warnings);
  if (!readSolid && !readRuns && !readSurface) return undefined;
  const solidMesh = readSolid?.(element, warnings);
  const fields = readFields(element, nodeFields.InlineGeometry, solidMesh ? [] : warnings);
  if (solidMesh)
    return geometryOfArrays(vertexArraysOf("triangles", solidMesh.data, fansOf(solidMesh.faces)), fields.solid);
  const childData = vertexDataOf(element, resolve, warnings);
  const texCoordMode = texCoordModeOf(element, resolve, warnings);
  const surface = readSurface?.(element, childData, warnings);
  if (readSurface && !surface) warnings.push({ element, message: "its numbers make no surface; nothing is drawn" });
  const data = surface?.data ?? childData,
    runs = surface?.faces ?? readRuns?.(fields, childData) ?? [];
  const isCreased = readSurface !== undefined || name === "indexedfaceset";
  const arrays = arraysOfRuns(primitives[name] ?? "triangles", data, runs, fields, isCreased);
  if (arrays === undefined) warnings.push({ element, message: "it names vertices that it lacks; nothing is drawn" });
  return geometryOfArrays(arrays && withGeneratedTexCoords(arrays, texCoordMode), fields.solid, data.texCoordMappings);
}

function planeGeometryOf(
  readPlane: PlaneReader,
  element: SceneElement,
  warnings: Warning[],
): GeometryDescription | undefined {
  const {
    geometry: { primitive, data: ownData, faces: ownFaces },
    solid,
  } = readPlane(element, warnings);
  if (primitive === "points") return geometryOfArrays(vertexArraysOf(primitive, ownData, ownFaces.flat()), solid);
  if (primitive === "lines") return geometryOfArrays(vertexArraysOf(primitive, ownData, linesOf(ownFaces)), solid);
  const { data, faces } =
    ownData.texCoords.length > 0 ? { data: ownData, faces: ownFaces } : withDefaultTexCoords(ownData, ownFaces);
  return geometryOfArrays(vertexArraysOf(primitive, data, fansOf(faces)), solid);
}

function arraysOfRuns(
  primitive: VertexArrays["primitive"],
  vertexData: VertexData,
  runs: Runs,
  fields: Fields,
  isCreased: boolean,
): VertexArrays | undefined {
  if (primitive === "points") return vertexArraysOf(primitive, vertexData, runs.flat());
  if (primitive === "lines") return vertexArraysOf(primitive, vertexData, linesOf(runs));
  const oriented = fields.ccw ? runs : runs.map((run) => run.toReversed());
  const { data, faces } =
    vertexData.texCoords.length > 0
      ? { data: vertexData, faces: oriented }
      : withDefaultTexCoords(vertexData, oriented);
  const cornersOf = fields.convex ? fansOf : (polygons: Runs) => trianglesOf(data.positions, polygons);
  if (data.normals.length > 0) return vertexArraysOf(primitive, data, cornersOf(faces));
  // Sets of triangles are smooth across shared vertices; faces have hard edges up to creaseAngle.
  const angle = isCreased ? fields.creaseAngle : fields.normalPerVertex ? Math.PI : 0;
  const creased = withCreasedNormals(data, faces, angle);
  return vertexArraysOf(primitive, creased.data, cornersOf(creased.faces));
}

/** The first child with one of these lower-case names, its USE resolved. */
function childNamed(element: SceneElement, resolve: Resolve, ...names: string[]): SceneElement | undefined {
  const child = childrenOf(element).find((candidate) => names.includes(lowerNameOf(candidate)));
  return child && resolve(child);
}

function vertexDataOf(element: SceneElement, resolve: Resolve, warnings: Warning[]): VertexData {
  const coordinate = childNamed(element, resolve, "coordinate", "coordinatedouble");
  const normal = childNamed(element, resolve, "normal");
  const color = childNamed(element, resolve, "color", "colorrgba");
  const fogCoordinate = childNamed(element, resolve, "fogcoordinate");
  return {
    positions: coordinate ? readFields(coordinate, nodeFields.Coordinate, warnings).point : [],
    normals: normal ? readFields(normal, nodeFields.Normal, warnings).vector : [],
    ...texCoordSetsOf(element, resolve, warnings),
    colors: color ? readFields(color, nodeFields.Color, warnings).color : [],
    colorComponents: color && lowerNameOf(color) === "colorrgba" ? 4 : 3,
    fogDepths: fogCoordinate ? readFields(fogCoordinate, nodeFields.FogCoordinate, warnings).depth : [],
  };
}

/** The runs of coordIndex between its -1s, with the indices of the other attributes (ISO/IEC 19775-1, 11.2.2.4). */
function indexedRuns(fields: Fields, data: VertexData): Runs {
  const { coordIndex, normalIndex, colorIndex, texCoordIndex } = fields;
  const runs: Corner[][] = [[]];
  const indexOf = (indices: readonly number[], perVertex: boolean, corner: number, position: number) => {
    const attributeIndex = perVertex ? corner : runs.length - 1;
    return indices.length > 0 ? (indices[attributeIndex] ?? -1) : perVertex ? position : attributeIndex;
  };
  coordIndex.forEach((position, corner) => {
    if (position < 0) {
      runs.push([]);
      return;
    }
    runs.at(-1)?.push({
      position,
      normal: data.normals.length > 0 ? indexOf(normalIndex, fields.normalPerVertex, corner, position) : -1,
      texCoord: data.texCoords.length > 0 ? indexOf(texCoordIndex, true, corner, position) : -1,
      color: data.colors.length > 0 ? indexOf(colorIndex, fields.colorPerVertex, corner, position) : -1,
    });
  });
  return runs;
}

/** Corners whose attributes are indexed by the vertex, or by the face. */
function runsByVertex(fields: Fields, data: VertexData, runs: readonly (readonly number[])[]): Runs {
  return runs.map((run, face) =>
    run.map((position) => ({
      position,
      normal: data.normals.length === 0 ? -1 : fields.normalPerVertex ? position : face,
      texCoord: data.texCoords.length === 0 ? -1 : position,
      color: data.colors.length === 0 ? -1 : fields.colorPerVertex ? position : face,
    })),
  );
}

function indicesTo(count: number): number[] {
  return Array.from({ length: count }, (_, index) => index);
}

/** Whole tuples of successive vertices; the rest is left out. */
function tuplesOf(size: number, vertices: readonly number[]): number[][] {
  return indicesTo(Math.floor(vertices.length / size)).map((tuple) => vertices.slice(size * tuple, size * (tuple + 1)));
}

/** Runs of consecutive vertices of these lengths. */
function consecutiveRuns(counts: readonly number[]): number[][] {
  let next = 0;
  return counts.map((count) => indicesTo(Math.max(count, 0)).map(() => next++));
}

function runsBetweenNegatives(index: readonly number[]): number[][] {
  const runs: number[][] = [[]];
  for (const vertex of index) {
    if (vertex < 0) runs.push([]);
    else runs.at(-1)?.push(vertex);
  }
  return runs;
}

function fan(run: readonly number[]): number[][] {
  return run.slice(2).map((last, i) => [run[0] ?? 0, run[i + 1] ?? 0, last]);
}

function strip(run: readonly number[]): number[][] {
  return run.slice(2).map((last, i) => {
    const [first, second] = [run[i] ?? 0, run[i + 1] ?? 0];
    return i % 2 === 0 ? [first, second, last] : [first, last, second];
  });
}
