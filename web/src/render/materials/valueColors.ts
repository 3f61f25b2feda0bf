// Reads the values of a vertex attribute, from the byte planes of an image or from a buffer. Where they colour the
// surface, each fragment looks the interpolated value up in the colour map; environment/fogs.ts uses depths in fog.

import type { IUniform, Texture, WebGLProgramParametersWithUniforms } from "three";
import type { DecodedImage } from "../../stage/decodedImage.ts";
import type { Stage, ValuePlanes } from "../../stage/stage.ts";
import { maxMapColors } from "../../document/colorMaps.ts";
import type { AttributeDescription, ColorMapDescription } from "../../document/description.ts";
import { toLinearChunk } from "../../lighting/physicalLighting.ts";
import { instanceFields, instancesDefine } from "../shaders/instanceRecord.ts";
import { readVertexStatement } from "../shaders/vertexChunk.ts";
import { imageVerticesDefine, srgbColorsDefine, wideLinesDefine } from "../shaders/vertexFormat.ts";
import { replaceChunks } from "../shaders/replaceChunks.ts";

/** The uniforms of a colour map. */
export function colorMapUniformsOf(map: ColorMapDescription): Record<string, IUniform> {
  const numbers = map.colors.flat();
  return {
    mapColors: { value: Array.from({ length: 3 * maxMapColors }, (_, i) => numbers[i] ?? 0) },
    mapColorCount: { value: map.colors.length },
    mapRange: { value: map.range },
  };
}

/** The uniforms from which the vertex shader reads values; none if the stage has no values. */
export function valueUniformsOf(
  stage: Stage,
  attribute: AttributeDescription,
  textureOf: (image: DecodedImage) => Texture,
): Record<string, IUniform> {
  const { value } = stage;
  if (value === undefined) return {};
  const { min, step } = valueFrameOf(stage, attribute);
  const images = stage.kind === "textures" && stage.value ? imageUniformsOf(stage.value, textureOf) : {};
  return { valueMin: { value: min }, valueStep: { value: step }, ...images };
}

/** The value of a stored 0 and the difference between two stored values, for padded components. */
export function valueFrameOf(
  stage: Stage,
  { min, size }: Pick<AttributeDescription, "min" | "size">,
): { min: readonly number[]; step: readonly number[] } {
  const maxStored = stage.kind === "buffers" ? stage.value?.maxStored : 256 ** (stage.value?.planeCount ?? 1) - 1;
  const padded = (values: readonly number[], missing: number) => [0, 1, 2, 3].map((c) => values[c] ?? missing);
  if (maxStored === undefined) return { min: padded([], 0), step: padded([], 1) };
  return {
    min: padded(min, 0),
    step: padded(
      size.map((extent) => extent / maxStored),
      0,
    ),
  };
}

function imageUniformsOf(
  { planes, planeCount, missingBytesMidpoint }: ValuePlanes,
  textureOf: (image: DecodedImage) => Texture,
): Record<string, IUniform> {
  const image = (plane: number) => ({ value: planes[plane] ? textureOf(planes[plane].image) : null });
  return {
    valueImage0: image(0),
    valueImage1: image(1),
    valueImage2: image(2),
    valueFirstTexels: { value: [0, 1, 2].map((plane) => planes[plane]?.firstTexel ?? 0) },
    valuePlanes: { value: planeCount },
    missingBytesMidpointValue: { value: missingBytesMidpoint },
  };
}

const vertexChunk = /* glsl */ `
#ifdef VALUE_COMPONENTS

#ifdef ${instancesDefine}
  #define valueMin instanceTexel(${instanceFields.valueMin / 4})
  #define valueStep instanceTexel(${instanceFields.valueStep / 4})
#else
  uniform vec4 valueMin, valueStep;
#endif

#ifdef ${imageVerticesDefine}

uniform sampler2D valueImage0, valueImage1, valueImage2;
uniform ivec3 valueFirstTexels;
uniform int valuePlanes;
uniform float missingBytesMidpointValue;

uvec4 valueBytes(sampler2D image, int first, int n) {
  return uvec4(texelOf(image, first, n) * 255.0 + 0.5);
}

vec4 readValues(int end) {
  int n = recordTexelIndex(recordIndex(drawVertexIndex(end)));
  uvec4 stored = valueBytes(valueImage0, valueFirstTexels.x, n);
  if (valuePlanes > 1) stored = (stored << 8) | valueBytes(valueImage1, valueFirstTexels.y, n);
  if (valuePlanes > 2) stored = (stored << 8) | valueBytes(valueImage2, valueFirstTexels.z, n);
  return valueMin + valueStep * (vec4(stored) + missingBytesMidpointValue);
}

#else

attribute vec4 vertexValue;
#ifdef ${wideLinesDefine}
  attribute vec4 vertexValueEnd;
#endif

vec4 readValues(int end) {
  #ifdef ${wideLinesDefine}
    if (end == 1) return valueMin + valueStep * vertexValueEnd;
  #endif
  return valueMin + valueStep * vertexValue;
}

#endif

float valueAt(int end) {
  vec4 values = readValues(end);
  #if VALUE_COMPONENTS == 1
    return values.x;
  #elif VALUE_COMPONENTS == 2
    return length(values.xy);
  #elif VALUE_COMPONENTS == 3
    return length(values.xyz);
  #else
    return length(values);
  #endif
}

float readValue() {
  #ifdef ${wideLinesDefine}
    return mix(valueAt(0), valueAt(1), linePosition);
  #else
    return valueAt(0);
  #endif
}

#endif

#ifdef VALUE_COLORS

// The position in the colour map, whose ends are 0 and 1.
varying float vColorMapCoord;
#ifdef ${instancesDefine}
  #define mapRange instanceTexel(${instanceFields.mapRange / 4}).xy
#else
  uniform vec2 mapRange;
#endif

float colorMapCoordOf(float value) {
  vec2 range = mapRange;
  float extent = range.y - range.x;
  return extent == 0.0 ? 0.0 : (value - range.x) / extent;
}

#endif
`;

const fragmentDeclarations = /* glsl */ `
#ifdef VALUE_COLORS
  varying float vColorMapCoord;
  uniform vec3 mapColors[${maxMapColors}];
  uniform int mapColorCount;

  vec3 mappedColor() {
    float position = clamp(vColorMapCoord, 0.0, 1.0) * float(mapColorCount - 1);
    int lower = min(int(position), mapColorCount - 2);
    vec3 color = mix(mapColors[lower], mapColors[lower + 1], position - float(lower));
    #ifdef ${srgbColorsDefine}
      ${toLinearChunk("color")}
    #endif
    return color;
  }
#endif
`;

const fragmentChunk = /* glsl */ `
#include <color_fragment>
#ifdef VALUE_COLORS
  diffuseColor.rgb = mappedColor();
#endif
`;

/** Call in `onBeforeCompile` after addVertexReading and addDepthShading; affects materials with `valueDefinesOf`. */
export function addValueColors(
  shader: Pick<WebGLProgramParametersWithUniforms, "vertexShader" | "fragmentShader">,
): void {
  shader.vertexShader = replaceChunks(shader.vertexShader, [
    ["void main() {", `${vertexChunk}\nvoid main() {`],
    [
      readVertexStatement,
      `${readVertexStatement}\n#ifdef VALUE_COLORS\n  vColorMapCoord = colorMapCoordOf(readValue());\n#endif`,
    ],
  ]);
  shader.fragmentShader =
    fragmentDeclarations + replaceChunks(shader.fragmentShader, [["#include <color_fragment>", fragmentChunk]]);
}
