// The GLSL of PhysicalMaterials with extensions in pages.

import { extendedLighting, extendedSurface, transmissionChunk } from "../../lighting/extendedLighting.ts";
import { instancesDefine } from "../shaders/instanceRecord.ts";
import { replaceChunks } from "../shaders/replaceChunks.ts";
import { extraMapDefine, extraTexel, extraUv } from "../shaders/texCoords.ts";
import type { ExtensionShaders } from "./extendedMaterials.ts";

const surfaceChunk = extendedSurface(
  (role, use) => `
#ifdef ${extraMapDefine(role)}
  ${use(extraTexel(role), extraUv(role))}
#endif`,
  `
#ifdef ${extraMapDefine("anisotropy")}
  ${extraUv("anisotropy")}
#elif defined(USE_NORMALMAP)
  vNormalMapUv
#elif defined(USE_MAP)
  vMapUv
#else
  vec2(0.0)
#endif
`,
);

/** How much larger lengths are in the scene than in the shape's own units. */
const shapeScaleChunk = /* glsl */ `
#ifdef ${instancesDefine}
  vShapeScale = length(vec3(instanceTexel(0).x, instanceTexel(1).x, instanceTexel(2).x)) / instanceTexel(3).x;
#else
  vShapeScale = length(modelMatrix[0].xyz) / latticeStep.x;
#endif
`;

export const extensionShaders: ExtensionShaders = {
  lightingChunks: (lighting) => [
    ["#include <lights_phong_pars_fragment>", lighting(extendedLighting)],
    ["#include <normal_fragment_maps>", `vec3 faceNormal = normal;\n#include <normal_fragment_maps>`],
    ["#include <lights_fragment_begin>", `${surfaceChunk}\n#include <lights_fragment_begin>`],
    ["#include <lights_fragment_end>", `#include <lights_fragment_end>\n${transmissionChunk}`],
  ],
  vertexShader: (vertexShader) =>
    replaceChunks(vertexShader, [
      ["#include <common>", "#include <common>\nvarying float vShapeScale;"],
      ["#include <fog_vertex>", `#include <fog_vertex>\n${shapeScaleChunk}`],
    ]),
};
