// What a part of a scene brings into the whole of it: the sum of what its parts bring.

import type { Box3 } from "three";
import type { PlacedViewpoint } from "./camera.ts";
import type { PlacedNode } from "./placedTree.ts";
import type { PlacedLevels, PlacedLight } from "./placement.ts";

/** Lists are in document order. */
export interface Reach {
  /** Around what is seen of it, in the scene's coordinates; undefined where nothing is. */
  readonly box: Box3 | undefined;
  /** Those that shine. */
  readonly lights: readonly PlacedLight[];
  readonly viewpoints: readonly PlacedViewpoint[];
  /** Those that are seen. */
  readonly levels: readonly PlacedLevels[];
  /** Groups that are seen and tell their boxes. */
  readonly bounded: readonly PlacedNode[];
}

const none: readonly never[] = [];
export const noReach: Reach = { box: undefined, lights: none, viewpoints: none, levels: none, bounded: none };

/** Of these together, and of what the group around them brings itself. */
export function reachOfAll(parts: readonly PlacedNode[], own: Pick<Reach, "box" | "levels" | "bounded">): Reach {
  const some = parts.map(({ reach }) => reach).filter((reach) => reach !== noReach);
  return {
    box: own.box ?? unionOf(some),
    lights: flat(some.map(({ lights }) => lights)),
    viewpoints: flat(some.map(({ viewpoints }) => viewpoints)),
    levels: flat([own.levels, ...some.map(({ levels }) => levels)]),
    bounded: flat([own.bounded, ...some.map(({ bounded }) => bounded)]),
  };
}

/** The only list that has anything in it stays as it is. */
function flat<Item>(lists: readonly (readonly Item[])[]): readonly Item[] {
  const some = lists.filter(({ length }) => length > 0);
  return some.length > 1 ? some.flat() : some[0] ?? none;
}

function unionOf(some: readonly Reach[]): Box3 | undefined {
  let union: Box3 | undefined;
  for (const { box } of some) if (box) union = union?.union(box) ?? box.clone();
  return union;
}
