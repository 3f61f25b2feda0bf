// The numbers of the extensions of PhysicalMaterial, which extendedLighting.ts reads.

/** Defined in physical materials that have extensions. */
export const extendedDefine = "EXTENDED";

/** The numbers and colors of extensions; each is a uniform. */
export const extensionUniforms = {
  anisotropyStrength: "float",
  anisotropyRotation: "float",
  clearcoat: "float",
  clearcoatRoughness: "float",
  dispersion: "float",
  indexOfRefraction: "float",
  iridescence: "float",
  iridescenceIndexOfRefraction: "float",
  iridescenceThicknessMinimum: "float",
  iridescenceThicknessMaximum: "float",
  sheenColor: "vec3",
  sheenRoughness: "float",
  reflectionStrength: "float",
  specularColor: "vec3",
  transmission: "float",
  thickness: "float",
  attenuationDistance: "float",
  attenuationColor: "vec3",
} as const;
