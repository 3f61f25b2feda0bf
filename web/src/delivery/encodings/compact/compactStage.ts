// Stages of SIG compact. One file holds patches of one or more geometries, which a worker decodes together; another
// holds base meshes, whose segments stand in for the patches until these have loaded.

import type { OtherValues, PatchBuffers } from "../../../decode/compact/patchBuffers.ts";
import { drawnPrimitives } from "../../../decode/drawnPrimitives.ts";
import { DecodeError } from "../../../decode/decodeError.ts";
import type { Deformation } from "../../../stage/deformation.ts";
import type { BufferStage, StageName, StatedDrawRange } from "../../../stage/stage.ts";
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
import { DeformationCollector } from "../../deformationCollector.ts";

export function compactStageBuilder(
  geometry: GeometryDescription,
  patch: PatchDescription,
  patchIndex: number,
  { storeBytes }: Pick<BuilderTools, "storeBytes">,
): StageBuilder {
  const uploads = new ArrayUploads(storeBytes);
  let baseStage: BufferStage | undefined;
  let fullStage: BufferStage | undefined;
  const collector = new DeformationCollector(geometry);
  const store = async (
    name: StageName,
    buffers: PatchBuffers,
    statedDraws: readonly StatedDrawRange[],
    signal: AbortSignal,
  ): Promise<BufferStage> => {
    const stage = await storeBuffers(uploads, buffers, geometry, name, statedDraws, signal);
    return name === "full" ? { ...stage, deformation: deformationIn(buffers, geometry, collector) } : stage;
  };
  const retire = (stage: BufferStage | undefined) => {
    if (stage !== undefined) retireBuffers(uploads, stage);
  };
  const drop = (role: string) => {
    retire(role === "base" ? baseStage : fullStage);
    if (role === "base") baseStage = undefined;
    else fullStage = undefined;
  };
  return {
    isDivisible: true,
    async accept(file, content, signal) {
      const { reference } = file;
      if (content.kind === "bases") {
        const segments = patchAt(content.bases, reference);
        if (segments.length !== geometry.patches.length) {
          throw new DecodeError(
            "malformed",
            `holds ${segments.length} segments for ${geometry.patches.length} patches`,
          );
        }
        const buffers = segments[patchIndex];
        if (buffers) checkBits(buffers, geometry);
        const draws: StatedDrawRange[] = [{ primitive: "triangles", first: 0, count: buffers?.index?.length ?? 0 }];
        baseStage = buffers && (await store("base", buffers, draws, signal));
      } else if (content.kind === "patches") {
        const buffers = patchAt(content.patches, reference);
        checkAgainstDocument(buffers, geometry, patch);
        fullStage = await store("full", buffers, drawRangesOf(patch), signal);
      } else {
        throw new DecodeError("malformed", "is no file of compact");
      }
    },
    stage: () => fullStage ?? baseStage,
    get storedBytes() {
      return uploads.byteLength + collector.byteLength;
    },
    drop: (file) => {
      drop(file.role);
    },
    clear() {
      drop("base");
      drop("patch");
    },
    sweep: () => {
      uploads.sweep();
    },
  };
}

/** Uploads the arrays of decoded triangles, lines or points. Rejects with the signal's reason. */
export async function storeBuffers(
  uploads: ArrayUploads,
  buffers: PatchBuffers,
  geometry: GeometryDescription,
  name: StageName,
  statedDraws: readonly StatedDrawRange[],
  signal: AbortSignal,
): Promise<BufferStage> {
  const { coord, attributes } = buffers;
  const { index, draws } = drawnPrimitives(buffers.index, statedDraws, geometry.ccw);
  const value = geometry.value && valuesOf(buffers, geometry, geometry.value);
  const [storedIndex, storedCoord, storedAttributes, storedValue] = await Promise.all([
    index && uploads.storeIndex(index, signal),
    uploads.storeVertices(coord, signal),
    uploads.storeAttributes(attributes, signal),
    value && uploads.storeVertices(value.vertices, signal),
  ]);
  return {
    kind: "buffers",
    vertexCount: buffers.vertexCount,
    name,
    draws,
    normalFormat: { kind: "vector" },
    index: storedIndex,
    coord: storedCoord,
    attributes: storedAttributes,
    value: value && storedValue && { ...storedValue, maxStored: 2 ** value.bits - 1 },
  };
}

/** Retires the arrays of a stage from `storeBuffers`. */
export function retireBuffers(uploads: ArrayUploads, { index, coord, attributes, value }: BufferStage): void {
  uploads.retire(index, coord, ...Object.values(attributes), value);
}

/** The patch or base mesh that a reference names, of those decoded from its file. */
function patchAt<Decoded>(decoded: readonly Decoded[], reference: Reference): Decoded {
  const patchIndex = "patchIndex" in reference ? reference.patchIndex : 0;
  const patch = decoded[patchIndex];
  if (patch === undefined)
    throw new DecodeError("malformed", `holds ${decoded.length} patches, of which none has number ${patchIndex}`);
  return patch;
}

/** What moves the vertices of a whole patch. */
function deformationIn(
  buffers: PatchBuffers,
  geometry: GeometryDescription,
  collector: DeformationCollector,
): Deformation | undefined {
  geometry.deformation?.attributes.forEach((attribute, n) => {
    const values = valuesOf(buffers, geometry, attribute);
    if (values === undefined) throw new DecodeError("malformed", `lacks the attribute "${attribute.name}"`);
    const maxStored = 2 ** values.bits - 1;
    const step = attribute.size.map((size) => size / maxStored);
    collector.add(n, { vertices: values.vertices, min: attribute.min, step }, buffers.vertexCount);
  });
  return collector.deformation;
}

/** The values of the attribute that colours the geometry; undefined in a base mesh without them. */
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

/**
 * Throws unless a decoded patch has the counts, bits and primitives that the document states: its draws rely on them.
 */
function checkAgainstDocument(
  buffers: PatchBuffers,
  geometry: GeometryDescription,
  { vertexCount, draws }: PatchDescription,
): void {
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
  const cornerCount = buffers.index?.length ?? buffers.vertexCount;
  const [draw, ...others] = draws;
  if (others.length > 0 || draw?.primitive !== buffers.topology || draw.count !== cornerCount) {
    throw new DecodeError(
      "malformed",
      `draws ${cornerCount} corners of ${buffers.topology}, other than the document states`,
    );
  }
}

/** Throws DecodeError where positions have other bits than the geometry states. */
export function checkBits({ positionBits }: PatchBuffers, geometry: GeometryDescription): void {
  const statedBits = latticeBitsOf(geometry);
  if (positionBits !== statedBits)
    throw new DecodeError("malformed", `has positions of ${positionBits} bits where the node states ${statedBits}`);
}
