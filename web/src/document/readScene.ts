// An <X3D> element -> SceneDescription. Unknown nodes are passed over with their
// children, as a browser passes over unknown tags; what they hold still counts.

import type {
  BackgroundDescription, Box3, GeometryDescription, GroupDescription, InlineDescription, NavigationDescription, NodeDescription,
  SceneDescription, ShapeDescription, TransformDescription,
} from "./description.ts";
import { colorMapOf } from "./attributes.ts";
import { readAppearance } from "./appearance.ts";
import type { SceneElement } from "./element.ts";
import { attributeOf, childrenOf, inPlaceOf, lowerNameOf } from "./element.ts";
import type { Vec3 } from "./fieldTypes.ts";
import { boxAround, boxOf, isUnbounded, readBinaryGeometry, readImageGeometry } from "./geometry.ts";
import { GeometryMemory } from "./geometryMemory.ts";
import { readInlineGeometry } from "./inlineGeometry.ts";
import type { Warning } from "./nodes.ts";
import { nodeFields, readFields } from "./nodes.ts";
import { asViewpoint } from "./orthoViewpoint.ts";

/** A document that an Inline shows. */
export interface InlinedDocument {
  readonly url: string;
  /** Its <X3D>; the urls in it are absolute. */
  readonly x3d: SceneElement;
}

/** What a scene shows beyond what its own elements say. */
export interface Supplements {
  /** Undefined while it is not here. */
  readonly inlined?: (inline: SceneElement) => InlinedDocument | undefined;
  /** The level of a LOD; undefined while nobody knows how far it is. */
  readonly levelOf?: (lod: SceneElement) => number | undefined;
}

/** Documents that inline one another deeper than this are no scene. */
const mostInlineDepth = 16;

/** What is collected on the way through the tree. */
interface Reading {
  readonly geometries: GeometryMemory;
  readonly defined: ReadonlyMap<string, SceneElement>;
  /** Elements whose USE is being followed, so that a circle of them ends. */
  readonly following: Set<SceneElement>;
  readonly warnings: Warning[];
  readonly inlines: InlineDescription[];
  readonly supplements: Supplements;
  /** The documents that this one is inlined by, outermost first. */
  readonly inlinedBy: readonly InlinedDocument[];
  readonly host: SceneElement | undefined;
  navigation: NavigationDescription | undefined;
  background: BackgroundDescription | undefined;
}

/** What groups hand down to what stands in them. */
interface Inherited {
  readonly visible: boolean;
  /** The same, but that every level of a LOD is seen. */
  readonly reaches: boolean;
  readonly priority: number;
}

/** With the same `geometries` as before, geometries that have not changed are the same objects. */
export function readScene(x3d: SceneElement, geometries = new GeometryMemory(), supplements: Supplements = {}): SceneDescription {
  const reading: Reading = {
    geometries, defined: definedIn(x3d), following: new Set(), warnings: [],
    inlines: [], supplements, inlinedBy: [], host: undefined,
    navigation: undefined, background: undefined,
  };
  const root: GroupDescription = {
    kind: "group", visible: true, box: undefined, transform: undefined, children: readChildren(x3d, reading, { visible: true, reaches: true, priority: 1 }),
  };
  const { background, inlines, warnings } = reading;
  const navigation = reading.navigation ?? readFields(withoutAttributes, nodeFields.NavigationInfo, warnings);
  const { chunkPriority } = readFields(x3d, nodeFields.X3D, warnings);
  return { root, navigation, background, chunkPriority, inlines, warnings };
}

function definedIn(element: SceneElement, defined = new Map<string, SceneElement>()): Map<string, SceneElement> {
  const name = attributeOf(element, "DEF");
  if (name !== undefined && !defined.has(name)) defined.set(name, element);
  for (const child of childrenOf(element)) definedIn(child, defined);
  return defined;
}

function readChildren(element: SceneElement, reading: Reading, inherited: Inherited): NodeDescription[] {
  return childrenOf(element).flatMap((child) => readNode(child, reading, inherited));
}

function readNode(element: SceneElement, reading: Reading, inherited: Inherited): NodeDescription[] {
  return withUse(element, reading, [], (node) => {
    const { warnings } = reading;
    switch (lowerNameOf(node)) {
      case "shape":
        return [readShape(element, node, reading, inherited)];
      case "group":
        return [readGroup(node, readFields(node, nodeFields.Group, warnings), reading, inherited)];
      case "transform": {
        const transform = readFields(node, nodeFields.Transform, warnings);
        return [readGroup(node, transform, reading, inherited, transform)];
      }
      case "switch":
        return [readSwitch(node, reading, inherited)];
      case "lod":
        return [readLevels(node, reading, inherited)];
      case "inline":
        return [readInline(element, node, reading, inherited)];
      case "directionallight":
        return [{ kind: "light", light: { kind: "directional", ...readFields(node, nodeFields.DirectionalLight, warnings) } }];
      case "pointlight":
        return [{ kind: "light", light: { kind: "point", ...readFields(node, nodeFields.PointLight, warnings) } }];
      case "spotlight":
        return [{ kind: "light", light: { kind: "spot", ...readFields(node, nodeFields.SpotLight, warnings) } }];
      case "viewpoint":
        return [{ kind: "viewpoint", element, viewpoint: readFields(node, nodeFields.Viewpoint, warnings) }];
      case "orthoviewpoint":
        return [{ kind: "viewpoint", element, viewpoint: asViewpoint(readFields(node, nodeFields.OrthoViewpoint, warnings)) }];
      case "navigationinfo": {
        const navigation = readFields(node, nodeFields.NavigationInfo, warnings);
        if (reading.navigation === undefined || navigation.set_bind || navigation.bind) reading.navigation = navigation;
        return [];
      }
      case "background":
        reading.background ??= readBackground(node, warnings);
        return [];
      default:
        return readChildren(node, reading, inherited);
    }
  });
}

