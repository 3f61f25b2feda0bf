// Reads the child nodes of a geometry that hold numbers of its vertices: Coordinate, Normal, Color and others.

import type { VertexData } from "../tessellate/faces.ts";
import type { Warning } from "./description.ts";
import type { Resolve, SceneElement } from "./element.ts";
import { childrenOf, lowerNameOf } from "./element.ts";
import { readMovingFields } from "./movingFields.ts";
import type { MovingAttribute } from "./movingGeometry.ts";
import type { MovingValues } from "./movingValues.ts";
import { nodeFields, readFields } from "./nodes.ts";
import { texCoordSetsOf } from "./readTexCoords.ts";

export interface VertexChildren {
  readonly data: VertexData;
  /** The child nodes whose numbers animation may change. */
  readonly nodes: ReadonlyMap<SceneElement, MovingAttribute>;
}

export function vertexChildrenOf(
  element: SceneElement,
  resolve: Resolve,
  warnings: Warning[],
  moving: MovingValues | undefined,
): VertexChildren {
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

/** The first child with one of these lower-case names, its USE resolved. */
function childNamed(element: SceneElement, resolve: Resolve, ...names: string[]): SceneElement | undefined {
  const child = childrenOf(element).find((candidate) => names.includes(lowerNameOf(candidate)));
  return child && resolve(child);
}
