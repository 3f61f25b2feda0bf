// Reads geometry nodes whose numbers are in the document. Their arrays become BG in data: URLs, so that delivery treats
// them like files, and an unchanged geometry has the same URL.

import { geometryOfArrays, geometryOfMovingArrays } from "./arrayGeometry.ts";
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
import type { MovingValues } from "./movingValues.ts";
import type { MovingAttribute, VertexLayout } from "./movingGeometry.ts";
import { MovingGeometry } from "./movingGeometry.ts";
import { nodeFields, readFields } from "./nodes.ts";
import { entryOf } from "./tables.ts";
import type { Solid } from "../tessellate/solids.ts";
import { box, cylinderOrCone, sphere } from "../tessellate/solids.ts";

type Fields = Values<typeof nodeFields.InlineGeometry>;

/** Runs of corners: a polygon, polyline or point each. */
type Runs = readonly (readonly Corner[])[];

/** False with a warning for a solid of negative size: its outside would be inside. */
function areSizes(sizes: readonly number[], element: SceneElement, warnings: Warning[]): boolean {
  const isSize = Math.min(...sizes) >= 0;
  if (!isSize) warnings.push({ element, message: "a size is negative; nothing is drawn" });
  return isSize;
}

const solids: Readonly<Record<string, (element: SceneElement, warnings: Warning[]) => Solid | undefined>> = {
  box: (element, warnings) => {
    const { size } = readFields(element, nodeFields.Box, warnings);
    return areSizes(size, element, warnings) ? box(size) : undefined;
  },
  sphere: (element, warnings) => {
    const { radius } = readFields(element, nodeFields.Sphere, warnings);
    return areSizes([radius], element, warnings) ? sphere(radius) : undefined;
  },
  cylinder: (element, warnings) => {
    const values = readFields(element, nodeFields.Cylinder, warnings);
    const { radius, height } = values;
    return areSizes([radius, height], element, warnings) ? cylinderOrCone(radius, radius, height, values) : undefined;
  },
  cone: (element, warnings) => {
    const values = readFields(element, nodeFields.Cone, warnings);
    const { bottomRadius, height } = values;
    if (!areSizes([bottomRadius, height], element, warnings)) return undefined;
    return cylinderOrCone(0, bottomRadius, height, { ...values, top: false });
  },
};

type PlaneReader = (
  element: SceneElement,
  warnings: Warning[],
  moving: MovingValues | undefined,
) => { readonly geometry: PlaneGeometry; readonly solid: boolean };

/** The fields of an element, with the numbers that animation has given them. */
function readMovingFields<NodeFields extends Parameters<typeof readFields>[1]>(
  element: SceneElement,
  fields: NodeFields,
  warnings: Warning[],
  moving: MovingValues | undefined,
): Values<NodeFields> {
  return { ...readFields(element, fields, warnings), ...moving?.fieldsOf(element) };
}

