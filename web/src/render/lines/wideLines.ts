// Makes the line draws of a stage wide, and counts the lines of a draw.

import type { DrawRange, Stage } from "../../stage/stage.ts";
import { isLine } from "../primitives/primitives.ts";

/** Results by the original stage, so that all shapes with this stage share one derived stage and its geometry. */
const wideLineStages = new WeakMap<Stage, Stage>();

/** A stage whose line draws are wide; the same stage if it has no lines. Repeated calls return the same object. */
export function withWideLines(stage: Stage): Stage {
  if (!stage.draws.some(isLine)) return stage;
  const wideLineStage = wideLineStages.get(stage) ?? {
    ...stage,
    draws: stage.draws.map((draw) => (isLine(draw) ? { ...draw, isWide: true } : draw)),
  };
  wideLineStages.set(stage, wideLineStage);
  return wideLineStage;
}

/** The number of vertices from the start of one line to the start of the next. */
export function lineStepOf({ primitive }: Pick<DrawRange, "primitive">): 1 | 2 {
  return primitive === "lineStrip" ? 1 : 2;
}

/** The number of lines of a draw, wide or thin. */
export function lineCountOf(range: Pick<DrawRange, "primitive" | "count">): number {
  return Math.max(0, Math.floor((range.count - 2) / lineStepOf(range)) + 1);
}
