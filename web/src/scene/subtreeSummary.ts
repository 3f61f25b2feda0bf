// What a part of a scene brings into the whole of it: the sum of what its parts bring.

import type { Box3 } from "three";
import type { LightInstance, ViewpointInstance } from "./instances.ts";
import type { NodeInstance, SubtreeSummary } from "./nodeInstance.ts";
import { emptySummary } from "./nodeInstance.ts";

const none: readonly never[] = [];

/** Of these together, and of what the group around them brings itself. One pass: there may be ten thousand. */
export function mergeSummaries(
  parts: readonly NodeInstance[],
  own: Pick<SubtreeSummary, "box" | "lods" | "boundedGroups" | "anchors" | "billboards" | "lightScopes">,
): SubtreeSummary {
  let union: Box3 | undefined;
  const lights = new Gathered<LightInstance>(),
    viewpoints = new Gathered<ViewpointInstance>();
  const levels = new Gathered(own.lods),
    bounded = new Gathered(own.boundedGroups);
  const anchors = new Gathered(own.anchors),
    billboards = new Gathered(own.billboards),
    scopes = new Gathered(own.lightScopes);
  for (const { summary: reach } of parts) {
    if (reach === emptySummary) continue;
    if (reach.box && own.box === undefined) union = union?.union(reach.box) ?? reach.box.clone();
    lights.add(reach.lights);
    viewpoints.add(reach.viewpoints);
    levels.add(reach.lods);
    bounded.add(reach.boundedGroups);
    anchors.add(reach.anchors);
    billboards.add(reach.billboards);
    scopes.add(reach.lightScopes);
  }
  return {
    box: own.box ?? union,
    lights: lights.all,
    viewpoints: viewpoints.all,
    lods: levels.all,
    boundedGroups: bounded.all,
    anchors: anchors.all,
    billboards: billboards.all,
    lightScopes: scopes.all,
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
