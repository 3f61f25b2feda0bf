// Draws sky and ground of X3D's backgrounds (ISO/IEC 19775-1, 24.2.1). Colours are rings around the zenith and the
// nadir; one triangle that covers the canvas draws them, and each pixel computes its view direction.

import { BufferAttribute, BufferGeometry, Mesh, ShaderMaterial } from "three";
import type { BackgroundDescription } from "../../document/description.ts";
import type { BackgroundMesh } from "../environment/lateEnvironment.ts";

/** The maximum number of sky rings and of ground rings that are drawn; further ones are ignored. */
const maxRings = 16;

const vertexShader = /* glsl */ `
varying vec3 direction;
void main() {
  gl_Position = vec4(position.xy, 1.0, 1.0);
  vec2 center = vec2(projectionMatrix[2][0], projectionMatrix[2][1]);
  vec2 viewPosition = (position.xy + center) / vec2(projectionMatrix[0][0], projectionMatrix[1][1]);
  direction = transpose(mat3(modelViewMatrix)) * vec3(viewPosition, -1.0);
}
`;

const fragmentShader = /* glsl */ `
uniform vec3 skyColors[RINGS];
uniform float skyAngles[RINGS];
uniform vec3 groundColors[RINGS];
uniform float groundAngles[RINGS];
uniform int skyCount;
uniform int groundCount;
uniform float opacity;
varying vec3 direction;

float fractionBetween(float begin, float end, float angle) {
  return clamp((angle - begin) / max(end - begin, 1e-6), 0.0, 1.0);
}

void main() {
  float fromZenith = acos(clamp(normalize(direction).y, -1.0, 1.0));
  float fromNadir = PI - fromZenith;
  vec3 color = skyColors[0];
  for (int i = 1; i < RINGS; ++i) {
    if (i < skyCount && fromZenith > skyAngles[i - 1])
      color = mix(skyColors[i - 1], skyColors[i], fractionBetween(skyAngles[i - 1], skyAngles[i], fromZenith));
  }
  if (groundCount > 0 && fromNadir <= groundAngles[groundCount - 1]) {
    color = groundColors[0];
    for (int i = 1; i < RINGS; ++i) {
      if (i < groundCount && fromNadir > groundAngles[i - 1])
        color = mix(groundColors[i - 1], groundColors[i], fractionBetween(groundAngles[i - 1], groundAngles[i], fromNadir));
    }
  }
  gl_FragColor = vec4(color * opacity, opacity);
}
`;

/** A mesh to draw behind everything else; its rotation is that of the background's node. */
export function makeSky(background: BackgroundDescription): BackgroundMesh {
  const triangle = new BufferGeometry().setAttribute(
    "position",
    new BufferAttribute(new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]), 3),
  );
  const mesh = new Mesh(
    triangle,
    new ShaderMaterial({
      vertexShader,
      fragmentShader,
      depthTest: false,
      depthWrite: false,
      defines: { RINGS: maxRings, PI: Math.PI },
      uniforms: {
        ...ringsOf("sky", background.sky),
        ...ringsOf("ground", background.ground),
        opacity: { value: 1 - background.transparency },
      },
    }),
  );
  mesh.frustumCulled = false;
  mesh.renderOrder = -Infinity;
  return mesh;
}

function ringsOf(name: "sky" | "ground", rings: BackgroundDescription["sky"]): Record<string, { value: unknown }> {
  const paddedRings = Array.from(
    { length: maxRings },
    (_, i) => rings[Math.min(i, rings.length - 1)] ?? { angle: 0, color: [0, 0, 0] },
  );
  return {
    [`${name}Colors`]: { value: paddedRings.flatMap(({ color }) => color) },
    [`${name}Angles`]: { value: paddedRings.map(({ angle }) => angle) },
    [`${name}Count`]: { value: Math.min(rings.length, maxRings) },
  };
}
