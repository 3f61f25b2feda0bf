// The patches of a file in integers, exactly what it holds: docs/formats/compact.md.

import type { Connectivity } from "./connectivity.ts";
import { unconnected } from "./connectivity.ts";
import { decodeTriangles } from "./conquest.ts";
import { readFileHeader } from "./header.ts";
import { decodeLines } from "./lines.ts";
import type { DecodedShape } from "./neighbours.ts";
import { decodeNormals, deriveNormals } from "./normals.ts";
import type { Segments } from "./segments.ts";
import { decodeSegments } from "./segments.ts";
import { decodePositions } from "./positions.ts";
import type { PatchHeader, SizedPatch } from "./sizes.ts";
import { decodeSizes } from "./sizes.ts";
import { StreamDecoders } from "./streams.ts";
import { decodeTexCoords } from "./texCoords.ts";
import { decodeValues } from "./values.ts";
import type { Wedges } from "./wedges.ts";
import { decodeWedges } from "./wedges.ts";

export interface CompactPatch extends DecodedShape {
  /** In the order of the header's attributes: its components of each wedge. */
  readonly attributes: readonly Int32Array[];
  /** Of a base. */
  readonly segments: Segments | undefined;
}

/**
 * What `take` makes of each patch of a payload, decoded in time linear in counts that are
 * limited. Safe for untrusted bytes. Throws DecodeError.
 */
export function decodePatches<Taken>(payload: Uint8Array, take: (patch: CompactPatch) => Taken): Taken[] {
  const { header, streams } = readFileHeader(payload);
  const sizes = decodeSizes(streams.sizes, header);
  const decoders = new StreamDecoders(streams);
  const taken = sizes.map((patch) => take(decodePatch(patch, decoders)));
  decoders.finish();
  return taken;
}

function decodePatch({ header, type }: SizedPatch, streams: StreamDecoders): CompactPatch {
  const connectivity = connectivityOf(header, streams);
  const parts = type.isBase ? decodeSegments(streams.segments, header, connectivity) : undefined;
  const positions = decodePositions(streams.positions, header, connectivity, parts);
  const wedges: Wedges =
    header.wedgeCount > header.vertexCount
      ? decodeWedges(streams.wedges, header, connectivity)
      : { wedge: connectivity.vertex, seams: undefined };
  const shape: DecodedShape = { header, connectivity, wedges, ...positions };
  return {
    ...shape,
    attributes: type.attributes.map((place, i) => decodeAttribute(place, i, shape, streams)),
    segments: parts,
  };
}

function connectivityOf({ topology, elementCount, vertexCount }: PatchHeader, streams: StreamDecoders): Connectivity {
  if (topology === "points") return unconnected;
  const decode = topology === "lines" ? decodeLines : decodeTriangles;
  return decode(streams.connectivity, elementCount, vertexCount);
}

/** The patch's attribute number i, which is that at a place of the file's. */
function decodeAttribute(place: number, i: number, shape: DecodedShape, streams: StreamDecoders): Int32Array {
  const type = shape.header.attributes[i]!;
  if (type.isDerived) return deriveNormals(type, shape);
  const decoder = streams.attribute(place);
  if (type.kind === "normal") return decodeNormals(decoder, type, shape);
  return type.kind === "texCoord" ? decodeTexCoords(decoder, type, shape) : decodeValues(decoder, type, shape);
}
