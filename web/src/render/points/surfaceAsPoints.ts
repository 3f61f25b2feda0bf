// A surface as its vertices alone: the same buffers and images, drawn as points.

import type { Stage } from "../../stage/stage.ts";
import { isSurface } from "../primitives/primitives.ts";

/** By the stage that they are made of, so that all its shapes share what they draw. */
const made = new WeakMap<Stage, Stage>();

/** `vertexCount`: its records, 0 where nobody has counted them. The same stage where it has no surface. */
export function surfaceAsPoints(stage: Stage, vertexCount: number): Stage {
  if (!stage.draws.some(isSurface)) return stage;
  const known = made.get(stage) ?? pointsOf(stage, vertexCount);
  made.set(stage, known);
  return known;
}

function pointsOf(stage: Stage, vertexCount: number): Stage {
  const isAllSurface = stage.draws.every(isSurface);
  // What stands in for several patches has their vertices too, and a grid has no index.
  const isOwn = stage.name !== "base" && stage.index !== undefined && vertexCount > 0;
  if (!isAllSurface || !isOwn)
    return { ...stage, draws: stage.draws.map((draw) => (isSurface(draw) ? { ...draw, primitive: "points" } : draw)) };
  const draws = [{ primitive: "points", first: 0, count: vertexCount }] as const;
  if (stage.kind === "buffers") return { ...stage, draws, index: undefined };
  const width = stage.coord[0]?.image.width ?? stage.implicitWidth;
  return { ...stage, draws, index: undefined, implicitWidth: width };
}
