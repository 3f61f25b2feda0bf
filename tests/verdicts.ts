// Holds the runtime's decoder of compact to the C++ one: reads lines of a verdict,
// a tab and a path, as fuzz/compact_verdicts prints them, and fails where it says
// something else of a file.

import { readFileSync } from "node:fs";
import { verdictOn } from "../web/src/decode/compact/verdict.testing.ts";

const lines = readFileSync(0, "utf8").split("\n").filter((line) => line !== "");
const differences = lines.flatMap((line) => {
  const [expected = "", path = ""] = line.split("\t");
  const verdict = String(verdictOn(readFileSync(path)));
  return verdict === expected ? [] : [`${path}: ${expected} in C++, ${verdict} in TypeScript`];
});
if (lines.length === 0) differences.push("no file was compared");
for (const difference of differences) console.error(difference);
console.error(`${lines.length} files, ${differences.length} differences`);
process.exitCode = differences.length === 0 ? 0 : 1;
