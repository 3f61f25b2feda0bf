// A Shape -> what it is, for itself: what groups around it hand down is not in it.

import { colorMapOf, withValues } from "./attributes.ts";
import { readAppearance } from "./appearance.ts";
import type { Box3, GeometryDescription, ShapeDescription } from "./description.ts";
import type { SceneElement } from "./element.ts";
import { attributeOf, childrenOf, inPlaceOf, lowerNameOf } from "./element.ts";
import type { Vec3 } from "./fieldTypes.ts";
import { boxAround, boxOf, isUnbounded, readBinaryGeometry, readImageGeometry } from "./geometry.ts";
import type { GeometryCache, Lookup } from "./geometryCache.ts";
import type { InlineGeometryReader } from "./inlineGeometry.ts";
import type { TextReader } from "./textReader.ts";
import type { Warning } from "./nodes.ts";
import { nodeFields, readFields } from "./nodes.ts";

/** What reading a shape needs besides its element. */
export interface ShapeReading {
  readonly geometries: GeometryCache;
  readonly lookup: Lookup;
  readonly warnings: Warning[];
  /** Undefined: nothing is seen of what stands in the document. */
  readonly inlineGeometry: InlineGeometryReader | undefined;
  /** Undefined: nothing is seen of texts. */
  readonly text: TextReader | undefined;
  /** Says that the shape is read again when this element of it is touched, in whatever document that stands. */
  readonly listen: (element: SceneElement) => void;
}

/** `element` is the shape's identity, `host` the page's element for it, `node` what describes it: the same but for USE. */
export function readShape(
  element: SceneElement,
  host: SceneElement,
  node: SceneElement,
  reading: ShapeReading,
): ShapeDescription {
  const { warnings } = reading;
  const values = readFields(node, nodeFields.Shape, warnings);
  const parts = childrenOf(node);
  const ownBox = boxOf(values);
  const [geometry, priorityOfGeometry] = readGeometryOf(parts, reading, ownBox, values.colorBy);
  const nodesIn = (part: SceneElement) =>
    childrenOf(part).flatMap((child) => {
      const used = usedBy(child, reading);
      return used === undefined ? [] : [inPlaceOf(child, used)];
    });
  const appearance = firstOf(parts, reading, (part) => (lowerNameOf(part) === "appearance" ? part : undefined));
  const isSeen = values.visible && values.render;
  const look = readAppearance(appearance, colorMapOf(node, values, geometry, warnings), nodesIn, warnings);
  return {
    kind: "shape",
    element,
    geometry,
    host,
    isUnread: geometry === undefined && parts.some(isGeometry),
    visible: isSeen,
    contributesToBounds: isSeen,
    priority: values.priority * priorityOfGeometry,
    isPickable: values.isPickable,
    box: ownBox ?? (geometry && boxOfGeometry(geometry)),
    appearance:
      geometry?.glyphAtlas === undefined || reading.text === undefined
        ? look
        : reading.text.appearanceOf(look, geometry.glyphAtlas, node, warnings),
  };
}

/** The geometry of a shape that has these parts, with its priority: beside it, as with another it is the same geometry. */
function readGeometryOf(
  parts: readonly SceneElement[],
  reading: ShapeReading,
  box: Box3 | undefined,
  colorBy: string,
): readonly [geometry: GeometryDescription | undefined, priority: number] {
  const { geometries, lookup, warnings } = reading;
  const found = firstOf(parts, reading, (part) => {
    if (lowerNameOf(part) === "text") reading.listen(part);
    const geometry = geometries.recall(part, lookup, warnings, (...of) => readGeometry(reading, ...of));
    return geometry && { part, geometry };
  });
  if (found === undefined) return [undefined, 1];
  const { priority } = readFields(found.part, { priority: nodeFields.ImageGeometry.priority }, []);
  const boxed =
    box === undefined
      ? found.geometry
      : geometries.variant(found.geometry, JSON.stringify(box), (plain) => withBox(plain, box));
  return [colorBy === "" ? boxed : geometries.variant(boxed, colorBy, (plain) => withValues(plain, colorBy)), priority];
}

const geometryReaders: Readonly<Record<string, typeof readImageGeometry>> = {
  imagegeometry: readImageGeometry,
  binarygeometry: readBinaryGeometry,
};

/** Undefined for what is no geometry. */
function readGeometry(
  { geometries, inlineGeometry, text }: ShapeReading,
  element: SceneElement,
  lookup: Lookup,
  warnings: Warning[],
): GeometryDescription | undefined {
  const resolve = (part: SceneElement) => {
    const name = attributeOf(part, "USE");
    return name === undefined ? part : lookup(name);
  };
  const name = lowerNameOf(element);
  if (name === "text") return text?.geometryOf(element, resolve, warnings);
  const ofFiles = geometryReaders[name]?.(element, warnings);
  return ofFiles ? geometries.intern(ofFiles) : inlineGeometry?.(element, resolve, warnings);
}

/** As far as can be said without reading it: nothing else stands in shapes. */
function isGeometry(part: SceneElement): boolean {
  const name = lowerNameOf(part);
  return name !== "appearance" && !name.startsWith("metadata");
}

/** The shape's box is that of a geometry's only patch which says nothing of its own. */
function withBox(geometry: GeometryDescription, box: Box3): GeometryDescription | undefined {
  const [patch, ...others] = geometry.patches;
  if (!patch || patch.box || others.length > 0) return undefined;
  return { ...geometry, patches: [{ ...patch, box }] };
}

/** The element, or what its USE names; undefined where that is nothing. */
function usedBy(element: SceneElement, { lookup, warnings }: ShapeReading): SceneElement | undefined {
  const name = attributeOf(element, "USE");
  if (name === undefined) return element;
  const node = lookup(name);
  if (node === undefined) warnings.push({ element, message: `USE="${name}" names no DEF of this scene` });
  return node;
}

function firstOf<Result>(
  elements: readonly SceneElement[],
  reading: ShapeReading,
  read: (element: SceneElement) => Result | undefined,
): Result | undefined {
  for (const element of elements) {
    const used = usedBy(element, reading);
    const result = used && read(used);
    if (result !== undefined) return result;
  }
  return undefined;
}

/** The union of the patches' boxes; undefined where only vertices can tell; the decode box, which holds them all, where one of them has none. */
function boxOfGeometry(geometry: GeometryDescription): Box3 | undefined {
  if (geometry.patches.some((patch) => isUnbounded(geometry, patch))) return undefined;
  const boxes = geometry.patches.map((patch) => patch.box);
  const known = boxes.filter((box) => box !== undefined);
  if (known.length === 0 || known.length < boxes.length) return boxAround(geometry.position, geometry.size);
  const along = (pick: (box: Box3) => Vec3, choose: (...values: number[]) => number): Vec3 =>
    [0, 1, 2].map((axis) => choose(...known.map((box) => pick(box)[axis] ?? 0))) as unknown as Vec3;
  return { min: along((box) => box.min, Math.min), max: along((box) => box.max, Math.max) };
}
