// Custom vertex attributes (FloatVertexAttribute), and the attribute whose values shaders read: `colorBy` names the one
// that colors a shape, whose values a color map maps to colors; otherwise it is the depth in fog.

import type {
  AppearanceDescription,
  AttributeDescription,
  ColorMapDescription,
  Encoding,
  GeometryDescription,
  PatchDescription,
  Reference,
  ValueUse,
  Vec2,
} from "./description.ts";
import { fogDepthName } from "./description.ts";
import { encodingFormats } from "./encodings.ts";
import type { SceneElement } from "./element.ts";
import { checkCounts } from "./geometryChecks.ts";
import { UnreadableGeometry } from "./unreadableGeometry.ts";
import { childrenOf, lowerNameOf } from "./element.ts";
import type { Values, Warning } from "./nodes.ts";
import { nodeFields, readFields } from "./nodes.ts";

/** Throws UnreadableGeometry for an attribute without a name, or with numbers that no file can hold. */
export function readAttributes(element: SceneElement, encoding: Encoding, warnings: Warning[]): AttributeDescription[] {
  const elements = childrenOf(element).filter((child) => lowerNameOf(child) === "floatvertexattribute");
  const names = new Set<string>();
  return elements.map((child) => {
    const { name, numComponents, valueBits, valueMin, valueSize } = readFields(
      child,
      nodeFields.FloatVertexAttribute,
      warnings,
    );
    checkCounts({ numComponents, valueBits });
    const components = ([1, 2, 3, 4] as const).find((count) => count === numComponents);
    const bits = encodingFormats[encoding].attributeBits(valueBits);
    const fileCount = encodingFormats[encoding].attributeFileCount(valueBits);
    if (name === "") throw new UnreadableGeometry("an attribute has no name");
    if (names.has(name)) throw new UnreadableGeometry("a geometry has two attributes of one name");
    names.add(name);
    if (components === undefined) throw new UnreadableGeometry("numComponents is none of 1 to 4");
    if (bits !== undefined && ![8, 16, 24].includes(bits))
      throw new UnreadableGeometry("valueBits is none of 8, 16 and 24");
    const perComponent = (values: readonly number[], missing: number) =>
      values.length > 0 ? values : Array.from({ length: components }, () => missing);
    const [min, size] = [perComponent(valueMin, 0), perComponent(valueSize, 1)];
    const isRange = (extent: number, c: number) => extent >= 0 && Math.abs(min[c] ?? 0) + extent <= maxFloat;
    if (min.length !== components || size.length !== components || !size.every(isRange))
      throw new UnreadableGeometry("valueMin and valueSize are no range of numbers");
    return { name, components, fileCount, bits, min, size };
  });
}

/** The largest number of single precision, X3D's. */
const maxFloat = 3.4028234663852886e38;

/** Throws UnreadableGeometry where a patch names other files than its attributes need. */
export function checkAttributeFiles(
  { attributes: files }: PatchDescription,
  attributes: readonly AttributeDescription[],
): void {
  const needed = attributes.reduce((sum, { fileCount }) => sum + fileCount, 0);
  if (files.length !== needed)
    throw new UnreadableGeometry(
      `attrib names ${files.length < needed ? "fewer" : "more"} files than the attributes need`,
    );
}

/** The files of one attribute among a patch's attribute files. */
export function filesOf(
  attributes: readonly AttributeDescription[],
  attribute: AttributeDescription,
  references: readonly Reference[],
): readonly Reference[] {
  const first = attributes.slice(0, attributes.indexOf(attribute)).reduce((sum, { fileCount }) => sum + fileCount, 0);
  return references.slice(first, first + attribute.fileCount);
}

/** The geometry with the values of a named attribute; undefined where it has no such attribute. */
export function withValues(
  geometry: GeometryDescription,
  name: string,
  use: ValueUse,
): GeometryDescription | undefined {
  const value = geometry.attributes.find((attribute) => attribute.name === name);
  if (value === undefined) return undefined;
  const patches = geometry.patches.map((patch) => ({
    ...patch,
    value: filesOf(geometry.attributes, value, patch.attributes),
  }));
  return { ...geometry, value, valueUse: use, patches };
}

/** The range of an attribute's values; for several components the range of their length. */
export function rangeOf({ components, min, size }: Pick<AttributeDescription, "components" | "min" | "size">): Vec2 {
  const low = min[0] ?? 0;
  if (components === 1) return [low, low + (size[0] ?? 0)];
  return [0, Math.hypot(...min.map((lowest, c) => Math.max(Math.abs(lowest), Math.abs(lowest + (size[c] ?? 0)))))];
}

export function colorMapOf(
  element: SceneElement,
  values: Values<typeof nodeFields.Shape>,
  geometry: GeometryDescription | undefined,
  warnings: Warning[],
): ColorMapDescription | undefined {
  if (values.colorBy === "") return undefined;
  if (geometry?.value === undefined) {
    if (geometry !== undefined)
      warnings.push({ element, message: `colorBy="${values.colorBy}" is no attribute of the geometry` });
    return undefined;
  }
  if (geometry.attributes.some(({ name }) => name === fogDepthName && name !== values.colorBy))
    warnings.push({ element, message: `colorBy="${values.colorBy}": its fog depends on the distance from the viewer` });
  const colors = values.colorMap;
  if (values.colorRange !== undefined) return { colors, range: values.colorRange };
  const isRangeStreamed = geometry.encoding === "live" || geometry.sequence !== undefined;
  return { colors, range: rangeOf(geometry.value), ...(isRangeStreamed && { isRangeStreamed }) };
}

/** The appearance of a geometry with streamed values: without a stated `colorRange` the stream states the range. */
export function withStreamedRange(
  appearance: AppearanceDescription,
  { value }: Pick<GeometryDescription, "value">,
): AppearanceDescription {
  const { colorMap } = appearance;
  if (colorMap?.isRangeStreamed !== true || value?.streamedRange === undefined) return appearance;
  return { ...appearance, colorMap: { ...colorMap, range: value.streamedRange } };
}
