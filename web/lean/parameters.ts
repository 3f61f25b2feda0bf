// Parameters of programs in three.js that are the same for all of our materials and scenes.

/** Parameters of programs that are false, or 0, for all of our materials and scenes. */
const unusedParameters = [
  "alphaHash",
  "alphaMap",
  "anisotropy",
  "anisotropyMap",
  "batching",
  "batchingColor",
  "bumpMap",
  "clearcoat",
  "clearcoatMap",
  "clearcoatNormalMap",
  "clearcoatRoughnessMap",
  "decodeVideoTexture",
  "decodeVideoTextureEmissive",
  "diffuseRoughness",
  "diffuseRoughnessMap",
  "dispersion",
  "displacementMap",
  "dithering",
  "envMap",
  "envMapMaxLod",
  "envMapMode",
  "envMapPMREM",
  "envMapSize",
  "extensionClipCullDistance",
  "extensionMultiDraw",
  "fogExp2",
  "gradientMap",
  "instancing",
  "instancingColor",
  "instancingMorph",
  "iridescence",
  "iridescenceMap",
  "iridescenceThicknessMap",
  "lightMap",
  "logarithmicDepthBuffer",
  "matcap",
  "metalnessMap",
  "morphColors",
  "morphNormals",
  "morphTargets",
  "morphTargetsCount",
  "morphTextureStride",
  "normalMapObjectSpace",
  "numClipIntersection",
  "numClippingPlanes",
  "numDirLightShadows",
  "numHemiLights",
  "numLightProbeGrids",
  "numLightProbes",
  "numPointLightShadows",
  "numRectAreaLights",
  "numSpotLightMaps",
  "numSpotLightShadows",
  "numSpotLightShadowsWithMaps",
  "numSunLightShadows",
  "numSunLights",
  "pointsUvs",
  "retroreflection",
  "reversedDepthBuffer",
  "roughnessMap",
  "shadowMapEnabled",
  "sheen",
  "sheenColorMap",
  "sheenRoughnessMap",
  "skinning",
  "specularColorMap",
  "specularIntensityMap",
  "thicknessMap",
  "transmission",
  "transmissionMap",
  "useDepthPacking",
  "vertexTangents",
];

/** Numbers in shaders that are 0 with them. */
export const unusedNumbers = [
  "NUM_CLIPPING_PLANES",
  "NUM_DIR_LIGHT_SHADOWS",
  "NUM_HEMI_LIGHTS",
  "NUM_LIGHT_PROBE_GRIDS",
  "NUM_POINT_LIGHT_SHADOWS",
  "NUM_RECT_AREA_LIGHTS",
  "NUM_SPOT_LIGHT_COORDS",
  "NUM_SPOT_LIGHT_MAPS",
  "NUM_SPOT_LIGHT_SHADOWS",
  "NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS",
  "NUM_SUN_LIGHTS",
  "NUM_SUN_LIGHT_SHADOWS",
  "UNION_CLIPPING_PLANES",
];

/** The modules of three.js that read or set parameters. */
const users = ["renderers/WebGLRenderer.js", "renderers/webgl/WebGLProgram.js", "renderers/webgl/WebGLPrograms.js"];

/**
 * A module of three.js, with this path in its sources, without what it does for unused parameters: what reads them gets
 * false or 0, and nothing sets them.
 */
export function withoutUnusedParameters(path: string, module: string): string {
  if (!users.includes(path)) return module;
  if (path.endsWith("WebGLPrograms.js")) requireParameters(module);
  const names = unusedParameters.join("|");
  return module
    .replaceAll(new RegExp(`\\bparameters\\.(${names})(Uv)?\\b`, "g"), (_, name: string) =>
      /^num|Count$|Stride$/.test(name) ? "0" : "false",
    )
    .replaceAll(new RegExp(`^\\t\\t\\t(${names})(Uv)?: .*,\\n`, "gm"), "")
    .replaceAll(/^\t\t\t(false|0)\b.*\? '#define .* : '',\n/gm, "")
    .replaceAll(/^\t\tarray\.push\( (false|0) \);\n/gm, "");
}

function requireParameters(module: string): void {
  const missing = unusedParameters.filter((name) => !module.includes(`\t${name}: `));
  if (missing.length > 0) throw new Error(`three.js' programs have no parameter ${missing.join(", ")} any more`);
}

/** The text of WebGLProgram.js without lines of GLSL that are never compiled. */
export function withoutUnusedLines(module: string, isUndefined: (name: string) => boolean): string {
  return module.replaceAll(/^\t*'#ifdef (\w+)',\n[^#]*'#endif',\n/gm, (lines, name: string) =>
    isUndefined(name) ? "" : lines,
  );
}
