// Where everything in a scene stands, in the scene's coordinates, and how far the
// scene reaches: what the camera must know before anything is drawn, and the same
// for whoever draws.

import { Box3, Matrix4, Quaternion, Vector3 } from "three";
import type {
  LevelsDescription, LightDescription, NodeDescription, Rotation, SceneDescription, ShapeDescription, TransformDescription, Vec3,
} from "../document/description.ts";
import type { PlacedViewpoint } from "./camera.ts";

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
}

export interface PlacedShape {
  readonly shape: ShapeDescription;
  readonly sceneFromShape: Matrix4;
}

export interface PlacedLight {
  readonly light: LightDescription;
  readonly sceneFromLight: Matrix4;
}

/** A LOD in one of its places. */
export interface PlacedLevels extends LevelsDescription {
  readonly sceneFromLevels: Matrix4;
}

export function placementOf(scene: SceneDescription): Placement {
  const box = new Box3();
  const shapes: PlacedShape[] = [];
  const lights: PlacedLight[] = [];
  const viewpoints: PlacedViewpoint[] = [];
  const levels: PlacedLevels[] = [];
  place(scene.root, new Matrix4(), true, true);
  return { box, shapes, lights, viewpoints, levels };

  function reachTo(reached: Box3): void {
    if (isDrawable(reached)) box.union(reached);
  }

  /** `counts`: no group around it has told its box. */
  function place(node: NodeDescription, sceneFromNode: Matrix4, isSeen: boolean, counts: boolean): void {
    switch (node.kind) {
      case "light":
        if (node.light.on && isSeen) lights.push({ light: node.light, sceneFromLight: sceneFromNode });
        return;
      case "viewpoint":
        viewpoints.push({ element: node.element, viewpoint: node.viewpoint, sceneFromViewpoint: sceneFromNode });
        return;
      case "shape":
        shapes.push({ shape: node, sceneFromShape: sceneFromNode });
        if (node.box && node.reaches && counts) reachTo(boxIn(sceneFromNode, node.box));
        return;
      case "group": {
        const sceneFromGroup = node.transform ? sceneFromNode.clone().multiply(matrixOf(node.transform)) : sceneFromNode;
        const isGroupSeen = isSeen && node.visible;
        if (node.levels && isGroupSeen) levels.push({ ...node.levels, sceneFromLevels: sceneFromGroup });
        const own = isGroupSeen && node.box ? boxIn(sceneFromGroup, node.box) : undefined;
        if (own !== undefined && counts) reachTo(own);
        for (const child of node.children) place(child, sceneFromGroup, isGroupSeen, counts && own === undefined);
      }
    }
  }
}

/** Lengths whose squares single precision still holds: beyond, no GPU draws anything, and the rest must be seen. */
const farthest = 1e18;

export function isDrawable({ min, max }: Box3): boolean {
  return [...min.toArray(), ...max.toArray()].every((edge) => Math.abs(edge) < farthest);
}

export function boxIn(sceneFromBox: Matrix4, { min, max }: { min: Vec3; max: Vec3 }): Box3 {
  return new Box3(new Vector3(...min), new Vector3(...max)).applyMatrix4(sceneFromBox);
}

/** X3D Transform: T C R SR S -SR -C (ISO/IEC 19775-1, 10.4.4). */
export function matrixOf(transform: TransformDescription): Matrix4 {
  const { translation, center, rotation, scaleOrientation, scale } = transform;
  const turn = rotationOf(rotation);
  const axes = rotationOf(scaleOrientation);
  const move = (vector: readonly [number, number, number], sign: number) =>
    new Matrix4().makeTranslation(vector[0] * sign, vector[1] * sign, vector[2] * sign);
  return move(translation, 1)
    .multiply(move(center, 1))
    .multiply(turn)
    .multiply(axes)
    .multiply(new Matrix4().makeScale(...scale))
    .multiply(axes.clone().invert())
    .multiply(move(center, -1));
}

function rotationOf([x, y, z, angle]: Rotation): Matrix4 {
  const axis = new Vector3(x, y, z);
  if (axis.lengthSq() === 0) return new Matrix4();
  return new Matrix4().makeRotationFromQuaternion(new Quaternion().setFromAxisAngle(axis.normalize(), angle));
}
