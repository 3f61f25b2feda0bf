// The decoders of a file's streams. One decoder serves all patches in turn; it is created on first use.

import { DecodeError } from "../decodeError.ts";
import { attributeModelCount } from "./attributeModels.ts";
import type { FileStreams, Version } from "./header.ts";
import { connectivityModelCount } from "./lines.ts";
import { segmentModelCount } from "./segments.ts";
import { positionModelsOf } from "./positions.ts";
import { RangeDecoder } from "./rangeDecoder.ts";
import { wedgeModelCount } from "./wedges.ts";

class Stream {
  readonly #bytes: Uint8Array;
  readonly #modelCount: number;
  #decoder: RangeDecoder | undefined;

  constructor(bytes: Uint8Array, modelCount: number) {
    this.#bytes = bytes;
    this.#modelCount = modelCount;
  }

  get decoder(): RangeDecoder {
    return (this.#decoder ??= new RangeDecoder(this.#bytes, this.#modelCount));
  }

  finish(): void {
    if (this.#decoder) this.#decoder.finish();
    else if (this.#bytes.length > 0) throw new DecodeError("malformed", "holds a stream that nothing reads");
  }
}

/** The decoders of all streams except that of the sizes. */
export class StreamDecoders {
  readonly #connectivity: Stream;
  readonly #segments: Stream;
  readonly #positions: Stream;
  readonly #wedges: Stream;
  readonly #attributes: readonly Stream[];

  constructor({ connectivity, segments, positions, wedges, attributes }: FileStreams, version: Version) {
    this.#connectivity = new Stream(connectivity, connectivityModelCount);
    this.#segments = new Stream(segments, segmentModelCount);
    this.#positions = new Stream(positions, positionModelsOf(version).count);
    this.#wedges = new Stream(wedges, wedgeModelCount);
    this.#attributes = attributes.map((stream) => new Stream(stream, attributeModelCount));
  }

  get connectivity(): RangeDecoder {
    return this.#connectivity.decoder;
  }
  get segments(): RangeDecoder {
    return this.#segments.decoder;
  }
  get positions(): RangeDecoder {
    return this.#positions.decoder;
  }
  get wedges(): RangeDecoder {
    return this.#wedges.decoder;
  }

  /** The decoder of the header's attribute with this index. */
  attribute(index: number): RangeDecoder {
    return this.#attributes[index]!.decoder;
  }

  /** To be called when all patches are decoded. Throws DecodeError where a stream holds unread bytes. */
  finish(): void {
    for (const stream of [this.#connectivity, this.#segments, this.#positions, this.#wedges, ...this.#attributes])
      stream.finish();
  }
}
