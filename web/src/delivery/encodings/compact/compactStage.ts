// SIG compact: one file holds all of a patch, and of others, which a worker decodes
// together, and another coarse shapes of all patches, whose parts stand in for them
// until they are here.

import type { OtherValues, PatchBuffers } from "../../../decode/compact/patchBuffers.ts";
import type { VertexArray } from "../../../stage/vertexArray.ts";
import { DecodeError } from "../../../decode/decodeError.ts";
import type { BufferStage, DrawRange, StageName } from "../../../stage/stage.ts";
import type {
  AttributeDescription,
  GeometryDescription,
  PatchDescription,
  Reference,
} from "../../../document/description.ts";
import { latticeBitsOf } from "../../../document/encodings.ts";
import { ArrayUploads } from "../../arrayUploads.ts";
import type { BuilderTools, StageBuilder } from "../../stageBuilder.ts";
import { drawRangesOf } from "../../stageBuilder.ts";

export function compactStageBuilder(
  geometry: GeometryDescription,
  patch: PatchDescription,
  place: number,
  { storeBytes }: Pick<BuilderTools, "storeBytes">,
): StageBuilder {
  const holdings = new ArrayUploads(storeBytes);
  let standIn: BufferStage | undefined;
  let full: BufferStage | undefined;
  const store = async (
    name: StageName,
    buffers: PatchBuffers,
    draws: readonly DrawRange[],
    signal: AbortSignal,
  ): Promise<BufferStage> => {
    const { index, coord, normal, color, texCoord } = buffers;
    const value = geometry.value && valuesOf(buffers, geometry, geometry.value);
    const some = (array: VertexArray | undefined) => array && holdings.storeVertices(array, signal);
    const [ownIndex, ownCoord, ownNormal, ownColor, ownTexCoord, ownValue] = await Promise.all([
      index && holdings.storeIndex(index, signal),
      holdings.storeVertices(coord, signal),
      some(normal),
      some(color),
      some(texCoord),
      some(value?.vertices),
    ]);
    return {
      kind: "buffers",
      vertexCount: buffers.vertexCount,
      name,
      draws,
      normalCode: { kind: "vector" },
      index: ownIndex,
      coord: ownCoord,
      normal: ownNormal,
      color: ownColor,
      texCoord: ownTexCoord,
      value: value && ownValue && { ...ownValue, maxStored: 2 ** value.bits - 1 },
    };
  };
  const retire = (stage: BufferStage | undefined) => {
    holdings.retire(stage?.index, stage?.coord, stage?.normal, stage?.color, stage?.texCoord, stage?.value);
  };
  const drop = (role: string) => {
    retire(role === "base" ? standIn : full);
    if (role === "base") standIn = undefined;
    else full = undefined;
  };
  return {
    isDivisible: true,
    async accept(part, content, signal) {
      const { reference } = part;
      if (content.kind === "bases") {
        const parts = patchAt(content.bases, reference);
        if (parts.length !== geometry.patches.length) {
          throw new DecodeError("malformed", `holds ${parts.length} parts for ${geometry.patches.length} patches`);
        }
        const buffers = parts[place];
        if (buffers) checkBits(buffers, geometry);
        const draws: DrawRange[] = [{ primitive: "triangles", first: 0, count: buffers?.index?.length ?? 0 }];
        standIn = buffers && (await store("base", buffers, draws, signal));
      } else if (content.kind === "patches") {
        const buffers = patchAt(content.patches, reference);
        check(buffers, geometry, patch);
        full = await store("full", buffers, drawRangesOf(patch), signal);
      } else {
        throw new DecodeError("malformed", "is no file of compact");
      }
    },
    stage: () => full ?? standIn,
    get storedBytes() {
      return holdings.byteLength;
    },
    drop: (part) => {
      drop(part.role);
    },
    clear() {
      drop("base");
      drop("patch");
    },
    sweep: () => {
      holdings.sweep();
    },
  };
}

/** The patch, or the base mesh, of a file that a reference names. */
function patchAt<Decoded>(decoded: readonly Decoded[], reference: Reference): Decoded {
  const patchIndex = "patchIndex" in reference ? reference.patchIndex : 0;
  const patch = decoded[patchIndex];
  if (patch === undefined)
    throw new DecodeError("malformed", `holds ${decoded.length} patches, of which none has number ${patchIndex}`);
  return patch;
}

/** Those of the attribute that colours the geometry; undefined in a base that is without. */
function valuesOf(
  { others }: PatchBuffers,
  { attributes }: GeometryDescription,
  attribute: AttributeDescription,
): OtherValues | undefined {
  const values = others[attributes.indexOf(attribute)];
  if (values !== undefined && values.vertices.components !== attribute.components) {
    throw new DecodeError(
      "malformed",
      `has ${values.vertices.components} numbers where "${attribute.name}" has ${attribute.components}`,
    );
  }
  return values;
}

/** What the document says of a patch must be what its file holds: drawing goes by it. */
function check(buffers: PatchBuffers, geometry: GeometryDescription, { vertexCount, draws }: PatchDescription): void {
  checkBits(buffers, geometry);
  if (geometry.value && valuesOf(buffers, geometry, geometry.value)?.bits !== geometry.value.bits) {
    throw new DecodeError("malformed", `holds other values of "${geometry.value.name}" than the document states`);
  }
  if (vertexCount !== 0 && vertexCount !== buffers.vertexCount) {
    throw new DecodeError(
      "malformed",
      `holds ${buffers.vertexCount} vertices where the document states ${vertexCount}`,
    );
  }
  const corners = buffers.index?.length ?? buffers.vertexCount;
  const [draw, ...others] = draws;
  if (others.length > 0 || draw?.primitive !== buffers.topology || draw.count !== corners) {
    throw new DecodeError(
      "malformed",
      `draws ${corners} corners of ${buffers.topology}, other than the document states`,
    );
  }
}

function checkBits({ positionBits }: PatchBuffers, geometry: GeometryDescription): void {
  const stated = latticeBitsOf(geometry);
  if (positionBits !== stated)
    throw new DecodeError("malformed", `has positions of ${positionBits} bits where the node states ${stated}`);
}
