// A patch in integers, exactly what the file holds: docs/formats/compact.md.

import { DecodeError } from "../decodeError.ts";
import type { Connectivity } from "./connectivity.ts";
import { unconnected } from "./connectivity.ts";
import { decodeTriangles } from "./conquest.ts";
import type { AttributeType, PatchHeader, PatchStreams } from "./header.ts";
import { readPatchHeader } from "./header.ts";
import { decodeLines } from "./lines.ts";
import type { DecodedShape } from "./neighbours.ts";
import { decodeNormals } from "./normals.ts";
import type { Parts } from "./parts.ts";
import { decodeParts } from "./parts.ts";
import { decodePositions } from "./positions.ts";
import { decodeTexCoords } from "./texCoords.ts";
import { decodeValues } from "./values.ts";
import type { Wedges } from "./wedges.ts";
import { decodeWedges } from "./wedges.ts";

export interface CompactPatch extends DecodedShape {
  /** In the order of the header's attributes: its components of each wedge. */
  readonly attributes: readonly Int32Array[];
  /** Of a base. */
  readonly parts: Parts | undefined;
}

/**
 * Decodes the patch that begins at a byte of a payload, in time linear in the
 * counts of its header. Safe for untrusted bytes. Throws DecodeError.
 */
export function decodePatch(payload: Uint8Array, start: number): CompactPatch {
  const { header, streams } = readPatchHeader(payload, start);
  const connectivity = connectivityOf(header, streams);
  const parts = streams.parts && decodeParts(streams.parts, header, connectivity);
  const positions = decodePositions(streams.positions, header, connectivity, parts);
  const wedges: Wedges = streams.wedges ? decodeWedges(streams.wedges, header, connectivity)
    : { wedge: connectivity.vertex, seams: undefined };
  const shape: DecodedShape = { header, connectivity, wedges, ...positions };
  const attributes = header.attributes.map((type, place) => decodeAttribute(streams.attributes[place]!, type, shape));
  return { ...shape, attributes, parts };
}

function connectivityOf(header: PatchHeader, { connectivity }: PatchStreams): Connectivity {
  if (connectivity === undefined) return unconnected;
  const decode = header.topology === "lines" ? decodeLines : decodeTriangles;
  return decode(connectivity, header.elementCount, header.vertexCount);
}

function decodeAttribute(stream: Uint8Array, type: AttributeType, shape: DecodedShape): Int32Array {
  if (type.isDerived && stream.length > 0) throw new DecodeError("malformed", "holds a stream of what is derived");
  if (type.kind === "normal") return decodeNormals(stream, type, shape);
  return type.kind === "texCoord" ? decodeTexCoords(stream, type, shape) : decodeValues(stream, type, shape);
}
