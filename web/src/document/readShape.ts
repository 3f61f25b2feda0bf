// Reads a Shape without the state that it inherits from groups.

import { colorMapOf, withValues } from "./attributes.ts";
import { hasDeformation } from "./deformation.ts";
import type { DeformationReader } from "./deformationReader.ts";
import { readAppearance, withoutLighting, withTexCoordSets } from "./appearance.ts";
import type { Box3, GeometryDescription, Playback, ShapeDescription } from "./description.ts";
import { fogDepthName } from "./description.ts";
import type { Resolve, SceneElement } from "./element.ts";
import { attributeOf, childrenOf, lowerNameOf, substitutedFor, unknownUse } from "./element.ts";
import { boxOf, readBinaryGeometry, readImageGeometry } from "./geometry.ts";
import { boxOfGeometry } from "./geometryBox.ts";
import type { GeometryCache, Lookup } from "./geometryCache.ts";
import type { OperatorReader } from "./operatorReader.ts";
import type { Operator } from "./operators.ts";
import type { InlineGeometryReader } from "./inlineGeometry.ts";
import { withCubeMapDirection } from "./readCubeMap.ts";
import { texCoordNodesOf } from "./texCoordNodes.ts";
import type { MovingValues } from "./movingValues.ts";
import type { NeedPart } from "./parts.ts";
import type { Refusals } from "./refused.ts";
import type { TextReader } from "./textReader.ts";
import type { Warning } from "./nodes.ts";
import { nodeFields, readFields } from "./nodes.ts";
import { entryOf } from "./tables.ts";
import { UnreadableGeometry } from "./unreadableGeometry.ts";

/** The context that reading a shape needs besides its element. */
export interface ShapeReadingContext {
  readonly geometries: GeometryCache;
  readonly lookup: Lookup;
  readonly warnings: Warning[];
  /** Undefined: geometry whose numbers are in the document is not drawn. */
  readonly inlineGeometry: InlineGeometryReader | undefined;
  /** The numbers that animation has given geometry in the document. */
  readonly moving: MovingValues;
  /** Undefined: what is not read is ignored without a word. */
  readonly refusals: Refusals | undefined;
  /** Undefined: Text is not drawn. */
  readonly text: TextReader | undefined;
  /** Is told of the parts of the runtime that the shape needs. */
  readonly need: NeedPart | undefined;
  /** Undefined: operators are read, but not applied. */
  readonly operators: OperatorReader | undefined;
  /** Undefined: vertices stay where they were modelled. */
  readonly deformation: DeformationReader | undefined;
  /** Registers an element, of any document, whose change makes the shape be read again. */
  readonly listen: (element: SceneElement) => void;
}

/**
 * `element`: the shape's identity. `host`: the page's element for it. `node`: the element with its fields, which is the
 * one that `element` USEs, or `element` itself.
 */
export function readShape(
  element: SceneElement,
  host: SceneElement,
  node: SceneElement,
  context: ShapeReadingContext,
): ShapeDescription {
  const { warnings } = context;
  const values = readFields(node, nodeFields.Shape, warnings);
  const children = withOneGeometry(node, context);
  needReaderOf(children, element, context);
  const ownBox = boxOf(values);
  const { geometry, priority, lit, playback, operators } =
    values.patch !== "" && !children.some(isGeometry)
      ? readSharedPatch(node, values.patch, context)
      : readGeometryOf(children, context, ownBox, values.colorBy);
  if (operators && context.operators === undefined) context.need?.("operators", element);
  if (geometry && hasDeformation(geometry) && context.deformation === undefined) context.need?.("deformation", element);
  const appearances = children.filter((child) => lowerNameOf(child) === "appearance");
  const appearance = firstOf(appearances, context, (child) => child);
  const isVisible = values.visible && values.render;
  const ownAppearance = readAppearance(
    appearance,
    colorMapOf(node, values, geometry, warnings),
    (parent) => nodesIn(parent, context),
    warnings,
  );
  if (ownAppearance.material.kind === "physical" && ownAppearance.material.extensions) context.need?.("extensions");
  if (ownAppearance.lines) context.need?.("files");
  const hasColors = geometry?.patches.some(({ color }) => color !== undefined) ?? false;
  const box = ownBox ?? (geometry && boxOfGeometry(geometry));
  const litAppearance = lit ? ownAppearance : withoutLighting(ownAppearance, hasColors);
  const appearanceDescription = withCubeMapDirection(
    withTexCoordSets(
      operators ? { ...litAppearance, operators } : litAppearance,
      geometry?.texCoordMappings,
      geometry?.levels?.chips,
    ),
    texCoordGeneratorIn(node, { ...context, warnings: [] }), // USEs have been resolved with warnings
    warnings,
  );
  return {
    kind: "shape",
    element,
    geometry,
    host,
    unreadableGeometry:
      geometry !== undefined ? undefined : (problemOf(children, context) ?? (values.patch !== "" ? "" : undefined)),
    ...(playback && { playback }),
    visible: isVisible,
    contributesToBounds: isVisible,
    priority: values.priority * priority,
    isPickable: values.isPickable,
    box: box && geometry && operators ? (context.operators?.boxOf(operators, geometry, box) ?? box) : box,
    ...(geometry?.deformation &&
      context.deformation && {
        deformer: {
          skin: undefined,
          displacers: context.deformation.displacersOf(
            node,
            geometry.deformation,
            (child) => resolveUse(child, context),
            warnings,
          ),
        },
      }),
    appearance:
      geometry?.glyphAtlas === undefined || context.text === undefined
        ? appearanceDescription
        : context.text.appearanceOf(appearanceDescription, geometry.glyphAtlas, node, warnings),
  };
}

