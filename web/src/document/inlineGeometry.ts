// Reads geometry nodes whose numbers are in the document. Their arrays become BG in data: URLs, so that delivery treats
// them like files, and an unchanged geometry has the same URL.

import type { Surface, VertexArrays } from "../tessellate/faces.ts";
import { withGeneratedTexCoords } from "../tessellate/texCoordModes.ts";
import { geometryOfArrays, geometryOfMovingArrays } from "./arrayGeometry.ts";
import { planeReaders, solidReaders, surfaceReaders } from "./computedGeometry.ts";
import { primitiveOf, runReaders } from "./cornerRuns.ts";
import type { GeometryDescription, Warning } from "./description.ts";
import type { Resolve, SceneElement } from "./element.ts";
import { lowerNameOf } from "./element.ts";
import { readMovingFields } from "./movingFields.ts";
import type { MovingAttribute, VertexLayout } from "./movingGeometry.ts";
import { MovingGeometry } from "./movingGeometry.ts";
import type { MovingValues } from "./movingValues.ts";
import type { Values } from "./nodes.ts";
import { nodeFields } from "./nodes.ts";
import { texCoordModeOf } from "./readTexCoords.ts";
import { arraysOfRuns } from "./runArrays.ts";
import { entryOf } from "./tables.ts";
import { vertexChildrenOf } from "./vertexChildren.ts";

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
  reads: (name) =>
    [solidReaders, planeReaders, surfaceReaders, runReaders].some((readers) => Object.hasOwn(readers, name)),
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

function inlineVerticesOf(
  element: SceneElement,
  resolve: Resolve,
  warnings: Warning[],
  moving: MovingValues | undefined,
): InlineVertices | undefined {
  const name = lowerNameOf(element);
  const readPlane = entryOf(planeReaders, name);
  if (readPlane) {
    const { geometry, solid } = readPlane(element, warnings, moving);
    return verticesOf(geometry.primitive, geometry, solid);
  }
  const readSolid = entryOf(solidReaders, name);
  if (readSolid) {
    const mesh = readSolid(element, warnings);
    const { solid } = readMovingFields(element, nodeFields.InlineGeometry, [], moving);
    return mesh && verticesOf("triangles", mesh, solid);
  }
  return Object.hasOwn(runReaders, name) || Object.hasOwn(surfaceReaders, name)
    ? verticesWithChildren(element, resolve, warnings, moving)
    : undefined;
}

/** The vertices of a surface, or of lines or points, that have their own normals and no child nodes. */
function verticesOf(primitive: VertexArrays["primitive"], { data, faces }: Surface, solid: boolean): InlineVertices {
  const { arrays } = arraysOfRuns(data, faces, { primitive, ccw: true, convex: true, creaseAngle: 0 });
  return { arrays, solid, nodes: new Map() };
}

/** The vertices of a geometry node whose child nodes may hold numbers of them. */
function verticesWithChildren(
  element: SceneElement,
  resolve: Resolve,
  warnings: Warning[],
  moving: MovingValues | undefined,
): InlineVertices {
  const name = lowerNameOf(element);
  const fields = readMovingFields(element, nodeFields.InlineGeometry, warnings, moving);
  const { data: childData, nodes } = vertexChildrenOf(element, resolve, warnings, moving);
  const texCoordMode = texCoordModeOf(element, resolve, warnings);
  const readSurface = entryOf(surfaceReaders, name);
  const surface = readSurface?.(element, childData, warnings, moving);
  if (readSurface && !surface) warnings.push({ element, message: "its numbers make no surface; nothing is drawn" });
  const data = surface?.data ?? childData,
    runs = surface?.faces ?? entryOf(runReaders, name)?.(fields, childData) ?? [];
  const style = { ...fields, primitive: primitiveOf(name), creaseAngle: creaseAngleOf(name, fields) };
  const { arrays, layout } = arraysOfRuns(data, runs, style);
  if (arrays === undefined) warnings.push({ element, message: "it names vertices that it lacks; nothing is drawn" });
  return {
    arrays: arrays && withGeneratedTexCoords(arrays, texCoordMode),
    solid: fields.solid,
    texCoordMappings: data.texCoordMappings,
    layout: surface ? undefined : layout,
    nodes,
  };
}

/** Faces have hard edges up to the field creaseAngle; sets of triangles are smooth across shared vertices. */
function creaseAngleOf(
  name: string,
  { creaseAngle, normalPerVertex }: Pick<Values<typeof nodeFields.InlineGeometry>, "creaseAngle" | "normalPerVertex">,
): number {
  if (name === "indexedfaceset" || Object.hasOwn(surfaceReaders, name)) return creaseAngle;
  return normalPerVertex ? Math.PI : 0;
}