function readBackground(node: SceneElement, warnings: Warning[]): BackgroundDescription {
  const { skyColor, skyAngle, groundColor, groundAngle } = readFields(node, nodeFields.Background, warnings);
  // The first colour is at the pole, each further one at its angle.
  const rings = (colors: readonly Vec3[], angles: readonly number[]) =>
    colors.slice(0, angles.length + 1).map((color, i) => ({ color, angle: i === 0 ? 0 : angles[i - 1] ?? 0 }));
  return { sky: rings(skyColor.length > 0 ? skyColor : [[0, 0, 0]], skyAngle), ground: rings(groundColor, groundAngle) };
}

interface GroupFields {
  readonly visible: boolean;
  readonly render: boolean;
  readonly priority: number;
  readonly bboxCenter: Vec3;
  readonly bboxSize: Vec3;
}

function isSeen({ visible, render }: Pick<GroupFields, "visible" | "render">): boolean {
  return visible && render;
}

/** What a node with these fields hands down. */
function within(fields: GroupFields, inherited: Inherited): Inherited {
  const seen = isSeen(fields);
  return { visible: inherited.visible && seen, reaches: inherited.reaches && seen, priority: inherited.priority * fields.priority };
}

function readGroup(node: SceneElement, fields: GroupFields, reading: Reading, inherited: Inherited,
                   transform?: TransformDescription): GroupDescription {
  return { kind: "group", visible: isSeen(fields), box: boxOf(fields), transform, children: readChildren(node, reading, within(fields, inherited)) };
}

/** One of its children is seen, or none; the others stay in the scene, so that choosing them shows at once what they have. */
function readSwitch(node: SceneElement, reading: Reading, inherited: Inherited): GroupDescription {
  const fields = readFields(node, nodeFields.Switch, reading.warnings);
  return readChoice(choicesIn(node), fields.whichChoice, false, fields, reading, inherited);
}

/** Children that are no nodes of their own are none of the choices. */
function choicesIn(node: SceneElement): SceneElement[] {
  return childrenOf(node).filter((child) => !lowerNameOf(child).startsWith("metadata"));
}

/** `allReach`: the scene reaches as far as those that are not chosen. */
function readChoice(nodes: readonly SceneElement[], choice: number, allReach: boolean, fields: GroupFields, reading: Reading,
                    inherited: Inherited): GroupDescription {
  const children = nodes.map((child, place): GroupDescription => {
    const visible = place === choice;
    const own = within(fields, { ...inherited, visible: inherited.visible && visible, reaches: inherited.reaches && (visible || allReach) });
    return { kind: "group", box: undefined, visible, transform: undefined, children: readNode(child, reading, own) };
  });
  return { kind: "group", box: undefined, visible: isSeen(fields), transform: undefined, children };
}

/** A choice that the distance makes. Until it is known the last level is seen, which asks for least. */
function readLevels(node: SceneElement, reading: Reading, inherited: Inherited): GroupDescription {
  const fields = readFields(node, nodeFields.LOD, reading.warnings);
  const nodes = choicesIn(node);
  const last = nodes.length - 1;
  const level = Math.min(reading.supplements.levelOf?.(node) ?? last, last);
  const { center, range } = fields;
  return { ...readChoice(nodes, level, true, fields, reading, inherited), levels: { element: node, center, range, count: nodes.length } };
}

/** The document stands where the Inline does, with names of its own; what it says of the whole scene counts for nothing. */
function readInline(element: SceneElement, node: SceneElement, reading: Reading, inherited: Inherited): GroupDescription {
  const { load, url, ...fields } = readFields(node, nodeFields.Inline, reading.warnings);
  const inner = within(fields, inherited);
  if (load && url.length > 0) reading.inlines.push({ element: node, urls: url, visible: inner.visible, priority: inner.priority });
  const found = load ? reading.supplements.inlined?.(node) : undefined;
  const problem = found && problemWith(found, reading);
  if (problem !== undefined) reading.warnings.push({ element, message: problem });
  const children = found === undefined || problem !== undefined ? [] : readChildren(found.x3d, {
    ...reading, defined: definedIn(found.x3d), inlinedBy: [...reading.inlinedBy, found], host: reading.host ?? element,
    navigation: undefined, background: undefined,
  }, inner);
  return { kind: "group", visible: isSeen(fields), box: boxOf(fields), transform: undefined, children };
}

