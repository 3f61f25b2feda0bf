// Fuzzes the runtime's reader of sequences: on damaged indexes and files, and on files whose damage the checksums of
// their frames hide, it returns the stated number of frames with integers in their range or throws an error of a named
// kind, with bounded memory and time. `make soak` runs it on more inputs; fuzz/sequence_fuzz.cpp does the same to the C++
// reader.

import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { TestRandom } from "../web/src/decode/compact/rangeEncoder.testing.ts";
import { DecodeError } from "../web/src/decode/decodeError.ts";
import type { Frame } from "../web/src/decode/frame/frame.ts";
import type { FrameLayout } from "../web/src/decode/frame/frameHeader.ts";
import { componentRunsOf, frameHeaderBytes, isLayout, unpackedBytesOf } from "../web/src/decode/frame/frameHeader.ts";
import { framesOfFile, sequenceFrames } from "../web/src/decode/sequence/sequenceFrames.ts";
import { maxSequenceFrames, readSequenceIndex } from "../web/src/decode/sequence/sequenceIndex.ts";
import { withChecksum, withDamagedPlanes, type Bytes } from "./damagedFrames.testing.ts";
import { damaged } from "./verdicts.testing.ts";

/** Number of inputs; `make soak` sets more. */
const inputCount = Number(process.env.IMGEO_MUTANTS ?? 1500);
const seed = Number(process.env.IMGEO_RANDOM_SEED ?? 1);
/** Milliseconds for one input of at most a few thousand bytes, on a busy machine. */
const maxMs = 2000;

interface Sequence {
  readonly index: Bytes;
  readonly file: Bytes;
}

const folder = join(import.meta.dirname, "../vectors/sequence-1");
const sequences: readonly Sequence[] = readdirSync(folder)
  .filter((name) => name.endsWith(".igf"))
  .sort()
  .map((name) => ({
    index: Uint8Array.from(readFileSync(join(folder, name.replace(/igf$/, "index.json")))),
    file: Uint8Array.from(readFileSync(join(folder, name))),
  }));

/** The index with one of its numbers replaced by a large one. */
function withLargeNumber(index: Bytes, random: TestRandom): Bytes {
  const text = new TextDecoder().decode(index);
  const numbers = Array.from(text.matchAll(/\b\d+\b/g));
  const number = numbers[random.below(numbers.length)] ?? assert.fail();
  const large = ["1025", "70000", "4194305", "999999999999"][random.below(4)] ?? "";
  return new TextEncoder().encode(text.slice(0, number.index) + large + text.slice(number.index + number[0].length));
}

/** The frames of an undamaged file. */
function framesIn(file: Bytes): Bytes[] {
  const frames: Bytes[] = [];
  for (let at = 0; at < file.length;) {
    const size = new DataView(file.buffer, file.byteOffset + at).getUint32(4, true);
    frames.push(file.slice(at, at + frameHeaderBytes + size));
    at += frameHeaderBytes + size;
  }
  return frames;
}

/** The file with one frame damaged, in another place, twice, or absent. */
function withDamagedFrame(file: Bytes, other: Bytes, random: TestRandom): Bytes {
  const frames = framesIn(file);
  const at = random.below(frames.length);
  const [frame = new Uint8Array(), strange = new Uint8Array()] = [frames[at], framesIn(other)[0]];
  const replacement = (): Bytes[] => {
    switch (random.below(6)) {
      case 0:
        return [];
      case 1:
        return [frame, frame];
      case 2:
        return [strange];
      case 3:
        return [withDamagedPlanes(frame, strange, random)];
      default:
        return [withChecksum(damaged(frame, strange, random))];
    }
  };
  return Uint8Array.from([...frames.slice(0, at), ...replacement(), ...frames.slice(at + 1)].flatMap((x) => [...x]));
}

function inputOf(random: TestRandom): Sequence {
  const any = () => sequences[random.below(sequences.length)] ?? assert.fail();
  const { index, file } = any();
  switch (random.below(8)) {
    case 0:
      return { index: damaged(index, any().index, random), file };
    case 1:
      return { index: any().index, file };
    case 2:
      return { index, file: damaged(file, any().file, random) };
    case 3:
      return { index: withLargeNumber(index, random), file };
    default:
      return { index, file: withDamagedFrame(file, any().file, random) };
  }
}

/** "decoded", or the kind of the error. */
async function verdictOn({ index: indexBytes, file }: Sequence): Promise<string> {
  try {
    const index = readSequenceIndex(indexBytes);
    assert.ok(isLayout(index) && index.frameCount > 0 && index.frameCount <= maxSequenceFrames);
    const [first] = index.files;
    assert.ok(first !== undefined);
    const packed = framesOfFile(file, first, index);
    assert.equal(packed.length, first.frames);
    for (const { bytes } of packed)
      assert.ok(unpackedBytesOf(index) <= 1032 * bytes.length, "more memory than the bytes can unpack to");
    const frames = packed.map(({ bytes }) => bytes);
    const job = { frames, before: undefined, from: 0 };
    const images = await sequenceFrames({ ...job, form: { kind: "images" } });
    const arrays = await sequenceFrames({ ...job, form: { kind: "arrays", normalSource: undefined } });
    assert.deepEqual([images.frames.length, arrays.frames.length], [first.frames, first.frames]);
    assertInRange(images.last, index);
    return "decoded";
  } catch (error) {
    if (error instanceof DecodeError) return error.kind;
    throw error;
  }
}

function assertInRange(components: Frame["components"], layout: FrameLayout): void {
  const bits = componentRunsOf(layout).flatMap((run) => Array.from({ length: run.count }, () => run.bits));
  assert.equal(components.length, bits.length);
  components.forEach((values, component) => {
    assert.equal(values.length, layout.vertices);
    assert.ok(values.every((value) => value < 2 ** (bits[component] ?? 0)));
  });
}

test("every damaged sequence is refused by name or decoded to the stated frames", async () => {
  const random = new TestRandom(seed);
  const counts: Record<string, number> = {};
  for (let n = 0; n < inputCount; ++n) {
    const input = inputOf(random);
    const start = performance.now();
    const verdict = await verdictOn(input).catch((error: unknown) => {
      const [index, file] = [input.index, input.file].map((bytes) => Buffer.from(bytes).toString("hex"));
      throw new Error(`seed ${seed}, input ${n}: ${index} ${file}`, { cause: error });
    });
    assert.ok(performance.now() - start < maxMs, `input ${n} took ${performance.now() - start} ms`);
    counts[verdict] = (counts[verdict] ?? 0) + 1;
  }
  // The inputs reach every end.
  for (const verdict of ["decoded", "truncated", "malformed", "unsupported", "limit"])
    assert.ok((counts[verdict] ?? 0) > 0, `${verdict}: ${JSON.stringify(counts)}`);
});
