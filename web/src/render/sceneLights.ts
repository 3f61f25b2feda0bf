// The lights of a scene as three.js has them. They hang beside its groups, not in
// them: those are passed over when they are out of the view, and lights shine on.

import { AmbientLight, Color, DirectionalLight, Group, PointLight, SpotLight, Vector3 } from "three";
import type { LightDescription } from "../document/description.ts";
import { coneOf, scaledFalloff } from "../lighting/falloff.ts";
import { lengthScaleOf } from "../navigation/matrices.ts";
import type { PlacedLight } from "../navigation/placement.ts";
import { noAttenuations } from "./lightFalloff.ts";
import { setColor } from "./materials.ts";

export interface SceneLights {
  readonly root: Group;
  /** Of those that have a place, by the number in their `decay`: see lightFalloff.ts. */
  readonly attenuations: Vector3[];
}

export function makeLights(lights: readonly PlacedLight[]): SceneLights {
  const root = new Group();
  const attenuations = noAttenuations();
  const ambient = new Color(0, 0, 0);
  for (const { light: description, sceneFromLight } of lights) {
    const light = lightOf(description);
    setColor(light.color, description.color);
    if (!(light instanceof DirectionalLight) && description.kind !== "directional") {
      const { radius, attenuation } = scaledFalloff(description, lengthScaleOf(sceneFromLight));
      light.distance = radius;
      light.decay = attenuations.length;
      attenuations.push(new Vector3(...attenuation));
    }
    const place = new Group();
    place.matrixAutoUpdate = false;
    place.matrix.copy(sceneFromLight);
    place.add(light);
    if (!(light instanceof PointLight)) place.add(light.target);
    root.add(place);
    ambient.add(light.color.clone().multiplyScalar(description.ambientIntensity));
  }
  if (ambient.r + ambient.g + ambient.b > 0) root.add(new AmbientLight(ambient));
  return { root, attenuations };
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
