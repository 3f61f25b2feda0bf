// Fog, LocalFog and FogCoordinate (ISO/IEC 19775-1, 24.2.3) in shaders. Programs of scenes without fog contain no such
// code.

import type { WebGLProgramParametersWithUniforms } from "three";
import { Vector2, Vector3 } from "three";
import type { FogDescription } from "../../document/description.ts";
import type { EffectScope } from "../../scene/effectScope.ts";
import { replaceChunks } from "../shaders/replaceChunks.ts";
import { fogDepthsDefine } from "../materials/lateValues.ts";
import { scopeRangeOf } from "../shaders/scopeRange.ts";
import type { FogUniforms } from "./effectUniforms.ts";

/** A fog that applies to the shapes of a scope. */
export interface ScopedFog {
  readonly fog: FogDescription;
  /** Scene units in one unit of the node. */
  readonly scale: number;
  readonly scope: EffectScope;
}

/** Further fogs are not drawn. */
const maxFogs = 32;

/** Sets the fogs of a scene, outer ones first. */
export function setFogs({ fogColors, fogRanges, fogScopes }: FogUniforms, all: readonly ScopedFog[]): void {
  const fogs = all.slice(0, maxFogs);
  fogColors.value = fogs.map(({ fog }) => new Vector3(...fog.color));
  fogRanges.value = fogs.map(
    ({ fog, scale }) => new Vector2(fog.visibilityRange * scale, fog.type === "exponential" ? 1 : 0),
  );
  fogScopes.value = fogs.map(({ scope }) => scopeRangeOf(scope));
}

/** Call in `onBeforeCompile` after addValueColors, before `viewPoint` and the draw's scope are added. */
export function addFogs(
  shader: Pick<WebGLProgramParametersWithUniforms, "vertexShader" | "fragmentShader">,
  count: number,
): void {
  const depthDeclaration = /* glsl */ `
#ifdef ${fogDepthsDefine}
  varying float vertexFogDepth;
#endif
`;
  const depthReading = /* glsl */ `
#include <fog_vertex>
#ifdef ${fogDepthsDefine}
  vertexFogDepth = readValue();
#endif
`;
  shader.vertexShader =
    depthDeclaration + replaceChunks(shader.vertexShader, [["#include <fog_vertex>", depthReading]]);
  const declarations = /* glsl */ `${depthDeclaration}
uniform vec3 fogColors[${count}];
uniform vec2 fogRanges[${count}];
uniform vec2 fogScopes[${count}];

// The share of the surface's own color that is visible at this distance (24.2.3): 1 without fog. The depth of a
// FogCoordinate, 0 ... 1, is the share of the fog's color (24.4.5: its range does not depend on visibilityRange).
float visibleShareIn(vec2 range, float distance) {
  if (range.x <= 0.0) return 1.0;
  #ifdef ${fogDepthsDefine}
    return 1.0 - clamp(vertexFogDepth, 0.0, 1.0);
  #endif
  if (distance >= range.x) return 0.0;
  return range.y > 0.0 ? exp(-distance / (range.x - distance)) : (range.x - distance) / range.x;
}
`;
  // After the conversion to display values, which the colors of fogs are.
  const mixing = /* glsl */ `
#include <fog_fragment>
  vec3 fogColor = vec3(0.0);
  float visibleShare = 1.0;
  for (int fog = 0; fog < ${count}; ++fog) {
    if (shareInScopes(fogScopes[fog]) > 0.0) {
      fogColor = fogColors[fog];
      visibleShare = visibleShareIn(fogRanges[fog], length(viewPoint));
    }
  }
  gl_FragColor.rgb = mix(fogColor, gl_FragColor.rgb, visibleShare);
`;
  shader.fragmentShader = declarations + replaceChunks(shader.fragmentShader, [["#include <fog_fragment>", mixing]]);
}
