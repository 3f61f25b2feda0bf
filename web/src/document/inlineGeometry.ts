// Reads geometry nodes whose numbers are in the document. Their arrays become BG in data: URLs, so that delivery treats
// them like files, and an unchanged geometry has the same URL.

import { geometryOfArrays } from "./arrayGeometry.ts";
import type { GeometryDescription, Warning } from "./description.ts";
import type { SceneElement } from "./element.ts";
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
import type { Values } from "./nodes.ts";
import { nodeFields, readFields } from "./nodes.ts";
import type { Solid } from "../tessellate/solids.ts";
import { box, cylinderOrCone, sphere } from "../tessellate/solids.ts";

/** The element that a USE names, or the element itself; undefined where the name is unknown. */
export type Resolve = (element: SceneElement) => SceneElement | undefined;

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

const runReaders: Readonly<Record<string, (fields: Fields, data: VertexData) => Runs>> = {
  indexedfaceset: (fields, data) => indexedRuns(fields, data),
  indexedlineset: (fields, data) => indexedRuns(fields, data),
  triangleset: (fields, data) => runsByVertex(fields, data, triplesOf(indicesTo(data.positions.length / 3))),
  indexedtriangleset: (fields, data) =>
    runsByVertex(fields, data, triplesOf(fields.index.filter((vertex) => vertex >= 0))),
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

/** Reads a geometry node; undefined for other nodes and for empty geometry. */
export type InlineGeometryReader = (
  element: SceneElement,
  resolve: Resolve,
  warnings: Warning[],
) => GeometryDescription | undefined;

export const readInlineGeometry: InlineGeometryReader = (element, resolve, warnings) => {
  const name = lowerNameOf(element);
  const readSolid = solids[name],
    readRuns = runReaders[name],
    readSurface = surfaces[name];
  if (!readSolid && !readRuns && !readSurface) return undefined;
  const solidMesh = readSolid?.(element, warnings);
  const fields = readFields(element, nodeFields.InlineGeometry, solidMesh ? [] : warnings);
  if (solidMesh)
    return geometryOfArrays(vertexArraysOf("triangles", solidMesh.data, fansOf(solidMesh.faces)), fields.solid);
  const childData = vertexDataOf(element, resolve, warnings);
  const surface = readSurface?.(element, childData, warnings);
  if (readSurface && !surface) warnings.push({ element, message: "its numbers make no surface; nothing is drawn" });
  const data = surface?.data ?? childData,
    runs = surface?.faces ?? readRuns?.(fields, childData) ?? [];
  const isCreased = readSurface !== undefined || name === "indexedfaceset";
  const arrays = arraysOfRuns(primitives[name] ?? "triangles", data, runs, fields, isCreased);
  if (arrays === undefined) warnings.push({ element, message: "it names vertices that it lacks; nothing is drawn" });
  return geometryOfArrays(arrays, fields.solid);
};

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

function vertexDataOf(element: SceneElement, resolve: Resolve, warnings: Warning[]): VertexData {
  const childNamed = (...names: string[]): SceneElement | undefined => {
    const child = childrenOf(element).find((candidate) => names.includes(lowerNameOf(candidate)));
    return child && resolve(child);
  };
  const [coordinate, normal, texCoord, color] = [
    childNamed("coordinate"),
    childNamed("normal"),
    childNamed("texturecoordinate"),
    childNamed("color", "colorrgba"),
  ];
  return {
    positions: coordinate ? readFields(coordinate, nodeFields.Coordinate, warnings).point : [],
    normals: normal ? readFields(normal, nodeFields.Normal, warnings).vector : [],
    texCoords: texCoord ? readFields(texCoord, nodeFields.TextureCoordinate, warnings).point : [],
    colors: color ? readFields(color, nodeFields.Color, warnings).color : [],
    colorComponents: color && lowerNameOf(color) === "colorrgba" ? 4 : 3,
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

function triplesOf(vertices: readonly number[]): number[][] {
  return indicesTo(Math.floor(vertices.length / 3)).map((triple) => vertices.slice(3 * triple, 3 * triple + 3));
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
