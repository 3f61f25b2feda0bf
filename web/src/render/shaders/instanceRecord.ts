// How shaders read the record of a place: where it is, what its vertices' numbers
// mean, and its colours. The place's number is an attribute: of each instance
// where a mesh is drawn in many places, of each vertex where many are one mesh.

/** Defined in materials whose draws are of many places. */
export const instancesDefine = "INSTANCES";

/** Defined in shaders that test what light reaches a draw: lightScopes.ts. */
export const scopedLightsDefine = "SCOPED_LIGHTS";

/** Added to a place's number: only back faces are drawn, only front faces. */
export const backFaces = 2 ** 31;
export const frontFaces = 2 ** 30;

/**
 * Where in a record each field begins, in numbers: the matrix' three rows; step and,
 * where the place is shown, one more than the number of its light scope; the frame of
 * texture coordinates; a look, which is diffuse and opacity, specular and shininess,
 * or metallic and roughness, emissive and ambient intensity, the range of the map of
 * colours, and the width of lines; and what stored values are.
 */
export const instanceFields = {
  matrix: 0,
  step: 12,
  visibleInScope: 15,
  texCoordFrame: 16,
  material: 20,
  mapRange: 32,
  lineWidth: 34,
  valueMin: 36,
  valueStep: 40,
} as const;
export const texelsPerInstance = 11;

export const instanceVertexChunk = /* glsl */ `
#ifdef ${instancesDefine}
  attribute uint instanceIndex;
  uniform highp sampler2D instances;
  flat varying vec4 instanceDiffuse, instanceSpecular, instanceEmissive;
  flat varying uint instanceFaces;
  #ifdef ${scopedLightsDefine}
    flat varying float instanceLightScope;
  #endif

  vec4 instanceTexel(int n) {
    int texel = int(instanceIndex & ${frontFaces - 1}u) * ${texelsPerInstance} + n;
    int width = textureSize(instances, 0).x;
    return texelFetch(instances, ivec2(texel % width, texel / width), 0);
  }

  vec3 instancePosition(vec3 stored) {
    vec4 point = vec4(stored, 1.0);
    return vec3(dot(instanceTexel(0), point), dot(instanceTexel(1), point), dot(instanceTexel(2), point));
  }

  // By the cofactors of the matrix without the lattice's steps: its inverse, transposed, but for a
  // factor, which is positive, as no record mirrors.
  vec3 instanceNormal(vec3 normal) {
    mat3 matrix = transpose(mat3(instanceTexel(0).xyz, instanceTexel(1).xyz, instanceTexel(2).xyz));
    vec3 steps = instanceTexel(3).xyz;
    vec3 x = matrix[0] / steps.x, y = matrix[1] / steps.y, z = matrix[2] / steps.z;
    return mat3(cross(y, z), cross(z, x), cross(x, y)) * normal;
  }

  vec4 instanceTexCoordFrame() {
    return instanceTexel(4);
  }

  // What is not shown lies beyond the far side of all that is seen.
  void applyInstance() {
    instanceDiffuse = instanceTexel(5);
    instanceSpecular = instanceTexel(6);
    instanceEmissive = instanceTexel(7);
    instanceFaces = instanceIndex & ${backFaces + frontFaces}u;
    float visibleInScope = instanceTexel(3).w;
    #ifdef ${scopedLightsDefine}
      instanceLightScope = visibleInScope - 1.0;
    #endif
    if (visibleInScope == 0.0) gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
  }
#else
  vec3 instancePosition(vec3 stored) {
    return stored;
  }

  // The normal matrix takes the lattice's steps out of it again.
  vec3 instanceNormal(vec3 normal) {
    return normal * latticeStep;
  }

  vec4 instanceTexCoordFrame() {
    return texCoordFrame;
  }

  void applyInstance() {}
#endif
`;

/** Before the fragment shader of a material whose colours come from the record. */
export const instanceFragmentChunk = /* glsl */ `
#ifdef ${instancesDefine}
  flat varying vec4 instanceDiffuse, instanceSpecular, instanceEmissive;
  flat varying uint instanceFaces;
#endif
`;

/** In place of its beginning. */
export const discardFacesChunk = /* glsl */ `void main() {
#ifdef ${instancesDefine}
  if (instanceFaces == (gl_FrontFacing ? ${backFaces}u : ${frontFaces}u)) discard;
#endif
`;

/** In three's fragment shaders: the uniforms of a material, and where they are a place's. */
export const instanceColorChunks: readonly (readonly [string, string])[] = [
  [
    "vec4 diffuseColor = vec4( diffuse, opacity );",
    `
#ifdef ${instancesDefine}
  vec4 diffuseColor = instanceDiffuse;
#else
  vec4 diffuseColor = vec4(diffuse, opacity);
#endif
`,
  ],
  [
    "vec3 totalEmissiveRadiance = emissive;",
    `
#ifdef ${instancesDefine}
  vec3 totalEmissiveRadiance = instanceEmissive.rgb;
#else
  vec3 totalEmissiveRadiance = emissive;
#endif
`,
  ],
];
