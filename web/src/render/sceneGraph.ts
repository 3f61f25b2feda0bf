// SceneDescription -> three.js groups and lights. Groups own nothing on the GPU,
// so they are made anew whenever the document changes; shapes are kept by their
// element and hung into the new tree.

import type { Box3 } from "three";
import { AmbientLight, Color, DirectionalLight, Group, Matrix4, PointLight, SpotLight, Vector3 } from "three";
import type { LightDescription, NodeDescription, SceneDescription, ShapeDescription } from "../document/description.ts";
import { coneOf } from "../lighting/falloff.ts";
import type { PlacedViewpoint } from "../navigation/camera.ts";
import type { PlacedLevels } from "../navigation/placement.ts";
import { boxIn, matrixOf, placementOf } from "../navigation/placement.ts";
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

/** A group that is seen, with its box in the scene's coordinates. */
export interface BoundedGroup {
  readonly group: Group;
  readonly box: Box3;
}

export function buildGraph(scene: SceneDescription, groupOf: (shape: ShapeDescription) => Group): BuiltGraph {
  const { box, lights, viewpoints, levels } = placementOf(scene);
  const bounded: BoundedGroup[] = [];
  const root = new Group();
  const ambient = new Color(0, 0, 0);
  const attenuations = noAttenuations();
  hang(scene.root, root, new Matrix4(), true);
  // Not into their groups: those are passed over when they are out of the view, and lights shine on.
  for (const { light, sceneFromLight } of lights) hangLight(light, sceneFromLight);
  if (ambient.r + ambient.g + ambient.b > 0) root.add(new AmbientLight(ambient));
  return { root, box, bounded, viewpoints, levels, attenuations };

  function hangLight(description: LightDescription, sceneFromLight: Matrix4): void {
    const light = lightOf(description);
    setColor(light.color, description.color);
    if (!(light instanceof DirectionalLight) && description.kind !== "directional") {
      // Its lengths are those of its own coordinates (17.4.2): what is scaled up reaches further.
      const scale = Math.cbrt(Math.abs(sceneFromLight.determinant())) || 1;
      light.distance = description.radius * scale;
      light.decay = attenuations.length;
      const [constant, linear, square] = description.attenuation;
      attenuations.push(new Vector3(constant, linear / scale, square / scale ** 2));
    }
    const place = new Group();
    place.matrixAutoUpdate = false;
    place.matrix.copy(sceneFromLight);
    place.add(light);
    if (!(light instanceof PointLight)) place.add(light.target);
    root.add(place);
    ambient.add(light.color.clone().multiplyScalar(description.ambientIntensity));
  }

  function hang(node: NodeDescription, parent: Group, sceneFromParent: Matrix4, isSeen: boolean): void {
    if (node.kind === "shape") {
      const group = groupOf(node);
      group.visible = node.visible;
      parent.add(group);
    } else if (node.kind === "group") {
      const group = new Group();
      group.visible = node.visible;
      group.matrixAutoUpdate = false;
      if (node.transform) group.matrix.copy(matrixOf(node.transform));
      parent.add(group);
      const sceneFromGroup = sceneFromParent.clone().multiply(group.matrix);
      const isGroupSeen = isSeen && node.visible;
      if (isGroupSeen && node.box) bounded.push({ group, box: boxIn(sceneFromGroup, node.box) });
      for (const child of node.children) hang(child, group, sceneFromGroup, isGroupSeen);
    }
  }
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
  if (light instanceof SpotLight && description.kind === "spot") {
    light.target.position.copy(light.position).add(new Vector3(...description.direction));
    const { edge, beam } = coneOf(description);
    light.angle = edge;
    light.penumbra = 1 - beam / edge;
  }
  return light;
}
