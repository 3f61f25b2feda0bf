// The vertex attributes of a stage in buffers, under three.js' names; three.js has no `vertexValue`.

import type { BufferStage, StoredVertices } from "../../stage/stage.ts";
import { isPairFormat } from "../../stage/stage.ts";

/** One attribute of a stage's vertices. */
export interface VertexAttribute {
  readonly name: string;
  readonly vertices: StoredVertices;
  /** Whether shaders read integers as 0 … 1 or -1 … 1: three.js' `BufferAttribute.normalized`. */
  readonly isNormalized: boolean;
}

export function vertexAttributesOf({
  coord,
  normal,
  normalFormat,
  color,
  texCoord,
  value,
}: BufferStage): VertexAttribute[] {
  const attribute = (name: string, vertices: StoredVertices | undefined, isNormalized: boolean): VertexAttribute[] =>
    vertices ? [{ name, vertices, isNormalized: isNormalized && vertices.type !== "Float32" }] : [];
  return [
    ...attribute("position", coord, false),
    ...attribute("normal", normal, !isPairFormat(normalFormat)),
    ...attribute("color", color, true),
    ...attribute("vertexValue", value, false),
    ...attribute("uv", texCoord, true),
  ];
}
