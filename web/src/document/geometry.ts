// Reads ImageGeometry and BinaryGeometry. A node with GeometryPatch children takes draws and references from them only.
// A node without them is its own single patch, and images that are its children (X3DOM's form) may give the references.

import type {
  Box3,
  ByteReference,
  Draw,
  Encoding,
  GeometryDescription,
  LevelsDescription,
  PairBits,
  PatchDescription,
  Primitive,
  Warning,
} from "./description.ts";
import type { ElementType } from "../stage/elementType.ts";
import { elementTypes } from "../stage/elementType.ts";
import { decodeModes, isPair, meshModes, normalEncodings, imageProfiles } from "./description.ts";
import { byVertexRoleWith, texCoordRoles } from "../stage/attributeRows.ts";
import { checkAttributeFiles, readAttributes } from "./attributes.ts";
import type { ContainerImages } from "./containerImages.ts";
import { containerImagesOf, isStreamUrl } from "./containerImages.ts";
import { encodingFormats, formatOf } from "./encodings.ts";
import type { Resolve, SceneElement } from "./element.ts";
import { attributeOf, childrenOf, lowerNameOf } from "./element.ts";
import type { Vec2, Vec3 } from "./fieldTypes.ts";
import {
  checkCounts,
  checkDraws,
  checkElementTypes,
  checkImageCounts,
  checkPatch,
  checkQuantization,
  choiceOf,
} from "./geometryChecks.ts";
import { withGrids } from "./gridPatches.ts";
import type { Values } from "./nodes.ts";
import { nodeFields, readFields } from "./nodes.ts";
import { readPatchReferences, referenceOf } from "./patchReferences.ts";
import { readSequence } from "./sequence.ts";
import { UnreadableGeometry } from "./unreadableGeometry.ts";

type PatchValues = Values<typeof nodeFields.GeometryPatch>;

export function readImageGeometry(element: SceneElement, resolve: Resolve, warnings: Warning[]): GeometryDescription {
  const values = readFields(element, nodeFields.ImageGeometry, warnings);
  // Only compact has `data`; documents of many small shapes leave the profile out.
  const profile = values.data !== "" && attributeOf(element, "profile") === undefined ? "compact" : values.profile;
  const encoding = choiceOf("profile", profile, imageProfiles);
  const { hasBase, hasGrids } = encodingFormats[encoding];
  const mode = hasGrids ? choiceOf("implicitMeshMode", values.implicitMeshMode, implicitModes) : "sig";
  const { numColorComponents, normalBits, texCoordBits } = values;
  checkCounts({ numColorComponents, normalBits, texCoordBits });
  const sequence = readSequence(element, resolve, warnings);
  const levels = hasBase && values.levels !== "" ? levelsOf(values.levels.trim(), values.chips) : undefined;
  const geometry: GeometryDescription = {
    ...commonFieldsOf(values, ["Uint16", "Uint32"]),
    ...(encoding === "compact" ? quantizationCubeOf(element) : undefined),
    attributes: readAttributes(element, encoding, warnings),
    encoding,
    colorComponents: colorComponentsOf(values),
    normalBits: normalBits === 16 ? 16 : 8,
    texCoordImageBits: texCoordBits === 8 ? 8 : 16,
    decode: decodeModeOf(element, values, warnings),
    base: hasBase && values.base !== "" ? referenceOf(values.base, encoding) : undefined,
    // Images store bytes; an index consists of two or three of them.
    coordType: "Uint8",
    ...byVertexRoleWith("Type", (): ElementType => "Uint8"),
    // "auto" is the paper's default (section 6): what the texels are without further word.
    patches: levels
      ? [{ ...readOwnPatch(element, encoding, resolve, []), data: undefined }]
      : withGrids(readPatches(element, encoding, resolve, warnings), mode === "auto" ? "sig" : mode),
    ...(levels && { levels }),
  };
  checkImageCounts(geometry, values);
  const streamed = checked(withStream(geometry));
  if (sequence === undefined) return streamed;
  if (streamed.encoding === "classic" && streamed.patches.length === 1) return { ...streamed, sequence };
  warnings.push({ element, message: "a sequence moves the vertices of one patch of profile classic, not of this one" });
  return streamed;
}

