// Colours from an attribute's values. A value is read beside its vertex (from the
// byte planes of an image, or from a buffer) and looked up in the map of colours for
// each pixel, so that between two vertices lie the colours of the values between.

import type { IUniform, Texture, WebGLProgramParametersWithUniforms } from "three";
import { Vector3 } from "three";
import type { DecodedImage } from "../decode/image.ts";
import type { Stage, ValuePlanes } from "../decode/stage.ts";
import { mostMapColors } from "../document/colorMaps.ts";
import type { AttributeDescription, ColorMapDescription } from "../document/description.ts";
import { toLinearChunk } from "../lighting/physicalLighting.ts";
import { imageVerticesDefine, readVertexStatement, replaceEach, srgbColorsDefine } from "./vertexChunk.ts";
import { wideLinesDefine } from "./wideLineChunk.ts";

/** Of a shape; changed in place. */
export interface ColorMapUniforms extends Record<string, IUniform> {
  mapColors: IUniform<Vector3[]>;
  mapColorCount: IUniform<number>;
  mapRange: IUniform<[number, number]>;
}

export function makeColorMapUniforms(): ColorMapUniforms {
  return {
    mapColors: { value: Array.from({ length: mostMapColors }, () => new Vector3()) },
    mapColorCount: { value: 2 },
    mapRange: { value: [0, 1] },
  };
}

export function setColorMap(uniforms: ColorMapUniforms, map: ColorMapDescription | undefined): void {
  if (map === undefined) return;
  map.colors.forEach((color, i) => uniforms.mapColors.value[i]?.set(...color));
  uniforms.mapColorCount.value = map.colors.length;
  uniforms.mapRange.value = [...map.range];
}

/** What a material must define to be coloured by the values of a stage. */
export function valueDefinesOf(stage: Stage, attribute: AttributeDescription | undefined): Record<string, string> {
  if (attribute === undefined || stage.value === undefined) return {};
  return { VALUE_COMPONENTS: `${attribute.components}` };
}

export function valueUniformsOf(stage: Stage, attribute: AttributeDescription | undefined,
                                textureOf: (image: DecodedImage) => Texture): Record<string, IUniform> {
  if (attribute === undefined || stage.value === undefined) return {};
  if (stage.kind === "buffers") return frameOf(attribute, stage.value.largest);
  return { ...frameOf(attribute, 256 ** stage.value.planeCount - 1), ...imageUniformsOf(stage.value, textureOf) };
}

/** What a stored 0 is, and a step. */
function frameOf({ min, size }: AttributeDescription, largest: number | undefined): Record<string, IUniform> {
  const four = (values: readonly number[], missing: number) => [0, 1, 2, 3].map((c) => values[c] ?? missing);
  if (largest === undefined) return { valueMin: { value: four([], 0) }, valueStep: { value: four([], 1) } };
  return { valueMin: { value: four(min, 0) }, valueStep: { value: four(size.map((extent) => extent / largest), 0) } };
}

function imageUniformsOf({ planes, planeCount, middleOfMissing }: ValuePlanes, textureOf: (image: DecodedImage) => Texture): Record<string, IUniform> {
  const image = (plane: number) => ({ value: planes[plane] ? textureOf(planes[plane].image) : null });
  return {
    valueImage0: image(0),
    valueImage1: image(1),
    valueImage2: image(2),
    valueFirstTexels: { value: [0, 1, 2].map((plane) => planes[plane]?.first ?? 0) },
    valuePlanes: { value: planeCount },
    middleOfMissingValue: { value: middleOfMissing },
  };
}

const vertexChunk = /* glsl */ `
#ifdef VALUE_COMPONENTS

varying float vValue;
uniform vec4 valueMin, valueStep;

#ifdef ${imageVerticesDefine}

uniform sampler2D valueImage0, valueImage1, valueImage2;
uniform ivec3 valueFirstTexels;
uniform int valuePlanes;
uniform float middleOfMissingValue;

uvec4 valueBytes(sampler2D image, int first, int n) {
  return uvec4(texelOf(image, first, n) * 255.0 + 0.5);
}

vec4 readValues(int end) {
  int n = recordTexel(recordNumber(drawnNumber(end)));
  uvec4 stored = valueBytes(valueImage0, valueFirstTexels.x, n);
  if (valuePlanes > 1) stored = (stored << 8) | valueBytes(valueImage1, valueFirstTexels.y, n);
  if (valuePlanes > 2) stored = (stored << 8) | valueBytes(valueImage2, valueFirstTexels.z, n);
  return valueMin + valueStep * (vec4(stored) + middleOfMissingValue);
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
    return mix(valueAt(0), valueAt(1), lineShare);
  #else
    return valueAt(0);
  #endif
}

#endif
`;

const fragmentDeclarations = /* glsl */ `
#ifdef VALUE_COMPONENTS
  varying float vValue;
  uniform vec3 mapColors[${mostMapColors}];
  uniform int mapColorCount;
  uniform vec2 mapRange;

  vec3 mappedColor(float value) {
    float extent = mapRange.y - mapRange.x;
    float place = extent == 0.0 ? 0.0 : clamp((value - mapRange.x) / extent, 0.0, 1.0);
    float at = place * float(mapColorCount - 1);
    int before = min(int(at), mapColorCount - 2);
    vec3 color = mix(mapColors[before], mapColors[before + 1], at - float(before));
    #ifdef ${srgbColorsDefine}
      ${toLinearChunk("color")}
    #endif
    return color;
  }
#endif
`;

const fragmentChunk = /* glsl */ `
#include <color_fragment>
#ifdef VALUE_COMPONENTS
  diffuseColor.rgb = mappedColor(vValue);
#endif
`;

/** For `onBeforeCompile`, behind readVerticesIn and shadeByFarnessIn; does nothing where the material does not define it. */
export function colorByValueIn(shader: Pick<WebGLProgramParametersWithUniforms, "vertexShader" | "fragmentShader">): void {
  shader.vertexShader = replaceEach(shader.vertexShader, [
    ["void main() {", `${vertexChunk}\nvoid main() {`],
    [readVertexStatement, `${readVertexStatement}\n#ifdef VALUE_COMPONENTS\n  vValue = readValue();\n#endif`],
  ]);
  shader.fragmentShader = fragmentDeclarations + replaceEach(shader.fragmentShader, [["#include <color_fragment>", fragmentChunk]]);
}
