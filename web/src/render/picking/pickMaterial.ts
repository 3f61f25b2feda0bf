// The material of the picking pass. Instead of a colour, each pixel gets the id of its draw, the
// primitive and the nearest vertex, and the position and normals there. Vertices come from the same
// chunk as in every other pass, so that hits agree with the picture.
//
// The render target has four attachments of 32-bit unsigned integers, to which every WebGL 2
// implementation can render. Floats are stored as their bits.

import type { Side, Texture } from "three";
import { GLSL3, ShaderMaterial, Vector4 } from "three";
import type { DrawRange } from "../../stage/stage.ts";
import type { AppearanceDescription } from "../../document/description.ts";
import { maxClipPlanes } from "../environment/clipPlanes.ts";
import { primitiveDefinesOf, addPrimitiveChunks } from "../points/roundPoints.ts";
import { alphaMaskDefine, alphaMaskVarying } from "../shaders/texCoords.ts";
import type { VertexFormat, VertexUniforms } from "../shaders/vertexFormat.ts";
import { addVertexReading } from "../shaders/vertexChunk.ts";
import { imageVerticesDefine, needsViewport, vertexDefinesOf, wideLinesDefine } from "../shaders/vertexFormat.ts";
import { followViewport } from "../shaders/followViewport.ts";
import { cornersOf } from "../primitives/primitives.ts";

/**
 * Offset of each field in the 32-bit words of a pixel. Normals are zero where there are none. The three words of
 * `facePoint`, a vertex of the face, fill words that other fields leave free.
 */
export const pickedWordOffsets = {
  pickId: 0,
  /** The index of the primitive in its draw. */
  element: 1,
  vertex: 2,
  depth: 3,
  position: 4,
  normal: 8,
  faceNormal: 12,
  facePoint: [7, 11, 15],
} as const;
/** Number of the render target's attachments. */
export const pickTargetCount = 4;

/** Defined where fragments with too little alpha are not hit. */
const alphaCutoffDefine = "HAS_ALPHA_CUTOFF";

/** Declared in both shaders. */
const varyings = /* glsl */ `
varying vec3 vPosition;
varying vec3 vNormal;
flat varying int element;
flat varying ivec3 cornerVertices;
flat varying vec3 facePoint;
flat varying vec3 faceNormal;
varying vec3 cornerWeights;
#ifdef ${alphaMaskDefine}
  varying vec2 ${alphaMaskVarying};
#endif
#ifdef USE_COLOR_ALPHA
  varying float vertexAlpha;
#endif
`;

const vertexShader = /* glsl */ `
#include <common>
uniform bool hasNormals;
${varyings}
#ifdef ${imageVerticesDefine}
  vec3 operatedPosition(int vertex) {
    vec3 position = storedPosition(vertex), normal = vec3(0.0);
    operate(position, normal);
    return position;
  }
#endif
void main() {
  #include <uv_vertex>
  #include <beginnormal_vertex>
  #include <begin_vertex>
  #include <project_vertex>
  #ifdef USE_COLOR_ALPHA
    vertexAlpha = vertex.color.a;
  #endif
  vPosition = transformed;
  // Normalized before interpolation, as in materials.
  vNormal = hasNormals ? objectNormal / max(length(objectNormal), 1e-30) : vec3(0.0);
  // If the geometry has an index buffer, the shader gets only the index of the primitive's last
  // vertex; picker.ts finds the others.
  element = gl_VertexID;
  cornerVertices = ivec3(gl_VertexID);
  cornerWeights = vec3(1.0, 0.0, 0.0);
  #ifdef ${wideLinesDefine}
    element = gl_InstanceID;
    cornerWeights = vec3(1.0 - linePosition, linePosition, 0.0);
  #endif
  facePoint = transformed;
  faceNormal = vec3(0.0);
  #ifdef ${imageVerticesDefine}
    #if defined(${wideLinesDefine})
      cornerVertices.xy = ivec2(recordIndex(drawVertexIndex(0)), recordIndex(drawVertexIndex(1)));
    #elif defined(IS_LINE_STRIP)
      // A vertex ends one line and begins the next, so even indices are one corner and odd ones the
      // other; flat varyings have the value of the line's last vertex.
      element = gl_VertexID - 1;
      int other = recordIndex(max(element, 0));
      bool isEven = (gl_VertexID & 1) == 0;
      cornerVertices.xy = isEven ? ivec2(recordIndex(gl_VertexID), other) : ivec2(other, recordIndex(gl_VertexID));
      cornerWeights = isEven ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
    #else
      element = gl_VertexID / PRIMITIVE_CORNERS;
      int firstCorner = element * PRIMITIVE_CORNERS;
      for (int corner = 0; corner < PRIMITIVE_CORNERS; ++corner) {
        cornerVertices[corner] = recordIndex(firstCorner + corner);
        cornerWeights[corner] = gl_VertexID == firstCorner + corner ? 1.0 : 0.0;
      }
    #endif
    #if PRIMITIVE_CORNERS == 3
      facePoint = operatedPosition(cornerVertices.x);
      vec3 firstEdge = operatedPosition(cornerVertices.y) - facePoint;
      faceNormal = cross(firstEdge, operatedPosition(cornerVertices.z) - facePoint);
    #endif
  #endif
}
`;

