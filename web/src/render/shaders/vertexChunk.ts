// The shader chunk that reads a vertex, in two versions: from images (imageVertexChunk.ts) and from
// buffers. The materials of all passes include it through `addVertexReading`, so shadows and picking
// see the same shape as the picture.
//
// The object's matrix transforms stored lattice coordinates. It is the same for all patches of a
// mesh, so that vertices that patches share go through the same arithmetic, and no crack opens.

import { attributeRows, texCoordRoles } from "../../stage/attributeRows.ts";
import { toLinearChunk } from "../../lighting/physicalLighting.ts";
import { lateImageVertices } from "./lateImageVertices.ts";
import { discardFacesChunk, instanceFragmentChunk, instanceVertexChunk } from "./instanceRecord.ts";
import { texCoordChunk, texCoordDeclarations } from "./texCoords.ts";
import { lateWideLines } from "../lines/lateWideLines.ts";
import { lateOperators, operateVertexChunk } from "../operators/lateOperators.ts";
import { deformVertexChunk, lateDeformation } from "../deformation/lateDeformation.ts";
import type { ShaderTexts } from "./editShaders.ts";
import { replaceChunks } from "./replaceChunks.ts";
import {
  blurredDefine,
  imageNormalsDefine,
  imageVerticesDefine,
  pointSpacingDefine,
  srgbColorsDefine,
  wideLinesDefine,
} from "./vertexFormat.ts";

// three.js defines FLAT_SHADED if a geometry has no normal attribute, even if an image has normals.
const imageNormalsChunk = /* glsl */ `
#ifdef ${imageNormalsDefine}
#undef FLAT_SHADED
#endif
`;

type TexCoordRole = (typeof texCoordRoles)[number];

/**
 * Defines BUFFER_<role>, and declares its attribute. three.js declares `uv`, and `uv1` … where a texture of the app
 * uses them.
 */
function bufferTexCoordMacros(role: TexCoordRole): string {
  const { bufferName, define = "" } = attributeRows[role];
  return `
#ifdef ${define}
  #define BUFFER_${role} ${bufferName}
  ${bufferName === "uv" ? "" : `#ifndef USE_${bufferName.toUpperCase()}\n  attribute vec2 ${bufferName};\n  #endif`}
#else
  #define BUFFER_${role} vec2(0.0)
#endif`;
}

/** Without the version from images, and wide lines, while no scene has needed them. */
const readVertexChunk = (): string => /* glsl */ `
uniform float pixelRatio;
uniform vec3 pointSizes;
uniform vec3 attenuation;
uniform vec3 latticeStep;
${texCoordDeclarations}

struct Vertex {
  vec3 position;
  vec3 normal;
  vec4 color;
  vec2 ${texCoordRoles.join(", ")};
};

#ifdef ${pointSpacingDefine}
  // In stored units.
  uniform float pointSpacing;
  uniform vec4 viewport;
#endif

// Uses gl_Position, which has been set.
float pointSizeAt(float distance) {
  float size = pointSizes.x / max(dot(attenuation, vec3(1.0, distance, distance * distance)), 1e-6);
  size = clamp(size, pointSizes.y, pointSizes.z) * pixelRatio;
  #ifdef ${pointSpacingDefine}
    mat3 axes = mat3(modelViewMatrix);
    float scale = sqrt(max(dot(axes[0], axes[0]), max(dot(axes[1], axes[1]), dot(axes[2], axes[2]))));
    size = max(size, pointSpacing * scale * projectionMatrix[1][1] * 0.5 * viewport.w / gl_Position.w);
  #endif
  return size;
}

#if defined(OCTAHEDRAL_NORMALS)

// Octahedral encoding (Meyer et al. 2010). The maximum is treated as the number below it, so that the axes are exact.
vec3 unitOf(vec2 pair) {
  vec2 p = min(pair, NORMAL_MAX - 1.0) * (2.0 / (NORMAL_MAX - 1.0)) - 1.0;
  vec3 unit = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  if (unit.z < 0.0) unit.xy = (1.0 - abs(p.yx)) * vec2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
  return normalize(unit);
}

#elif defined(SPHERICAL_NORMALS)

vec3 unitOf(vec2 pair) {
  vec2 angles = PI * vec2(2.0, 1.0) * pair / NORMAL_MAX - vec2(PI, 0.0);
  return vec3(sin(angles.y) * cos(angles.x), sin(angles.y) * sin(angles.x), cos(angles.y));
}

#endif

#ifdef ${imageVerticesDefine}
${lateImageVertices.added?.vertexChunk ?? ""}
#else

vec3 unitNormal(vec3 normal) {
  #if defined(NORMAL_WORDS)
    float word = normal.x < 0.0 ? normal.x + 65536.0 : normal.x; // X3DOM's format, in records of Int16
    return unitOf(vec2(mod(word, 256.0), floor(word / 256.0)));
  #elif defined(NORMAL_MAX)
    return unitOf(normal.xy);
  #elif defined(NORMAL_BYTES)
    return normal * 2.0 - 1.0;
  #else
    return normal;
  #endif
}

${lateImageVertices.added?.blurredBufferChunk ?? ""}
#if defined(USE_COLOR_ALPHA)
  #define STORED_COLOR(color) color
#elif defined(USE_COLOR)
  #define STORED_COLOR(color) vec4(color, 1.0)
#else
  #define STORED_COLOR(color) vec4(1.0)
#endif
${texCoordRoles.map(bufferTexCoordMacros).join("\n")}

#ifdef ${wideLinesDefine}
${lateWideLines.added?.endChunk ?? ""}
#endif

Vertex bufferVertexAt(int end) {
  #ifdef ${wideLinesDefine}
    if (end == 1) return lineEnd();
  #endif
  return Vertex(position, unitNormal(normal), STORED_COLOR(color),
    ${texCoordRoles.map((role) => `BUFFER_${role}`).join(", ")});
}

Vertex vertexAt(int end) {
  Vertex vertex = bufferVertexAt(end);
  #ifdef ${blurredDefine}
    vertex.position = blurredAt(0, end);
    #ifdef BLURRED_NORMALS
      vertex.normal = blurredAt(1, end);
    #endif
  #endif
  return vertex;
}

#endif
`;

