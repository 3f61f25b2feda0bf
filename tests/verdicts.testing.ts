// What the runtime's decoder of compact says of files, beside what the C++ one said.

import { readFileSync } from "node:fs";
import { DecodeError } from "../web/src/decode/decodeError.ts";
import { payloadOf } from "../web/src/decode/compact/jobs.ts";
import { verdictOn } from "../web/src/decode/compact/verdict.testing.ts";

/** Of a payload, or of the image that has it as its pixels. */
async function verdictOnFile(path: string): Promise<string> {
  const bytes = new Uint8Array(readFileSync(path));
  try {
    return String(verdictOn(path.endsWith(".png") ? await payloadOf(bytes) : bytes));
  } catch (error) {
    if (error instanceof DecodeError) return error.kind;
    throw error;
  }
}

/** Of lines as fuzz/compact_verdicts prints them: a verdict, a tab and a path. */
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
