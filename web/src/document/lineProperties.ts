// Reads LineProperties (ISO/IEC 19775-1, 12.4.3). X3D numbers its line types after ISO/IEC 9973, which does not define
// dash lengths.

import type { LineDescription, Warning } from "./description.ts";
import type { SceneElement } from "./element.ts";
import { nodeFields, readFields } from "./nodes.ts";

const solid = 1;

/** By line type: alternating lengths of dashes and gaps, in line widths. */
const dashesOf: ReadonlyMap<number, readonly number[]> = new Map([
  [solid, []],
  [2, [6, 4]], // dashed
  [3, [1, 2]], // dotted
  [4, [6, 2.5, 1, 2.5]], // dashed-dotted
  [5, [6, 2.5, 1, 2.5, 1, 2.5]], // dash-dot-dot
  [10, [9, 3, 3, 3]], // chain line
  [11, [14, 3, 4, 3]], // centre line
  [12, [3, 3]], // hidden line
  [13, [14, 3, 4, 3, 4, 3]], // phantom line
]);

/** The largest number of dash lengths and gap lengths of a line type. */
export const maxDashLengths = 6;

/** In CSS pixels. Points have the same maximum. */
const [minWidth, maxWidth] = [1, 1024];

/** Undefined for thin solid lines, the default. */
export function readLines(element: SceneElement, warnings: Warning[]): LineDescription | undefined {
  const { applied, linetype, linewidthScaleFactor } = readFields(element, nodeFields.LineProperties, warnings);
  if (!applied) return undefined;
  const known = dashesOf.get(linetype);
  if (known === undefined)
    warnings.push({ element, message: `linetype ${linetype} is not supported; the lines are solid` });
  const dashes = known ?? [];
  const width = Math.min(Math.max(linewidthScaleFactor, minWidth), maxWidth);
  return width === minWidth && dashes.length === 0 ? undefined : { width, dashes };
}
