// SIG compact: one file holds all of a patch, which a worker decodes.

import type { PatchBuffers } from "../decode/compact/patchBuffers.ts";
import { readPatchHeader } from "../decode/compact/header.ts";
import { DecodeError } from "../decode/decodeError.ts";
import type { RunJob } from "../decode/jobs.ts";
import type { BufferStage } from "../decode/stage.ts";
import type { GeometryDescription, PatchDescription } from "../document/description.ts";
import { latticeBitsOf } from "../document/storedFrame.ts";
import type { StageBuilder } from "./stageBuilder.ts";
import { drawRangesOf } from "./stageBuilder.ts";

export function compactBuilder(geometry: GeometryDescription, patch: PatchDescription, run: RunJob, signal: AbortSignal): StageBuilder {
  let stage: BufferStage | undefined;
  return {
    async accept(part, content) {
      if (content.kind !== "payload") throw new DecodeError("malformed", "is no file of compact");
      const { first } = part.reference;
      const { end } = readPatchHeader(content.bytes, first);
      const buffers = await run("compactPatch", content.bytes.slice(first, end), signal);
      check(buffers, geometry, patch);
      const { index, coord, normal, color } = buffers;
      stage = { kind: "buffers", name: "full", index, draws: drawRangesOf(patch), coord, normal, normalCode: { kind: "vector" }, color };
    },
    stage: () => stage,
  };
}

/** What the document says of a patch must be what its file holds: drawing goes by it. */
function check(buffers: PatchBuffers, geometry: GeometryDescription, { vertexCount, draws }: PatchDescription): void {
  const { topology, positionBits, index } = buffers;
  if (positionBits !== latticeBitsOf(geometry)) {
    throw new DecodeError("malformed", `has positions of ${positionBits} bits where the node states ${latticeBitsOf(geometry)}`);
  }
  if (vertexCount !== 0 && vertexCount !== buffers.vertexCount) {
    throw new DecodeError("malformed", `holds ${buffers.vertexCount} vertices where the document states ${vertexCount}`);
  }
  const corners = index?.length ?? buffers.vertexCount;
  const [draw, ...others] = draws;
  if (others.length > 0 || draw?.primitive !== topology || draw.count !== corners) {
    throw new DecodeError("malformed", `draws ${corners} corners of ${topology}, other than the document states`);
  }
}
