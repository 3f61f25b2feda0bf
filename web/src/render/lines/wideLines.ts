// Which draws are wide lines, and how many lines a draw has.

import type { DrawRange, Stage } from "../../stage/stage.ts";
import { isLine } from "../primitives/primitives.ts";

/** By the original stage, so that all shapes that show it share one derived stage and its geometry. */
const made = new WeakMap<Stage, Stage>();

/** A stage whose line draws are wide; the same stage where it has no lines. Repeated calls return the same object. */
export function withWideLines(stage: Stage): Stage {
  if (!stage.draws.some(isLine)) return stage;
  const known = made.get(stage) ?? {
    ...stage,
    draws: stage.draws.map((draw) => (isLine(draw) ? { ...draw, isWide: true } : draw)),
  };
  made.set(stage, known);
  return known;
}

/** The distance in vertices from the begin of a line to that of the next. */
export function lineStepOf({ primitive }: Pick<DrawRange, "primitive">): 1 | 2 {
  return primitive === "lineStrip" ? 1 : 2;
}

/** The number of lines of a draw, wide or thin. */
export function lineCountOf(range: Pick<DrawRange, "primitive" | "count">): number {
  return Math.max(0, Math.floor((range.count - 2) / lineStepOf(range)) + 1);
}
