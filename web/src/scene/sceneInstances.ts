// Lists the instances of a scene's nodes with their transforms, and the scene's bounds, for cameras and renderers.

import type { Box3 } from "three";
import type { SceneDescription } from "../document/description.ts";
import type {
  EnvironmentLightInstance,
  LightInstance,
  LodInstance,
  ShapeInstance,
  ViewpointInstance,
} from "./instances.ts";
import { InstanceTree } from "./instanceTree.ts";
import type { NodeInstance } from "./nodeInstance.ts";
import { boundsOf } from "./subtreeBounds.ts";

/** Lists are in document order. */
export interface SceneInstances {
  /** Bounds of all visible shapes; empty if there are none. */
  readonly box: Box3;
  readonly shapes: readonly ShapeInstance[];
  /** Lights that are on and visible. */
  readonly lights: readonly LightInstance[];
  readonly environmentLights: readonly EnvironmentLightInstance[];
  readonly viewpoints: readonly ViewpointInstance[];
  /** Whether anything is clipped or in fog. */
  readonly hasClippingOrFog: boolean;
  /** Visible LODs. */
  readonly lods: readonly LodInstance[];
  readonly billboards: readonly NodeInstance[];
}

/** Reads a scene once; InstanceTree follows a scene that changes. */
export function instancesOf(scene: SceneDescription): SceneInstances {
  const { root } = new InstanceTree().update(scene.root);
  const { lights, environmentLights, viewpoints, clipPlanes, fogs, localFogs, lods, billboards } = root.summary;
  return {
    box: boundsOf(root),
    shapes: Array.from(shapesIn(root)),
    lights,
    environmentLights,
    viewpoints,
    hasClippingOrFog: clipPlanes.length > 0 || [...fogs, ...localFogs].some(({ fog }) => fog.visibilityRange > 0),
    lods,
    billboards,
  };
}

function* shapesIn({ description, sceneFromNode, effectScope, children }: NodeInstance): Generator<ShapeInstance> {
  if (description.kind === "shape") yield { shape: description, sceneFromShape: sceneFromNode, effectScope };
  for (const child of children) yield* shapesIn(child);
}
