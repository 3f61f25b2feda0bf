// The vertex attributes of a stage in buffers, under three.js' names; three.js has no `vertexValue`.

import { attributeRows, vertexRoles } from "../../stage/attributeRows.ts";
import type { BufferStage, GpuVertices } from "../../stage/stage.ts";
import { isPairFormat } from "../../stage/stage.ts";

/** One attribute of a stage's vertices. */
export interface VertexAttribute {
  readonly name: string;
  readonly vertices: GpuVertices;
  /** Whether shaders read integers as 0 … 1 or -1 … 1: three.js' `BufferAttribute.normalized`. */
  readonly isNormalized: boolean;
}

export function vertexAttributesOf({ coord, attributes, normalFormat, value }: BufferStage): VertexAttribute[] {
  const attribute = (name: string, vertices: GpuVertices | undefined, isNormalized: boolean): VertexAttribute[] =>
    vertices ? [{ name, vertices, isNormalized: isNormalized && vertices.type !== "Float32" }] : [];
  return [
    ...attribute("position", coord, false),
    ...vertexRoles.flatMap((role) =>
      attribute(attributeRows[role].bufferName, attributes[role], role !== "normal" || !isPairFormat(normalFormat)),
    ),
    ...attribute("vertexValue", value, false),
  ];
}
