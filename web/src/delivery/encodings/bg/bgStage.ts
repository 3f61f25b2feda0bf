// Stages of BG: typed arrays of index, coordinates, normals, texture coordinates, colours and values.

import type { VertexRole } from "../../../stage/attributeRows.ts";
import { attributeRows } from "../../../stage/attributeRows.ts";
import type { Bounds } from "../../../stage/vertexArray.ts";
import { DecodeError } from "../../../decode/decodeError.ts";
import type { ElementRange } from "../../../decode/bg/bgArrays.ts";
import { boundsOf, countThatFits, indexArrayOf, vertexArrayOf } from "../../../decode/bg/bgArrays.ts";
import { byteSizeOf } from "../../../stage/elementType.ts";
import type {
  BufferStage,
  DrawRange,
  NormalFormat,
  GpuIndex,
  GpuVertices,
  StatedDrawRange,
} from "../../../stage/stage.ts";
import { drawnPrimitives } from "../../../decode/drawnPrimitives.ts";
import type { ElementType } from "../../../stage/elementType.ts";
import type { GeometryDescription, PatchDescription, Reference } from "../../../document/description.ts";
import { isPair } from "../../../document/description.ts";
import { hasNormalsInCoords, isUnbounded } from "../../../document/geometry.ts";
import { ArrayUploads } from "../../arrayUploads.ts";
import type { AttributeRole } from "../../patchFiles.ts";
import { cornerCountOf } from "../../../document/patchSizes.ts";
import { DeformationCollector } from "../../deformationCollector.ts";
import type { BuilderTools, StageBuilder } from "../../stageBuilder.ts";
import { attainedStageName, drawRangesOf } from "../../stageBuilder.ts";

interface AvailableArrays {
  index?: { readonly stored: GpuIndex | undefined; readonly draws: readonly DrawRange[] };
  coord?: GpuVertices;
  bounds?: Bounds | undefined;
  readonly attributes: Partial<Record<VertexRole, GpuVertices>>;
  value?: GpuVertices;
}

export function bgStageBuilder(
  geometry: GeometryDescription,
  patch: PatchDescription,
  { storeBytes }: BuilderTools,
): StageBuilder {
  const uploads = new ArrayUploads(storeBytes);
  let available: AvailableArrays = { attributes: {} };
  const collector = new DeformationCollector(geometry);
  const normalFormat = normalFormatOf(geometry);
  const drawsWithoutIndex = (count: number) => drawnPrimitives(undefined, drawRangesFor(patch, count), geometry.ccw);

  return {
    isDivisible: false,

    async accept(file, content, signal) {
      if (content.kind !== "bytes" || file.role === "patch" || file.role === "base")
        throw new DecodeError("malformed", "is no typed array");
      const range = rangeOf(geometry, patch, { role: file.role, plane: file.plane }, file.reference);
      const arrays = available; // `clear` replaces `available` while an upload runs
      if (file.role === "index") {
        // If the document states no vertexCount, only WebGL checks that indices are in range.
        const indices = indexArrayOf(content.bytes, range, patch.vertexCount || 2 ** 32);
        const { index, draws } = drawnPrimitives(indices, drawRangesFor(patch, indices.length), geometry.ccw);
        arrays.index = { stored: await uploads.storeIndex(index, signal), draws };
        return;
      }
      const vertices = vertexArrayOf(content.bytes, range);
      if (file.role === "deformation") {
        collector.add(file.plane, { vertices, min: [], step: [] }, patch.vertexCount);
        return;
      }
      const stored = await uploads.storeVertices(vertices, signal);
      if (file.role === "value") arrays.value = stored;
      else if (file.role !== "coord") arrays.attributes[file.role] = stored;
      if (file.role !== "coord") return;
      arrays.coord = stored;
      if (isUnbounded(geometry, patch)) arrays.bounds = boundsOf(vertices);
      if (hasNormalsInCoords(geometry, patch)) arrays.attributes.normal = fourthElementOf(stored);
      if (patch.index !== undefined) return;
      // Converted primitives without an index get one.
      const { index, draws } = drawsWithoutIndex(patch.vertexCount || countThatFits(content.bytes.byteLength, range));
      arrays.index = { stored: index && (await uploads.storeIndex(index, signal)), draws };
    },

    stage(): BufferStage | undefined {
      const { coord, bounds, attributes, value, index } = available;
      if (coord === undefined || !collector.isWhole) return undefined;
      const name = attainedStageName(patch, { index, attributes, coord: [coord], value: value ? [value] : [] });
      const points = { stored: undefined, draws: [{ primitive: "points", first: 0, count: countOf(coord) } as const] };
      const { stored, draws } = index ?? points;
      return {
        kind: "buffers",
        vertexCount: patch.vertexCount,
        name,
        index: stored,
        draws,
        coord,
        bounds,
        attributes: { ...attributes },
        normalFormat,
        value: value && { ...value, maxStored: undefined },
        deformation: collector.deformation,
      };
    },

    get storedBytes() {
      return uploads.byteLength + collector.byteLength;
    },
    drop: () => undefined,
    clear() {
      // Normals in coordinate records share the array of the coordinates.
      const { index, coord, attributes, value } = available;
      const normal = hasNormalsInCoords(geometry, patch) ? undefined : attributes.normal;
      uploads.retire(index?.stored, coord, ...Object.values({ ...attributes, normal }), value);
      available = { attributes: {} };
      collector.clear();
    },
    sweep: () => {
      uploads.sweep();
    },
  };
}

