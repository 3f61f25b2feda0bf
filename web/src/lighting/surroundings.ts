// GLSL of the light from all around a surface: of an EnvironmentLight where one reaches it (declared by
// render/environment/environmentLight.ts), else of uniform grey surroundings, which only metals and coats reflect.

/** Defined in programs of scenes with an EnvironmentLight. */
export const environmentDefine = "ENVIRONMENT_LIGHT";

export const surroundingsChunk = /* glsl */ `
const float greyRadiance = 0.3;

// The light from a direction (towards the surroundings), in view coordinates, spread by roughness. metallic: the share
// of the grey surroundings that is reflected.
vec3 surroundingRadiance(vec3 direction, float roughness, float metallic) {
#ifdef ${environmentDefine}
  if (environmentReaches()) return environmentRadiance(direction, roughness);
#endif
  return vec3(greyRadiance * metallic);
}

// The light that falls on a surface, by pi.
vec3 surroundingIrradiance(vec3 normal) {
#ifdef ${environmentDefine}
  if (environmentReaches()) return environmentIrradiance(normal);
#endif
  return vec3(0.0);
}
`;

/** Ambient light, with that of an EnvironmentLight. */
export const ambientLightChunk = /* glsl */ `
vec3 allAmbientLight(vec3 light) {
#ifdef ${environmentDefine}
  if (environmentReaches()) return light + environmentAmbient;
#endif
  return light;
}
`;
