// The lights of a scene as three.js lights. They are children of a group of their own beside the
// groups of shapes, because culled groups become invisible and lights must not.

import type { Vector2 } from "three";
import { AmbientLight, Color, DirectionalLight, Group, PointLight, SpotLight, Vector3 } from "three";
import type { LightDescription } from "../../document/description.ts";
import { coneOf, scaledFalloff } from "../../lighting/falloff.ts";
import { lengthScaleOf } from "../../scene/transforms.ts";
import { sceneScope } from "../../scene/effectScope.ts";
import type { LightInstance } from "../../scene/instances.ts";
import { scopeRangeOf } from "../shaders/scopeRange.ts";
import { setColor } from "./linearColor.ts";

/** Light parameters that three.js lacks, as uniforms of all lit materials. */
export interface SceneLightUniforms {
  /** Attenuation of each point and spot light, indexed by its `decay` (lightFalloff.ts). Never empty. */
  readonly attenuations: { value: Vector3[] };
  /**
   * For each light, the first and the last scope number that it reaches: point lights, then spot lights, then
   * directional lights, then two entries that reach everything. Empty where all lights are global.
   */
  readonly lightScopeRanges: { value: Vector2[] };
  /** In the same order, the ambient light of lights that do not reach every scope; black for the others. */
  readonly scopedAmbients: { value: Vector3[] };
}

export function makeLightUniforms(): SceneLightUniforms {
  return {
    attenuations: { value: [new Vector3(1, 0, 0)] },
    lightScopeRanges: { value: [] },
    scopedAmbients: { value: [] },
  };
}

export interface SceneLights {
  readonly root: Group;
  readonly uniforms: SceneLightUniforms;
}

export function makeLights(lights: readonly LightInstance[]): SceneLights {
  const root = new Group();
  const uniforms = makeLightUniforms();
  const attenuations = uniforms.attenuations.value;
  const ambient = new Color(0, 0, 0);
  for (const { light: description, sceneFromLight, scope } of lights) {
    const light = lightOf(description);
    setColor(light.color, description.color);
    if (!(light instanceof DirectionalLight) && description.kind !== "directional") {
      const { radius, attenuation } = scaledFalloff(description, lengthScaleOf(sceneFromLight));
      light.distance = radius;
      light.decay = attenuations.length;
      attenuations.push(new Vector3(...attenuation));
    }
    const group = new Group();
    group.matrixAutoUpdate = false;
    group.matrix.copy(sceneFromLight);
    group.add(light);
    if (!(light instanceof PointLight)) group.add(light.target);
    root.add(group);
    if (scope === sceneScope) ambient.add(ambientOf(description));
  }
  if (ambient.r + ambient.g + ambient.b > 0) root.add(new AmbientLight(ambient));
  if (lights.some(({ scope }) => scope !== sceneScope)) setScopeRanges(uniforms, lights);
  return { root, uniforms };
}

function ambientOf({ color, ambientIntensity }: LightDescription): Color {
  const ambient = new Color();
  setColor(ambient, color);
  return ambient.multiplyScalar(ambientIntensity);
}

/**
 * Appends the values of each light in the order in which three.js' programs count lights. The headlight, where there is
 * one, is the last directional light.
 */
function setScopeRanges(
  { lightScopeRanges, scopedAmbients }: SceneLightUniforms,
  lights: readonly LightInstance[],
): void {
  for (const kind of ["point", "spot", "directional"] as const) {
    for (const { light, scope } of lights.filter((each) => each.light.kind === kind)) {
      lightScopeRanges.value.push(scopeRangeOf(scope));
      scopedAmbients.value.push(new Vector3(...(scope === sceneScope ? [0, 0, 0] : ambientOf(light).toArray())));
    }
  }
  // One entry for the headlight, and one because GLSL has no empty arrays.
  for (let more = 0; more < 2; ++more) {
    lightScopeRanges.value.push(scopeRangeOf(sceneScope));
    scopedAmbients.value.push(new Vector3());
  }
}

function lightOf(description: LightDescription): DirectionalLight | PointLight | SpotLight {
  if (description.kind === "directional") {
    const light = new DirectionalLight();
    light.intensity = description.intensity;
    // A three.js DirectionalLight shines from its position towards its target.
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