/** The shape's children; of several geometries the first, with a warning. */
function withOneGeometry(
  shape: SceneElement,
  { inlineGeometry, refusals, warnings }: ShapeReadingContext,
): SceneElement[] {
  const children = childrenOf(shape);
  const [first, ...others] = children.filter(
    (child) => isKnownGeometry(lowerNameOf(child), inlineGeometry) || refusals?.reasonAgainst(child) !== undefined,
  );
  if (others.length === 0) return children;
  warnings.push({
    element: shape,
    message: `a Shape has one geometry; of ${others.length + 1} the first is drawn`,
  });
  return children.filter((child) => child === first || !others.includes(child));
}

/** The shape's TextureCoordinateGenerator: of its geometry, or its own where convert has written the geometry. */
function texCoordGeneratorIn(shape: SceneElement, context: ShapeReadingContext): SceneElement | undefined {
  const isGenerator = (node: SceneElement) => lowerNameOf(node) === "texturecoordinategenerator";
  for (const child of nodesIn(shape, context)) {
    if (isGenerator(child)) return child;
    const found = isGeometry(child)
      ? texCoordNodesOf(child, (each) => resolveUse(each, context)).find(isGenerator)
      : undefined;
    if (found) return found;
  }
  return undefined;
}

/** An element's children, with USEs resolved. */
export function nodesIn(parent: SceneElement, context: ShapeReadingContext): SceneElement[] {
  return childrenOf(parent).flatMap((child) => {
    const used = resolveUse(child, context);
    return used === undefined ? [] : [substitutedFor(child, used)];
  });
}

interface ShapeGeometry {
  readonly geometry: GeometryDescription | undefined;
  /** Separate from the geometry, as `lit` is, because it does not change the geometry's identity. */
  readonly priority: number;
  readonly lit: boolean;
  readonly playback?: Playback;
  readonly operators?: readonly Operator[];
}

/** The geometry among a shape's children. */
function readGeometryOf(
  children: readonly SceneElement[],
  context: ShapeReadingContext,
  box: Box3 | undefined,
  colorBy: string,
): ShapeGeometry {
  const { geometries, lookup, warnings, deformation } = context;
  const found = firstOf(children.filter(isGeometry), context, (child) => {
    if (lowerNameOf(child) === "text") context.listen(child);
    const geometry = geometries.geometryOf(child, lookup, warnings, (...args) => readGeometry(context, ...args));
    return geometry && { child, geometry };
  });
  if (found === undefined) return { geometry: undefined, priority: 1, lit: true };
  const boxed =
    box === undefined
      ? found.geometry
      : geometries.variant(found.geometry, JSON.stringify(box), (plain) => withBox(plain, box));
  const [name, use] = colorBy === "" ? ([fogDepthName, "fogDepth"] as const) : ([colorBy, "color"] as const);
  const hasValues = boxed.attributes.some((attribute) => attribute.name === name);
  const geometry = hasValues
    ? geometries.variant(boxed, JSON.stringify([use, name]), (plain) => withValues(plain, name, use))
    : boxed;
  const deformed =
    deformation && hasDeformation(geometry)
      ? geometries.variant(geometry, `deformed in ${JSON.stringify(box)}`, (plain) => deformation.deformed(plain, box))
      : geometry;
  if (deformed.value) context.need?.("values");
  if (deformed.encoding !== "compact") context.need?.("files");
  if (deformed.encoding === "live" || deformed.sequence) context.need?.("streams");
  if (deformed.levels) context.need?.("levels");
  return { geometry: deformed, ...drawingFieldsOf(found.child, context, deformed) };
}

