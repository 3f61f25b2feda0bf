// Values of fields that are out of range or contradict one another. The tool refuses the same, with the same words, in
// src/documents/geometry_reader.cpp.

import type { VertexRole } from "../stage/attributeRows.ts";
import { vertexRoles } from "../stage/attributeRows.ts";
import { byteSizeOf, isUnsigned } from "../stage/elementType.ts";
import { packedPositionBits } from "../stage/packedPositionBits.ts";
import type { Encoding, GeometryDescription, NormalEncoding, PatchDescription } from "./description.ts";
import { isPair } from "./description.ts";
import { encodingFormats, formatOf } from "./encodings.ts";
import { shortened } from "./nodes.ts";
import { UnreadableGeometry } from "./unreadableGeometry.ts";

/** The choice that the text names, case-insensitively. Throws UnreadableGeometry where it names none. */
export function choiceOf<Choice extends string>(field: string, text: string, choices: readonly Choice[]): Choice {
  const found = choices.find((choice) => choice.toLowerCase() === text.trim().toLowerCase());
  if (found === undefined)
    throw new UnreadableGeometry(`${field}="${shortened(text)}" is none of ${choices.join(", ")}`);
  return found;
}

/** Throws UnreadableGeometry for fields that are below 0. */
export function checkCounts(fields: Readonly<Record<string, number>>): void {
  for (const [name, value] of Object.entries(fields))
    if (value < 0) throw new UnreadableGeometry(`${name} ${value} is negative`);
}

/** Throws UnreadableGeometry where a patch has no vertices. */
export function checkPatch({ coord, data }: PatchDescription, encoding: Encoding): void {
  const isPacked = encodingFormats[encoding].storage === "packed";
  if (isPacked && data === undefined) throw new UnreadableGeometry("a patch of compact has no data");
  if (!isPacked && coord.length === 0) throw new UnreadableGeometry("there are no coordinates");
}

/**
 * Throws UnreadableGeometry where nothing is drawn of a patch: a count of 0 stands for all elements of an array, but
 * images do not state how many numbers they hold. Packed files are compared with the counts when they are decoded.
 */
export function checkDraws({ draws, grid }: PatchDescription, encoding: Encoding): void {
  const { storage } = encodingFormats[encoding];
  const isAll = storage === "packed" || encoding === "live" || (storage === "arrays" && draws.length === 1);
  if (!isAll && grid === undefined && draws.every(({ count }) => count === 0))
    throw new UnreadableGeometry("vertexCount is 0; nothing is drawn");
}

/** Bits of Float32 coordinates without `positionBits`, which are then no integers of a lattice. */
const sourceBits = 32;

/** Throws UnreadableGeometry where the coordinates have no quantization box, or no integers of `positionBits`. */
export function checkQuantization(geometry: GeometryDescription): void {
  const { encoding, coordType, patches, size, positionBits } = geometry;
  const { storage } = formatOf(geometry);
  const planeCount = patches[0]?.coord.length ?? 0;
  if (storage === "bytePlanes" && patches.some(({ coord }) => coord.length !== planeCount))
    throw new UnreadableGeometry("patches differ in their coordinate images");
  const isFloat = storage === "arrays" && coordType === "Float32";
  const bytes =
    storage === "packed"
      ? packedPositionBits.default / 8
      : storage === "bytePlanes"
        ? planeCount
        : byteSizeOf(coordType);
  const bits = positionBits || 8 * bytes;
  const isHeld = {
    packed: bits >= packedPositionBits.min && bits <= packedPositionBits.max,
    bytePlanes: bits >= 8 && Math.ceil(bits / 8) === bytes,
    arrays: bits >= 8 && (isFloat ? bits <= 24 || bits === sourceBits : bits <= 8 * bytes),
  };
  if (!isHeld[storage]) throw new UnreadableGeometry(`positionBits is no precision of coordinates of ${bytes} bytes`);
  const needsBox = encoding !== "live" && !(isFloat && bits === sourceBits);
  if (needsBox && !(Math.min(...size) >= 0 && Math.max(...size) > 0))
    throw new UnreadableGeometry("size is the extent of no box");
}

/** Throws UnreadableGeometry for element types that indices and normals cannot have. */
export function checkElementTypes({ patches, indexType, normalType, normalEncoding }: GeometryDescription): void {
  if (patches.some(({ index }) => index) && !isUnsigned(indexType))
    throw new UnreadableGeometry(`indices of type ${indexType} are not read; unsigned types are`);
  if (!patches.some(({ normal }) => normal)) return;
  if (isPair(normalEncoding) && normalType !== "Uint8" && normalType !== "Uint16")
    throw new UnreadableGeometry(`normals of two numbers of type ${normalType} are not read; Uint8 and Uint16 are`);
  if (!isPair(normalEncoding) && isUnsigned(normalType))
    throw new UnreadableGeometry(`normals of type ${normalType} are not read; signed types are`);
}

/**
 * Throws UnreadableGeometry where patches have other images of an attribute than the stated bits need, or differ in
 * their number; 0: the bits of so many images.
 */
export function checkImageCounts(
  { patches, normalEncoding }: GeometryDescription,
  { normalBits, texCoordBits }: { readonly normalBits: number; readonly texCoordBits: number },
): void {
  for (const role of vertexRoles) {
    const counts = patches.flatMap(({ [role]: first, lowBytes }) =>
      first === undefined ? [] : [1 + (lowBytes[role]?.length ?? 0)],
    );
    const [count] = counts;
    if (count === undefined) continue;
    if (counts.some((other) => other !== count))
      throw new UnreadableGeometry(`patches differ in their images of ${role}`);
    const stated = role === "normal" ? normalBits : role === "color" ? 0 : texCoordBits;
    const bits = stated || bitsOfImages(role, normalEncoding, count);
    if (count !== imageCountOf(role, normalEncoding, bits))
      throw new UnreadableGeometry(`${count} images of ${role} hold no numbers of ${bits} bits`);
  }
}

/** Bits of the numbers of an attribute in so many images, where the document does not state them. */
function bitsOfImages(role: VertexRole, normalEncoding: NormalEncoding, count: number): number {
  if (role === "normal") return isPair(normalEncoding) ? 8 : 8 * count;
  return (role === "color" ? 0 : 8) + 8 * count;
}

/** The images that hold an attribute of so many bits; 0 for bits that it cannot have. */
function imageCountOf(role: VertexRole, normalEncoding: NormalEncoding, bits: number): number {
  if (bits === 8) return 1;
  if (role === "color") return bits === 16 || bits === 24 ? bits / 8 : 0;
  if (role !== "normal") return bits === 16 ? 1 : bits === 24 ? 2 : 0;
  return bits !== 16 || normalEncoding === "palette" ? 0 : isPair(normalEncoding) ? 1 : 2;
}
