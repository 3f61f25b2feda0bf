// Merges the summaries of subtrees into that of the group around them.

import type { Box3 } from "three";
import type {
  BackgroundInstance,
  ClipPlaneInstance,
  EnvironmentLightInstance,
  FogInstance,
  LightInstance,
  LocalFogInstance,
  ViewpointInstance,
} from "./instances.ts";
import type { NodeInstance, SubtreeSummary } from "./nodeInstance.ts";
import { emptySummary } from "./nodeInstance.ts";

const none: readonly never[] = [];

/**
 * The summary of a group: `own` is the contribution of the group itself. Takes one pass, since a group may have ten
 * thousand children.
 */
export function mergeSummaries(
  children: readonly NodeInstance[],
  own: Pick<SubtreeSummary, "box" | "lods" | "boundedGroups" | "anchors" | "billboards" | "effectScopes">,
): SubtreeSummary {
  const [only] = children;
  if (only !== undefined && children.length === 1 && isEmpty(own)) return only.summary; // a Transform around a shape
  let union: Box3 | undefined;
  const lights = new ConcatenatedList<LightInstance>(),
    environmentLights = new ConcatenatedList<EnvironmentLightInstance>(),
    viewpoints = new ConcatenatedList<ViewpointInstance>(),
    backgrounds = new ConcatenatedList<BackgroundInstance>(),
    fogs = new ConcatenatedList<FogInstance>(),
    localFogs = new ConcatenatedList<LocalFogInstance>(),
    clipPlanes = new ConcatenatedList<ClipPlaneInstance>();
  const lods = new ConcatenatedList(own.lods),
    boundedGroups = new ConcatenatedList(own.boundedGroups);
  const anchors = new ConcatenatedList(own.anchors),
    billboards = new ConcatenatedList(own.billboards),
    effectScopes = new ConcatenatedList(own.effectScopes);
  for (const { summary } of children) {
    if (summary === emptySummary) continue;
    if (summary.box && own.box === undefined) union = union?.union(summary.box) ?? summary.box.clone();
    lights.add(summary.lights);
    environmentLights.add(summary.environmentLights);
    viewpoints.add(summary.viewpoints);
    backgrounds.add(summary.backgrounds);
    fogs.add(summary.fogs);
    localFogs.add(summary.localFogs);
    clipPlanes.add(summary.clipPlanes);
    lods.add(summary.lods);
    boundedGroups.add(summary.boundedGroups);
    anchors.add(summary.anchors);
    billboards.add(summary.billboards);
    effectScopes.add(summary.effectScopes);
  }
  return {
    box: own.box ?? union,
    lights: lights.all,
    environmentLights: environmentLights.all,
    viewpoints: viewpoints.all,
    backgrounds: backgrounds.all,
    fogs: fogs.all,
    localFogs: localFogs.all,
    clipPlanes: clipPlanes.all,
    lods: lods.all,
    boundedGroups: boundedGroups.all,
    anchors: anchors.all,
    billboards: billboards.all,
    effectScopes: effectScopes.all,
  };
}

function isEmpty({
  box,
  lods,
  boundedGroups,
  anchors,
  billboards,
  effectScopes,
}: Parameters<typeof mergeSummaries>[1]): boolean {
  return (
    box === undefined &&
    lods.length + boundedGroups.length + anchors.length + billboards.length + effectScopes.length === 0
  );
}

/** Concatenates lists; copies none of them while only one has items. */
class ConcatenatedList<Item> {
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
