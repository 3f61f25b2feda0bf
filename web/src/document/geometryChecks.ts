// Values of fields that contradict one another. The tool refuses the same in src/documents/geometry_reader.cpp and
// src/containers/bg/decode_bg.cpp.

import type { VertexRole } from "../stage/attributeRows.ts";
import { vertexRoles } from "../stage/attributeRows.ts";
import { isUnsigned } from "../stage/elementType.ts";
import type { GeometryDescription, NormalEncoding } from "./description.ts";
import { isPair } from "./description.ts";
import { UnreadableGeometry } from "./unreadableGeometry.ts";

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

/** Throws UnreadableGeometry where a patch has other images of an attribute than the stated bits need; 0: any bits. */
export function checkImageCounts(
  { patches, normalEncoding }: GeometryDescription,
  { normalBits, texCoordBits }: { readonly normalBits: number; readonly texCoordBits: number },
): void {
  for (const role of vertexRoles) {
    const bits = role === "normal" ? normalBits : role === "color" ? 0 : texCoordBits;
    for (const patch of bits === 0 ? [] : patches) {
      const count = patch[role] === undefined ? 0 : 1 + (patch.lowBytes[role]?.length ?? 0);
      if (count > 0 && count !== imageCountOf(role, normalEncoding, bits))
        throw new UnreadableGeometry(`${count} images of ${role} hold no numbers of ${bits} bits`);
    }
  }
}

/** The images that hold an attribute of so many bits; 0 for bits that it cannot have. */
function imageCountOf(role: VertexRole, normalEncoding: NormalEncoding, bits: number): number {
  if (bits === 8) return 1;
  if (role !== "normal") return bits === 16 ? 1 : bits === 24 ? 2 : 0;
  return bits !== 16 || normalEncoding === "palette" ? 0 : isPair(normalEncoding) ? 1 : 2;
}