/** A reader of the node's fields that makes geometry of them; lines and points have no `solid`. */
function planeReader<Fields extends Parameters<typeof readFields>[1]>(
  fields: Fields,
  geometryOf: (values: Values<Fields>) => PlaneGeometry,
): PlaneReader {
  return (element, warnings, moving) => {
    const values = readMovingFields(element, fields, warnings, moving);
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
  Record<
    string,
    (
      element: SceneElement,
      childData: VertexData,
      warnings: Warning[],
      moving: MovingValues | undefined,
    ) => Surface | undefined
  >
> = {
  elevationgrid: (element, childData, warnings, moving) =>
    elevationGrid(readMovingFields(element, nodeFields.ElevationGrid, warnings, moving), childData),
  extrusion: (element, _, warnings, moving) =>
    extrusion(readMovingFields(element, nodeFields.Extrusion, warnings, moving)),
};

const primitives: Readonly<Record<string, VertexArrays["primitive"]>> = {
  indexedlineset: "lines",
  lineset: "lines",
  pointset: "points",
};

export interface InlineGeometryReader {
  /** Whether it reads nodes of this lower-case name. */
  readonly reads: (name: string) => boolean;
  /**
   * Reads a geometry node; undefined for other nodes and for empty geometry. Where `moving` has numbers of its nodes,
   * they count, and the geometry moves with them.
   */
  readonly read: (
    element: SceneElement,
    resolve: Resolve,
    warnings: Warning[],
    moving?: MovingValues,
  ) => GeometryDescription | undefined;
}

export const inlineGeometryReader: InlineGeometryReader = {
  reads: (name) => [solids, planeReaders, runReaders, surfaces].some((readers) => Object.hasOwn(readers, name)),
  read: readInlineGeometry,
};

function readInlineGeometry(
  element: SceneElement,
  resolve: Resolve,
  warnings: Warning[],
  moving?: MovingValues,
): GeometryDescription | undefined {
  const vertices = inlineVerticesOf(element, resolve, warnings, moving);
  if (vertices?.arrays === undefined) return undefined;
  const { arrays, solid, texCoordMappings, layout, nodes } = vertices;
  const sources = [element, ...nodes.keys()];
  if (moving === undefined || arrays.positions.length === 0 || !sources.some((node) => moving.has(node)))
    return geometryOfArrays(arrays, solid, texCoordMappings);
  const known = moving.geometryOf(element);
  const wholeLayout = layout && { ...layout, nodes };
  const geometry = known?.follow(arrays, wholeLayout)
    ? known
    : new MovingGeometry(arrays, wholeLayout, () => inlineVerticesOf(element, resolve, [], moving)?.arrays);
  moving.join(sources, element, geometry);
  return geometryOfMovingArrays(geometry, solid, texCoordMappings);
}

interface InlineVertices {
  readonly arrays: VertexArrays | undefined;
  readonly solid: boolean;
  readonly texCoordMappings?: readonly string[] | undefined;
  /** Undefined where arrays follow from the numbers in another way. */
  readonly layout?: Omit<VertexLayout, "nodes"> | undefined;
  /** The child nodes with numbers. */
  readonly nodes: ReadonlyMap<SceneElement, MovingAttribute>;
}

const noNodes: ReadonlyMap<SceneElement, MovingAttribute> = new Map();

function inlineVerticesOf(
  element: SceneElement,
  resolve: Resolve,
  warnings: Warning[],
  moving: MovingValues | undefined,
): InlineVertices | undefined {
  const name = lowerNameOf(element);
  const readSolid = entryOf(solids, name),
    readPlane = entryOf(planeReaders, name),
    readRuns = entryOf(runReaders, name),
    readSurface = entryOf(surfaces, name);
  if (readPlane) return planeVerticesOf(readPlane(element, warnings, moving));
  if (!readSolid && !readRuns && !readSurface) return undefined;
  const solidMesh = readSolid?.(element, warnings);
  if (readSolid && !solidMesh) return undefined;
  const fields = readMovingFields(element, nodeFields.InlineGeometry, solidMesh ? [] : warnings, moving);
  if (solidMesh)
    return {
      arrays: vertexArraysOf("triangles", solidMesh.data, fansOf(solidMesh.faces)),
      solid: fields.solid,
      nodes: noNodes,
    };
  const { data: childData, nodes } = vertexDataOf(element, resolve, warnings, moving);
  const texCoordMode = texCoordModeOf(element, resolve, warnings);
  const surface = readSurface?.(element, childData, warnings, moving);
  if (readSurface && !surface) warnings.push({ element, message: "its numbers make no surface; nothing is drawn" });
  const data = surface?.data ?? childData,
    runs = surface?.faces ?? readRuns?.(fields, childData) ?? [];
  const isCreased = readSurface !== undefined || name === "indexedfaceset";
  const { arrays, layout } = arraysOfRuns(primitives[name] ?? "triangles", data, runs, fields, isCreased);
  if (arrays === undefined) warnings.push({ element, message: "it names vertices that it lacks; nothing is drawn" });
  return {
    arrays: arrays && withGeneratedTexCoords(arrays, texCoordMode),
    solid: fields.solid,
    texCoordMappings: data.texCoordMappings,
    layout: surface ? undefined : layout,
    nodes,
  };
}

function planeVerticesOf({
  geometry: { primitive, data: ownData, faces: ownFaces },
  solid,
}: ReturnType<PlaneReader>): InlineVertices {
  const nodes = noNodes;
  if (primitive === "points") return { arrays: vertexArraysOf(primitive, ownData, ownFaces.flat()), solid, nodes };
  if (primitive === "lines") return { arrays: vertexArraysOf(primitive, ownData, linesOf(ownFaces)), solid, nodes };
  const { data, faces } =
    ownData.texCoords.length > 0 ? { data: ownData, faces: ownFaces } : withDefaultTexCoords(ownData, ownFaces);
  return { arrays: vertexArraysOf(primitive, data, fansOf(faces)), solid, nodes };
}

function arraysOfRuns(
  primitive: VertexArrays["primitive"],
  vertexData: VertexData,
  runs: Runs,
  fields: Fields,
  isCreased: boolean,
): { readonly arrays: VertexArrays | undefined; readonly layout: Omit<VertexLayout, "nodes"> } {
  const made = (
    data: VertexData,
    corners: readonly Corner[],
    creasedNormals?: VertexLayout["creasedNormals"],
  ): ReturnType<typeof arraysOfRuns> => ({
    arrays: vertexArraysOf(primitive, data, corners),
    layout: { corners, creasedNormals },
  });
  if (primitive === "points") return made(vertexData, runs.flat());
  if (primitive === "lines") return made(vertexData, linesOf(runs));
  const oriented = fields.ccw ? runs : runs.map((run) => run.toReversed());
  const { data, faces } =
    vertexData.texCoords.length > 0
      ? { data: vertexData, faces: oriented }
      : withDefaultTexCoords(vertexData, oriented);
  const cornersOf = fields.convex ? fansOf : (polygons: Runs) => trianglesOf(data.positions, polygons);
  if (data.normals.length > 0) return made(data, cornersOf(faces));
  // Sets of triangles are smooth across shared vertices; faces have hard edges up to creaseAngle.
  const angle = isCreased ? fields.creaseAngle : fields.normalPerVertex ? Math.PI : 0;
  const creased = withCreasedNormals(data, faces, angle);
  return made(creased.data, cornersOf(creased.faces), creased.normals);
}

/** The first child with one of these lower-case names, its USE resolved. */
function childNamed(element: SceneElement, resolve: Resolve, ...names: string[]): SceneElement | undefined {
  const child = childrenOf(element).find((candidate) => names.includes(lowerNameOf(candidate)));
  return child && resolve(child);
}

function vertexDataOf(
  element: SceneElement,
  resolve: Resolve,
  warnings: Warning[],
  moving: MovingValues | undefined,
): { readonly data: VertexData; readonly nodes: ReadonlyMap<SceneElement, MovingAttribute> } {
  const coordinate = childNamed(element, resolve, "coordinate", "coordinatedouble");
  const normal = childNamed(element, resolve, "normal");
  const color = childNamed(element, resolve, "color", "colorrgba");
  const fogCoordinate = childNamed(element, resolve, "fogcoordinate");
  const texCoord = childNamed(element, resolve, "texturecoordinate");
  const nodes = new Map<SceneElement, MovingAttribute>();
  if (coordinate) nodes.set(coordinate, "positions");
  if (normal) nodes.set(normal, "normals");
  if (color) nodes.set(color, "colors");
  if (texCoord) nodes.set(texCoord, "texCoords");
  const texCoordSets = texCoordSetsOf(element, resolve, warnings);
  const data: VertexData = {
    positions: coordinate ? readMovingFields(coordinate, nodeFields.Coordinate, warnings, moving).point : [],
    normals: normal ? readMovingFields(normal, nodeFields.Normal, warnings, moving).vector : [],
    ...texCoordSets,
    texCoords: moving?.numbersOf(texCoord, "point") ?? texCoordSets.texCoords,
    colors: color ? readMovingFields(color, nodeFields.Color, warnings, moving).color : [],
    colorComponents: color && lowerNameOf(color) === "colorrgba" ? 4 : 3,
    fogDepths: fogCoordinate ? readFields(fogCoordinate, nodeFields.FogCoordinate, warnings).depth : [],
  };
  return { data, nodes };
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
