// Draws the vertices of a surface as points, from the same buffers and images.

import type { Stage } from "../../stage/stage.ts";
import { isSurface } from "../primitives/primitives.ts";

/** Results by the original stage, so that all shapes with this stage share one derived stage and its geometry. */
const pointStages = new WeakMap<Stage, Stage>();

/**
 * The stage with points in place of surfaces; the same stage if it has none. `vertexCount` is the number of vertex
 * records, 0 if unknown.
 */
export function surfaceAsPoints(stage: Stage, vertexCount: number): Stage {
  if (!stage.draws.some(isSurface)) return stage;
  const pointStage = pointStages.get(stage) ?? pointsOf(stage, vertexCount);
  pointStages.set(stage, pointStage);
  return pointStage;
}

function pointsOf(stage: Stage, vertexCount: number): Stage {
  const areAllSurfaces = stage.draws.every(isSurface);
  // A base stage also has vertices of other patches, and a grid has no index: their draws keep their
  // ranges and change the primitive only.
  const canDrawEachVertexOnce = stage.name !== "base" && stage.index !== undefined && vertexCount > 0;
  if (!areAllSurfaces || !canDrawEachVertexOnce)
    return { ...stage, draws: stage.draws.map((draw) => (isSurface(draw) ? { ...draw, primitive: "points" } : draw)) };
  const draws = [{ primitive: "points", first: 0, count: vertexCount }] as const;
  if (stage.kind === "buffers") return { ...stage, draws, index: undefined };
  const width = stage.coord[0]?.image.width ?? stage.implicitWidth;
  return { ...stage, draws, index: undefined, implicitWidth: width };
}
