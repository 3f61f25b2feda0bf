// Makes the three.js object that draws a primitive type.

import type { BufferGeometry } from "three";
import { Line, LineSegments, Mesh, Points } from "three";
import type { DrawRange } from "../../stage/stage.ts";

export type DrawnObject = Mesh | Points | Line;

export function makeDrawnObject(
  { primitive, isWide }: Pick<DrawRange, "primitive" | "isWide">,
  geometry: BufferGeometry,
  material: Mesh["material"],
): DrawnObject {
  return isWide
    ? withoutCulling(new Mesh(geometry, material))
    : primitive === "points"
      ? new Points(geometry, material)
      : primitive === "lines"
        ? new LineSegments(geometry, material)
        : primitive === "lineStrip"
          ? new Line(geometry, material)
          : new Mesh(geometry, material);
}

/** Disables three.js' culling, whose bounds do not include the width of lines. */
function withoutCulling(object: DrawnObject): DrawnObject {
  object.frustumCulled = false;
  return object;
}
