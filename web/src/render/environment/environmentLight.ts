// EnvironmentLight (ISO/IEC 19775-1, 17.4.2) in shaders: the values of the scene's light, and the GLSL functions that
// lighting/surroundings.ts calls. Programs of scenes without one contain no such code.

import type { IUniform, WebGLProgramParametersWithUniforms } from "three";
import { Matrix3, Vector3 } from "three";
import { toLinearChunk } from "../../lighting/physicalLighting.ts";
import { environmentDefine } from "../../lighting/surroundings.ts";
import type { EnvironmentLightInstance } from "../../scene/instances.ts";
import { rotationIn, rotationOf } from "../../scene/transforms.ts";
import { scopeRangeOf } from "../shaders/scopeRange.ts";
import type { DiffuseSource, EnvironmentUniforms } from "./effectUniforms.ts";
import { makeEnvironmentUniforms } from "./effectUniforms.ts";

/** Those among the values that the materials of a scene share. */
export function environmentUniformsOf(shared: EnvironmentUniforms): Record<string, IUniform> {
  const names = Object.keys(makeEnvironmentUniforms()) as (keyof EnvironmentUniforms)[];
  const uniforms = names.filter((name) => name !== "environmentDiffuseSource");
  return Object.fromEntries(uniforms.map((name) => [name, shared[name]]));
}

/** Sets the light of a scene; undefined: none. */
export function setEnvironmentLight(
  uniforms: EnvironmentUniforms,
  instance: EnvironmentLightInstance | undefined,
): void {
  uniforms.environmentDiffuseSource.value = diffuseSourceOf(instance);
  if (instance === undefined) return;
  const { light, sceneFromLight, scope } = instance;
  const { diffuseCoefficients: numbers } = light;
  uniforms.environmentCoefficients.value = Array.from({ length: numbers.length / 3 }, (_, i) =>
    new Vector3().fromArray(numbers, 3 * i),
  );
  uniforms.environmentScope.value = scopeRangeOf(scope);
  uniforms.environmentColor.value = new Vector3(...light.color).multiplyScalar(light.intensity);
  uniforms.environmentAmbient.value = new Vector3(...light.color).multiplyScalar(light.ambientIntensity);
  const sceneFromMap = rotationIn(sceneFromLight).multiply(rotationOf(light.rotation));
  uniforms.environmentRotation.value = new Matrix3().setFromMatrix4(sceneFromMap.transpose());
}

function diffuseSourceOf(instance: EnvironmentLightInstance | undefined): DiffuseSource {
  if (instance === undefined) return "none";
  if (instance.light.diffuse) return "texture";
  return instance.light.diffuseCoefficients.length > 0 ? "coefficients" : "specular";
}

const declarations = /* glsl */ `
#define ${environmentDefine}
uniform samplerCube environmentSpecular;
uniform vec2 environmentLevels;
uniform vec2 environmentScope;
uniform vec3 environmentColor;
uniform vec3 environmentAmbient;
uniform mat3 environmentRotation;

bool environmentReaches() {
  return environmentLevels.x >= 0.0 && shareInScopes(environmentScope) > 0.0;
}

// From the camera's axes to those of the cube maps.
vec3 inEnvironment(vec3 direction) {
  return environmentRotation * (direction * mat3(viewMatrix));
}

// x is turned round: the cube is seen from within.
vec3 environmentTexel(samplerCube cube, vec3 direction, float level) {
  vec3 color = textureLod(cube, vec3(-direction.x, direction.yz), level).rgb;
  ${toLinearChunk("color")}
  return color * environmentColor;
}

// The level whose texels are as wide as the lobe of GGX.
vec3 environmentRadiance(vec3 direction, float roughness) {
  float alpha2 = pow(max(roughness, 0.01), 4.0);
  float level = environmentLevels.x + 0.5 * log2(6.0 * alpha2 / (1.0 + alpha2));
  return environmentTexel(environmentSpecular, inEnvironment(direction), clamp(level, 0.0, environmentLevels.x));
}
`;

/** By where it comes from, the function environmentIrradiance. */
const irradiance: Readonly<Record<Exclude<DiffuseSource, "none">, string>> = {
  specular: /* glsl */ `
vec3 environmentIrradiance(vec3 normal) {
  return environmentTexel(environmentSpecular, inEnvironment(normal), environmentLevels.x);
}
`,
  texture: /* glsl */ `
uniform samplerCube environmentDiffuse;
vec3 environmentIrradiance(vec3 normal) {
  return environmentLevels.y < 0.0 ? vec3(0.0) : environmentTexel(environmentDiffuse, inEnvironment(normal), 0.0);
}
`,
  // The irradiance of Ramamoorthi and Hanrahan (2001), by pi.
  coefficients: /* glsl */ `
uniform vec3 environmentCoefficients[9];
vec3 environmentIrradiance(vec3 normal) {
  vec3 n = inEnvironment(normal);
  vec3 sum = 0.282095 * environmentCoefficients[0] +
    0.488603 * (n.y * environmentCoefficients[1] + n.z * environmentCoefficients[2] +
                n.x * environmentCoefficients[3]) +
    1.092548 * (n.x * n.y * environmentCoefficients[4] + n.y * n.z * environmentCoefficients[5] +
                n.x * n.z * environmentCoefficients[7]) +
    0.315392 * (3.0 * n.z * n.z - 1.0) * environmentCoefficients[6] +
    0.546274 * (n.x * n.x - n.y * n.y) * environmentCoefficients[8];
  return max(sum, 0.0) * environmentColor / 3.14159265;
}
`,
};

/** Call in `onBeforeCompile`, before the draw's scope is added. */
export function addEnvironmentLight(
  shader: Pick<WebGLProgramParametersWithUniforms, "fragmentShader">,
  source: Exclude<DiffuseSource, "none">,
): void {
  shader.fragmentShader = declarations + irradiance[source] + shader.fragmentShader;
}
