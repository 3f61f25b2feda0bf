// Fuzzes the runtime's decoder of frames: on damaged frames, on frames whose damage the checksums hide, and on random
// bytes it returns integers in their range or throws an error of a named kind, with bounded memory and time. `make
// soak` runs it on more inputs; fuzz/frame_fuzz.cpp does the same to the C++ decoder.

import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { TestRandom } from "../web/src/decode/compact/rangeEncoder.testing.ts";
import { DecodeError } from "../web/src/decode/decodeError.ts";
import { decodeFrame } from "../web/src/decode/frame/frame.ts";
import { frameArrays } from "../web/src/decode/frame/frameArrays.ts";
import { componentRunsOf, isLayout, maxFrameVertices, unpackedBytesOf } from "../web/src/decode/frame/frameHeader.ts";
import { frameImages } from "../web/src/decode/frame/frameImages.ts";
import { withChecksum, withDamagedPlanes, type Bytes } from "./damagedFrames.testing.ts";
import { damaged } from "./verdicts.testing.ts";

/** Number of inputs; `make soak` sets more. */
const inputCount = Number(process.env.IMGEO_MUTANTS ?? 1500);
const seed = Number(process.env.IMGEO_RANDOM_SEED ?? 1);
/** Milliseconds for one input of at most a few hundred bytes, on a busy machine. */
const maxMs = 2000;

const repository = join(import.meta.dirname, "..");
const frames = ["vectors/frame-1", "fuzz/corpus/frame"].flatMap((folder) =>
  readdirSync(join(repository, folder))
    .filter((name) => name.endsWith(".igf"))
    .sort()
    .map((name) => Uint8Array.from(readFileSync(join(repository, folder, name)))),
);

function inputOf(random: TestRandom): Bytes {
  const any = () => frames[random.below(frames.length)] ?? new Uint8Array();
  switch (random.below(8)) {
    case 0:
      return Uint8Array.from({ length: random.below(300) }, () => random.below(256));
    case 1:
      return withChecksum(Uint8Array.from({ length: random.below(300) }, () => random.below(256)));
    case 2:
      return withDamagedPlanes(any(), any(), random);
    default: {
      let bytes = any();
      for (let edit = random.below(4); edit >= 0; --edit) bytes = damaged(bytes, any(), random);
      return random.below(3) === 0 ? bytes : withChecksum(bytes);
    }
  }
}

/** Number of vertices that were decoded, or the kind of the error. */
async function verdictOn(bytes: Bytes): Promise<string> {
  try {
    const { header, components } = await decodeFrame(bytes);
    const { vertices } = header;
    assert.ok(isLayout(header) && vertices <= maxFrameVertices);
    assert.ok(unpackedBytesOf(header) <= 1032 * bytes.length, "more memory than the bytes can unpack to");
    const runs = componentRunsOf(header).flatMap(({ count, bits }) => Array.from({ length: count }, () => bits));
    assert.equal(components.length, runs.length);
    components.forEach((values, component) => {
      assert.equal(values.length, vertices);
      assert.ok(values.every((value) => value < 2 ** (runs[component] ?? 0)));
    });
    const { coord } = await frameArrays({ bytes, normalSource: undefined });
    const images = await frameImages(bytes);
    assert.equal(images.coord[0]?.length, 4 * images.width * images.height);
    assert.ok(coord.array.length >= 3 * vertices);
    return "decoded";
  } catch (error) {
    if (error instanceof DecodeError) return error.kind;
    throw error;
  }
}

test("every damaged frame is refused by name or decoded to integers in their range", async () => {
  const random = new TestRandom(seed);
  const counts: Record<string, number> = {};
  for (let n = 0; n < inputCount; ++n) {
    const bytes = inputOf(random);
    const start = performance.now();
    const verdict = await verdictOn(bytes).catch((error: unknown) => {
      throw new Error(`seed ${seed}, input ${n}: ${Buffer.from(bytes).toString("hex")}`, { cause: error });
    });
    assert.ok(performance.now() - start < maxMs, `input ${n} took ${performance.now() - start} ms`);
    counts[verdict] = (counts[verdict] ?? 0) + 1;
  }
  // The inputs reach every end.
  for (const verdict of ["decoded", "truncated", "malformed", "unsupported", "limit"])
    assert.ok((counts[verdict] ?? 0) > 0, `${verdict}: ${JSON.stringify(counts)}`);
});
