// LineProperties -> how lines are drawn (ISO/IEC 19775-1, 12.4.3). X3D names its
// kinds of lines by the numbers of ISO/IEC 9973, which leaves their measures open.

import type { LineDescription, Warning } from "./description.ts";
import type { SceneElement } from "./element.ts";
import { nodeFields, readFields } from "./nodes.ts";

const solid = 1;

/** By their number: lengths that are drawn and left out in turn, in widths. */
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

/** The most lengths of any kind. */
export const maxDashLengths = 6;

/** In CSS pixels. The least is that of dashes, the most that of points. */
const [leastWidth, mostWidth] = [1, 1024];

/** Undefined for lines that are drawn as if nothing were said of them. */
export function readLines(element: SceneElement, warnings: Warning[]): LineDescription | undefined {
  const { applied, linetype, linewidthScaleFactor } = readFields(element, nodeFields.LineProperties, warnings);
  if (!applied) return undefined;
  const known = dashesOf.get(linetype);
  if (known === undefined)
    warnings.push({ element, message: `lines of linetype ${linetype} are not drawn so; they are solid` });
  const dashes = known ?? [];
  const width = Math.min(Math.max(linewidthScaleFactor, leastWidth), mostWidth);
  return width === leastWidth && dashes.length === 0 ? undefined : { width, dashes };
}
