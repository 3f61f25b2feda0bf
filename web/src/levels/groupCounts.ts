// Compares a decoded group with what the index of levels states of it.

import type { LevelGroup } from "../decode/compact/levelGroup.ts";
import { DecodeError } from "../decode/decodeError.ts";
import type { LevelIndex } from "./levelIndex.ts";

/** Throws DecodeError where a decoded group has other segments, elements or vertices than the index states. */
export function checkCounts(
  { buffers, segmentStarts, hasSegments }: LevelGroup,
  index: LevelIndex,
  group: number,
): void {
  const children = index.children(group).length;
  const elements = segmentStarts.at(-1) ?? 0;
  if ((buffers.topology === "points") !== index.hasPoints)
    throw new DecodeError("malformed", `holds ${buffers.topology}, other than the index of levels states`);
  const segmentCount = Math.max(children, 1);
  if ((hasSegments !== undefined && hasSegments !== children > 0) || segmentStarts.length !== segmentCount + 1)
    throw new DecodeError("malformed", `has ${segmentStarts.length - 1} segments for ${children} children`);
  const stated = index.hasPoints ? index.vertices(group) : index.triangles(group);
  if (elements !== stated || buffers.vertexCount !== index.vertices(group))
    throw new DecodeError(
      "malformed",
      `has ${elements} ${buffers.topology} of ${buffers.vertexCount} vertices, other than the index of levels states`,
    );
}
