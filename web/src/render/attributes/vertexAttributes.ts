// The attributes of a stage in vertex buffers, under the names that three.js gives them.

import type { BufferStage, StoredVertices } from "../../stage/stage.ts";
import { isPairCode } from "../../stage/stage.ts";

/** One attribute of a stage's vertices. */
export interface VertexAttribute {
  readonly name: string;
  readonly vertices: StoredVertices;
  /** Shaders read integers as 0 … 1 or -1 … 1, as three.js' `BufferAttribute.normalized` says. */
  readonly isNormalized: boolean;
}

export function vertexAttributesOf({
  coord,
  normal,
  normalCode,
  color,
  texCoord,
  value,
}: BufferStage): VertexAttribute[] {
  const attribute = (name: string, vertices: StoredVertices | undefined, isNormalized: boolean): VertexAttribute[] =>
    vertices ? [{ name, vertices, isNormalized: isNormalized && vertices.type !== "Float32" }] : [];
  return [
    ...attribute("position", coord, false),
    ...attribute("normal", normal, !isPairCode(normalCode)),
    ...attribute("color", color, true),
    ...attribute("vertexValue", value, false),
    ...attribute("uv", texCoord, true),
  ];
}
