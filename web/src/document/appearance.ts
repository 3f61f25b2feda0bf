// Appearance -> what a shape looks like. A texture of the main colour is read from
// where X3D has it since version 3, the Appearance, or from the material's own
// field; of the other textures of X3D 4 we show none.

import type {
  AlphaDescription, AppearanceDescription, MaterialDescription, PointDescription, SamplingDescription, TextureDescription, Warning,
  WrapMode,
} from "./description.ts";
import type { SceneElement } from "./element.ts";
import { attributeOf, lowerNameOf } from "./element.ts";
import { nodeFields, readFields } from "./nodes.ts";

/** The children of an element, with what they USE in their place. */
export type ChildrenOf = (element: SceneElement) => readonly SceneElement[];

/** By the material's name, the field that a texture of its main colour is in. */
const colorFields: Readonly<Record<string, string>> = {
  material: "diffuseTexture", physicalmaterial: "baseTexture", unlitmaterial: "emissiveTexture",
};

export function readAppearance(element: SceneElement | undefined, childrenOf: ChildrenOf, warnings: Warning[]): AppearanceDescription {
  const parts = element === undefined ? [] : childrenOf(element);
  const named = (name: string) => parts.find((part) => lowerNameOf(part) === name);
  const material = parts.find((part) => lowerNameOf(part) in colorFields);
  const points = named("pointproperties");
  return {
    material: readMaterial(material, warnings),
    alpha: element ? readAlpha(element, warnings) : automaticAlpha,
    texture: readColorTexture(parts, material, childrenOf, warnings),
    points: points && readPoints(points, warnings),
  };
}

function readMaterial(element: SceneElement | undefined, warnings: Warning[]): MaterialDescription {
  switch (element && lowerNameOf(element)) {
    case "physicalmaterial": return { kind: "physical", ...readFields(element ?? nothing, nodeFields.PhysicalMaterial, warnings) };
    case "unlitmaterial": return { kind: "unlit", ...readFields(element ?? nothing, nodeFields.UnlitMaterial, warnings) };
    case "material": return { kind: "phong", ...readFields(element ?? nothing, nodeFields.Material, warnings) };
    // Without a material no light counts (ISO/IEC 19775-1, 17.2.2.2): what is seen is white, a texture, or colours.
    default: return { kind: "unlit", ...readFields(nothing, nodeFields.UnlitMaterial, warnings) };
  }
}

const nothing: SceneElement = { localName: "", children: [], getAttribute: () => null, getAttributeNames: () => [] };

const automaticAlpha: AlphaDescription = { mode: "AUTO", cutoff: 0.5 };

function readAlpha(element: SceneElement, warnings: Warning[]): AlphaDescription {
  const { alphaMode, alphaCutoff } = readFields(element, nodeFields.Appearance, warnings);
  const mode = (["AUTO", "OPAQUE", "MASK", "BLEND"] as const).find((known) => known === alphaMode.trim().toUpperCase());
  return { mode: mode ?? "AUTO", cutoff: alphaCutoff };
}

function readColorTexture(parts: readonly SceneElement[], material: SceneElement | undefined, childrenOf: ChildrenOf,
                          warnings: Warning[]): TextureDescription | undefined {
  const field = colorFields[material ? lowerNameOf(material) : ""] ?? "";
  const fieldOf = (texture: SceneElement) => attributeOf(texture, "containerField")?.toLowerCase() ?? "";
  const isTexture = (part: SceneElement) => lowerNameOf(part) === "imagetexture";
  const inMaterial = material && childrenOf(material).find((part) => isTexture(part) && fieldOf(part) === field.toLowerCase());
  const element = inMaterial ?? parts.find((part) => isTexture(part) && ["", "texture", field.toLowerCase()].includes(fieldOf(part)));
  if (element === undefined) return undefined;
  const { url, repeatS, repeatT } = readFields(element, nodeFields.ImageTexture, warnings);
  const [first] = url;
  if (first === undefined) return undefined;
  const properties = childrenOf(element).find((part) => lowerNameOf(part) === "textureproperties");
  const mapping = inMaterial ? attributeOf(material, `${field}Mapping`) ?? "" : "";
  return {
    url: first,
    sampling: samplingOf(properties, repeatS, repeatT, warnings),
    transform: matrixOf(transformFor(mapping, parts, childrenOf), warnings),
  };
}

function samplingOf(element: SceneElement | undefined, repeatS: boolean, repeatT: boolean, warnings: Warning[]): SamplingDescription {
  const wrap = (repeats: boolean): WrapMode => (repeats ? "repeat" : "clamp");
  if (element === undefined) return { wrapS: wrap(repeatS), wrapT: wrap(repeatT), isSmooth: true, hasMipmaps: true, anisotropy: 1 };
  const values = readFields(element, nodeFields.TextureProperties, warnings);
  const isNearest = (filter: string) => /^(NEAREST|FASTEST)/i.test(filter.trim());
  return {
    wrapS: wrapOf(values.boundaryModeS), wrapT: wrapOf(values.boundaryModeT),
    isSmooth: !isNearest(values.magnificationFilter),
    // A picture that is seen small without them glitters: only who asks for it gets that.
    hasMipmaps: !/^(NEAREST|AVG|AVG_PIXEL|FASTEST|NEAREST_PIXEL)$/i.test(values.minificationFilter.trim()),
    anisotropy: Math.max(1, values.anisotropicDegree),
  };
}

function wrapOf(mode: string): WrapMode {
  const word = mode.trim().toUpperCase();
  return word.startsWith("CLAMP") ? "clamp" : word === "MIRRORED_REPEAT" ? "mirror" : "repeat";
}

function transformFor(mapping: string, parts: readonly SceneElement[], childrenOf: ChildrenOf): SceneElement | undefined {
  const all = parts.flatMap((part) => (lowerNameOf(part) === "multitexturetransform" ? childrenOf(part) : [part]))
    .filter((part) => lowerNameOf(part) === "texturetransform");
  return all.find((part) => mapping !== "" && attributeOf(part, "mapping") === mapping) ?? all.find((part) => (attributeOf(part, "mapping") ?? "") === "");
}

const identity = [1, 0, 0, 0, 1, 0, 0, 0, 1] as const;

/** X3D's -C S R C T (ISO/IEC 19775-1, 18.4.8), column by column: what is applied first stands last. */
function matrixOf(element: SceneElement | undefined, warnings: Warning[]): TextureDescription["transform"] {
  if (element === undefined) return identity;
  const { translation, rotation, scale, center: [cx, cy] } = readFields(element, nodeFields.TextureTransform, warnings);
  const [cos, sin] = [Math.cos(rotation), Math.sin(rotation)];
  const [a, b, c, d] = [scale[0] * cos, scale[1] * sin, -scale[0] * sin, scale[1] * cos];
  const [x, y] = [translation[0] + cx, translation[1] + cy];
  return [a, b, 0, c, d, 0, a * x + c * y - cx, b * x + d * y - cy, 1];
}

function readPoints(element: SceneElement, warnings: Warning[]): PointDescription {
  const { pointSizeScaleFactor, pointSizeMinValue, pointSizeMaxValue, attenuation } = readFields(element, nodeFields.PointProperties, warnings);
  return { size: pointSizeScaleFactor, least: pointSizeMinValue ?? 0, most: pointSizeMaxValue ?? Infinity, attenuation };
}
