// Compares the runtime's decoder of compact with the C++ decoder, and generates damaged files for both.

import { execFileSync } from "node:child_process";
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { DecodeError } from "../web/src/decode/decodeError.ts";
import { payloadOf } from "../web/src/decode/compact/payload.ts";
import { TestRandom } from "../web/src/decode/compact/rangeEncoder.testing.ts";
import { verdictOn } from "../web/src/decode/compact/verdict.testing.ts";

const compactVerdicts = join(import.meta.dirname, "../build/fuzz/compact_verdicts");

/** What fuzz/compact_verdicts prints of the files in some folders: a line for each. */
export function verdictLines(folders: string[]): string {
  return execFileSync(compactVerdicts, folders, { encoding: "utf8", maxBuffer: Infinity });
}

/** Verdict on a payload, or on the image whose pixels are the payload. */
async function verdictOnFile(path: string): Promise<string> {
  const bytes = new Uint8Array(readFileSync(path));
  try {
    return String(verdictOn(path.endsWith(".png") ? await payloadOf(bytes) : bytes));
  } catch (error) {
    if (error instanceof DecodeError) return error.kind;
    throw error;
  }
}

/** Compares verdicts. `output` holds lines of fuzz/compact_verdicts: a verdict, a tab and a path. */
export async function differencesIn(output: string): Promise<{ count: number; differences: string[] }> {
  const lines = output.split("\n").filter((line) => line !== "");
  const differences: string[] = [];
  for (const line of lines) {
    const [expected = "", path = ""] = line.split("\t");
    const verdict = await verdictOnFile(path);
    if (verdict !== expected) differences.push(`${path}: ${expected} in C++, ${verdict} in TypeScript`);
  }
  return { count: lines.length, differences };
}

/** Writes `count` files of a corpus with a few bytes changed, moved, or cut off; the same seed gives the same files. */
export function writeMutants(directory: string, corpus: string, count: number, seed: number): void {
  const files = readdirSync(corpus)
    .sort()
    .map((name) => readFileSync(join(corpus, name)));
  const random = new TestRandom(seed);
  const any = () => files[random.below(files.length)] ?? new Uint8Array();
  for (let n = 0; n < count; ++n) {
    let bytes = Uint8Array.from(any());
    for (let edit = random.below(5); edit >= 0; --edit) bytes = damaged(bytes, any(), random);
    writeFileSync(join(directory, `${n}.bin`), bytes);
  }
}

/** A copy with a byte changed, moved, or cut off, or with the end of another file. */
export function damaged(
  bytes: Uint8Array<ArrayBuffer>,
  other: Uint8Array,
  random: TestRandom,
): Uint8Array<ArrayBuffer> {
  if (bytes.length === 0) return bytes;
  // Half of the positions are among the first 64 bytes, where headers are.
  const at = random.below(random.below(2) === 0 ? Math.min(bytes.length, 64) : bytes.length);
  const put = (byte: number) => bytes.with(at, byte);
  switch (random.below(8)) {
    case 0:
      return bytes.slice(0, at);
    case 1:
      return Uint8Array.from([...bytes.subarray(0, at), ...other.subarray(Math.min(at, other.length))]);
    case 2:
      return Uint8Array.from([...bytes.subarray(0, at), random.below(256), ...bytes.subarray(at)]);
    case 3:
      return Uint8Array.from([...bytes.subarray(0, at), ...bytes.subarray(at + 1)]);
    case 4:
      return put([0, 1, 127, 128, 255][random.below(5)] ?? 0);
    case 5:
      return put((bytes[at] ?? 0) ^ (1 << random.below(8)));
    default:
      return put(random.below(256));
  }
}
