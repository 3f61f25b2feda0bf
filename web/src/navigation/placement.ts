// Where everything in a scene stands, in the scene's coordinates, and how far the
// scene reaches: what the camera must know before anything is drawn, and the same
// for whoever draws.

import type { Matrix4 } from "three";
import { Box3 } from "three";
import type {
  LevelsDescription,
  LightDescription,
  SceneDescription,
  ShapeDescription,
} from "../document/description.ts";
import type { PlacedViewpoint } from "./camera.ts";
import type { LightScope } from "./lightScope.ts";
import type { PlacedNode } from "./placedTree.ts";
import { PlacedTree } from "./placedTree.ts";

/** All in document order. */
export interface Placement {
  /** Of the boxes of all shapes that are seen. */
  readonly box: Box3;
  /** Once for each place where one stands. */
  readonly shapes: readonly PlacedShape[];
  /** Those that shine. */
  readonly lights: readonly PlacedLight[];
  readonly viewpoints: readonly PlacedViewpoint[];
  /** Those that are seen. */
  readonly levels: readonly PlacedLevels[];
  readonly billboards: readonly PlacedNode[];
}

export interface PlacedShape {
  readonly shape: ShapeDescription;
  readonly sceneFromShape: Matrix4;
  /** The innermost that it stands in. */
  readonly lightScope: LightScope;
}

export interface PlacedLight {
  readonly light: LightDescription;
  readonly sceneFromLight: Matrix4;
  /** What it shines on. */
  readonly scope: LightScope;
}

/** A LOD in one of its places. */
export interface PlacedLevels extends LevelsDescription {
  readonly sceneFromLevels: Matrix4;
}

/** Of a scene that nobody follows. */
export function placementOf(scene: SceneDescription): Placement {
  const { root } = new PlacedTree().follow(scene.root);
  const { box, lights, viewpoints, levels, billboards } = root.reach;
  return { box: box ?? new Box3(), shapes: Array.from(shapesIn(root)), lights, viewpoints, levels, billboards };
}

function* shapesIn({ description, sceneFromNode, lightScope, children }: PlacedNode): Generator<PlacedShape> {
  if (description.kind === "shape") yield { shape: description, sceneFromShape: sceneFromNode, lightScope };
  for (const child of children) yield* shapesIn(child);
}
