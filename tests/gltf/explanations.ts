// Explains for files why imgeo's picture differs from that of three.js' GLTFLoader.

/** Pictures with a mean difference of a colour channel of up to this, of 255, count as equal. */
export const maxEqualMean = 2;

const withoutMaterial =
  "no material: imgeo draws its own default, a grey surface, three.js that of glTF, a rough white metal";

const explanations: readonly (readonly [file: RegExp, why: string])[] = [
  [/glTF2\/cameras\/Cameras\.gltf$/, withoutMaterial],
  [/glTF2\/IncorrectVertexArrays\/Cube\.gltf$/, withoutMaterial],
  [/glTF2\/simple_skin\/simple_skin\.gltf$/, withoutMaterial],
  [/Mesh_PrimitiveMode\/Mesh_PrimitiveMode_\d+\.gltf$/, withoutMaterial],
  [/wrongTypes\/badObject\.gltf$/, `the material is not valid and is left out with a warning; ${withoutMaterial}`],
  [
    /wrongTypes\/badExtension\.gltf$/,
    "the material is not valid and is left out with a warning; three.js reads past it",
  ],
  [
    /ClearCoat-glTF\/ClearCoatTest\.gltf$/,
    "coats reflect the grey room that surrounds metals; in three.js' picture it surrounds metals only, and highlights are widened by the curvature",
  ],
  [
    /magicleap-two\/none\.glb$/,
    "dark surfaces reflect ambient light, too, as light from everywhere does; not in three.js",
  ],
  [
    /BoxTextured-glTF-techniqueWebGL\/BoxTextured\.gltf$/,
    "a rough white metal: three.js adds the light of several reflections between microfacets, glTF's appendix B does not",
  ],
  [
    /BoxTextured-glTF-pbrSpecularGlossiness\/BoxTextured\.gltf$/,
    "three.js no longer supports KHR_materials_pbrSpecularGlossiness",
  ],
];

/** Why the picture of a file may differ by more than `maxEqualMean`; "" if nothing explains it. */
export function explanationOf(file: string): string {
  return explanations.find(([pattern]) => pattern.test(file))?.[1] ?? "";
}
