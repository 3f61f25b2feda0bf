// A decoded group of triangles or points of a level of detail (docs/formats/levels.md): on level 0 a patch; above, the
// coarse forms of the group's children, which are the segments of a base, or patches of points.

import { DecodeError } from "../decodeError.ts";
import { makeIndex } from "../indexArray.ts";
import { byVertexRole } from "../../stage/attributeRows.ts";
import type { ElementArray, VertexArray } from "../../stage/vertexArray.ts";
import { trianglesBySegment } from "./baseBuffers.ts";
import type { DecodedPatch } from "./decodedFile.ts";
import type { PatchBuffers } from "./patchBuffers.ts";

export interface LevelGroup {
  /** The triangles, or points, are in the order of the segments. */
  readonly buffers: PatchBuffers;
  /** The first element of each segment, and at the end the number of elements. A patch counts as one segment. */
  readonly segmentStarts: Int32Array;
  /** Whether the file holds a base; undefined for points, of which one segment is a patch as any other. */
  readonly hasSegments: boolean | undefined;
}

/** `patches`: all of the file. Throws DecodeError for lines, and for several patches of triangles. */
export function groupOf(patches: readonly DecodedPatch[]): LevelGroup {
  const [first, ...others] = patches;
  if (first === undefined) throw new DecodeError("malformed", "holds no group");
  if (first.buffers.topology === "points") return groupOfPoints(patches.map(({ buffers }) => buffers));
  if (others.length > 0) throw new DecodeError("malformed", `holds ${patches.length} patches of triangles`);
  return groupOfTriangles(first);
}

function groupOfTriangles({ buffers, segments }: DecodedPatch): LevelGroup {
  const { index, topology, vertexCount } = buffers;
  if (topology !== "triangles" || index === undefined) throw new DecodeError("malformed", `holds ${topology}`);
  if (segments === undefined) return { buffers, segmentStarts: Int32Array.of(0, index.length / 3), hasSegments: false };
  const { firsts, triangles } = trianglesBySegment(segments.segment, segments.segmentCount);
  const sorted = makeIndex(vertexCount, index.length);
  for (const [to, from] of triangles.entries())
    for (let corner = 0; corner < 3; ++corner) sorted[3 * to + corner] = index[3 * from + corner]!;
  return { buffers: { ...buffers, index: sorted }, segmentStarts: firsts, hasSegments: true };
}

function groupOfPoints(patches: readonly PatchBuffers[]): LevelGroup {
  const starts = [0];
  for (const { vertexCount } of patches) starts.push(starts.at(-1)! + vertexCount);
  return { buffers: joinedPoints(patches), segmentStarts: Int32Array.from(starts), hasSegments: undefined };
}

/** The points of all patches, one patch after the other. Throws DecodeError where they are not stored alike. */
function joinedPoints(patches: readonly PatchBuffers[]): PatchBuffers {
  const first = patches[0]!;
  if (patches.length === 1) return first;
  for (const { topology, positionBits, others } of patches)
    if (
      topology !== "points" ||
      positionBits !== first.positionBits ||
      others.some(({ bits }, i) => bits !== first.others[i]?.bits)
    )
      throw differs();
  return {
    topology: "points",
    positionBits: first.positionBits,
    vertexCount: patches.reduce((sum, { vertexCount }) => sum + vertexCount, 0),
    index: undefined,
    coord: joinedVertices(patches.map(({ coord }) => coord))!,
    attributes: byVertexRole((role) => joinedVertices(patches.map(({ attributes }) => attributes[role]))),
    others: first.others.map(({ bits }, i) => ({
      bits,
      vertices: joinedVertices(patches.map(({ others }) => others[i]?.vertices)) ?? absent(),
    })),
  };
}

function joinedVertices(parts: readonly (VertexArray | undefined)[]): VertexArray | undefined {
  const [first] = parts;
  const present = parts.filter((part) => part !== undefined);
  if (present.length !== parts.length && present.length > 0) throw differs();
  if (first === undefined) return undefined;
  const { components, stride, offset, array } = first;
  for (const part of present)
    if (part.array.constructor !== array.constructor || part.components !== components || part.stride !== stride)
      throw differs();
  const length = present.reduce((sum, part) => sum + part.array.length, 0);
  const joined = new (array.constructor as new (length: number) => ElementArray)(length);
  let at = 0;
  for (const part of present) {
    joined.set(part.array, at);
    at += part.array.length;
  }
  return { array: joined, components, stride, offset };
}

function differs(): DecodeError {
  return new DecodeError("malformed", "holds patches of points with different attributes");
}

function absent(): never {
  throw differs();
}
