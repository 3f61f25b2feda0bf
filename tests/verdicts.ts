// Compares the runtime's decoder of compact with the C++ decoder: reads lines of a verdict, a tab and a path, as
// fuzz/compact_verdicts prints them, and fails where its own verdict on the file differs. `make soak` runs
// it on the corpus and on the inputs that fuzzing has found.

import { readFileSync } from "node:fs";
import { differencesIn } from "./verdicts.testing.ts";

const { count, differences } = await differencesIn(readFileSync(0, "utf8"));
for (const difference of differences) console.error(difference);
console.error(`${count} files, ${differences.length} differences`);
process.exitCode = count > 0 && differences.length === 0 ? 0 : 1;
