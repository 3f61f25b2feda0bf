// An <X3D> element -> SceneDescription. Unknown nodes are passed over with their
// children, as a browser passes over unknown tags; what they hold still counts.

import type {
  Box3, GeometryDescription, GroupDescription, NavigationDescription, NodeDescription, SceneDescription, ShapeDescription,
  TransformDescription,
} from "./description.ts";
import { colorMapOf } from "./attributes.ts";
import { readAppearance } from "./appearance.ts";
import type { SceneElement } from "./element.ts";
import { attributeOf, childrenOf, lowerNameOf } from "./element.ts";
import type { Vec3 } from "./fieldTypes.ts";
import { boxAround, boxOf, isUnbounded, readBinaryGeometry, readImageGeometry } from "./geometry.ts";
import { GeometryMemory } from "./geometryMemory.ts";
import { readInlineGeometry } from "./inlineGeometry.ts";
import type { Warning } from "./nodes.ts";
import { nodeFields, readFields } from "./nodes.ts";

/** What is collected on the way through the tree. */
interface Reading {
  readonly geometries: GeometryMemory;
  readonly defined: ReadonlyMap<string, SceneElement>;
  /** Elements whose USE is being followed, so that a circle of them ends. */
  readonly following: Set<SceneElement>;
  readonly warnings: Warning[];
  navigation: NavigationDescription | undefined;
  skyColor: Vec3 | undefined;
}

/** What groups hand down to what stands in them. */
interface Inherited {
  readonly visible: boolean;
  readonly priority: number;
}

/** With the same `geometries` as before, geometries that have not changed are the same objects. */
export function readScene(x3d: SceneElement, geometries = new GeometryMemory()): SceneDescription {
  const reading: Reading = {
    geometries, defined: definedIn(x3d), following: new Set(), warnings: [],
    navigation: undefined, skyColor: undefined,
  };
  const root: GroupDescription = {
    kind: "group", visible: true, box: undefined, transform: undefined, children: readChildren(x3d, reading, { visible: true, priority: 1 }),
  };
  const { skyColor, warnings } = reading;
  const navigation = reading.navigation ?? readFields(withoutAttributes, nodeFields.NavigationInfo, warnings);
  const { chunkPriority } = readFields(x3d, nodeFields.X3D, warnings);
  return { root, navigation, skyColor, chunkPriority, warnings };
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
      case "directionallight":
        return [{ kind: "light", light: { kind: "directional", ...readFields(node, nodeFields.DirectionalLight, warnings) } }];
      case "pointlight":
        return [{ kind: "light", light: { kind: "point", ...readFields(node, nodeFields.PointLight, warnings) } }];
      case "spotlight":
        return [{ kind: "light", light: { kind: "spot", ...readFields(node, nodeFields.SpotLight, warnings) } }];
      case "viewpoint":
        return [{ kind: "viewpoint", element, viewpoint: readFields(node, nodeFields.Viewpoint, warnings) }];
      case "navigationinfo": {
        const navigation = readFields(node, nodeFields.NavigationInfo, warnings);
        if (reading.navigation === undefined || navigation.set_bind || navigation.bind) reading.navigation = navigation;
        return [];
      }
      case "background":
        reading.skyColor ??= readFields(node, nodeFields.Background, warnings).skyColor;
        return [];
      default:
        return readChildren(node, reading, inherited);
    }
  });
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
  return { visible: inherited.visible && isSeen(fields), priority: inherited.priority * fields.priority };
}

function readGroup(node: SceneElement, fields: GroupFields, reading: Reading, inherited: Inherited,
                   transform?: TransformDescription): GroupDescription {
  return { kind: "group", visible: isSeen(fields), box: boxOf(fields), transform, children: readChildren(node, reading, within(fields, inherited)) };
}

/** One of its children is seen, or none; the others stay in the scene, so that choosing them shows at once what they have. */
function readSwitch(node: SceneElement, reading: Reading, inherited: Inherited): GroupDescription {
  const fields = readFields(node, nodeFields.Switch, reading.warnings);
  const children = childrenOf(node).map((child, place): GroupDescription => {
    const visible = place === fields.whichChoice;
    const own = within(fields, { ...inherited, visible: inherited.visible && visible });
    return { kind: "group", box: undefined, visible, transform: undefined, children: readNode(child, reading, own) };
  });
  return { kind: "group", box: undefined, visible: isSeen(fields), transform: undefined, children };
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
  const plain = first(parts, reading, (part) => {
    const read = readGeometry(part, reading);
    // Beside the geometry, not in it: with another priority it is the same geometry.
    if (read) priorityOfGeometry = readFields(part, { priority: nodeFields.ImageGeometry.priority }, []).priority;
    return read;
  });
  const nodesIn = (part: SceneElement) => childrenOf(part).flatMap((child) => withUse(child, reading, [], (used) => [used]));
  const appearance = first(parts, reading, (part) =>
    lowerNameOf(part) === "appearance" ? readAppearance(part, nodesIn, reading.warnings) : undefined);
  const geometry = plain && values.colorBy !== "" ? reading.geometries.withValues(plain, values.colorBy) : plain;
  return {
    kind: "shape", element, geometry,
    colorMap: colorMapOf(node, values, geometry, reading.warnings),
    visible: inherited.visible && isSeen(values),
    priority: inherited.priority * values.priority * priorityOfGeometry,
    isPickable: values.isPickable,
    box: boxOf(values) ?? (geometry && boxOfGeometry(geometry)),
    appearance: appearance ?? readAppearance(undefined, nodesIn, reading.warnings),
  };
}

const geometryReaders: Readonly<Record<string, typeof readImageGeometry>> = {
  imagegeometry: readImageGeometry, binarygeometry: readBinaryGeometry,
};

/** Undefined for what is no geometry. */
function readGeometry(element: SceneElement, { geometries, warnings, defined }: Reading): GeometryDescription | undefined {
  const read = geometryReaders[lowerNameOf(element)];
  const resolve = (part: SceneElement) => {
    const name = attributeOf(part, "USE");
    return name === undefined ? part : defined.get(name);
  };
  return geometries.recall(element, () => read?.(element, warnings) ?? readInlineGeometry(element, resolve, warnings));
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
