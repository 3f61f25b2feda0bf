// The shaders of a first look: vertices out of buffers of lattice numbers, and the
// light of X3D in the same words as the runtime's (lighting).

import { falloffChunk } from "../lighting/falloff.ts";
import { physicalDefine, toDisplayedChunk, toLinearChunk } from "../lighting/physicalLighting.ts";
import { x3dLighting } from "../lighting/x3dLighting.ts";
import type { LightKind } from "./previewLights.ts";

/** Where attributes are in every program. Without colours of vertices that of all is white. */
export const attributeLocations = { position: 0, normal: 1, color: 2 } as const;

/** What differs from program to program. */
export interface ProgramKind {
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
  vec4 place = viewFromStored * vec4(position, 1.0);
  gl_Position = clipFromView * place;
  towardsEye = -place.xyz;
  viewNormal = viewFromNormal * normal;
  vertexColor = color;
  #ifdef ${physicalDefine}
    ${toLinearChunk("vertexColor")}
  #endif
}
`;

// Lights stand in the coordinates of the view. Each is called by its kind: a GPU that
// has to find that out at every pixel goes through all of them.
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
IncidentLight directionalLight(int i, vec3 place) {
  return IncidentLight(lightColors[i], -lightDirections[i]);
}

IncidentLight pointLight(int i, vec3 place) {
  vec3 way = lightPositions[i] - place;
  return IncidentLight(lightColors[i] * attenuationAtDistance(length(way), lightRadii[i], lightAttenuations[i]), normalize(way));
}

IncidentLight spotLight(int i, vec3 place) {
  IncidentLight light = pointLight(i, place);
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
    vec3 shown = color * vertexColor;
  #else
    X3dMaterial material = X3dMaterial(color * vertexColor, specular, shininess, vec3(ambientIntensity), metallic, roughness);
    ReflectedLight reflected = ReflectedLight(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
    vec3 normal = facingNormal();
    vec3 eye = normalize(towardsEye);
    ${lights.map((kind, i) => `directX3d(${kind}Light(${i}, -towardsEye), -towardsEye, normal, eye, vec3(0.0), material, reflected);`).join("\n    ")}
    ambientX3d(ambientLight, -towardsEye, normal, eye, vec3(0.0), material, reflected);
    vec3 shown = reflected.directDiffuse + reflected.directSpecular + reflected.indirectDiffuse + reflected.indirectSpecular + emissive;
  #endif
  pixel = vec4(clamp(exposure * shown, 0.0, 1.0), 1.0);
  #ifdef ${physicalDefine}
    ${toDisplayedChunk("pixel.rgb")}
  #endif
}
`;

export interface Program {
  readonly program: WebGLProgram;
  /** By name; null for what the program has no use for. */
  readonly uniform: (name: string) => WebGLUniformLocation | null;
}

/** Begins to compile; whoever uses it waits. */
export function makeProgram(gl: WebGL2RenderingContext, kind: ProgramKind): Program {
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
    if (shader === null) continue; // the context is lost: nothing comes of it
    gl.shaderSource(shader, head + text);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
    gl.deleteShader(shader); // when the program goes
  }
  gl.linkProgram(program);
  const places = new Map<string, WebGLUniformLocation | null>();
  return {
    program,
    uniform: (name) => {
      const known = places.get(name);
      if (known !== undefined) return known;
      const place = gl.getUniformLocation(program, name);
      places.set(name, place);
      return place;
    },
  };
}
