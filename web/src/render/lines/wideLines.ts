// Lines that are wide: which they are, and how many.

import type { DrawRange, Stage } from "../../stage/stage.ts";
import { isLine } from "../primitives/primitives.ts";

/** By the stage that they are made of, so that all its shapes share what they draw. */
const made = new WeakMap<Stage, Stage>();

/** The same stage where it has no lines. */
export function withWideLines(stage: Stage): Stage {
  if (!stage.draws.some(isLine)) return stage;
  const known = made.get(stage) ?? {
    ...stage,
    draws: stage.draws.map((draw) => (isLine(draw) ? { ...draw, isWide: true } : draw)),
  };
  made.set(stage, known);
  return known;
}

/** How many vertices on the next line begins. */
export function lineStepOf({ primitive }: Pick<DrawRange, "primitive">): 1 | 2 {
  return primitive === "lineStrip" ? 1 : 2;
}

/** Also where they are thin. */
export function lineCountOf(range: Pick<DrawRange, "primitive" | "count">): number {
  return Math.max(0, Math.floor((range.count - 2) / lineStepOf(range)) + 1);
}
