// The record of an instance in a batch, and the shader chunks that read it: matrix, dequantisation,
// material, visibility. The vertex attribute `instanceIndex` says which record: once per instance
// in instanced draws, per vertex in merged meshes.

/** Defined in materials that draw instances with records. */
export const instancesDefine = "INSTANCES";

/** Defined in shaders that test the scope of a draw (drawScope.ts). */
export const scopesDefine = "SCOPES";

/** Flags that are added to an instance index, so that only back faces or only front faces are drawn. */
export const backFaces = 2 ** 31;
export const frontFaces = 2 ** 30;

/** Offset of each field in a record, in floats. */
export const instanceFields = {
  /** Three rows of the matrix from stored coordinates. */
  matrix: 0,
  /** The lattice step. */
  step: 12,
  /** 1 + the effect scope's number; 0 if the instance is invisible. */
  visibleInScope: 15,
  /** Origin and extent of each set of texture coordinates. */
  texCoordFrames: 16,
  /** Diffuse and opacity; specular and shininess, or metallic and roughness; emissive and ambient intensity. */
  material: 32,
  /** The range of the colour map. */
  mapRange: 44,
  lineWidth: 46,
  /** The value of a stored 0. */
  valueMin: 48,
  /** The difference between two stored values. */
  valueStep: 52,
} as const;
export const texelsPerInstance = 14;
const texelOf = (field: keyof typeof instanceFields) => Math.floor(instanceFields[field] / 4);

export const instanceVertexChunk = /* glsl */ `
#ifdef ${instancesDefine}
  attribute uint instanceIndex;
  uniform highp sampler2D instances;
  flat varying vec4 instanceDiffuse, instanceSpecular, instanceEmissive;
  flat varying uint instanceFaces;
  #ifdef ${scopesDefine}
    flat varying float instanceScope;
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

  // Cofactor matrix without the lattice steps: the inverse transpose up to a factor, which is
  // positive, because no record mirrors.
  vec3 instanceNormal(vec3 normal) {
    mat3 matrix = transpose(mat3(instanceTexel(0).xyz, instanceTexel(1).xyz, instanceTexel(2).xyz));
    vec3 steps = instanceTexel(3).xyz;
    vec3 x = matrix[0] / steps.x, y = matrix[1] / steps.y, z = matrix[2] / steps.z;
    return mat3(cross(y, z), cross(z, x), cross(x, y)) * normal;
  }

  vec4 instanceTexCoordFrame(int set) {
    return instanceTexel(${texelOf("texCoordFrames")} + set);
  }

  // Invisible instances are moved beyond the far plane.
  void applyInstance() {
    instanceDiffuse = instanceTexel(${texelOf("material")});
    instanceSpecular = instanceTexel(${texelOf("material")} + 1);
    instanceEmissive = instanceTexel(${texelOf("material")} + 2);
    instanceFaces = instanceIndex & ${backFaces + frontFaces}u;
    float visibleInScope = instanceTexel(3).w;
    #ifdef ${scopesDefine}
      instanceScope = visibleInScope - 1.0;
    #endif
    if (visibleInScope == 0.0) gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
  }
#else
  vec3 instancePosition(vec3 stored) {
    return stored;
  }

  // The normal matrix divides by the lattice steps again.
  vec3 instanceNormal(vec3 normal) {
    return normal * latticeStep;
  }

  vec4 instanceTexCoordFrame(int set) {
    return texCoordFrames[set];
  }

  void applyInstance() {}
#endif
`;

/** Inserted before the fragment shader of a material whose colours come from the record. */
export const instanceFragmentChunk = /* glsl */ `
#ifdef ${instancesDefine}
  flat varying vec4 instanceDiffuse, instanceSpecular, instanceEmissive;
  flat varying uint instanceFaces;
#endif
`;

/** Replaces `void main() {` of a fragment shader. */
export const discardFacesChunk = /* glsl */ `void main() {
#ifdef ${instancesDefine}
  if (instanceFaces == (gl_FrontFacing ? ${backFaces}u : ${frontFaces}u)) discard;
#endif
`;

/** Makes three.js' fragment shaders take colours from the record instead of uniforms. */
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
