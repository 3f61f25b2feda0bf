// BG: typed arrays of index, coordinates, normals and colours.

import { DecodeError } from "../decode/decodeError.ts";
import type { ElementRange } from "../decode/elements.ts";
import { countIn, indexArrayOf, vertexArrayOf } from "../decode/elements.ts";
import type { BufferStage, DrawRange, IndexArray, VertexArray } from "../decode/stage.ts";
import { withoutStrips } from "../decode/strips.ts";
import type { GeometryDescription, PatchDescription, Reference } from "../document/description.ts";
import { hasNormalsInCoords } from "../document/geometry.ts";
import type { PartRole } from "./parts.ts";
import { componentsOf } from "./parts.ts";
import type { StageBuilder } from "./stageBuilder.ts";
import { drawRangesOf, normalCodeOf, stageNameOf } from "./stageBuilder.ts";

export function bgBuilder(geometry: GeometryDescription, patch: PatchDescription): StageBuilder {
  const here: { index?: IndexArray; coord?: VertexArray; normal?: VertexArray; color?: VertexArray } = {};
  let drawn: { index: IndexArray; draws: readonly DrawRange[] } | undefined;
  const normalCode = normalCodeOf(geometry);
  let vertexCount = patch.vertexCount;

  return {
    accept(part, content) {
      if (content.kind !== "bytes" || part.role === "patch") throw new DecodeError("malformed", "is no typed array");
      const range = rangeOf(geometry, patch, part.role, part.reference);
      if (part.role === "index") {
        // A document that does not tell the number of vertices leaves this to WebGL's own bounds.
        here.index = indexArrayOf(content.bytes, range, patch.vertexCount || 2 ** 32);
        drawn = withoutStrips(here.index, drawRangesFor(patch, here.index.length));
        return;
      }
      const vertices = vertexArrayOf(content.bytes, range);
      here[part.role] = vertices;
      if (part.role !== "coord") return;
      vertexCount ||= countIn(content.bytes.byteLength, range);
      if (hasNormalsInCoords(geometry, patch)) here.normal = fourthElementOf(vertices);
    },

    stage(): BufferStage | undefined {
      const { coord, normal, color } = here;
      if (coord === undefined) return undefined;
      const name = stageNameOf(patch, { index: here.index, normal, color, coord: [coord] });
      const unindexed = () => name === "points" ? [{ primitive: "points", first: 0, count: vertexCount } as const]
        : drawRangesFor(patch, vertexCount);
      // Strips without an index get one, since buffers are drawn as separate triangles.
      const shown = drawn ?? withoutStrips(undefined, unindexed());
      return { kind: "buffers", name, index: shown.index, draws: shown.draws, coord, normal, normalCode, color };
    },
  };
}

/** Of 16-bit coordinates, where it holds the normal as a word of two bytes. */
function fourthElementOf({ array, stride, offset }: VertexArray): VertexArray {
  if (offset + 3 >= stride) throw new DecodeError("malformed", "has no fourth element in its records");
  return { array, components: 1, stride, offset: offset + 3 };
}

/** X3DOM's rule: a vertexCount of 0 means all there are. */
function drawRangesFor(patch: PatchDescription, available: number): readonly DrawRange[] {
  const draws = drawRangesOf(patch);
  const only = draws.length === 1 ? draws[0] : undefined;
  if (only?.count === 0) return [{ ...only, count: available }];
  const wanted = draws.reduce((sum, draw) => sum + draw.count, 0);
  if (wanted > available) throw new DecodeError("truncated", `holds ${available} of ${wanted} indices`);
  return draws;
}

function rangeOf(geometry: GeometryDescription, patch: PatchDescription, role: PartRole,
                 reference: Reference): ElementRange {
  return {
    type: geometry[`${role}Type`],
    byteOffset: reference.first,
    byteStride: reference.stride,
    components: componentsOf(geometry, role),
    count: role === "index" ? patch.draws.reduce((sum, draw) => sum + draw.count, 0) : patch.vertexCount,
  };
}
