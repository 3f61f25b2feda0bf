// SIG compact: one file holds all of a patch, which a worker decodes, and another a
// coarse shape of all patches, whose parts stand in for them until they are here.

import type { PatchBuffers } from "../decode/compact/patchBuffers.ts";
import { readPatchHeader } from "../decode/compact/header.ts";
import { DecodeError } from "../decode/decodeError.ts";
import type { RunJob } from "../decode/jobs.ts";
import type { BufferStage, DrawRange, StageName, VertexArray } from "../decode/stage.ts";
import type { GeometryDescription, PatchDescription } from "../document/description.ts";
import { latticeBitsOf } from "../document/storedFrame.ts";
import { Holdings } from "./holdings.ts";
import type { BuilderTools, StageBuilder } from "./stageBuilder.ts";
import { drawRangesOf } from "./stageBuilder.ts";

type Payload = Uint8Array<ArrayBuffer>;
type Parts = readonly (PatchBuffers | undefined)[];

/** The base of a geometry, decoded once for all patches, and kept no longer than its payload. */
export class BaseParts {
  readonly #geometry: GeometryDescription;
  readonly #run: RunJob;
  readonly #decoded = new WeakMap<Payload, Promise<Parts>>();

  constructor(geometry: GeometryDescription, run: RunJob) {
    this.#geometry = geometry;
    this.#run = run;
  }

  /** Of each patch; undefined where a part has no triangles. */
  of(payload: Payload, first: number): Promise<Parts> {
    const parts = this.#decoded.get(payload) ?? this.#decode(payload, first);
    this.#decoded.set(payload, parts);
    return parts;
  }

  async #decode(payload: Payload, first: number): Promise<Parts> {
    const { end } = readPatchHeader(payload, first);
    // Whoever gives it up, others wait for it as well; it is a matter of milliseconds.
    const parts = await this.#run("compactBase", payload.slice(first, end), new AbortController().signal);
    const { patches } = this.#geometry;
    if (parts.length !== patches.length) {
      throw new DecodeError("malformed", `holds ${parts.length} parts for ${patches.length} patches`);
    }
    for (const part of parts) if (part) checkBits(part, this.#geometry);
    return parts;
  }
}

export function compactBuilder(geometry: GeometryDescription, patch: PatchDescription, place: number, base: BaseParts,
                               { runJob, storeBytes }: BuilderTools): StageBuilder {
  const holdings = new Holdings(storeBytes);
  let standIn: BufferStage | undefined;
  let full: BufferStage | undefined;
  const store = async (name: StageName, buffers: PatchBuffers, draws: readonly DrawRange[], signal: AbortSignal): Promise<BufferStage> => {
    const { index, coord, normal, color, texCoord } = buffers;
    const some = (array: VertexArray | undefined) => array && holdings.storeVertices(array, signal);
    const [ownIndex, ownCoord, ownNormal, ownColor, ownTexCoord] = await Promise.all([
      index && holdings.storeIndex(index, signal), holdings.storeVertices(coord, signal), some(normal), some(color), some(texCoord),
    ]);
    return {
      kind: "buffers", name, draws, normalCode: { kind: "vector" }, value: undefined,
      index: ownIndex, coord: ownCoord, normal: ownNormal, color: ownColor, texCoord: ownTexCoord,
    };
  };
  const retire = (stage: BufferStage | undefined) => { holdings.retire(stage?.index, stage?.coord, stage?.normal, stage?.color, stage?.texCoord); };
  const drop = (role: string) => {
    retire(role === "base" ? standIn : full);
    if (role === "base") standIn = undefined;
    else full = undefined;
  };
  return {
    isDivisible: true,
    async accept(part, content, signal) {
      if (content.kind !== "payload") throw new DecodeError("malformed", "is no file of compact");
      const { first } = part.reference;
      if (part.role === "base") {
        const buffers = (await base.of(content.bytes, first))[place];
        const count = buffers?.index?.length ?? 0;
        standIn = buffers && await store("base", buffers, [{ primitive: "triangles", first: 0, count }], signal);
        return;
      }
      const { end } = readPatchHeader(content.bytes, first);
      const buffers = await runJob("compactPatch", content.bytes.slice(first, end), signal);
      check(buffers, geometry, patch);
      full = await store("full", buffers, drawRangesOf(patch), signal);
    },
    stage: () => full ?? standIn,
    get storedBytes() { return holdings.byteLength; },
    drop: (part) => { drop(part.role); },
    clear() {
      drop("base");
      drop("patch");
    },
    sweep: () => { holdings.sweep(); },
  };
}

/** What the document says of a patch must be what its file holds: drawing goes by it. */
function check(buffers: PatchBuffers, geometry: GeometryDescription, { vertexCount, draws }: PatchDescription): void {
  checkBits(buffers, geometry);
  if (vertexCount !== 0 && vertexCount !== buffers.vertexCount) {
    throw new DecodeError("malformed", `holds ${buffers.vertexCount} vertices where the document states ${vertexCount}`);
  }
  const corners = buffers.index?.length ?? buffers.vertexCount;
  const [draw, ...others] = draws;
  if (others.length > 0 || draw?.primitive !== buffers.topology || draw.count !== corners) {
    throw new DecodeError("malformed", `draws ${corners} corners of ${buffers.topology}, other than the document states`);
  }
}

function checkBits({ positionBits }: PatchBuffers, geometry: GeometryDescription): void {
  const stated = latticeBitsOf(geometry);
  if (positionBits !== stated) throw new DecodeError("malformed", `has positions of ${positionBits} bits where the node states ${stated}`);
}