function levelsOf(url: string, chips: number): LevelsDescription {
  if (!Number.isInteger(chips) || chips < 0 || chips > 3)
    throw new UnreadableGeometry(`chips="${chips}" is no number of a set of texture coordinates from 1 to 3`);
  return chips === 0 ? { url } : { url, chips };
}

/** A live stream in place of files of coordinates (docs/live.md). */
function withStream(geometry: GeometryDescription): GeometryDescription {
  const [patch, ...others] = geometry.patches;
  const coord = patch?.coord[0];
  if (patch === undefined || others.length > 0 || coord === undefined || !isStreamUrl(coord.url)) return geometry;
  return { ...geometry, encoding: "live", attributes: [streamedValues], patches: [{ ...patch, coord: [coord] }] };
}

/** The values of a stream, as `colorBy="value"` names them; the stream states their range. */
const streamedValues = { name: "value", components: 1, fileCount: 0, bits: 8, min: [0], size: [1] } as const;

const implicitModes = ["auto", ...meshModes] as const;

function colorComponentsOf({ numColorComponents }: { readonly numColorComponents: number }): 3 | 4 {
  if (numColorComponents === 3 || numColorComponents === 4) return numColorComponents;
  throw new UnreadableGeometry(`numColorComponents="${numColorComponents}" is neither 3 nor 4`);
}

/** How images are decoded, which changes no picture: an unknown mode is the default. */
function decodeModeOf(
  element: SceneElement,
  { decode }: { readonly decode: string },
  warnings: Warning[],
): GeometryDescription["decode"] {
  const found = decodeModes.find((mode) => mode === decode.trim().toLowerCase());
  if (found === undefined)
    warnings.push({ element, message: `decode="${decode}" is none of ${decodeModes.join(", ")}` });
  return found ?? "auto";
}

/**
 * The quantization box of a compact geometry with neither `position` nor `size`: the cube over the longest edge of its
 * own box, from the box's minimum. Undefined where it has no box. src/documents/geometry_reader.cpp does the same.
 */
function quantizationCubeOf(element: SceneElement): { position: Vec3; size: Vec3 } | undefined {
  if (attributeOf(element, "position") !== undefined || attributeOf(element, "size") !== undefined) return undefined;
  const { bboxCenter, bboxSize } = readFields(element, nodeFields.GeometryPatch, []);
  const edge = Math.max(...bboxSize);
  if (!(edge > 0) || bboxSize.some((extent) => extent < 0)) return undefined;
  const along = (axis: 0 | 1 | 2) => bboxCenter[axis] - bboxSize[axis] / 2 + edge / 2;
  return { position: [along(0), along(1), along(2)], size: [edge, edge, edge] };
}

export function readBinaryGeometry(element: SceneElement, resolve: Resolve, warnings: Warning[]): GeometryDescription {
  const values = readFields(element, nodeFields.BinaryGeometry, warnings);
  if (values.compressed)
    throw new UnreadableGeometry(
      "compressed arrays are not read; let the server compress the files (Content-Encoding) instead",
    );
  const geometry: GeometryDescription = {
    ...commonFieldsOf(values, elementTypes),
    attributes: readAttributes(element, "bg", warnings),
    encoding: "bg",
    colorComponents: values.rgbaColors ? 4 : 3,
    decode: "auto",
    coordType: choiceOf("coordType", values.coordType, elementTypes),
    ...byVertexRoleWith("Type", (role) => choiceOf(`${role}Type`, values[`${role}Type`], elementTypes)),
    patches: readPatches(element, "bg", resolve, warnings).map((patch) =>
      values.normalPerVertex ? patch : { ...patch, normal: undefined },
    ),
    base: undefined,
  };
  const read = values.normalPerVertex && values.normalAsSphericalCoordinates ? withNormalsInCoords(geometry) : geometry;
  checkElementTypes(read);
  return checked(read);
}

function checked(geometry: GeometryDescription): GeometryDescription {
  const { encoding, patches, attributes, levels } = geometry;
  for (const patch of patches) {
    if (levels === undefined) checkPatch(patch, encoding);
    if (formatOf(geometry).storage !== "packed" && encoding !== "live") checkAttributeFiles(patch, attributes);
  }
  checkQuantization(geometry);
  for (const patch of patches) checkDraws(patch, encoding);
  return geometry;
}

