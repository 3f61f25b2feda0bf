// Finds text that must not be in any tracked file: paths of one machine, and hosts of package registries.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";

const root = join(import.meta.dirname, "..");

const forbidden: [pattern: RegExp, what: string][] = [
  [/(?<![\w.)}])\/(work|home|root|Users)\/\w/, "a path of one machine"],
  [/\bregistry\.[a-z]|"resolved"\s*:/, "a package registry"],
];

/** One sentence per offending line, starting with file:line. */
function findForbidden(path: string, text: string): string[] {
  return text
    .split("\n")
    .flatMap((line, index) =>
      forbidden.filter(([pattern]) => pattern.test(line)).map(([, what]) => `${path}:${index + 1}: names ${what}`),
    );
}

test("no tracked file names a path of one machine or a package registry", () => {
  const paths = execFileSync("git", ["ls-files", "-z"], { cwd: root, encoding: "utf8" }).split("\0");
  const files = paths.filter((path) => path !== "" && existsSync(join(root, path)));
  assert.ok(files.length > 10, "the tracked files were not found");
  // latin1 keeps every byte, so that binary files are searched as well.
  assert.deepEqual(
    files.flatMap((path) => findForbidden(path, readFileSync(join(root, path), "latin1"))),
    [],
  );
});

test("such paths and hosts are found", () => {
  const hosts = ["registry", "npmjs.org"].join(".");
  const bad = ["fine: docs/images/home", `cmake -S ${["", "home", "me", "imgeo"].join("/")}`, `https://${hosts}/three`];
  assert.deepEqual(findForbidden("x", bad.join("\n")), [
    "x:2: names a path of one machine",
    "x:3: names a package registry",
  ]);
});
