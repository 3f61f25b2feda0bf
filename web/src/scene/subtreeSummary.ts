// What nodes and groups add to their scene: merges the summaries of subtrees into that of the group around them.

import type { Matrix4 } from "three";
import { Vector4 } from "three";
import type { GroupDescription, Vec4 } from "../document/description.ts";
import type { EffectScope } from "./effectScope.ts";
import { sceneScope } from "./effectScope.ts";
import type {
  BackgroundInstance,
  ClipPlaneInstance,
  EnvironmentLightInstance,
  FogInstance,
  LightInstance,
  LocalFogInstance,
  ViewpointInstance,
} from "./instances.ts";
import type { InheritedState, NodeInstance, SubtreeSummary } from "./nodeInstance.ts";
import { emptySummary } from "./nodeInstance.ts";
import { lengthScaleOf } from "./transforms.ts";

const none: readonly never[] = [];

/** The summary of a node that is no group. */
export function leafSummary(
  { description, sceneFromNode }: NodeInstance,
  { isVisible, effectScope }: InheritedState,
): SubtreeSummary {
  switch (description.kind) {
    case "viewpoint":
      return {
        ...emptySummary,
        viewpoints: [
          { element: description.element, viewpoint: description.viewpoint, sceneFromViewpoint: sceneFromNode.clone() },
        ],
      };
    case "background":
      return { ...emptySummary, backgrounds: [{ ...description, sceneFromBackground: sceneFromNode.clone() }] };
    case "fog":
      return { ...emptySummary, fogs: [{ ...description, scale: lengthScaleOf(sceneFromNode) }] };
    case "localFog":
      return description.enabled && isVisible
        ? {
            ...emptySummary,
            localFogs: [{ fog: description.fog, scale: lengthScaleOf(sceneFromNode), scope: effectScope }],
          }
        : emptySummary;
    case "clipPlane": {
      const plane = description.enabled && isVisible ? scenePlaneOf(description.plane, sceneFromNode) : undefined;
      return plane ? { ...emptySummary, clipPlanes: [{ plane, scope: effectScope }] } : emptySummary;
    }
    case "light":
      return description.light.on && isVisible
        ? { ...emptySummary, lights: [lightInstance(description.light, sceneFromNode, effectScope)] }
        : emptySummary;
    case "environmentLight":
      return description.on && isVisible
        ? {
            ...emptySummary,
            environmentLights: [lightInstance(description, sceneFromNode, effectScope)],
          }
        : emptySummary;
    case "shape":
    case "group":
      return emptySummary;
  }
}

/** A plane of a node in scene coordinates; undefined where the node has no volume or the plane no direction. */
function scenePlaneOf(plane: Vec4, sceneFromNode: Matrix4): Vector4 | undefined {
  if (sceneFromNode.determinant() === 0) return undefined;
  const scenePlane = new Vector4(...plane).applyMatrix4(sceneFromNode.clone().invert().transpose());
  const length = Math.hypot(scenePlane.x, scenePlane.y, scenePlane.z);
  return length > 0 ? scenePlane.divideScalar(length) : undefined;
}

function lightInstance<Light extends { readonly global: boolean }>(
  light: Light,
  sceneFromLight: Matrix4,
  around: EffectScope,
): { light: Light; sceneFromLight: Matrix4; scope: EffectScope } {
  return { light, sceneFromLight: sceneFromLight.clone(), scope: light.global ? sceneScope : around };
}

/** The summary of a group whose children are up to date. */
export function groupSummary(
  node: NodeInstance,
  group: GroupDescription,
  { isVisible, effectScope: scopeAround }: InheritedState,
): SubtreeSummary {
  const { sceneFromNode, box } = node;
  const isGroupVisible = isVisible && group.visible;
  const summary = mergeSummaries(node.children, {
    boundedGroups: box ? [node] : none,
    anchors: group.anchor && isGroupVisible ? [group.anchor] : none,
    billboards: group.billboardAxis ? [node] : none,
    effectScopes: node.effectScope === scopeAround ? none : [node.effectScope],
    lods: group.lod && isGroupVisible ? [{ ...group.lod, sceneFromLod: sceneFromNode.clone() }] : none,
  });
  // Boxes inside a billboard have no fixed position.
  return group.billboardAxis ? { ...summary, boundedGroups: none } : summary;
}

/** Whether it depends on the transforms around the subtree. */
export function dependsOnTransforms(summary: SubtreeSummary): boolean {
  if (summary === emptySummary) return false;
  const { lights, environmentLights, viewpoints, backgrounds, fogs, localFogs, clipPlanes, lods } = summary;
  return [lights, environmentLights, viewpoints, backgrounds, fogs, localFogs, clipPlanes, lods].some(
    (list) => list.length > 0,
  );
}

/**
 * The summary of a group: `own` is the contribution of the group itself. Takes one pass, since a group may have ten
 * thousand children.
 */
function mergeSummaries(
  children: readonly NodeInstance[],
  own: Pick<SubtreeSummary, "lods" | "boundedGroups" | "anchors" | "billboards" | "effectScopes">,
): SubtreeSummary {
  const addsNothing = Object.values(own).every((list) => list.length === 0);
  const [only] = children;
  if (addsNothing && only !== undefined && children.length === 1) return only.summary;
  if (addsNothing && children.every(({ summary }) => summary === emptySummary)) return emptySummary;
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
