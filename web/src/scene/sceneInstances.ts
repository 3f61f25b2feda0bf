// Where everything in a scene stands, in the scene's coordinates, and how far the
// scene reaches: what the camera must know before anything is drawn, and the same
// for whoever draws.

import { Box3 } from "three";
import type { SceneDescription } from "../document/description.ts";
import type { LightInstance, LodInstance, ShapeInstance, ViewpointInstance } from "./instances.ts";
import { InstanceTree } from "./instanceTree.ts";
import type { NodeInstance } from "./nodeInstance.ts";

/** All in document order. */
export interface SceneInstances {
  /** Of the boxes of all shapes that are seen. */
  readonly box: Box3;
  /** Once for each place where one stands. */
  readonly shapes: readonly ShapeInstance[];
  /** Those that shine. */
  readonly lights: readonly LightInstance[];
  readonly viewpoints: readonly ViewpointInstance[];
  /** Those that are seen. */
  readonly lods: readonly LodInstance[];
  readonly billboards: readonly NodeInstance[];
}

/** Of a scene that nobody follows. */
export function instancesOf(scene: SceneDescription): SceneInstances {
  const { root } = new InstanceTree().update(scene.root);
  const { box, lights, viewpoints, lods: levels, billboards } = root.summary;
  return { box: box ?? new Box3(), shapes: Array.from(shapesIn(root)), lights, viewpoints, lods: levels, billboards };
}

function* shapesIn({ description, sceneFromNode, lightScope, children }: NodeInstance): Generator<ShapeInstance> {
  if (description.kind === "shape") yield { shape: description, sceneFromShape: sceneFromNode, lightScope };
  for (const child of children) yield* shapesIn(child);
}
