// X3D's lighting (ISO/IEC 19775-1, 17.2.2) in GLSL, for pages and for the preview: per light,
// diffuse N.L + specular (N.H)^(128 shininess), plus its ambient term.
//
// Colours are not converted: the document's values are display values, and light is added up in
// them, as X3D's equations are written and as X3DOM draws them. A grey of 0.5 that faces the headlight is
// 128 on the screen. Colours and light of a PhysicalMaterial are linear: physicalLighting.ts.

import { physicalDefine, physicalLighting } from "./physicalLighting.ts";
import { ambientLightChunk } from "./surroundings.ts";

/** What the lighting functions know of a surface. */
export const materialStruct = /* glsl */ `
struct X3dMaterial {
  vec3 diffuseColor;
  vec3 specularColor;
  float shininess;
  vec3 ambient;
  float metallic;
  float roughness;
};
`;

/**
 * The functions directX3d and ambientX3d. They need three.js' IncidentLight (color, direction towards the light) and
 * ReflectedLight (directDiffuse, directSpecular, indirectDiffuse, indirectSpecular). Directions have length 1.
 */
export const x3dLighting = /* glsl */ `
${materialStruct}
${ambientLightChunk}
#ifdef ${physicalDefine}
${physicalLighting}
#else

void directX3d(const in IncidentLight light, const in vec3 position, const in vec3 normal, const in vec3 viewDirection,
               const in vec3 clearcoatNormal, const in X3dMaterial material, inout ReflectedLight reflected) {
  float NL = dot(normal, light.direction);
  if (NL <= 0.0) return;
  vec3 halfway = normalize(light.direction + viewDirection);
  reflected.directDiffuse += light.color * material.diffuseColor * NL;
  float highlight = pow(max(dot(normal, halfway), 1e-6), material.shininess);
  reflected.directSpecular += light.color * material.specularColor * highlight;
}

void ambientX3d(const in vec3 light, const in vec3 position, const in vec3 normal, const in vec3 viewDirection,
                const in vec3 clearcoatNormal, const in X3dMaterial material, inout ReflectedLight reflected) {
  reflected.indirectDiffuse += allAmbientLight(light) * material.diffuseColor * material.ambient;
}

#endif
`;
