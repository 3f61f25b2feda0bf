// What a document's clocks move, without playing it: the values at moments of each clock, from nodes of their own, so
// that neither the scene nor its attributes change.

import type { AnimatedDocuments } from "./documents.ts";
import type { DrawnFieldOf, FieldChange } from "./documentGraph.ts";
import { AnimationPlayer } from "./player.ts";
import { TimeSensor } from "./timeSensor.ts";

/** More keys than this are sampled evenly; fewer where many nodes take part, so that this takes less than 0.1 s. */
const maxMoments = 64;
const maxEvents = 10_000;

/**
 * Calls back with the values that fields of drawn nodes receive at moments of each clock, one clock after the other: at
 * the keys of all interpolators, and halfway between them.
 */
export function visitMoments(
  documents: AnimatedDocuments,
  drawnFieldOf: DrawnFieldOf,
  visit: (changes: readonly FieldChange[]) => void,
): void {
  const player = new AnimationPlayer(
    documents,
    { now: () => 0, schedule: () => () => undefined },
    { drawnFieldOf, apply: visit, writeAttribute: () => undefined, onEvent: () => undefined, warn: () => undefined },
    false,
  );
  player.read();
  const nodes = Array.from(player.nodes);
  const count = Math.max(5, Math.min(maxMoments, Math.floor(maxEvents / nodes.length)));
  const moments = momentsOf(
    nodes.map(([, node]) => node.valueOf("key")),
    count,
  );
  for (const [element, { behaviour }] of nodes)
    if (behaviour instanceof TimeSensor)
      for (const fraction of moments) player.setValue(element, "set_fraction", fraction);
  player.dispose();
}

/** The fractions at these lists of keys and halfway between them, ascending, at most `count`; empty without keys. */
function momentsOf(lists: readonly unknown[], count: number): readonly number[] {
  const keys = new Set<number>();
  for (const list of lists)
    if (Array.isArray(list)) for (const key of list as readonly number[]) if (key >= 0 && key <= 1) keys.add(key);
  const sorted = Array.from(keys).sort((a, b) => a - b);
  const all = sorted.flatMap((key, i) => (i === 0 ? [key] : [((sorted[i - 1] ?? key) + key) / 2, key]));
  if (all.length <= count) return all;
  return Array.from({ length: count }, (_, n) => n / (count - 1));
}
