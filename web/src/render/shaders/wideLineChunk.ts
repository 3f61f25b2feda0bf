// Lines of more than a pixel, which WebGL does not have: each is an instance of one
// outline, a strip with a half disc at either end, laid out on the screen around
// what the line's two ends are there. So the joints of a line of many parts are
// round, and its borders are as smooth as those of any surface.

import type { BufferGeometry, Camera, Material, Scene, Vector4, WebGLRenderer } from "three";
import { maxDashLengths } from "../../document/lineProperties.ts";
import { instanceFields, instancesDefine } from "./instanceRecord.ts";

/** Defined in materials of wide lines: how many vertices on the next line begins. */
export const wideLinesDefine = "WIDE_LINES";

/** Of a half disc: of lines up to 20 pixels it is off the circle by less than a fifth of one. */
const capSides = 8;

/** Triangles of the outline's vertices: 0 … capSides around the line's begin, the others around its end, all to the left. */
export const outlineTriangles: readonly number[] = [
  ...fanOf(0),
  ...fanOf(capSides + 1),
  0,
  capSides,
  capSides + 1,
  0,
  capSides + 1,
  2 * capSides + 1,
];

function fanOf(first: number): number[] {
  return Array.from({ length: capSides - 1 }, (_, side) => [first, first + side + 1, first + side + 2]).flat();
}

/** Behind `vertexAt` and `instancePosition`. */
export const wideLineChunk = /* glsl */ `
#ifdef ${wideLinesDefine}

uniform vec4 viewport;
#ifdef ${instancesDefine}
  #define lineWidth instanceTexel(${Math.floor(instanceFields.lineWidth / 4)})[${instanceFields.lineWidth % 4}]
#else
  uniform float lineWidth;
#endif
// The axis of the screen along which dashes are measured, and where they begin, in widths.
flat varying vec3 dashAxis;
// Where along the line this vertex is, and how far beside that on the screen.
float lineShare;
vec2 besideLine;

vec2 onScreen(vec4 clip) {
  return viewport.xy + (clip.xy / clip.w * 0.5 + 0.5) * viewport.zw;
}

// What is nearer than the near plane has no place on the screen: there the line begins, or ends.
vec2 sharesSeen(vec4 begin, vec4 end) {
  vec2 ahead = vec2(begin.z + begin.w, end.z + end.w);
  float cut = ahead.x / (ahead.x - ahead.y);
  return vec2(ahead.x < 0.0 && ahead.y > 0.0 ? cut : 0.0, ahead.y < 0.0 && ahead.x > 0.0 ? cut : 1.0);
}

void layLine(vec3 from, vec3 to) {
  mat4 clipFromObject = projectionMatrix * modelViewMatrix;
  vec4 begin = clipFromObject * vec4(instancePosition(from), 1.0), end = clipFromObject * vec4(instancePosition(to), 1.0);
  vec2 shares = sharesSeen(begin, end);
  vec2 way = onScreen(mix(begin, end, shares.y)) - onScreen(mix(begin, end, shares.x));
  vec2 along = dot(way, way) > 1e-12 ? normalize(way) : vec2(1.0, 0.0);
  bool isEnd = gl_VertexID > ${capSides};
  lineShare = isEnd ? shares.y : shares.x;
  float angle = PI * (0.5 + float(isEnd ? gl_VertexID - 1 : gl_VertexID) / ${capSides}.0);
  vec2 away = cos(angle) * along + sin(angle) * vec2(-along.y, along.x);
  float width = lineWidth * pixelRatio;
  besideLine = away * width / viewport.zw;
  // As OpenGL's stipple: so dashes run on where many short lines make one. They move with the shape.
  vec4 origin = clipFromObject * vec4(instancePosition(vec3(0.0)), 1.0);
  vec2 start = origin.w > 0.0 ? onScreen(origin) : vec2(0.0);
  dashAxis = abs(along.x) >= abs(along.y) ? vec3(1.0, 0.0, start.x) / width : vec3(0.0, 1.0, start.y) / width;
}

void widenLine() {
  gl_Position.xy += besideLine * gl_Position.w;
}

Vertex readVertex() {
  Vertex begin = vertexAt(0), end = vertexAt(1);
  layLine(begin.position, end.position);
  return Vertex(mix(begin.position, end.position, lineShare), mix(begin.normal, end.normal, lineShare),
                mix(begin.color, end.color, lineShare), mix(begin.texCoord, end.texCoord, lineShare));
}

#else

void widenLine() {}

Vertex readVertex() {
  return vertexAt(0);
}

#endif
`;

/** Before the fragment shader. */
export const dashChunk = /* glsl */ `
#ifdef ${wideLinesDefine}

uniform float dashes[${maxDashLengths}];
uniform int dashCount;
flat varying vec3 dashAxis;

bool isBetweenDashes() {
  float period = 0.0;
  for (int i = 0; i < dashCount; ++i) period += dashes[i];
  float left = mod(dot(gl_FragCoord.xy, dashAxis.xy) - dashAxis.z, period);
  for (int i = 0; i < dashCount; ++i) {
    left -= dashes[i];
    if (left < 0.0) return (i & 1) == 1;
  }
  return dashCount > 0;
}

#endif
`;

/** In place of its beginning. */
export const discardGapsChunk = /* glsl */ `void main() {
#ifdef ${wideLinesDefine}
  if (isBetweenDashes()) discard;
#endif
`;

/** Lets a material of wide lines know how large the picture is that is being drawn. */
export function followViewport(material: Material, viewport: { readonly value: Vector4 }): void {
  const own = material.onBeforeRender.bind(material);
  material.onBeforeRender = (
    renderer: WebGLRenderer,
    scene: Scene,
    camera: Camera,
    geometry: BufferGeometry,
    object,
    group,
  ) => {
    own(renderer, scene, camera, geometry, object, group);
    renderer.getCurrentViewport(viewport.value);
  };
}
