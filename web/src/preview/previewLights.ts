// The lights of a preview as uniforms of its shaders, in view coordinates.

import type { Matrix4 } from "three";
import { Vector3 } from "three";
import { coneOf, scaledFalloff } from "../lighting/falloff.ts";
import type { EffectScope } from "../scene/effectScope.ts";
import type { LightInstance } from "../scene/instances.ts";
import { lengthScaleOf } from "../scene/transforms.ts";
import type { PreviewScene } from "./previewScene.ts";

export type LightKind = LightInstance["light"]["kind"];

/** Values of all lights, concatenated, by the names of the uniforms. */
export interface LightUniforms {
  readonly lightColors: readonly number[];
  readonly lightPositions: readonly number[];
  readonly lightDirections: readonly number[];
  readonly lightAttenuations: readonly number[];
  readonly lightRadii: readonly number[];
  /** Two per light: the cosines of cutOffAngle and of beamWidth. */
  readonly lightCones: readonly number[];
  readonly ambientLight: readonly [number, number, number];
}

/** The kind of each light, the headlight last. */
export function lightKindsOf({ lights, headlight }: Pick<PreviewScene, "lights" | "headlight">): LightKind[] {
  return [...lights.map(({ light }) => light.kind), ...(headlight ? ["directional" as const] : [])];
}

/** The lights for shapes in an effect scope. Lights that do not reach the scope are black. */
export function lightUniformsOf(
  { lights, headlight }: Pick<PreviewScene, "lights" | "headlight">,
  effectScope: EffectScope,
  viewFromScene: Matrix4,
): LightUniforms {
  const all = lights.map((light) => ({
    ...lightValuesOf(light, viewFromScene),
    ...(!light.scope.contains(effectScope) && { color: [0, 0, 0] }),
  }));
  if (headlight) all.push({ ...directionalDefaults, color: [1, 1, 1], direction: [0, 0, -1] });
  const lightsInScope = lights.filter(({ scope }) => scope.contains(effectScope));
  const ambient = [0, 1, 2].map((channel) =>
    lightsInScope.reduce((sum, { light }) => sum + (light.color[channel] ?? 0) * light.ambientIntensity, 0),
  );
  return {
    lightColors: all.flatMap(({ color }) => color),
    lightPositions: all.flatMap(({ position }) => position),
    lightDirections: all.flatMap(({ direction }) => direction),
    lightAttenuations: all.flatMap(({ attenuation }) => attenuation),
    lightRadii: all.map(({ radius }) => radius),
    lightCones: all.flatMap(({ cone }) => cone),
    ambientLight: [ambient[0] ?? 0, ambient[1] ?? 0, ambient[2] ?? 0],
  };
}

interface LightValues {
  readonly color: readonly number[];
  readonly position: readonly number[];
  readonly direction: readonly number[];
  readonly attenuation: readonly number[];
  readonly radius: number;
  readonly cone: readonly number[];
}

/** Values that a directional light does not use. */
const directionalDefaults = { position: [0, 0, 0], attenuation: [1, 0, 0], radius: 0, cone: [0, 0] };

function lightValuesOf({ light, sceneFromLight }: LightInstance, viewFromScene: Matrix4): LightValues {
  const color = light.color.map((channel) => channel * light.intensity);
  const viewFromLight = viewFromScene.clone().multiply(sceneFromLight);
  const viewDirectionOf = (direction: readonly [number, number, number]) =>
    new Vector3(...direction).transformDirection(viewFromLight).toArray();
  if (light.kind === "directional")
    return { ...directionalDefaults, color, direction: viewDirectionOf(light.direction) };
  const position = new Vector3(...light.location).applyMatrix4(viewFromLight).toArray();
  const { radius, attenuation } = scaledFalloff(light, lengthScaleOf(sceneFromLight));
  if (light.kind === "point")
    return { ...directionalDefaults, color, position, direction: [0, 0, -1], attenuation, radius };
  const { edge, beam } = coneOf(light);
  return {
    color,
    position,
    direction: viewDirectionOf(light.direction),
    attenuation,
    radius,
    cone: [Math.cos(edge), Math.cos(beam)],
  };
}
