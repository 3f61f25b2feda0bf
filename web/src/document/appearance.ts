// Reads Appearance nodes: material, alpha, textures, point and line properties.

import type {
  AlphaDescription,
  AppearanceDescription,
  ColorMapDescription,
  MaterialDescription,
  MaterialExtensions,
  PointDescription,
  TextureDescription,
  TextureRole,
  Warning,
} from "./description.ts";
import { textureRoles } from "./description.ts";
import type { SceneElement } from "./element.ts";
import { attributeOf, emptyElement, lowerNameOf } from "./element.ts";
import { readLines } from "./lineProperties.ts";
import { nodeFields, readFields } from "./nodes.ts";
import { withinPictureLimit } from "./pictureLimit.ts";
import { isCubeMap, readCubeMap } from "./readCubeMap.ts";
import type { ChildrenOf } from "./readImage.ts";
import { fieldOf, isTexture, readImageOf } from "./readImage.ts";
import { entryOf } from "./tables.ts";

type TextureFields = Partial<Readonly<Record<TextureRole, string>>>;

/** The texture fields of each material, by texture role. */
const textureFields: Readonly<Record<string, TextureFields>> = {
  material: {
    color: "diffuseTexture",
    emissive: "emissiveTexture",
    normal: "normalTexture",
    occlusion: "occlusionTexture",
    ambient: "ambientTexture",
    specular: "specularTexture",
    shininess: "shininessTexture",
  },
  physicalmaterial: {
    color: "baseTexture",
    emissive: "emissiveTexture",
    metallicRoughness: "metallicRoughnessTexture",
    normal: "normalTexture",
    occlusion: "occlusionTexture",
  },
  unlitmaterial: { color: "emissiveTexture" },
};

/** The texture fields of each extension of PhysicalMaterial. */
const extensionTextureFields: Readonly<Record<string, TextureFields>> = {
  anisotropymaterialextension: { anisotropy: "anisotropyTexture" },
  clearcoatmaterialextension: {
    clearcoat: "clearcoatTexture",
    clearcoatRoughness: "clearcoatRoughnessTexture",
    clearcoatNormal: "clearcoatNormalTexture",
  },
  dispersionmaterialextension: {},
  emissivestrengthmaterialextension: {},
  iormaterialextension: {},
  iridescencematerialextension: {
    iridescence: "iridescenceTexture",
    iridescenceThickness: "iridescenceThicknessTexture",
  },
  sheenmaterialextension: { sheenColor: "sheenColorTexture", sheenRoughness: "sheenRoughnessTexture" },
  specularmaterialextension: { specularStrength: "specularTexture", specularColor: "specularColorTexture" },
  transmissionmaterialextension: { transmission: "transmissionTexture" },
  volumematerialextension: { thickness: "thicknessTexture" },
};

/** The roles of textures that hold colors in sRGB; the others hold data. */
const colorRoles: readonly TextureRole[] = ["color", "emissive", "ambient", "specular", "sheenColor", "specularColor"];

/** `colorMap` comes from the Shape: X3D's Appearance has no such field. */
export function readAppearance(
  element: SceneElement | undefined,
  colorMap: ColorMapDescription | undefined,
  childrenOf: ChildrenOf,
  warnings: Warning[],
): AppearanceDescription {
  const children =
    element === undefined ? [] : childrenOf(element).flatMap((child) => texturesFor(child, childrenOf, warnings));
  const childNamed = (name: string) => children.find((child) => lowerNameOf(child) === name);
  const material = children.find((child) => entryOf(textureFields, lowerNameOf(child)));
  const points = childNamed("pointproperties");
  const lines = childNamed("lineproperties");
  const appearance: AppearanceDescription = {
    material: readMaterial(material, childrenOf, warnings),
    alpha: element ? readAlpha(element, warnings) : automaticAlpha,
    textures: [
      ...readTextures(children, material, textureFields, childrenOf, warnings),
      ...extensionsOf(material, childrenOf).flatMap((extension) =>
        readTextures(children, extension, extensionTextureFields, childrenOf, warnings),
      ),
    ],
    cubeMap: readAppearanceCubeMap(children, material, childrenOf, warnings),
    points: points && readPoints(points, warnings),
    lines: lines && readLines(lines, warnings),
    colorMap,
  };
  return withinPictureLimit(appearance, element, warnings);
}

/**
 * The appearance of a geometry with `lit="false"` (X3DOM): its texture, else the colors of its vertices, else the
 * material's emissiveColor, whatever the lights.
 */
export function withoutLighting(appearance: AppearanceDescription, hasVertexColors: boolean): AppearanceDescription {
  const { material } = appearance;
  const textures = appearance.textures.filter(({ role }) => role === "color");
  const isColored = textures.length > 0 || hasVertexColors || appearance.colorMap !== undefined;
  const emissiveColor = isColored ? ([1, 1, 1] as const) : material.emissiveColor;
  return {
    ...appearance,
    textures,
    material: { kind: "unlit", emissiveColor, transparency: material.transparency },
  };
}

