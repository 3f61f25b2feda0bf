// How shaders read the record of a place: where it is, what its vertices' numbers
// mean, and its colours. The place's number is an attribute: of each instance
// where a mesh is drawn in many places, of each vertex where many are one mesh.

/** Defined in materials whose draws are of many places. */
export const instancesDefine = "PLACES";

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
  attribute uint place;
  uniform highp sampler2D places;
  flat varying vec4 placeDiffuse, placeSpecular, placeEmissive;
  flat varying uint placeFaces;
  #ifdef ${scopedLightsDefine}
    flat varying float placeLightScope;
  #endif

  vec4 placeTexel(int n) {
    int texel = int(place & ${frontFaces - 1}u) * ${texelsPerInstance} + n;
    int width = textureSize(places, 0).x;
    return texelFetch(places, ivec2(texel % width, texel / width), 0);
  }

  vec3 inPlace(vec3 stored) {
    vec4 point = vec4(stored, 1.0);
    return vec3(dot(placeTexel(0), point), dot(placeTexel(1), point), dot(placeTexel(2), point));
  }

  // By the cofactors of the matrix without the lattice's steps: its inverse, transposed, but for a
  // factor, which is positive, as no record mirrors.
  vec3 normalInPlace(vec3 normal) {
    mat3 matrix = transpose(mat3(placeTexel(0).xyz, placeTexel(1).xyz, placeTexel(2).xyz));
    vec3 steps = placeTexel(3).xyz;
    vec3 x = matrix[0] / steps.x, y = matrix[1] / steps.y, z = matrix[2] / steps.z;
    return mat3(cross(y, z), cross(z, x), cross(x, y)) * normal;
  }

  vec4 texCoordFrameOfPlace() {
    return placeTexel(4);
  }

  // What is not shown lies beyond the far side of all that is seen.
  void showPlace() {
    placeDiffuse = placeTexel(5);
    placeSpecular = placeTexel(6);
    placeEmissive = placeTexel(7);
    placeFaces = place & ${backFaces + frontFaces}u;
    float shownIn = placeTexel(3).w;
    #ifdef ${scopedLightsDefine}
      placeLightScope = shownIn - 1.0;
    #endif
    if (shownIn == 0.0) gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
  }
#else
  vec3 inPlace(vec3 stored) {
    return stored;
  }

  // The normal matrix takes the lattice's steps out of it again.
  vec3 normalInPlace(vec3 normal) {
    return normal * latticeStep;
  }

  vec4 texCoordFrameOfPlace() {
    return texCoordFrame;
  }

  void showPlace() {}
#endif
`;

/** Before the fragment shader of a material whose colours come from the record. */
export const instanceFragmentChunk = /* glsl */ `
#ifdef ${instancesDefine}
  flat varying vec4 placeDiffuse, placeSpecular, placeEmissive;
  flat varying uint placeFaces;
#endif
`;

/** In place of its beginning. */
export const cutFacesChunk = /* glsl */ `void main() {
#ifdef ${instancesDefine}
  if (placeFaces == (gl_FrontFacing ? ${backFaces}u : ${frontFaces}u)) discard;
#endif
`;

/** In three's fragment shaders: the uniforms of a material, and where they are a place's. */
export const instanceColorChunks: readonly (readonly [string, string])[] = [
  [
    "vec4 diffuseColor = vec4( diffuse, opacity );",
    `
#ifdef ${instancesDefine}
  vec4 diffuseColor = placeDiffuse;
#else
  vec4 diffuseColor = vec4(diffuse, opacity);
#endif
`,
  ],
  [
    "vec3 totalEmissiveRadiance = emissive;",
    `
#ifdef ${instancesDefine}
  vec3 totalEmissiveRadiance = placeEmissive.rgb;
#else
  vec3 totalEmissiveRadiance = emissive;
#endif
`,
  ],
];
