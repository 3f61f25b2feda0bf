// GLSL for lines wider than a pixel, which WebGL lacks. Each line is an instance of one outline, a
// strip with a half disc at either end, which the vertex shader places around the line's ends on the
// screen. So the joints of polylines are round, and edges are antialiased like those of surfaces.

import { attributeRows, texCoordRoles, vertexRoles } from "../../stage/attributeRows.ts";
import { maxDashLengths } from "../../document/lineProperties.ts";
import { instanceFields, instancesDefine } from "./instanceRecord.ts";

/** Sides of a half disc: for lines of up to 20 pixels it deviates from the circle by less than a fifth of a pixel. */
const capSides = 8;

/**
 * Triangles of the outline, all counter-clockwise. Vertices 0 … capSides surround the line's start, the others its
 * end.
 */
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

type TexCoordRole = (typeof texCoordRoles)[number];

/** Defines END_<role>, and declares the attribute of the line's end. */
function endTexCoordMacros(role: TexCoordRole): string {
  const { bufferName, define = "" } = attributeRows[role];
  return `
#ifdef ${define}
  #define END_${role} ${bufferName}End
  attribute vec2 ${bufferName}End;
#else
  #define END_${role} vec2(0.0)
#endif`;
}

/** The end of a line in buffers. Included after `unitNormal` and `STORED_COLOR`. */
export const lineEndChunk = /* glsl */ `
${texCoordRoles.map(endTexCoordMacros).join("\n")}

attribute vec3 positionEnd, normalEnd;
#if defined(USE_COLOR_ALPHA)
  attribute vec4 colorEnd;
#elif defined(USE_COLOR)
  attribute vec3 colorEnd;
#endif

Vertex lineEnd() {
  return Vertex(positionEnd, unitNormal(normalEnd), STORED_COLOR(colorEnd),
    ${texCoordRoles.map((role) => `END_${role}`).join(", ")});
}
`;

/** `readVertex` and `widenLine` of vertex shaders. Included after `vertexAt`, `operate` and `instancePosition`. */
export const wideLineChunk = /* glsl */ `
uniform vec4 viewport;
#ifdef ${instancesDefine}
  #define lineWidth instanceTexel(${Math.floor(instanceFields.lineWidth / 4)})[${instanceFields.lineWidth % 4}]
#else
  uniform float lineWidth;
#endif
// The screen axis along which dashes are measured, and their origin, in line widths.
flat varying vec3 dashAxis;
// Position along the line (0 … 1), and offset from the line in normalized device coordinates.
float linePosition;
vec2 lineOffset;

vec2 screenPosition(vec4 clip) {
  return viewport.xy + (clip.xy / clip.w * 0.5 + 0.5) * viewport.zw;
}

// The range of a line (0 … 1) beyond the near plane. Nearer points have no position on the screen.
vec2 visibleRange(vec4 begin, vec4 end) {
  vec2 ahead = vec2(begin.z + begin.w, end.z + end.w);
  float cut = ahead.x / (ahead.x - ahead.y);
  return vec2(ahead.x < 0.0 && ahead.y > 0.0 ? cut : 0.0, ahead.y < 0.0 && ahead.x > 0.0 ? cut : 1.0);
}

void computeOutline(vec3 from, vec3 to) {
  mat4 clipFromObject = projectionMatrix * modelViewMatrix;
  vec4 begin = clipFromObject * vec4(instancePosition(from), 1.0);
  vec4 end = clipFromObject * vec4(instancePosition(to), 1.0);
  vec2 range = visibleRange(begin, end);
  vec2 direction = screenPosition(mix(begin, end, range.y)) - screenPosition(mix(begin, end, range.x));
  vec2 along = dot(direction, direction) > 1e-12 ? normalize(direction) : vec2(1.0, 0.0);
  bool isEnd = gl_VertexID > ${capSides};
  linePosition = isEnd ? range.y : range.x;
  float angle = PI * (0.5 + float(isEnd ? gl_VertexID - 1 : gl_VertexID) / ${capSides}.0);
  vec2 offsetDirection = cos(angle) * along + sin(angle) * vec2(-along.y, along.x);
  float width = lineWidth * pixelRatio;
  lineOffset = offsetDirection * width / viewport.zw;
  // As with OpenGL's line stipple, dashes continue over adjacent short lines. They move with the
  // shape.
  vec4 origin = clipFromObject * vec4(instancePosition(vec3(0.0)), 1.0);
  vec2 start = origin.w > 0.0 ? screenPosition(origin) : vec2(0.0);
  dashAxis = abs(along.x) >= abs(along.y) ? vec3(1.0, 0.0, start.x) / width : vec3(0.0, 1.0, start.y) / width;
}

void widenLine() {
  gl_Position.xy += lineOffset * gl_Position.w;
}

Vertex readVertex() {
  Vertex begin = vertexAt(0), end = vertexAt(1);
  operate(begin.position, begin.normal);
  operate(end.position, end.normal);
  computeOutline(begin.position, end.position);
  Vertex vertex;
  ${["position", ...vertexRoles].map((name) => `vertex.${name} = mix(begin.${name}, end.${name}, linePosition);`).join("\n  ")}
  return vertex;
}
`;

/** Declarations at the head of a fragment shader. */
export const dashChunk = /* glsl */ `
uniform float dashes[${maxDashLengths}];
uniform int dashCount;
flat varying vec3 dashAxis;

bool isBetweenDashes() {
  float period = 0.0;
  for (int i = 0; i < dashCount; ++i) period += dashes[i];
  float distanceLeft = mod(dot(gl_FragCoord.xy, dashAxis.xy) - dashAxis.z, period);
  for (int i = 0; i < dashCount; ++i) {
    distanceLeft -= dashes[i];
    if (distanceLeft < 0.0) return (i & 1) == 1;
  }
  return dashCount > 0;
}
`;
