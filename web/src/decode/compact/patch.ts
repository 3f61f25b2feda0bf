// Decodes the patches of a file to integers: docs/formats/compact.md.

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
  /** For each attribute of the header, the components of each wedge. */
  readonly attributes: readonly Int32Array[];
  /** Base meshes only. */
  readonly segments: Segments | undefined;
}

/**
 * Decodes the patches of a payload and returns what `take` makes of each. Takes time linear in counts that are limited.
 * Safe for untrusted bytes. Throws DecodeError.
 */
export function decodePatches<Taken>(payload: Uint8Array, take: (patch: CompactPatch) => Taken): Taken[] {
  const { header, streams } = readFileHeader(payload);
  const sizes = decodeSizes(streams.sizes, header);
  const decoders = new StreamDecoders(streams, header.version);
  const taken = sizes.map((patch) => take(decodePatch(patch, decoders)));
  decoders.finish();
  return taken;
}

function decodePatch({ header, type }: SizedPatch, streams: StreamDecoders): CompactPatch {
  const connectivity = connectivityOf(header, streams);
  const segments = type.isBase ? decodeSegments(streams.segments, header, connectivity) : undefined;
  const positions = decodePositions(streams.positions, header, connectivity, segments);
  const wedges: Wedges =
    header.wedgeCount > header.vertexCount
      ? decodeWedges(streams.wedges, header, connectivity)
      : { wedge: connectivity.vertex, seams: undefined };
  const shape: DecodedShape = { header, connectivity, wedges, ...positions };
  return {
    ...shape,
    attributes: type.attributes.map((fileIndex, i) => decodeAttribute(fileIndex, i, shape, streams)),
    segments,
  };
}

function connectivityOf({ topology, elementCount, vertexCount }: PatchHeader, streams: StreamDecoders): Connectivity {
  if (topology === "points") return unconnected;
  const decode = topology === "lines" ? decodeLines : decodeTriangles;
  return decode(streams.connectivity, elementCount, vertexCount);
}

/** Decodes attribute i of the patch, which is the attribute `fileIndex` of the file. */
function decodeAttribute(fileIndex: number, i: number, shape: DecodedShape, streams: StreamDecoders): Int32Array {
  const type = shape.header.attributes[i]!;
  if (type.isDerived) return deriveNormals(type, shape);
  const decoder = streams.attribute(fileIndex);
  if (type.kind === "normal") return decodeNormals(decoder, type, shape);
  return type.kind === "texCoord" ? decodeTexCoords(decoder, type, shape) : decodeValues(decoder, type, shape);
}
