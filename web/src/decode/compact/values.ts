// Decodes colours and other values. Each is predicted from the mean of two neighbours or a parallelogram, as the
// encoder chose (docs/formats/compact.md, "Colours and others").

import { DecodeError } from "../decodeError.ts";
import { choiceModels, firstModels, repeatModel, secondModels } from "./attributeModels.ts";
import type { AttributeType } from "./header.ts";
import type { DecodedShape } from "./neighbours.ts";
import { decodeRepeats, Neighbours } from "./neighbours.ts";
import type { RangeDecoder } from "./rangeDecoder.ts";
import { bitLength, numberModelCount } from "./rangeDecoder.ts";

/** `components` of each wedge, each 0 … 2^bits - 1. Safe for untrusted bytes. Throws DecodeError. */
export function decodeValues(decoder: RangeDecoder, type: AttributeType, shape: DecodedShape): Int32Array {
  const repeats = decodeRepeats(decoder, repeatModel, shape.wedges);
  const previous = shape.wedges.seams?.previous;
  const { components } = type;
  const values = new Int32Array(components * shape.header.wedgeCount);
  const valueDecoder = new ValueDecoder(decoder, type, shape, values);
  for (let w = 0; w < shape.header.wedgeCount; ++w) {
    if (repeats.length > 0 && repeats[w] === 1) {
      const first = components * previous![w]!;
      values.copyWithin(components * w, first, first + components);
    } else {
      valueDecoder.decode(w);
    }
  }
  return values;
}

class ValueDecoder {
  readonly #decoder: RangeDecoder;
  readonly #isColor: boolean;
  readonly #components: number;
  readonly #maxStored: number;
  readonly #values: Int32Array;
  readonly #neighbours: Neighbours;
  #lastChoice = 0;

  constructor(
    decoder: RangeDecoder,
    { kind, components, bits }: AttributeType,
    shape: DecodedShape,
    values: Int32Array,
  ) {
    this.#decoder = decoder;
    this.#isColor = kind === "color";
    this.#components = components;
    this.#maxStored = 2 ** bits - 1;
    this.#values = values;
    this.#neighbours = new Neighbours(shape);
  }

  decode(w: number): void {
    const decoder = this.#decoder;
    const neighbours = this.#neighbours;
    neighbours.find(w);
    // The encoder chooses between two candidates only where both exist.
    const isParallelogram = neighbours.o >= 0 && decoder.bit(choiceModels + (2 * 4 + this.#lastChoice) * 2) === 0;
    this.#lastChoice = Number(isParallelogram);
    let first = 0;
    let length = 0;
    for (let j = 0; j < this.#components; ++j) {
      // Green is decoded first; the predictions of red and blue include its residual.
      const component = this.#isColor && j < 2 ? 1 - j : j;
      const expected = Math.min(Math.max(this.#predict(w, component, isParallelogram), 0), this.#maxStored);
      const residual = decoder.signed(
        j === 0 ? firstModels : secondModels + numberModelCount * (31 * (j - 1) + length),
      );
      length = bitLength(Math.abs(residual));
      if (j === 0) first = residual;
      const value = expected + residual + (this.#isColor && (j === 1 || j === 2) ? first : 0);
      if (value < 0 || value > this.#maxStored)
        throw new DecodeError("malformed", "holds a value that its bits cannot hold");
      this.#values[this.#components * w + component] = value;
    }
  }

  #predict(w: number, component: number, isParallelogram: boolean): number {
    const { a, b, o } = this.#neighbours;
    const values = this.#values;
    const at = (wedge: number) => values[this.#components * wedge + component]!;
    if (a >= 0 && b >= 0) return isParallelogram ? at(a) + at(b) - at(o) : (at(a) + at(b)) >> 1;
    if (a >= 0 || b >= 0) return at(a >= 0 ? a : b);
    return w > 0 ? at(w - 1) : (this.#maxStored + 1) / 2;
  }
}
