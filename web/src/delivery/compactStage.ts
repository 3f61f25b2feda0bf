// SIG compact: one file holds all of a patch, which a worker decodes.

import type { PatchBuffers } from "../decode/compact/patchBuffers.ts";
import { readPatchHeader } from "../decode/compact/header.ts";
import { DecodeError } from "../decode/decodeError.ts";
import type { BufferStage, VertexArray } from "../decode/stage.ts";
import type { GeometryDescription, PatchDescription } from "../document/description.ts";
import { latticeBitsOf } from "../document/storedFrame.ts";
import { Holdings } from "./holdings.ts";
import type { BuilderTools, StageBuilder } from "./stageBuilder.ts";
import { drawRangesOf } from "./stageBuilder.ts";

export function compactBuilder(geometry: GeometryDescription, patch: PatchDescription, { runJob, storeBytes }: BuilderTools): StageBuilder {
  const holdings = new Holdings(storeBytes);
  let stage: BufferStage | undefined;
  return {
    isDivisible: false,
    async accept(part, content, signal) {
      if (content.kind !== "payload") throw new DecodeError("malformed", "is no file of compact");
      const { first } = part.reference;
      const { end } = readPatchHeader(content.bytes, first);
      const buffers = await runJob("compactPatch", content.bytes.slice(first, end), signal);
      check(buffers, geometry, patch);
      const { index, coord, normal, color } = buffers;
      const store = (array: VertexArray | undefined) => array && holdings.storeVertices(array, signal);
      stage = {
        kind: "buffers", name: "full", draws: drawRangesOf(patch), normalCode: { kind: "vector" },
        index: index && await holdings.storeIndex(index, signal),
        coord: await holdings.storeVertices(coord, signal), normal: await store(normal), color: await store(color),
      };
    },
    stage: () => stage,
    get storedBytes() { return holdings.byteLength; },
    drop: () => undefined,
    clear() {
      holdings.retire(stage?.index, stage?.coord, stage?.normal, stage?.color);
      stage = undefined;
    },
    sweep: () => { holdings.sweep(); },
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