/** The extensions of a PhysicalMaterial. */
function extensionsOf(material: SceneElement | undefined, childrenOf: ChildrenOf): SceneElement[] {
  if (material === undefined || lowerNameOf(material) !== "physicalmaterial") return [];
  return childrenOf(material).filter((child) => entryOf(extensionTextureFields, lowerNameOf(child)));
}

/** Fields of the extension that a material lacks have their defaults. */
function readExtensions(elements: readonly SceneElement[], warnings: Warning[]): MaterialExtensions {
  const read = <Fields extends Parameters<typeof readFields>[1]>(name: string, fields: Fields) =>
    readFields(elements.find((element) => lowerNameOf(element) === name) ?? emptyElement, fields, warnings);
  return {
    ...read("anisotropymaterialextension", nodeFields.AnisotropyMaterialExtension),
    ...read("clearcoatmaterialextension", nodeFields.ClearcoatMaterialExtension),
    ...read("dispersionmaterialextension", nodeFields.DispersionMaterialExtension),
    ...read("iormaterialextension", nodeFields.IORMaterialExtension),
    ...read("iridescencematerialextension", nodeFields.IridescenceMaterialExtension),
    ...read("sheenmaterialextension", nodeFields.SheenMaterialExtension),
    ...read("specularmaterialextension", nodeFields.SpecularMaterialExtension),
    ...read("transmissionmaterialextension", nodeFields.TransmissionMaterialExtension),
    ...read("volumematerialextension", nodeFields.VolumeMaterialExtension),
  };
}

function readPhysical(element: SceneElement, childrenOf: ChildrenOf, warnings: Warning[]): MaterialDescription {
  const fields = readFields(element, nodeFields.PhysicalMaterial, warnings);
  const isStrength = (extension: SceneElement) => lowerNameOf(extension) === "emissivestrengthmaterialextension";
  const extensions = extensionsOf(element, childrenOf);
  const strength = extensions.find(isStrength);
  const { emissiveStrength } = readFields(
    strength ?? emptyElement,
    nodeFields.EmissiveStrengthMaterialExtension,
    warnings,
  );
  const [red, green, blue] = fields.emissiveColor;
  return {
    kind: "physical",
    ...fields,
    emissiveColor: [red * emissiveStrength, green * emissiveStrength, blue * emissiveStrength],
    ...(extensions.some((extension) => !isStrength(extension)) && {
      extensions: readExtensions(extensions, warnings),
    }),
  };
}

function readMaterial(
  element: SceneElement | undefined,
  childrenOf: ChildrenOf,
  warnings: Warning[],
): MaterialDescription {
  switch (element && lowerNameOf(element)) {
    case "physicalmaterial":
      return readPhysical(element ?? emptyElement, childrenOf, warnings);
    case "unlitmaterial":
      return { kind: "unlit", ...readFields(element ?? emptyElement, nodeFields.UnlitMaterial, warnings) };
    case "material":
      return { kind: "phong", ...readFields(element ?? emptyElement, nodeFields.Material, warnings) };
    // Without a material there is no lighting (ISO/IEC 19775-1, 17.2.2.2): white, a texture, or vertex colors are
    // displayed.
    default:
      return { kind: "unlit", ...readFields(emptyElement, nodeFields.UnlitMaterial, warnings) };
  }
}

const automaticAlpha: AlphaDescription = { mode: "AUTO", cutoff: 0.5 };

function readAlpha(element: SceneElement, warnings: Warning[]): AlphaDescription {
  const { alphaMode, alphaCutoff } = readFields(element, nodeFields.Appearance, warnings);
  const mode = (["AUTO", "OPAQUE", "MASK", "BLEND"] as const).find((known) => known === alphaMode.trim().toUpperCase());
  return { mode: mode ?? "AUTO", cutoff: alphaCutoff };
}

/**
 * Replaces a MultiTexture by its first texture and its first cube map: X3D 4 has the materials' texture fields instead.
 * Other elements stay.
 */
function texturesFor(child: SceneElement, childrenOf: ChildrenOf, warnings: Warning[]): readonly SceneElement[] {
  if (lowerNameOf(child) !== "multitexture") return [child];
  const children = childrenOf(child);
  const used = [...children.filter(isTexture).slice(0, 1), ...children.filter(isCubeMap).slice(0, 1)];
  const shown = used.length < 2 ? "the first texture" : "the first texture and the first cube map";
  if (used.length < 2 || used.length < children.length)
    warnings.push({ element: child, message: `only ${shown} of a <MultiTexture> is shown` });
  return used;
}

/** The cube map in the field of the main color; warns of others. */
function readAppearanceCubeMap(
  children: readonly SceneElement[],
  material: SceneElement | undefined,
  childrenOf: ChildrenOf,
  warnings: Warning[],
): AppearanceDescription["cubeMap"] {
  const colorField = textureFields[material ? lowerNameOf(material) : "material"]?.color ?? "";
  const all = [...(material ? childrenOf(material) : []), ...children].filter(isCubeMap);
  const isUsed = (texture: SceneElement) => ["", "texture", colorField.toLowerCase()].includes(fieldOf(texture));
  const used = all.find(isUsed);
  for (const other of all)
    if (other !== used)
      warnings.push({ element: other, message: "is drawn as texture of the main color only, one for each shape" });
  const map = used && readCubeMap(used, childrenOf, warnings);
  return map && { ...map, direction: "reflection" };
}

