// GLSL that moves vertices with the joints and displacers of their shape.

import type { DeformationLayout } from "../../stage/deformation.ts";
import { texelsPerVertex } from "../../stage/deformation.ts";

const deformedDefine = "DEFORMED";

/** The #defines of a material whose vertices move. */
export function deformationDefinesOf(layout: DeformationLayout): Record<string, string> {
  return {
    [deformedDefine]: "",
    JOINT_SETS: `${layout.jointSets}`,
    DISPLACERS: `${layout.displacers}`,
    TEXELS_PER_VERTEX: `${texelsPerVertex(layout)}`,
    ...(layout.displacesNormals && { DISPLACES_NORMALS: "" }),
  };
}

/** Texels of a joint's matrix in the pose: its rows. */
export const texelsPerJoint = 3;

/** Defines `deform`. Included after `latticeStep` and `Vertex`. Vertices are in buffers, so that gl_VertexID is theirs. */
export const deformationChunk = /* glsl */ `
#ifdef ${deformedDefine}

uniform highp sampler2D deformationImage, poseImage;
uniform vec3 latticeOrigin;
uniform int jointCount;

vec4 texelIn(highp sampler2D image, int n) {
  int width = textureSize(image, 0).x;
  return texelFetch(image, ivec2(n % width, n / width), 0);
}

vec4 deformationTexel(int n) {
  return texelIn(deformationImage, gl_VertexID * TEXELS_PER_VERTEX + n);
}

#if DISPLACERS > 0

void displace(inout vec3 point, inout vec3 normal) {
  if (normal != vec3(0.0)) normal = normalize(normal);
  for (int i = 0; i < DISPLACERS; ++i) {
    float weight = texelIn(poseImage, ${texelsPerJoint} * jointCount + i / 4)[i % 4];
    if (weight == 0.0) continue;
    #ifdef DISPLACES_NORMALS
      point += weight * deformationTexel(2 * JOINT_SETS + 2 * i).xyz;
      normal += weight * deformationTexel(2 * JOINT_SETS + 2 * i + 1).xyz;
    #else
      point += weight * deformationTexel(2 * JOINT_SETS + i).xyz;
    #endif
  }
}

#endif

#if JOINT_SETS > 0

void followJoints(inout vec3 point, inout vec3 normal) {
  vec4 x = vec4(0.0), y = vec4(0.0), z = vec4(0.0);
  float sum = 0.0;
  for (int set = 0; set < JOINT_SETS; ++set) {
    vec4 joints = deformationTexel(2 * set), weights = deformationTexel(2 * set + 1);
    for (int i = 0; i < 4; ++i) {
      if (weights[i] == 0.0) continue;
      int row = ${texelsPerJoint} * int(joints[i] + 0.5);
      x += weights[i] * texelIn(poseImage, row);
      y += weights[i] * texelIn(poseImage, row + 1);
      z += weights[i] * texelIn(poseImage, row + 2);
      sum += weights[i];
    }
  }
  if (sum == 0.0) return;
  point = vec3(dot(x, vec4(point, 1.0)), dot(y, vec4(point, 1.0)), dot(z, vec4(point, 1.0))) / sum;
  // The cofactor matrix, with the sign of the determinant: the inverse transpose up to a positive factor.
  vec3 a = cross(y.xyz, z.xyz), b = cross(z.xyz, x.xyz), c = cross(x.xyz, y.xyz);
  normal = sign(dot(x.xyz, a)) * vec3(dot(a, normal), dot(b, normal), dot(c, normal));
}

#endif

void deform(inout vec3 position, inout vec3 normal) {
  vec3 point = latticeOrigin + latticeStep * position;
  #if DISPLACERS > 0
    displace(point, normal);
  #endif
  #if JOINT_SETS > 0
    if (jointCount > 0) followJoints(point, normal);
  #endif
  position = (point - latticeOrigin) / latticeStep;
}

#else

void deform(inout vec3 position, inout vec3 normal) {}

#endif
`;
