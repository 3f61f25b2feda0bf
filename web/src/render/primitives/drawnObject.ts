// The three.js object that draws one kind of primitive.

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
    ? unculled(new Mesh(geometry, material))
    : primitive === "points"
      ? new Points(geometry, material)
      : primitive === "lines"
        ? new LineSegments(geometry, material)
        : primitive === "lineStrip"
          ? new Line(geometry, material)
          : new Mesh(geometry, material);
}

/** What is wide on the screen reaches beyond bounds that know nothing of it. */
function unculled(object: DrawnObject): DrawnObject {
  object.frustumCulled = false;
  return object;
}
