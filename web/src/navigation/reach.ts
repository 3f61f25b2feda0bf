// What a part of a scene brings into the whole of it: the sum of what its parts bring.

import type { Box3 } from "three";
import type { PlacedViewpoint } from "./camera.ts";
import type { AnchorDescription } from "../document/description.ts";
import type { LightScope } from "./lightScope.ts";
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
  /** Those that are seen. */
  readonly anchors: readonly AnchorDescription[];
  /** Each before those in it. */
  readonly billboards: readonly PlacedNode[];
  /** Groups that lights shine in, and nowhere else; each before those in it. */
  readonly scopes: readonly LightScope[];
}

const none: readonly never[] = [];
export const noReach: Reach = {
  box: undefined,
  lights: none,
  viewpoints: none,
  levels: none,
  bounded: none,
  anchors: none,
  billboards: none,
  scopes: none,
};

/** Of these together, and of what the group around them brings itself. One pass: there may be ten thousand. */
export function reachOfAll(
  parts: readonly PlacedNode[],
  own: Pick<Reach, "box" | "levels" | "bounded" | "anchors" | "billboards" | "scopes">,
): Reach {
  let union: Box3 | undefined;
  const lights = new Gathered<PlacedLight>(),
    viewpoints = new Gathered<PlacedViewpoint>();
  const levels = new Gathered(own.levels),
    bounded = new Gathered(own.bounded);
  const anchors = new Gathered(own.anchors),
    billboards = new Gathered(own.billboards),
    scopes = new Gathered(own.scopes);
  for (const { reach } of parts) {
    if (reach === noReach) continue;
    if (reach.box && own.box === undefined) union = union?.union(reach.box) ?? reach.box.clone();
    lights.add(reach.lights);
    viewpoints.add(reach.viewpoints);
    levels.add(reach.levels);
    bounded.add(reach.bounded);
    anchors.add(reach.anchors);
    billboards.add(reach.billboards);
    scopes.add(reach.scopes);
  }
  return {
    box: own.box ?? union,
    lights: lights.all,
    viewpoints: viewpoints.all,
    levels: levels.all,
    bounded: bounded.all,
    anchors: anchors.all,
    billboards: billboards.all,
    scopes: scopes.all,
  };
}

/** Lists one after the other; the only one that has anything in it stays as it is. */
class Gathered<Item> {
  #all: readonly Item[];
  #own: Item[] | undefined;

  constructor(first: readonly Item[] = none) {
    this.#all = first;
  }

  get all(): readonly Item[] {
    return this.#all;
  }

  add(list: readonly Item[]): void {
    if (list.length === 0) return;
    if (this.#all.length === 0) {
      this.#all = list;
      return;
    }
    this.#own ??= [...this.#all];
    for (const item of list) this.#own.push(item);
    this.#all = this.#own;
  }
}
