// SceneDescription -> three.js groups and lights. Groups own nothing on the GPU,
// so they are made anew whenever the document changes; shapes are kept by their
// element and hung into the new tree.

import {
  AmbientLight, Box3, Color, DirectionalLight, Group, Matrix4, PointLight, Quaternion, SpotLight, Vector3,
} from "three";
import type {
  LevelsDescription, LightDescription, NodeDescription, Rotation, SceneDescription, ShapeDescription, TransformDescription, Vec3,
} from "../document/description.ts";
import type { PlacedViewpoint } from "../navigation/camera.ts";
import { noAttenuations } from "./lightFalloff.ts";
import { setColor } from "./materials.ts";

export interface BuiltGraph {
  readonly root: Group;
  /** Of the boxes of all shapes that are seen, in the scene's coordinates. */
  readonly box: Box3;
  /** What may be passed over as a whole when it is out of the view. */
  readonly bounded: readonly BoundedGroup[];
  /** In document order. */
  readonly viewpoints: readonly PlacedViewpoint[];
  readonly levels: readonly PlacedLevels[];
  /** Of the lights that have a place, by the number in their `decay`: see lightFalloff.ts. */
  readonly attenuations: Vector3[];
}

/** A LOD in one of its places. */
export interface PlacedLevels extends LevelsDescription {
  readonly sceneFromLevels: Matrix4;
}

/** A group that is seen, with its box in the scene's coordinates. */
export interface BoundedGroup {
  readonly group: Group;
  readonly box: Box3;
}

export function buildGraph(scene: SceneDescription, groupOf: (shape: ShapeDescription) => Group): BuiltGraph {
  const box = new Box3();
  const viewpoints: PlacedViewpoint[] = [];
  const bounded: BoundedGroup[] = [];
  const levels: PlacedLevels[] = [];
  const root = new Group();
  const ambient = new Color(0, 0, 0);
  const attenuations = noAttenuations();
  hang(scene.root, root, new Matrix4(), true, true);
  if (ambient.r + ambient.g + ambient.b > 0) root.add(new AmbientLight(ambient));
  return { root, box, bounded, viewpoints, levels, attenuations };

  function hangLight(description: LightDescription, sceneFromLight: Matrix4): void {
    const light = lightOf(description);
    setColor(light.color, description.color);
    if (!(light instanceof DirectionalLight) && description.kind !== "directional") {
      light.decay = attenuations.length;
      attenuations.push(new Vector3(...description.attenuation));
    }
    const place = new Group();
    place.matrixAutoUpdate = false;
    place.matrix.copy(sceneFromLight);
    place.add(light);
    if (!(light instanceof PointLight)) place.add(light.target);
    root.add(place);
    ambient.add(light.color.clone().multiplyScalar(description.ambientIntensity));
  }

  function reachTo(reached: Box3): void {
    if (isDrawable(reached)) box.union(reached);
  }

  /** `counts`: no group around it has told its box. */
  function hang(node: NodeDescription, parent: Group, sceneFromParent: Matrix4, isSeen: boolean, counts: boolean): void {
    switch (node.kind) {
      case "light":
        // Not into its group: that is passed over when it is out of the view, and shines on.
        if (node.light.on && isSeen) hangLight(node.light, sceneFromParent);
        return;
      case "viewpoint":
        viewpoints.push({ element: node.element, viewpoint: node.viewpoint, sceneFromViewpoint: sceneFromParent });
        return;
      case "shape": {
        const group = groupOf(node);
        group.visible = node.visible;
        parent.add(group);
        if (node.box && node.reaches && counts) reachTo(boxIn(sceneFromParent, node.box));
        return;
      }
      case "group": {
        const group = new Group();
        group.visible = node.visible;
        group.matrixAutoUpdate = false;
        if (node.transform) group.matrix.copy(matrixOf(node.transform));
        parent.add(group);
        const sceneFromGroup = sceneFromParent.clone().multiply(group.matrix);
        const isGroupSeen = isSeen && node.visible;
        if (node.levels && isGroupSeen) levels.push({ ...node.levels, sceneFromLevels: sceneFromGroup });
        const own = isGroupSeen && node.box ? boxIn(sceneFromGroup, node.box) : undefined;
        if (own !== undefined) {
          bounded.push({ group, box: own });
          if (counts) reachTo(own);
        }
        for (const child of node.children) hang(child, group, sceneFromGroup, isGroupSeen, counts && own === undefined);
      }
    }
  }
}

/** Lengths whose squares single precision still holds: beyond, no GPU draws anything, and the rest must be seen. */
const farthest = 1e18;

export function isDrawable({ min, max }: Box3): boolean {
  return [...min.toArray(), ...max.toArray()].every((edge) => Math.abs(edge) < farthest);
}

function boxIn(sceneFromBox: Matrix4, { min, max }: { min: Vec3; max: Vec3 }): Box3 {
  return new Box3(new Vector3(...min), new Vector3(...max)).applyMatrix4(sceneFromBox);
}

function lightOf(description: LightDescription): DirectionalLight | PointLight | SpotLight {
  if (description.kind === "directional") {
    const light = new DirectionalLight();
    light.intensity = description.intensity;
    // three's light shines from its position to its target.
    light.position.set(0, 0, 0);
    light.target.position.set(...description.direction);
    return light;
  }
  const light = description.kind === "point" ? new PointLight() : new SpotLight();
  light.position.set(...description.location);
  light.intensity = description.intensity;
  light.distance = description.radius;
  if (light instanceof SpotLight && description.kind === "spot") {
    light.target.position.copy(light.position).add(new Vector3(...description.direction));
    light.angle = Math.min(description.cutOffAngle, Math.PI / 2);
    light.penumbra = 1 - Math.min(description.beamWidth / description.cutOffAngle, 1);
  }
  return light;
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
