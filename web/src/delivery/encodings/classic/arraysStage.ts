// The stage of buffers that the available arrays of a patch make.

import type { GeometryDescription, PatchDescription } from "../../../document/description.ts";
import { vertexRoles } from "../../../stage/attributeRows.ts";
import type { Deformation } from "../../../stage/deformation.ts";
import { byteSizeOf } from "../../../stage/elementType.ts";
import type { BufferStage, GpuValues, NormalFormat, StageName } from "../../../stage/stage.ts";
import { attainedStageName } from "../../stageBuilder.ts";
import type { AvailableArrays } from "./availableArrays.ts";
import { normalFormatOf } from "./classicFormat.ts";
import { columnsOf, planeCountOf } from "./patchImages.ts";

/** Undefined while there are no coordinates. */
export function arraysStageOf(
  geometry: GeometryDescription,
  patch: PatchDescription,
  available: AvailableArrays,
  deformation: Deformation | undefined,
): BufferStage | undefined {
  const { attributes, streamed, coordSize } = available;
  const coord = streamed?.coord ?? available.coord;
  if (coord === undefined) return undefined;
  const value = valueOf(geometry, available);
  const name = stageNameOf(patch, available, value);
  const count = coord.bytes.byteLength / byteSizeOf(coord.type) / coord.stride;
  const points = { index: undefined, draws: [{ primitive: "points", first: 0, count } as const] };
  const { index, draws } = (name === "points" ? undefined : available.indexedDraws) ?? points;
  return {
    kind: "buffers",
    vertexCount: count,
    name,
    index,
    draws,
    coord,
    coordImage: streamed ? undefined : { columns: columnsOf(patch, coordSize), grid: patch.grid },
    attributes: {
      ...attributes,
      normal: streamed?.normal ?? attributes.normal ?? available.slopeNormals,
      color: streamed?.color ?? attributes.color,
    },
    normalFormat: streamed?.normal ? streamed.normalFormat : storedFormatOf(geometry, patch, available),
    value,
    deformation,
    ...(streamed && { bounds: patch.box }),
  };
}

function stageNameOf(patch: PatchDescription, available: AvailableArrays, value: GpuValues | undefined): StageName {
  const { attributes, attributePlaneCounts } = available;
  const name = attainedStageName(patch, {
    index: available.indexedDraws,
    attributes,
    coord: Array.from({ length: available.coordPlaneCount }),
    value: value ? patch.value : [],
  });
  const isWhole = vertexRoles.every(
    (role) => attributes[role] === undefined || attributePlaneCounts[role] === planeCountOf(patch, role),
  );
  return name === "full" && !isWhole ? "shaded" : name;
}

/** Normals of several byte planes are decoded to vectors. */
function storedFormatOf(
  geometry: GeometryDescription,
  patch: PatchDescription,
  { attributes }: AvailableArrays,
): NormalFormat {
  return attributes.normal && patch.lowBytes.normal === undefined ? normalFormatOf(geometry) : { kind: "vector" };
}

function valueOf({ value }: GeometryDescription, { value: decoded, streamed }: AvailableArrays): GpuValues | undefined {
  if (value?.streamedRange !== undefined) return streamed?.value;
  return decoded && { ...decoded, maxStored: undefined };
}