const fragmentShader = /* glsl */ `
uniform uint pickId;
uniform int clipPlaneCount;
uniform vec4 clipPlanes[${maxClipPlanes}];
${varyings}
layout(location = 0) out uvec4 outIds;
layout(location = 1) out uvec4 outPosition;
layout(location = 2) out uvec4 outNormal;
layout(location = 3) out uvec4 outFaceNormal;
#ifdef ${alphaCutoffDefine}
  uniform vec2 alphaFactorAndCutoff;
#endif
#ifdef ${alphaMaskDefine}
  uniform sampler2D alphaMask;
#endif

void main() {
  for (int plane = 0; plane < clipPlaneCount; ++plane)
    if (dot(clipPlanes[plane], vec4(vPosition, 1.0)) < 0.0) discard;
  #ifdef ${alphaCutoffDefine}
    float alpha = alphaFactorAndCutoff.x;
    #ifdef ${alphaMaskDefine}
      alpha *= texture(alphaMask, ${alphaMaskVarying}).a;
    #endif
    #ifdef USE_COLOR_ALPHA
      alpha *= vertexAlpha;
    #endif
    if (alpha < alphaFactorAndCutoff.y) discard;
  #endif
  vec3 w = cornerWeights;
  int nearest = w.x >= w.y && w.x >= w.z ? cornerVertices.x : w.y >= w.z ? cornerVertices.y : cornerVertices.z;
  vec3 normal = gl_FrontFacing || PRIMITIVE_CORNERS != 3 ? vNormal : -vNormal;
  outIds = uvec4(pickId, uint(element), uint(nearest), floatBitsToUint(gl_FragCoord.z));
  uvec3 point = floatBitsToUint(facePoint);
  outPosition = uvec4(floatBitsToUint(vPosition), point.x);
  outNormal = uvec4(floatBitsToUint(normal), point.y);
  outFaceNormal = uvec4(floatBitsToUint(faceNormal), point.z);
}
`;

export interface PickMaterialRequest extends VertexFormat {
  readonly primitive: DrawRange["primitive"];
  readonly side: Side;
  readonly hasNormals: boolean;
  readonly alphaMask: AlphaMask | undefined;
  /** Shared with the material of the picture. */
  readonly uniforms: VertexUniforms;
}

export type PickMaterial = ShaderMaterial & {
  uniforms: {
    readonly pickId: { value: number };
    readonly clipPlaneCount: { value: number };
    /** In stored coordinates. */
    readonly clipPlanes: { readonly value: readonly Vector4[] };
  };
};

/** The alpha test of a surface with alphaMode MASK: fragments with alpha below the cutoff are discarded. */
export interface AlphaMask {
  readonly texture: Texture | undefined;
  /** Whether the alpha of vertex colours is a factor, too. */
  readonly usesVertexAlpha: boolean;
  /** The material's alpha, a factor of the alpha of the texture and of vertex colours. */
  readonly factor: number;
  readonly cutoff: number;
}

export function alphaMaskOf(
  { alpha: { mode, cutoff }, material: { transparency } }: AppearanceDescription,
  texture: Texture | undefined,
  usesVertexAlpha: boolean,
): AlphaMask | undefined {
  return mode === "MASK" ? { texture, usesVertexAlpha, factor: 1 - transparency, cutoff } : undefined;
}

export function makePickMaterial(request: PickMaterialRequest): PickMaterial {
  const { primitive, side, hasNormals, alphaMask, uniforms } = request;
  const shader = { vertexShader, fragmentShader };
  addVertexReading(shader);
  addPrimitiveChunks(shader);
  const material = new ShaderMaterial({
    ...shader,
    side,
    glslVersion: GLSL3,
    defines: {
      PRIMITIVE_CORNERS: cornersOf(request),
      ...(primitive === "lineStrip" && { IS_LINE_STRIP: "" }),
      ...vertexDefinesOf(request, hasNormals),
      ...primitiveDefinesOf(primitive),
      ...(alphaMask && { [alphaCutoffDefine]: "" }),
      ...(alphaMask?.texture && { [alphaMaskDefine]: "" }),
      ...(alphaMask?.usesVertexAlpha === true && { USE_COLOR_ALPHA: "" }),
    },
    uniforms: {
      ...uniforms,
      pickId: { value: 0 },
      clipPlaneCount: { value: 0 },
      clipPlanes: { value: Array.from({ length: maxClipPlanes }, () => new Vector4()) },
      hasNormals: { value: hasNormals },
      ...(alphaMask && {
        alphaMask: { value: alphaMask.texture ?? null },
        alphaFactorAndCutoff: { value: [alphaMask.factor, alphaMask.cutoff] },
      }),
    },
  }) as PickMaterial;
  if (needsViewport(request)) followViewport(material, uniforms.viewport);
  return material;
}
