// Decodes the connectivity of lines: docs/formats/compact.md, "Lines".

import { DecodeError } from "../decodeError.ts";
import type { Connectivity } from "./connectivity.ts";
import { unconnected } from "./connectivity.ts";
import { triangleModelCount } from "./conquest.ts";
import type { RangeDecoder } from "./rangeDecoder.ts";
import { numberModelCount } from "./rangeDecoder.ts";

// These models follow those of triangles in the same stream.
const chainModel = triangleModelCount;
const oldModels = chainModel + 1;
const vertexModels = oldModels + 2;
export const connectivityModelCount = vertexModels + numberModelCount;

/** Safe for untrusted bytes. Throws DecodeError. */
export function decodeLines(decoder: RangeDecoder, lineCount: number, vertexCount: number): Connectivity {
  const vertex = new Int32Array(2 * lineCount);
  const from = new Int32Array(vertexCount).fill(-1);
  let decodedCount = 0;

  /** Decodes one end of a line. */
  const end = (model: number): number => {
    if (decoder.bit(model) === 1) {
      const known = decodedCount - 1 - decoder.number(vertexModels);
      if (known < 0) throw new DecodeError("malformed", "names a vertex that is not decoded yet");
      return known;
    }
    if (decodedCount === vertexCount) throw new DecodeError("malformed", "holds more vertices than its header states");
    return decodedCount++;
  };

  let b = -1;
  for (let line = 0; line < lineCount; ++line) {
    const a = line > 0 && decoder.bit(chainModel) === 1 ? b : end(oldModels);
    const newVertex = decodedCount;
    b = end(oldModels + 1);
    if (b === newVertex) from[b] = a;
    vertex[2 * line] = a;
    vertex[2 * line + 1] = b;
  }
  if (decodedCount < vertexCount) throw new DecodeError("malformed", "holds fewer vertices than its header states");
  return { ...unconnected, vertex, from };
}