const colorChunk = /* glsl */ `
#if defined(USE_COLOR) || defined(USE_COLOR_ALPHA)
  vColor = vertex.color;
  #ifdef ${srgbColorsDefine}
    ${toLinearChunk("vColor.rgb")}
  #endif
#endif
`;

/** The statement that sets the size of a point. */
export const pointSizeChunk = "gl_PointSize = pointSizeAt(length(mvPosition.xyz));";

/** The first statement of a vertex shader. */
export const readVertexStatement = "Vertex vertex = readVertex();";

/** What the texts that addVertexReading adds depend on, for `editShaders`. */
export function readVertexKey(): string {
  return [lateImageVertices, lateWideLines, lateDeformation, lateOperators]
    .map(({ added }) => added !== undefined)
    .join(" ");
}

/** `readVertex`, and `widenLine`, which moves a vertex of a wide line. */
const lineVertexChunk = (): string => /* glsl */ `
#ifdef ${wideLinesDefine}
${lateWideLines.added?.vertexChunk ?? ""}
#else

void widenLine() {}

Vertex readVertex() {
  Vertex vertex = vertexAt(0);
  deform(vertex.position, vertex.normal);
  operate(vertex.position, vertex.normal);
  return vertex;
}

#endif
`;

/** Declarations at the head of a fragment shader. */
const fragmentHead = (): string => /* glsl */ `
#ifdef ${wideLinesDefine}
${lateWideLines.added?.dashChunk ?? ""}
#endif
`;

/** Replaces `void main() {` of a fragment shader. */
const discardGapsChunk = /* glsl */ `void main() {
#ifdef ${wideLinesDefine}
  if (isBetweenDashes()) discard;
#endif
`;

function vertexReadingChunk(): string {
  const chunks = [readVertexChunk(), deformVertexChunk(), operateVertexChunk(), instanceVertexChunk, lineVertexChunk()];
  return ["#include <common>\n", ...chunks].join("");
}

/** Makes the shaders of a material read vertices with this chunk. Call in `onBeforeCompile` of built-in materials. */
export function addVertexReading(shader: ShaderTexts): void {
  shader.fragmentShader =
    imageNormalsChunk +
    instanceFragmentChunk +
    fragmentHead() +
    replaceChunks(shader.fragmentShader, [
      ["void main() {", discardGapsChunk],
      ["void main() {", discardFacesChunk],
    ]);
  shader.vertexShader =
    imageNormalsChunk +
    replaceChunks(shader.vertexShader, [
      ["#include <common>", vertexReadingChunk()],
      ["void main() {", `void main() {\n  ${readVertexStatement}`],
      ["#include <uv_vertex>", texCoordChunk],
      ["#include <project_vertex>", `#include <project_vertex>\n${pointSizeChunk}\napplyInstance();\nwidenLine();`],
      ["#include <color_vertex>", colorChunk],
      // Normals are stored in the shape's coordinates, positions in those of the lattice.
      ["#include <beginnormal_vertex>", "vec3 objectNormal = instanceNormal(vertex.normal);"],
      ["#include <begin_vertex>", "vec3 transformed = instancePosition(vertex.position);"],
    ]);
}
