// A surface drawn as its vertices: the same buffers and images, with points as the primitive.

import type { Stage } from "../../stage/stage.ts";
import { isSurface } from "../primitives/primitives.ts";

/** By the original stage, so that all shapes that show it share one derived stage and its geometry. */
const made = new WeakMap<Stage, Stage>();

/** The same stage where it has no surface. `vertexCount`: the number of vertex records, 0 where unknown. */
export function surfaceAsPoints(stage: Stage, vertexCount: number): Stage {
  if (!stage.draws.some(isSurface)) return stage;
  const known = made.get(stage) ?? pointsOf(stage, vertexCount);
  made.set(stage, known);
  return known;
}

function pointsOf(stage: Stage, vertexCount: number): Stage {
  const isAllSurface = stage.draws.every(isSurface);
  // A base stage also has vertices of other patches, and a grid has no index: their draws stay as
  // they are.
  const isOwn = stage.name !== "base" && stage.index !== undefined && vertexCount > 0;
  if (!isAllSurface || !isOwn)
    return { ...stage, draws: stage.draws.map((draw) => (isSurface(draw) ? { ...draw, primitive: "points" } : draw)) };
  const draws = [{ primitive: "points", first: 0, count: vertexCount }] as const;
  if (stage.kind === "buffers") return { ...stage, draws, index: undefined };
  const width = stage.coord[0]?.image.width ?? stage.implicitWidth;
  return { ...stage, draws, index: undefined, implicitWidth: width };
}
