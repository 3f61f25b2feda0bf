// The part of the shader chunk vertexChunk.ts that reads vertices by index from images (classic SIG, section 5.1 of the
// paper), also after the operator blur.
//
// Image bytes are combined as integers and converted to float last: up to 24 bits, lattice points are exact.

import { attributeRows, texCoordRoles, vertexRoles } from "../../stage/attributeRows.ts";
import { blurredDefine, glslFirstTexelOf, wideLinesDefine } from "./vertexFormat.ts";

type TexCoordRole = (typeof texCoordRoles)[number];

/** Defines IMAGE_<role>, the texture coordinates of a `record`; zeros where vertices lack the set. */
function imageTexCoordMacro(role: TexCoordRole): string {
  return `
#ifdef ${attributeRows[role].define ?? ""}
  #define IMAGE_${role} readTexCoord(${role}Image, ${glslFirstTexelOf(role)}, record)
#else
  #define IMAGE_${role} vec2(0.0)
#endif`;
}

/** Included in shaders of materials with IMAGE_VERTICES. */
export const imageVertexChunk = /* glsl */ `
uniform sampler2D indexImage, coordImage0, coordImage1, coordImage2, coordImage3;
uniform sampler2D ${vertexRoles.map((role) => `${role}Image`).join(", ")};
uniform int firstTexels[${1 + vertexRoles.length}];
uniform ivec4 coordFirstTexels;
uniform int coordPlaneCount;
uniform float missingBytesMidpoint;
uniform bool hasIndex;
uniform bool isIndexWide;
uniform int implicitWidth;
uniform ivec2 gridSize;
uniform ivec4 gridPart;
uniform bool isGridClosed;
uniform float maxStoredValue;
uniform int firstSequenceIndex;
uniform bool isStrip;
uniform int lineCount;
uniform bool areTexCoordsBytes;
uniform bool colorHasAlpha;
uniform float blurRadius;
uniform int recordCount;

#ifdef GRID

// Two triangles per cell, counter-clockwise if columns run right and rows down. In a closed grid, the
// first column follows the last.
int gridVertex(int drawVertexIndex) {
  int cell = drawVertexIndex / 6;
  int corner = drawVertexIndex % 6;
  int cellsAcross = isGridClosed ? gridSize.x : gridSize.x - 1;
  ivec2 offset = corner == 0 ? ivec2(0, 0) : corner == 1 || corner == 3 ? ivec2(0, 1)
    : corner == 2 || corner == 5 ? ivec2(1, 0) : ivec2(1, 1);
  ivec2 at = ivec2(cell % cellsAcross, cell / cellsAcross) + offset;
  return at.y * gridSize.x + at.x % gridSize.x;
}

#endif

// three.js draws no triangle strips, so they are drawn as separate triangles. Triangle t has the
// corners t, t + 1, t + 2 of the strip; the first two are exchanged if t is odd.
int sequenceIndex(int drawVertexIndex) {
  #ifdef GRID
    return gridVertex(drawVertexIndex);
  #endif
  if (!isStrip) return firstSequenceIndex + drawVertexIndex;
  int triangle = drawVertexIndex / 3;
  int corner = drawVertexIndex % 3;
  return firstSequenceIndex + triangle + (corner == 2 ? 2 : corner ^ (triangle & 1));
}

// Texel n, counted row by row, from texel "first" on.
vec4 texelOf(sampler2D image, int first, int n) {
  int width = textureSize(image, 0).x;
  return texelFetch(image, ivec2((first + n) % width, (first + n) / width), 0);
}

// The texel of a sequence index. Sequence indices are stored in rows of implicitWidth, which may be
// less than the image's width.
int texelIndex(sampler2D image, int n) {
  return (n / implicitWidth) * textureSize(image, 0).x + n % implicitWidth;
}

uvec3 bytesOf(vec4 texel) {
  return uvec3(texel.rgb * 255.0 + 0.5);
}

// An index texel holds the three bytes of a record index, or column and row in units of 1/256 of
// the coordinate image (docs/formats/nodes.md, "Stored values").
int recordIndex(int drawVertexIndex) {
  int sequence = sequenceIndex(drawVertexIndex);
  if (!hasIndex) return sequence;
  int n = texelIndex(indexImage, sequence);
  ivec3 index = ivec3(bytesOf(texelOf(indexImage, ${glslFirstTexelOf("index")}, n)));
  if (isIndexWide) return index.r | index.g << 8 | index.b << 16;
  ivec2 columnRow = index.rg;
  ivec2 size = textureSize(coordImage0, 0);
  ivec2 texel = (columnRow * size + 128) >> 8;
  return texel.y * size.x + texel.x;
}

// The texel of a record. Without an index, records are stored in rows of implicitWidth.
int recordTexelIndex(int record) {
  return hasIndex ? record : texelIndex(coordImage0, record);
}

vec3 texelPosition(int record) {
  int n = recordTexelIndex(record);
  uvec3 stored = bytesOf(texelOf(coordImage0, coordFirstTexels.x, n));
  if (coordPlaneCount > 1) stored = (stored << 8) | bytesOf(texelOf(coordImage1, coordFirstTexels.y, n));
  if (coordPlaneCount > 2) stored = (stored << 8) | bytesOf(texelOf(coordImage2, coordFirstTexels.z, n));
  if (coordPlaneCount > 3) stored = (stored << 8) | bytesOf(texelOf(coordImage3, coordFirstTexels.w, n));
  vec3 position = vec3(stored) + missingBytesMidpoint;
  #ifdef GRID_HEIGHTS
    ivec2 at = gridPart.xy + ivec2(record % gridSize.x, record / gridSize.x);
    vec2 xz = vec2(at) * maxStoredValue / vec2(gridPart.zw - 1);
    return vec3(xz.x, position.x, xz.y);
  #else
    return position;
  #endif
}

#ifdef ${blurredDefine}

// After the operator blur, as decode/classic/blur.ts filters it.
vec3 storedPosition(int record) {
  int columns = gridSize.x > 0 ? gridSize.x : hasIndex ? textureSize(coordImage0, 0).x : implicitWidth;
  ivec2 at = ivec2(record % columns, record / columns);
  int rows = recordCount / columns;
  int inRow = at.y < rows ? columns : recordCount % columns;
  int reach = int(ceil(blurRadius));
  int across = isGridClosed ? reach : min(reach, min(at.x, inRow - 1 - at.x));
  int down = at.y < rows ? min(reach, min(at.y, rows - 1 - at.y)) : 0;
  vec4 sum = vec4(0.0);
  for (int y = -down; y <= down; ++y)
    for (int x = -across; x <= across; ++x) {
      float weight = exp(-2.0 * float(x * x + y * y) / (blurRadius * blurRadius));
      int neighbour = (at.y + y) * columns + (at.x + x + 4 * columns) % columns;
      sum += weight * vec4(texelPosition(neighbour), 1.0);
    }
  return sum.xyz / sum.w;
}

#else
  #define storedPosition texelPosition
#endif

#ifdef GRID

// The normal from differences between the neighbours on both sides; at a border, the vertex itself is
// one of them. Divided by the step because the caller multiplies by it.
vec3 differenceNormal(ivec2 at) {
  ivec2 last = gridSize - 1;
  int left = isGridClosed ? (at.x + last.x) % gridSize.x : max(at.x - 1, 0);
  int right = isGridClosed ? (at.x + 1) % gridSize.x : min(at.x + 1, last.x);
  vec3 along = storedPosition(at.y * gridSize.x + right) - storedPosition(at.y * gridSize.x + left);
  int above = max(at.y - 1, 0), below = min(at.y + 1, last.y);
  vec3 down = storedPosition(below * gridSize.x + at.x) - storedPosition(above * gridSize.x + at.x);
  return cross(down, along) / latticeStep;
}

// At a pole, where all vertices of a row are one point, the normal is that of the next row.
vec3 gridNormal(int record) {
  ivec2 at = ivec2(record % gridSize.x, record / gridSize.x);
  vec3 normal = differenceNormal(at);
  return normal != vec3(0.0) ? normal : differenceNormal(ivec2(at.x, at.y == 0 ? 1 : at.y - 1));
}

#endif

// Two numbers of a texel in 16 bits each: red and blue are the bytes of the first, green and alpha those of the second.
vec2 wordsOf(vec4 texel) {
  vec4 bytes = texel * 255.0;
  return bytes.rg * 256.0 + bytes.ba;
}

vec3 readNormal(int record) {
  #if defined(GRID_NORMALS) || defined(BLURRED_NORMALS)
    return gridNormal(record);
  #elif defined(NORMAL_WORD_TEXELS)
    return unitOf(floor(wordsOf(texelOf(normalImage, ${glslFirstTexelOf("normal")}, recordTexelIndex(record))) + 0.5));
  #elif defined(NORMAL_MAX)
    ivec2 size = textureSize(normalImage, 0);
    int first = ${glslFirstTexelOf("normal")};
    return unitOf(255.0 * vec2(texelOf(normalImage, first, record).r,
                               texelOf(normalImage, first + size.x * size.y / 2, record).r));
  #else
    return texelOf(normalImage, ${glslFirstTexelOf("normal")}, recordTexelIndex(record)).rgb * 2.0 - 1.0;
  #endif
}

vec2 readTexCoord(sampler2D image, int first, int record) {
  vec4 texel = texelOf(image, first, recordTexelIndex(record));
  return areTexCoordsBytes ? texel.rg : wordsOf(texel) / 65535.0;
}

${texCoordRoles.map(imageTexCoordMacro).join("\n")}

// Index of the vertex in its draw; of a wide line, that of its start (0) or end (1).
int drawVertexIndex(int end) {
  #ifdef ${wideLinesDefine}
    return gl_InstanceID % lineCount * ${wideLinesDefine} + end;
  #else
    return gl_VertexID;
  #endif
}

Vertex vertexAt(int end) {
  int record = recordIndex(drawVertexIndex(end));
  vec4 color = texelOf(colorImage, ${glslFirstTexelOf("color")}, recordTexelIndex(record));
  if (!colorHasAlpha) color.a = 1.0;
  return Vertex(storedPosition(record), readNormal(record), color,
    ${texCoordRoles.map((role) => `IMAGE_${role}`).join(", ")});
}

`;

/** Included in shaders of materials that read vertices from buffers. */
export const blurredBufferChunk = /* glsl */ `
#ifdef ${blurredDefine}

// Coordinates and, of grids, normals after the operator blur, in as many rows each (stages/blurredVertices.ts).
uniform sampler2D blurredImage;
#ifdef ${wideLinesDefine}
  attribute vec2 vertexIndices;
#endif

vec3 blurredAt(int part, int end) {
  #ifdef ${wideLinesDefine}
    int index = int(vertexIndices[end]);
  #else
    int index = gl_VertexID;
  #endif
  ivec2 size = textureSize(blurredImage, 0);
  return texelFetch(blurredImage, ivec2(index % size.x, index / size.x + part * (size.y / 2)), 0).xyz;
}

#endif
`;