/** Textures are in the material's fields (X3D 4); the color texture may be the Appearance's (X3D 3). */
function readTextures(
  children: readonly SceneElement[],
  material: SceneElement | undefined,
  fieldsByName: Readonly<Record<string, TextureFields>>,
  childrenOf: ChildrenOf,
  warnings: Warning[],
): TextureDescription[] {
  const materialTextures = material ? childrenOf(material).filter(isTexture) : [];
  const fields = fieldsByName[material ? lowerNameOf(material) : "material"] ?? {};
  return textureRoles.flatMap((role) => {
    const field = fields[role];
    if (field === undefined) return [];
    const isOfField = (texture: SceneElement) => fieldOf(texture) === field.toLowerCase();
    const materialTexture = materialTextures.find(isOfField);
    const element =
      materialTexture ??
      (role === "color"
        ? children.find((child) => isTexture(child) && (["", "texture"].includes(fieldOf(child)) || isOfField(child)))
        : undefined);
    const mapping = materialTexture && material ? (attributeOf(material, `${field}Mapping`) ?? "") : "";
    return element
      ? readTexture(
          role,
          element,
          mapping,
          matrixOf(transformFor(mapping, children, childrenOf), warnings),
          childrenOf,
          warnings,
        )
      : [];
  });
}

function readTexture(
  role: TextureRole,
  element: SceneElement,
  mapping: string,
  transform: TextureDescription["transform"],
  childrenOf: ChildrenOf,
  warnings: Warning[],
): TextureDescription[] {
  const image = readImageOf(element, childrenOf, warnings);
  if (image === undefined) return [];
  return [
    {
      ...image,
      role,
      sampling: { ...image.sampling, isData: !colorRoles.includes(role) },
      transform,
      mapping,
      texCoordSet: 0,
    },
  ];
}

/**
 * The appearance with the sets of texture coordinates that the mappings of its textures name. A mapping is the name of
 * a set, or this name, a dot and the role of the texture, where it also names a transform. Other mappings stand for the
 * first set. With images of groups of levels of detail, the color texture has the set `chips`.
 */
export function withTexCoordSets(
  appearance: AppearanceDescription,
  names: readonly string[] = [],
  chips?: number,
): AppearanceDescription {
  const setOf = ({ mapping, role }: TextureDescription) =>
    chips !== undefined && role === "color"
      ? chips
      : Math.max(
          0,
          names.findIndex((name) => mapping === name || mapping === `${name}.${role}`),
        );
  if (appearance.textures.every((texture) => setOf(texture) === texture.texCoordSet)) return appearance;
  return {
    ...appearance,
    textures: appearance.textures.map((texture) => ({ ...texture, texCoordSet: setOf(texture) })),
  };
}

function transformFor(
  mapping: string,
  children: readonly SceneElement[],
  childrenOf: ChildrenOf,
): SceneElement | undefined {
  const all = children
    .flatMap((child) => (lowerNameOf(child) === "multitexturetransform" ? childrenOf(child) : [child]))
    .filter((child) => lowerNameOf(child) === "texturetransform");
  return (
    all.find((child) => mapping !== "" && attributeOf(child, "mapping") === mapping) ??
    all.find((child) => (attributeOf(child, "mapping") ?? "") === "")
  );
}

const identity = [1, 0, 0, 0, 1, 0, 0, 0, 1] as const;

/** X3D's -C S R C T (ISO/IEC 19775-1, 18.4.8), in column-major order: the rightmost factor applies first. */
function matrixOf(element: SceneElement | undefined, warnings: Warning[]): TextureDescription["transform"] {
  if (element === undefined) return identity;
  const {
    translation,
    rotation,
    scale,
    center: [cx, cy],
  } = readFields(element, nodeFields.TextureTransform, warnings);
  const [cos, sin] = [Math.cos(rotation), Math.sin(rotation)];
  const [a, b, c, d] = [scale[0] * cos, scale[1] * sin, -scale[0] * sin, scale[1] * cos];
  const [x, y] = [translation[0] + cx, translation[1] + cy];
  return [a, b, 0, c, d, 0, a * x + c * y - cx, b * x + d * y - cy, 1];
}

function readPoints(element: SceneElement, warnings: Warning[]): PointDescription {
  const { pointSizeScaleFactor, pointSizeMinValue, pointSizeMaxValue, attenuation } = readFields(
    element,
    nodeFields.PointProperties,
    warnings,
  );
  return {
    size: pointSizeScaleFactor,
    minSize: pointSizeMinValue ?? 0,
    maxSize: pointSizeMaxValue ?? Infinity,
    attenuation,
  };
}