/** X3DOM stores spherical normals of one byte each in the fourth element of 16-bit coordinate records. */
function withNormalsInCoords(geometry: GeometryDescription): GeometryDescription {
  if (!geometry.coordType.endsWith("16"))
    throw new UnreadableGeometry(`spherical normals in coordinates of type ${geometry.coordType} are not read`);
  const patches = geometry.patches.map((patch) => ({ ...patch, normal: fourthElementOf(patch) }));
  return { ...geometry, normalEncoding: "spherical", normalType: "Uint8", patches };
}

/** The last two bytes of 16-bit coordinate records, which three components leave free. */
function fourthElementOf({ coord: [coord] }: PatchDescription): ByteReference | undefined {
  if (coord === undefined || !("byteOffset" in coord)) return undefined;
  return { ...coord, byteOffset: coord.byteOffset + 6, byteStride: coord.byteStride || 8 };
}

/** Whether a patch's normals are pairs of bytes in the fourth element of its coordinate records. */
export function hasNormalsInCoords(geometry: GeometryDescription, patch: PatchDescription): boolean {
  const isBytePair = geometry.normalType === "Uint8" && isPair(geometry.normalEncoding);
  if (!isBytePair || !geometry.coordType.endsWith("16")) return false;
  const expected = fourthElementOf(patch);
  const { normal } = patch;
  return (
    expected !== undefined &&
    normal !== undefined &&
    "byteOffset" in normal &&
    normal.url === expected.url &&
    normal.byteOffset === expected.byteOffset &&
    normal.byteStride === expected.byteStride
  );
}

/**
 * Whether a patch's bounds are unknown before its coordinates are loaded: floats need not lie in the quantization box,
 * and a live stream states its own.
 */
export function isUnbounded(
  { coordType, encoding }: Pick<GeometryDescription, "coordType" | "encoding">,
  { box }: PatchDescription,
): boolean {
  return (coordType === "Float32" || encoding === "live") && box === undefined;
}

/** Fields of ImageGeometry only. */
type ImageFields =
  | "paused"
  | "rate"
  | "numColorComponents"
  | "normalBits"
  | "texCoordBits"
  | "decode"
  | "profile"
  | "base"
  | "levels"
  | "chips"
  | "implicitMeshMode"
  | "implicitMeshCount"
  | "surfaceDistance";

function commonFieldsOf(
  values: Omit<Values<typeof nodeFields.ImageGeometry>, ImageFields>,
  indexTypes: readonly ElementType[],
) {
  const { position, size, positionBits, solid, ccw } = values;
  checkCounts({ positionBits });
  const indexType = choiceOf("indexType", values.indexType, indexTypes);
  const normalEncoding = choiceOf("normalEncoding", values.normalEncoding, normalEncodings);
  return {
    position,
    size,
    positionBits,
    solid,
    ccw,
    texCoordBoxes: texCoordRoles.map((role) => ({ min: values[`${role}Min`], size: values[`${role}Size`] })),
    texCoordMappings: values.texCoordMapping,
    indexType,
    normalEncoding,
    normalBits: 8 as PairBits,
    texCoordImageBits: 16 as PairBits,
    value: undefined,
  };
}

/** The box of `bboxCenter` and `bboxSize`; undefined for X3D's size -1 -1 -1. */
export function boxOf(values: { bboxCenter: Vec3; bboxSize: Vec3 }): Box3 | undefined {
  if (values.bboxSize.some((edge) => edge < 0)) return undefined;
  return boxAround(values.bboxCenter, values.bboxSize);
}

export function boxAround(center: Vec3, size: Vec3): Box3 {
  return {
    min: [center[0] - size[0] / 2, center[1] - size[1] / 2, center[2] - size[2] / 2],
    max: [center[0] + size[0] / 2, center[1] + size[1] / 2, center[2] + size[2] / 2],
  };
}

function readPatches(
  element: SceneElement,
  encoding: Encoding,
  resolve: Resolve,
  warnings: Warning[],
): PatchDescription[] {
  const patchElements = childrenOf(element).filter((child) => lowerNameOf(child) === "geometrypatch");
  if (patchElements.length > 0)
    return patchElements.map((child) => {
      const values = readFields(child, nodeFields.GeometryPatch, warnings);
      return patchOf(child, withImplicitMeshCount(child, values, warnings), {}, encoding, warnings);
    });
  return [readOwnPatch(element, encoding, resolve, warnings)];
}