/** The fourth element of 16-bit coordinate records, which holds the normal as two bytes. */
function fourthElementOf({ bytes, type, stride, offset }: GpuVertices): GpuVertices {
  if (offset + 3 >= stride) throw new DecodeError("malformed", "has no fourth element in its records");
  return { bytes, type, components: 1, stride, offset: offset + 3 };
}

function countOf({ bytes, type, stride }: GpuVertices): number {
  return Math.floor(bytes.byteLength / byteSizeOf(type) / stride);
}

/** As in X3DOM, a vertexCount of 0 means all available vertices. */
function drawRangesFor(patch: PatchDescription, available: number): readonly StatedDrawRange[] {
  const draws = drawRangesOf(patch);
  const single = draws.length === 1 ? draws[0] : undefined;
  if (single?.count === 0) return [{ ...single, count: available }];
  const required = draws.reduce((sum, draw) => sum + draw.count, 0);
  if (required > available) throw new DecodeError("truncated", `holds ${available} of ${required} indices`);
  return draws;
}

function rangeOf(
  geometry: GeometryDescription,
  patch: PatchDescription,
  { role, plane }: { readonly role: AttributeRole; readonly plane: number },
  reference: Reference,
): ElementRange {
  if (!("byteOffset" in reference)) throw new DecodeError("malformed", "is referenced without a byte offset");
  return {
    type: elementTypeOf(geometry, role),
    byteOffset: reference.byteOffset,
    byteStride: reference.byteStride,
    components: componentsOf(geometry, role, plane),
    count: role === "index" ? cornerCountOf(patch) : patch.vertexCount,
  };
}

/** Bytes from one element to the next; 0: tightly packed. */
export function byteStrideOf(reference: Reference): number {
  return "byteStride" in reference ? reference.byteStride : 0;
}

export function elementTypeOf(geometry: GeometryDescription, role: AttributeRole): ElementType {
  return role === "value" || role === "deformation" ? "Float32" : geometry[`${role}Type`];
}

/** Number of components per element. `plane`: which attribute of the deformation. */
export function componentsOf(geometry: GeometryDescription, role: AttributeRole, plane = 0): 1 | 2 | 3 | 4 {
  switch (role) {
    case "index":
      return 1;
    case "coord":
      return 3;
    case "normal":
      return isPair(geometry.normalEncoding) ? 2 : attributeRows.normal.components;
    case "color":
      return geometry.colorComponents;
    case "value":
      return geometry.value?.components ?? 1;
    case "deformation":
      return geometry.deformation?.attributes[plane]?.components ?? 4;
    default:
      return attributeRows[role].components;
  }
}

function normalFormatOf({ normalEncoding, normalType }: GeometryDescription): NormalFormat {
  return isPair(normalEncoding) ? { kind: normalEncoding, bits: normalType === "Uint16" ? 16 : 8 } : { kind: "vector" };
}