function problemWith({ url }: InlinedDocument, { inlinedBy }: Reading): string | undefined {
  if (inlinedBy.some((outer) => outer.url === url)) return `names ${url}, which it stands in itself`;
  return inlinedBy.length >= mostInlineDepth ? `names ${url}, more than ${mostInlineDepth} documents deep` : undefined;
}

/** Reads `element`, or what its USE names; `nothing` where that leads nowhere or in a circle. */
function withUse<Result>(element: SceneElement, reading: Reading, nothing: Result,
                         read: (node: SceneElement) => Result): Result {
  const name = attributeOf(element, "USE");
  if (name === undefined) return read(element);
  const node = reading.defined.get(name);
  if (node === undefined || reading.following.has(node)) {
    reading.warnings.push({ element, message: `USE="${name}" names ${node ? "itself" : "no DEF of this scene"}` });
    return nothing;
  }
  reading.following.add(node);
  try {
    return read(node);
  } finally {
    reading.following.delete(node);
  }
}

/** `element` is the shape's identity, `node` what describes it: the same but for USE. */
function readShape(element: SceneElement, node: SceneElement, reading: Reading, inherited: Inherited): ShapeDescription {
  const values = readFields(node, nodeFields.Shape, reading.warnings);
  const parts = childrenOf(node);
  let priorityOfGeometry = 1;
  const ownBox = boxOf(values);
  const plain = first(parts, reading, (part) => {
    const read = readGeometry(part, reading, ownBox);
    // Beside the geometry, not in it: with another priority it is the same geometry.
    if (read) priorityOfGeometry = readFields(part, { priority: nodeFields.ImageGeometry.priority }, []).priority;
    return read;
  });
  const nodesIn = (part: SceneElement) => childrenOf(part).flatMap((child) => withUse(child, reading, [], (used) => [inPlaceOf(child, used)]));
  const appearance = first(parts, reading, (part) =>
    lowerNameOf(part) === "appearance" ? readAppearance(part, nodesIn, reading.warnings) : undefined);
  const geometry = plain && values.colorBy !== "" ? reading.geometries.withValues(plain, values.colorBy) : plain;
  return {
    kind: "shape", element, geometry, host: reading.host ?? element,
    colorMap: colorMapOf(node, values, geometry, reading.warnings),
    visible: inherited.visible && isSeen(values),
    reaches: inherited.reaches && isSeen(values),
    priority: inherited.priority * values.priority * priorityOfGeometry,
    isPickable: values.isPickable,
    box: ownBox ?? (geometry && boxOfGeometry(geometry)),
    appearance: appearance ?? readAppearance(undefined, nodesIn, reading.warnings),
  };
}

const geometryReaders: Readonly<Record<string, typeof readImageGeometry>> = {
  imagegeometry: readImageGeometry, binarygeometry: readBinaryGeometry,
};

/** Undefined for what is no geometry. The shape's box is that of a geometry's only patch which says nothing of its own. */
function readGeometry(element: SceneElement, { geometries, warnings, defined }: Reading, box: Box3 | undefined): GeometryDescription | undefined {
  const read = geometryReaders[lowerNameOf(element)];
  const resolve = (part: SceneElement) => {
    const name = attributeOf(part, "USE");
    return name === undefined ? part : defined.get(name);
  };
  return geometries.recall(element, () =>
    withBox(read?.(element, warnings), box) ?? readInlineGeometry(element, resolve, warnings));
}

function withBox(geometry: GeometryDescription | undefined, box: Box3 | undefined): GeometryDescription | undefined {
  const [patch, ...others] = geometry?.patches ?? [];
  if (!geometry || !patch || patch.box || others.length > 0) return geometry;
  return { ...geometry, patches: [{ ...patch, box }] };
}

const withoutAttributes: SceneElement = {
  localName: "", children: [], getAttribute: () => null, getAttributeNames: () => [],
};

function first<Result>(elements: SceneElement[], reading: Reading,
                       read: (element: SceneElement) => Result | undefined): Result | undefined {
  for (const element of elements) {
    const result = withUse(element, reading, undefined, read);
    if (result !== undefined) return result;
  }
  return undefined;
}

/** The union of the patches' boxes; undefined where only vertices can tell; the decode box, which holds them all, where one of them has none. */
function boxOfGeometry(geometry: NonNullable<ShapeDescription["geometry"]>): Box3 | undefined {
  if (geometry.patches.some((patch) => isUnbounded(geometry, patch))) return undefined;
  const boxes = geometry.patches.map((patch) => patch.box);
  const known = boxes.filter((box) => box !== undefined);
  if (known.length === 0 || known.length < boxes.length) return boxAround(geometry.position, geometry.size);
  const along = (pick: (box: Box3) => Vec3, choose: (...values: number[]) => number): Vec3 =>
    [0, 1, 2].map((axis) => choose(...known.map((box) => pick(box)[axis] ?? 0))) as unknown as Vec3;
  return { min: along((box) => box.min, Math.min), max: along((box) => box.max, Math.max) };
}
