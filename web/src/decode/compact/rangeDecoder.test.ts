import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { DecodeError } from "../decodeError.ts";
import { RangeDecoder } from "./rangeDecoder.ts";
import { TestEncoder, TestRandom } from "./rangeEncoder.testing.ts";

/** Encodes a value, and checks that the decoder reads it. */
interface Call {
  readonly encode: (encoder: TestEncoder) => void;
  readonly check: (decoder: RangeDecoder) => void;
}

/** A random call of the decoder, with random models and a value that is mostly small. */
function randomCall(random: TestRandom): Call {
  const models = 32 * random.below(4);
  const value = random.below(2 ** random.below(31));
  const signed = random.below(2) === 1 ? -value : value;
  const calls: (() => Call)[] = [
    () => ({
      encode: (encoder) => {
        encoder.bit(models + 31, value % 3 === 0);
      },
      check: (decoder) => {
        assert.equal(decoder.bit(models + 31), Number(value % 3 === 0));
      },
    }),
    () => {
      const count = random.below(31);
      const bits = value & (2 ** count - 1);
      return {
        encode: (encoder) => {
          encoder.raw(count, bits);
        },
        check: (decoder) => {
          assert.equal(decoder.raw(count), bits);
        },
      };
    },
    () => ({
      encode: (encoder) => {
        encoder.tree(models, 4, value % 16);
      },
      check: (decoder) => {
        assert.equal(decoder.tree(models, 4), value % 16);
      },
    }),
    () => ({
      encode: (encoder) => {
        encoder.number(models, value);
      },
      check: (decoder) => {
        assert.equal(decoder.number(models), value);
      },
    }),
    () => ({
      encode: (encoder) => {
        encoder.signed(models, signed);
      },
      check: (decoder) => {
        assert.ok(decoder.signed(models) === signed);
      },
    }),
    () => ({
      encode: (encoder) => {
        encoder.longSigned(models, 96 - models, signed);
      },
      check: (decoder) => {
        assert.ok(decoder.longSigned(models, 96 - models) === signed);
      },
    }),
    () => ({
      encode: (encoder) => {
        encoder.small(models, signed);
      },
      check: (decoder) => {
        assert.ok(decoder.small(models) === signed);
      },
    }),
  ];
  return calls[random.below(calls.length)]!();
}

function encoded(calls: readonly Call[]): Uint8Array<ArrayBuffer> {
  const encoder = new TestEncoder(128);
  for (const { encode } of calls) encode(encoder);
  return encoder.finish();
}

function decode(bytes: Uint8Array, calls: readonly Call[]): void {
  const decoder = new RangeDecoder(bytes, 128);
  for (const { check } of calls) check(decoder);
  decoder.finish();
}

describe("a stream", () => {
  test("returns the written values in their order", () => {
    for (let seed = 0; seed < 300; ++seed) {
      const random = new TestRandom(seed);
      const calls = Array.from({ length: random.below(400) }, () => randomCall(random));
      decode(encoded(calls), calls);
    }
  });

  test("of nearly constant bits is short, and carries run through it", () => {
    const calls = Array.from({ length: 200_000 }, (_, index): Call => ({
      encode: (encoder) => {
        encoder.bit(0, index % 997 === 0);
      },
      check: (decoder) => {
        assert.ok(decoder.bit(0) === Number(index % 997 === 0));
      },
    }));
    const bytes = encoded(calls);
    assert.ok(bytes.length < 600, `${bytes.length} bytes`);
    decode(bytes, calls);
  });

  test("is refused with one byte more or less at either end", () => {
    const refused = (error: unknown) => error instanceof DecodeError && error.kind === "malformed";
    for (const calls of [
      [],
      [1, 5, 13, 29].map((count): Call => ({
        encode: (encoder) => {
          encoder.raw(count, 1);
          encoder.bit(0, true);
        },
        check: (decoder) => {
          decoder.raw(count);
          decoder.bit(0);
        },
      })),
    ]) {
      const bytes = encoded(calls);
      decode(bytes, calls);
      for (const wrong of [
        bytes.subarray(1),
        bytes.subarray(0, -1),
        Uint8Array.from([...bytes, 0]),
        Uint8Array.from([0, ...bytes]),
      ]) {
        assert.throws(() => {
          decode(wrong, calls);
        }, refused);
      }
    }
  });

  test("ends every attempt to read beyond it", () => {
    const calls: ((decoder: RangeDecoder) => void)[] = [
      (decoder) => decoder.bit(0),
      (decoder) => decoder.raw(1),
      (decoder) => decoder.signed(0),
      (decoder) => decoder.longSigned(0, 0),
      (decoder) => decoder.small(0),
    ];
    for (const call of calls) {
      for (const byte of [0, 0x55, 0xff]) {
        const decoder = new RangeDecoder(new Uint8Array(1000).fill(byte), 32);
        assert.throws(() => {
          for (let i = 0; i < 10_000_000; ++i) call(decoder);
        }, DecodeError);
      }
    }
  });
});
