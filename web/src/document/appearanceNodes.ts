// The fields of Appearance nodes, and of the nodes in them: a part of the table in nodes.ts.

import {
  MFUrl,
  optional,
  SFBool,
  SFColor,
  SFFloat,
  SFImage,
  SFInt32,
  SFString,
  SFVec2f,
  SFVec3f,
} from "./fieldTypes.ts";
import { noPixels } from "./pixelImage.ts";

export const appearanceNodes = {
  Material: {
    diffuseColor: SFColor([0.8, 0.8, 0.8]),
    specularColor: SFColor([0, 0, 0]),
    emissiveColor: SFColor([0, 0, 0]),
    ambientIntensity: SFFloat(0.2),
    shininess: SFFloat(0.2),
    transparency: SFFloat(0),
    normalScale: SFFloat(1),
    occlusionStrength: SFFloat(1),
  },
  PhysicalMaterial: {
    baseColor: SFColor([1, 1, 1]),
    metallic: SFFloat(1),
    roughness: SFFloat(1),
    emissiveColor: SFColor([0, 0, 0]),
    transparency: SFFloat(0),
    normalScale: SFFloat(1),
    occlusionStrength: SFFloat(1),
  },
  AnisotropyMaterialExtension: {
    anisotropyStrength: SFFloat(0),
    anisotropyRotation: SFFloat(0),
  },
  ClearcoatMaterialExtension: {
    clearcoat: SFFloat(0),
    clearcoatRoughness: SFFloat(0),
  },
  DispersionMaterialExtension: { dispersion: SFFloat(0) },
  EmissiveStrengthMaterialExtension: { emissiveStrength: SFFloat(1) },
  IORMaterialExtension: { indexOfRefraction: SFFloat(1.5) },
  IridescenceMaterialExtension: {
    iridescence: SFFloat(0),
    iridescenceIndexOfRefraction: SFFloat(1.3),
    iridescenceThicknessMinimum: SFFloat(100),
    iridescenceThicknessMaximum: SFFloat(400),
  },
  SheenMaterialExtension: {
    sheenColor: SFColor([0, 0, 0]),
    sheenRoughness: SFFloat(0),
  },
  SpecularMaterialExtension: {
    specular: SFFloat(1),
    specularColor: SFColor([1, 1, 1]),
  },
  TransmissionMaterialExtension: { transmission: SFFloat(0) },
  VolumeMaterialExtension: {
    thickness: SFFloat(0),
    attenuationDistance: SFFloat(1000000),
    attenuationColor: SFColor([1, 1, 1]),
  },
  UnlitMaterial: {
    emissiveColor: SFColor([1, 1, 1]),
    transparency: SFFloat(0),
  },
  Appearance: { alphaMode: SFString("AUTO"), alphaCutoff: SFFloat(0.5) },
  TextureProperties: {
    boundaryModeS: SFString("REPEAT"),
    boundaryModeT: SFString("REPEAT"),
    magnificationFilter: SFString("DEFAULT"),
    minificationFilter: SFString("DEFAULT"),
    anisotropicDegree: SFFloat(1),
  },
  TextureTransform: {
    translation: SFVec2f([0, 0]),
    rotation: SFFloat(0),
    scale: SFVec2f([1, 1]),
    center: SFVec2f([0, 0]),
  },
  LineProperties: { applied: SFBool(true), linetype: SFInt32(1), linewidthScaleFactor: SFFloat(0) },
  PointProperties: {
    pointSizeScaleFactor: SFFloat(1),
    /** Default: no bound. With X3D's defaults, 1 and 1, the scale factor would have no effect. */
    pointSizeMinValue: optional(SFFloat(1)),
    pointSizeMaxValue: optional(SFFloat(1)),
    attenuation: SFVec3f([1, 0, 0]),
  },
  ImageTexture: {
    containerField: SFString(""),
    url: MFUrl([]),
    preview: SFString(""),
    repeatS: SFBool(true),
    repeatT: SFBool(true),
  },
  ImageCubeMapTexture: { containerField: SFString(""), url: MFUrl([]), preview: SFString("") },
  GeneratedCubeMapTexture: { containerField: SFString(""), size: SFInt32(128), update: SFString("NONE") },
  ComposedCubeMapTexture: { containerField: SFString("") },
  PixelTexture: { image: SFImage(noPixels), repeatS: SFBool(true), repeatT: SFBool(true) },
} as const;