/** The only patch of a node without GeometryPatch children. */
function readOwnPatch(
  element: SceneElement,
  encoding: Encoding,
  resolve: Resolve,
  warnings: Warning[],
): PatchDescription {
  const images =
    encodingFormats[encoding].storage === "bytePlanes" ? containerImagesOf(element, resolve, warnings) : {};
  // The reader of the node has warned of the fields that it shares with a patch.
  const values = { ...readFields(element, nodeFields.GeometryPatch, []), ...readFields(element, ownFields, warnings) };
  return patchOf(element, withImplicitMeshCount(element, values, warnings), images, encoding, warnings);
}

/** The fields of a GeometryPatch that the node around it does not have. */
const { bboxCenter, bboxSize, recordCount, gridOrigin } = nodeFields.GeometryPatch;
const ownFields = { bboxCenter, bboxSize, recordCount, gridOrigin };

function patchOf(
  element: SceneElement,
  values: PatchValues,
  images: ContainerImages,
  encoding: Encoding,
  warnings: Warning[],
): PatchDescription {
  checkCounts({ recordCount: values.recordCount });
  const [implicitWidth, implicitHeight] = implicitSizeOf(values.implicitMeshSize);
  return {
    box: boxOf(values),
    vertexCount: values.recordCount,
    draws: drawsOf(element, values, warnings),
    implicitWidth,
    implicitHeight,
    grid: undefined,
    gridOrigin: values.gridOrigin,
    ...readPatchReferences(element, values, images, encoding, warnings),
    value: [],
  };
}

/** Columns and rows; 0 rows are as many as columns. Throws UnreadableGeometry for other numbers than those of images. */
function implicitSizeOf([columns, rows]: Vec2): Vec2 {
  for (const edge of [columns, rows])
    if (!(edge >= 0 && edge <= 65536 && Number.isInteger(edge)))
      throw new UnreadableGeometry("implicitMeshSize is no size of an image");
  if (columns === 0) throw new UnreadableGeometry("implicitMeshSize has no columns");
  return [columns, rows || columns];
}

/** The paper's name for `implicitMeshSize`, which has the last word where both are stated. */
function withImplicitMeshCount(element: SceneElement, values: PatchValues, warnings: Warning[]): PatchValues {
  if (attributeOf(element, "implicitMeshSize") !== undefined) return values;
  const { implicitMeshCount } = readFields(
    element,
    { implicitMeshCount: nodeFields.ImageGeometry.implicitMeshCount },
    warnings,
  );
  return implicitMeshCount === undefined ? values : { ...values, implicitMeshSize: implicitMeshCount };
}

const primitives: Readonly<Record<string, Primitive>> = {
  POINTS: "points",
  LINES: "lines",
  LINESTRIP: "lineStrip",
  LINELOOP: "lineLoop",
  TRIANGLES: "triangles",
  TRIANGLESTRIP: "triangleStrip",
  TRIANGLEFAN: "triangleFan",
};

function drawsOf(element: SceneElement, values: PatchValues, warnings: Warning[]): Draw[] {
  const { length } = values.primType;
  const counts = values.vertexCount.length > 0 ? values.vertexCount : [0];
  if (length > counts.length && attributeOf(element, "primType") !== undefined)
    warnings.push({
      element,
      message: `primType has ${length} draws, vertexCount ${counts.length}; the further ones are not used`,
    });
  if (length < counts.length)
    warnings.push({
      element,
      message: `primType has ${length} of ${counts.length} draws; TRIANGLES are drawn for the others`,
    });
  return counts.map((count, index) => {
    const name = values.primType[index] ?? "TRIANGLES";
    const primitive = primitives[name.toUpperCase()];
    if (primitive === undefined)
      warnings.push({
        element,
        message: `primType "${name}" is none of ${Object.keys(primitives).join(", ")}; TRIANGLES are drawn`,
      });
    checkCounts({ vertexCount: count });
    return { primitive: primitive ?? "triangles", count };
  });
}
