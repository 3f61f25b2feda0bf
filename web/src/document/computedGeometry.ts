// Reads geometry nodes whose vertices are computed from their fields: solids, geometry in a plane, and surfaces. Each
// table has readers by the lower-case names of nodes.

import { elevationGrid } from "../tessellate/elevationGrid.ts";
import { extrusion } from "../tessellate/extrusion.ts";
import type { Surface, VertexData } from "../tessellate/faces.ts";
import type { PlaneGeometry } from "../tessellate/geometry2d.ts";
import { arc, circle, closedArc, disk, polyline, polypoint, rectangle, triangles2d } from "../tessellate/geometry2d.ts";
import type { Solid } from "../tessellate/solids.ts";
import { box, cylinderOrCone, sphere } from "../tessellate/solids.ts";
import type { Warning } from "./description.ts";
import type { SceneElement } from "./element.ts";
import { readMovingFields } from "./movingFields.ts";
import type { MovingValues } from "./movingValues.ts";
import type { Values } from "./nodes.ts";
import { nodeFields, readFields } from "./nodes.ts";

/** Undefined where the fields make no geometry, with a warning. */
type SolidReader = (element: SceneElement, warnings: Warning[]) => Solid | undefined;

export const solidReaders: Readonly<Record<string, SolidReader>> = {
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

/** Lines and points are never `solid`. */
type PlaneReader = (
  element: SceneElement,
  warnings: Warning[],
  moving: MovingValues | undefined,
) => { readonly geometry: PlaneGeometry; readonly solid: boolean };

export const planeReaders: Readonly<Record<string, PlaneReader>> = {
  arc2d: planeReader(nodeFields.Arc2D, arc),
  arcclose2d: planeReader(nodeFields.ArcClose2D, closedArc),
  circle2d: planeReader(nodeFields.Circle2D, circle),
  disk2d: planeReader(nodeFields.Disk2D, disk),
  polyline2d: planeReader(nodeFields.Polyline2D, ({ lineSegments }) => polyline(lineSegments)),
  polypoint2d: planeReader(nodeFields.Polypoint2D, ({ point }) => polypoint(point)),
  rectangle2d: planeReader(nodeFields.Rectangle2D, rectangle),
  triangleset2d: planeReader(nodeFields.TriangleSet2D, ({ vertices }) => triangles2d(vertices)),
};

/** `childData`: the numbers of child nodes. */
type SurfaceReader = (
  element: SceneElement,
  childData: VertexData,
  warnings: Warning[],
  moving: MovingValues | undefined,
) => Surface | undefined;

export const surfaceReaders: Readonly<Record<string, SurfaceReader>> = {
  elevationgrid: (element, childData, warnings, moving) =>
    elevationGrid(readMovingFields(element, nodeFields.ElevationGrid, warnings, moving), childData),
  extrusion: (element, _, warnings, moving) =>
    extrusion(readMovingFields(element, nodeFields.Extrusion, warnings, moving)),
};

/** False with a warning for a solid of negative size: its outside would be inside. */
function areSizes(sizes: readonly number[], element: SceneElement, warnings: Warning[]): boolean {
  const isSize = Math.min(...sizes) >= 0;
  if (!isSize) warnings.push({ element, message: "a size is negative; nothing is drawn" });
  return isSize;
}

/** A reader of the node's fields that makes geometry of them. */
function planeReader<Fields extends Parameters<typeof readFields>[1]>(
  fields: Fields,
  geometryOf: (values: Values<Fields>) => PlaneGeometry,
): PlaneReader {
  return (element, warnings, moving) => {
    const values = readMovingFields(element, fields, warnings, moving);
    return { geometry: geometryOf(values), solid: "solid" in values && values.solid === true };
  };
}
