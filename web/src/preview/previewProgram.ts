// The shader programs of a preview: vertices in lattice coordinates, and the X3D
// lighting model by the same GLSL as the runtime's (lighting/).

import { falloffChunk } from "../lighting/falloff.ts";
import { physicalDefine, toSrgbChunk, toLinearChunk } from "../lighting/physicalLighting.ts";
import { x3dLighting } from "../lighting/x3dLighting.ts";
import type { LightKind } from "./previewLights.ts";

/**
 * Attribute locations in every program. A base mesh without vertex colours is drawn with the constant attribute white.
 */
export const attributeLocations = { position: 0, normal: 1, color: 2 } as const;

/** The properties of a shape that its program is compiled for. */
export interface PreviewProgramKind {
  readonly material: "phong" | "physical" | "unlit";
  readonly hasNormals: boolean;
  readonly isTwoSided: boolean;
  readonly lights: readonly LightKind[];
}

const vertexShader = /* glsl */ `
layout(location = ${attributeLocations.position}) in vec3 position;
layout(location = ${attributeLocations.normal}) in vec3 normal;
layout(location = ${attributeLocations.color}) in vec3 color;
uniform mat4 clipFromView;
uniform mat4 viewFromStored;
uniform mat3 viewFromNormal;
out vec3 towardsEye;
out vec3 viewNormal;
out vec3 vertexColor;

void main() {
  vec4 viewPosition = viewFromStored * vec4(position, 1.0);
  gl_Position = clipFromView * viewPosition;
  towardsEye = -viewPosition.xyz;
  viewNormal = normalize(viewFromNormal * normal); // stored normals have different lengths
  vertexColor = color;
  #ifdef ${physicalDefine}
    ${toLinearChunk("vertexColor")}
  #endif
}
`;

// Light positions are in view coordinates. The source calls the function of each light's kind,
// because a GPU that branches on the kind at every pixel evaluates all kinds.
const fragmentShader = (lights: readonly LightKind[]): string => /* glsl */ `
precision highp float;
struct IncidentLight { vec3 color; vec3 direction; };
struct ReflectedLight { vec3 directDiffuse; vec3 directSpecular; vec3 indirectDiffuse; vec3 indirectSpecular; };

uniform vec3 color;
uniform vec3 specular;
uniform vec3 emissive;
uniform float shininess;
uniform float ambientIntensity;
uniform float metallic;
uniform float roughness;
uniform float exposure;
uniform vec3 ambientLight;
#if LIGHTS > 0
uniform vec3 lightColors[LIGHTS];
uniform vec3 lightPositions[LIGHTS];
uniform vec3 lightDirections[LIGHTS];
uniform vec3 lightAttenuations[LIGHTS];
uniform float lightRadii[LIGHTS];
uniform vec2 lightCones[LIGHTS];
#endif
in vec3 towardsEye;
in vec3 viewNormal;
in vec3 vertexColor;
out vec4 pixel;

${x3dLighting}
${falloffChunk}

#if LIGHTS > 0
IncidentLight directionalLight(int i, vec3 viewPosition) {
  return IncidentLight(lightColors[i], -lightDirections[i]);
}

IncidentLight pointLight(int i, vec3 viewPosition) {
  vec3 toLight = lightPositions[i] - viewPosition;
  return IncidentLight(lightColors[i] * attenuationAtDistance(length(toLight), lightRadii[i], lightAttenuations[i]), normalize(toLight));
}

IncidentLight spotLight(int i, vec3 viewPosition) {
  IncidentLight light = pointLight(i, viewPosition);
  light.color *= attenuationInCone(lightCones[i].x, lightCones[i].y, dot(-light.direction, lightDirections[i]));
  return light;
}
#endif

vec3 facingNormal() {
  #ifdef FLAT
    return normalize(cross(dFdx(towardsEye), dFdy(towardsEye)));
  #else
    vec3 normal = normalize(viewNormal);
    #ifdef TWO_SIDED
      if (!gl_FrontFacing) normal = -normal;
    #endif
    return normal;
  #endif
}

void main() {
  #ifdef UNLIT
    vec3 radiance = color * vertexColor;
  #else
    X3dMaterial material = X3dMaterial(color * vertexColor, specular, shininess, vec3(ambientIntensity), metallic, roughness);
    ReflectedLight reflected = ReflectedLight(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
    vec3 normal = facingNormal();
    vec3 viewDirection = normalize(towardsEye);
    ${lights.map((kind, i) => `directX3d(${kind}Light(${i}, -towardsEye), -towardsEye, normal, viewDirection, vec3(0.0), material, reflected);`).join("\n    ")}
    ambientX3d(ambientLight, -towardsEye, normal, viewDirection, vec3(0.0), material, reflected);
    vec3 radiance = reflected.directDiffuse + reflected.directSpecular + reflected.indirectDiffuse + reflected.indirectSpecular + emissive;
  #endif
  pixel = vec4(clamp(exposure * radiance, 0.0, 1.0), 1.0);
  #ifdef ${physicalDefine}
    ${toSrgbChunk("pixel.rgb")}
  #endif
}
`;

export interface PreviewProgram {
  readonly program: WebGLProgram;
  /** The location of a uniform; null where the program does not use it. */
  readonly uniform: (name: string) => WebGLUniformLocation | null;
}

/** Begins to compile a program. The first draw with it waits for the compiler. */
export function makePreviewProgram(gl: WebGL2RenderingContext, kind: PreviewProgramKind): PreviewProgram {
  const { material, hasNormals, isTwoSided, lights } = kind;
  const flags: readonly [string, boolean][] = [
    [physicalDefine, material === "physical"],
    ["UNLIT", material === "unlit"],
    ["FLAT", !hasNormals],
    ["TWO_SIDED", isTwoSided],
  ];
  const defines = flags.map(([name, isSet]) => (isSet ? `#define ${name}\n` : "")).join("");
  const head = `#version 300 es\n${defines}#define LIGHTS ${lights.length}\n`;
  const program = gl.createProgram();
  for (const [type, text] of [
    [gl.VERTEX_SHADER, vertexShader],
    [gl.FRAGMENT_SHADER, fragmentShader(lights)],
  ] as const) {
    const shader = gl.createShader(type);
    if (shader === null) continue; // the context is lost, which ends the preview
    gl.shaderSource(shader, head + text);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
    gl.deleteShader(shader); // the GPU keeps it until the program is deleted
  }
  gl.linkProgram(program);
  const locations = new Map<string, WebGLUniformLocation | null>();
  return {
    program,
    uniform: (name) => {
      const cached = locations.get(name);
      if (cached !== undefined) return cached;
      const location = gl.getUniformLocation(program, name);
      locations.set(name, location);
      return location;
    },
  };
}