/** Asks for the part that reads geometry in the document, where a shape has such. */
function needReaderOf(children: readonly SceneElement[], shape: SceneElement, context: ShapeReadingContext): void {
  if (context.inlineGeometry !== undefined || context.need === undefined) return;
  for (const child of children.filter(isGeometry)) {
    const node = resolveUse(child, { ...context, warnings: [] });
    if (node === undefined || Object.hasOwn(geometryReaders, lowerNameOf(node))) continue;
    context.need("documentGeometry", shape);
    context.need("files"); // its arrays are in the form of BG's files
  }
}

/** The geometry that the field `patch` of a Shape names, "DEF#N": patch N of the file of the geometry node DEF. */
function readSharedPatch(element: SceneElement, patch: string, context: ShapeReadingContext): ShapeGeometry {
  const { geometries, lookup, warnings } = context;
  const [name, index] = patch.split("#");
  const node = name === undefined ? undefined : lookup(name);
  const isIndex = index !== undefined && /^\d{1,9}$/.test(index);
  const shared =
    node && isIndex
      ? geometries.geometryOf(node, lookup, warnings, (...args) => readGeometry(context, ...args))
      : undefined;
  if (node === undefined || shared?.encoding !== "compact" || shared.patches.length !== 1) {
    warnings.push({ element, message: `patch="${patch}" names no patch of a geometry of this scene` });
    return { geometry: undefined, priority: 1, lit: true };
  }
  const geometry = geometries.variant(shared, `#${index}`, (plain) => withPatchIndex(plain, Number(index)));
  return { geometry, ...drawingFieldsOf(node, context, geometry) };
}

/** The fields of a geometry node that are not part of its description. The reader of the node has warned of them. */
function drawingFieldsOf(
  node: SceneElement,
  { operators: reader, warnings }: ShapeReadingContext,
  geometry: GeometryDescription,
): Omit<ShapeGeometry, "geometry"> {
  const { priority, lit, paused, rate, operators: text } = nodeFields.ImageGeometry;
  const { operators: list, ...common } = readFields(node, { priority, lit, operators: text }, []);
  const { operators, problem } = (list === "" ? undefined : reader?.read(list, geometry)) ?? { operators: [] };
  if (problem !== undefined) warnings.push({ element: node, message: problem });
  const fields = list === "" ? common : { ...common, operators };
  return geometry.encoding === "live" ? { ...fields, playback: readFields(node, { paused, rate }, []) } : fields;
}

function withPatchIndex(geometry: GeometryDescription, patchIndex: number): GeometryDescription | undefined {
  const [patch] = geometry.patches;
  return patch?.data && { ...geometry, patches: [{ ...patch, data: { url: patch.data.url, patchIndex } }] };
}

const geometryReaders: Readonly<Record<string, typeof readBinaryGeometry>> = {
  imagegeometry: readImageGeometry,
  binarygeometry: readBinaryGeometry,
};

/** Undefined for an element that is no geometry. */
function readGeometry(
  { geometries, inlineGeometry, moving, refusals, text }: ShapeReadingContext,
  element: SceneElement,
  lookup: Lookup,
  warnings: Warning[],
): GeometryDescription | undefined {
  if (refusals?.reasonAgainst(element) !== undefined) return undefined;
  const resolve = resolverOf(lookup);
  const name = lowerNameOf(element);
  const own: Warning[] = [];
  const fileGeometry = readFileGeometry(element, resolve, own);
  if (fileGeometry instanceof UnreadableGeometry) return undefined;
  refusals?.warnOfFields(element, warnings);
  warnings.push(...own);
  if (name === "text") return text?.geometryOf(element, resolve, warnings);
  return fileGeometry ? geometries.intern(fileGeometry) : inlineGeometry?.read(element, resolve, warnings, moving);
}

/** Finds the element that a USE names; the element itself without one. */
function resolverOf(lookup: Lookup): Resolve {
  return (element) => {
    const name = attributeOf(element, "USE");
    return name === undefined ? element : lookup(name);
  };
}

/** Undefined for other nodes than those of files; an UnreadableGeometry has the sentence why it is left out. */
function readFileGeometry(
  element: SceneElement,
  resolve: Resolve,
  warnings: Warning[],
): GeometryDescription | UnreadableGeometry | undefined {
  try {
    return entryOf(geometryReaders, lowerNameOf(element))?.(element, resolve, warnings);
  } catch (error) {
    if (error instanceof UnreadableGeometry) return error;
    throw error;
  }
}

/**
 * Why none of a shape's children is drawn: the sentence about a geometry node that no reader knows, which becomes a
 * warning too; "" where a reader found nothing to draw; undefined without a geometry node.
 */
function problemOf(children: readonly SceneElement[], context: ShapeReadingContext): string | undefined {
  const geometries = children.filter(isGeometry);
  if (geometries.length === 0) return undefined;
  const { refusals, warnings } = context;
  if (refusals === undefined) return ""; // before the runtime has loaded, which says it
  for (const child of geometries) {
    const node = resolveUse(child, { ...context, warnings: [] });
    if (node === undefined) return `<${child.localName}> ${unknownUse(attributeOf(child, "USE"))}`;
    const reason = reasonAgainst(node, context);
    if (reason === undefined) continue;
    warnings.push({ element: node, message: reason });
    return `<${node.localName}> ${reason}`;
  }
  return "";
}

/** Why a node is left out; undefined for one of a geometry that pages draw. */
function reasonAgainst(node: SceneElement, context: ShapeReadingContext): string | undefined {
  const { inlineGeometry, refusals, lookup } = context;
  const reason = refusals?.reasonAgainst(node);
  if (reason !== undefined) return reason;
  const fileGeometry = readFileGeometry(node, resolverOf(lookup), []);
  if (fileGeometry !== undefined) return fileGeometry instanceof UnreadableGeometry ? fileGeometry.message : undefined;
  // The reader of geometry in the document, which knows the other nodes, is there only in scenes that have some.
  if (inlineGeometry === undefined || isKnownGeometry(lowerNameOf(node), inlineGeometry)) return undefined;
  return "it is no geometry node that pages draw; nothing is drawn";
}

/** Whether pages draw a geometry of this lower-case name. */
function isKnownGeometry(name: string, inlineGeometry: InlineGeometryReader | undefined): boolean {
  return Object.hasOwn(geometryReaders, name) || name === "text" || (inlineGeometry?.reads(name) ?? false);
}

/** Whether a child of a Shape is a geometry, judged by its name: all but Appearance, HAnimDisplacers and metadata are. */
function isGeometry(child: SceneElement): boolean {
  const name = lowerNameOf(child);
  return name !== "appearance" && name !== "hanimdisplacer" && !name.startsWith("metadata");
}

/**
 * Gives the shape's box to patches that have none: to the only one, or to those of floats, which lie in no quantization
 * box. Undefined where there is none such.
 */
function withBox(geometry: GeometryDescription, box: Box3): GeometryDescription | undefined {
  const { patches } = geometry;
  const lacksBox = patches.some((patch) => patch.box === undefined);
  if (!lacksBox || (patches.length > 1 && geometry.coordType !== "Float32")) return undefined;
  return { ...geometry, patches: patches.map((patch) => (patch.box ? patch : { ...patch, box })) };
}

/** The element, or the one that its USE names; undefined where there is none. */
function resolveUse(element: SceneElement, { lookup, warnings }: ShapeReadingContext): SceneElement | undefined {
  const name = attributeOf(element, "USE");
  if (name === undefined) return element;
  const node = lookup(name);
  if (node === undefined) warnings.push({ element, message: unknownUse(name) });
  return node;
}

function firstOf<Result>(
  elements: readonly SceneElement[],
  context: ShapeReadingContext,
  read: (element: SceneElement) => Result | undefined,
): Result | undefined {
  for (const element of elements) {
    const used = resolveUse(element, context);
    const result = used && read(used);
    if (result !== undefined) return result;
  }
  return undefined;
}
