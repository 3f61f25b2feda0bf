// Checks that NOTICE names every package that is installed to build, run or test imgeo.
import assert from "node:assert/strict";
import { readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";

const root = join(import.meta.dirname, "..");
const read = (path: string): string => readFileSync(join(root, path), "utf8");

/** The packages that NOTICE names: words at the start of its indented lines, separated by commas. */
function packagesOfNotice(): Set<string> {
  const lists = read("NOTICE").split("-".repeat(40))[0] ?? "";
  const names = new Set<string>();
  for (const line of lists.split("\n")) {
    const listed = /^ {3}(\S.*?)(?: {2,}\S.*)?$/.exec(line)?.[1];
    for (const name of listed?.split(/,\s*/) ?? []) names.add(name);
  }
  return names;
}

function debianPackages(): string[] {
  return readdirSync(join(root, "scripts"))
    .filter((name) => /^apt-packages.*\.txt$/.test(name))
    .flatMap((name) => read(`scripts/${name}`).split("\n"))
    .filter((line) => line !== "" && !line.startsWith("#"));
}

function npmPackages(): string[] {
  const manifest = JSON.parse(read("package.json")) as Record<string, Record<string, string> | undefined>;
  return ["dependencies", "devDependencies", "optionalDependencies"].flatMap((kind) =>
    Object.keys(manifest[kind] ?? {}),
  );
}

test("NOTICE names every Debian package that the scripts install", () => {
  const listed = packagesOfNotice();
  assert.ok(debianPackages().length > 20, "the lists of packages were not found");
  assert.deepEqual(
    debianPackages().filter((name) => !listed.has(name)),
    [],
  );
});

test("NOTICE names every npm package of package.json", () => {
  const listed = packagesOfNotice();
  assert.ok(npmPackages().length > 10, "package.json names no packages");
  assert.deepEqual(
    npmPackages().filter((name) => !listed.has(name)),
    [],
  );
});

test("NOTICE holds the licence text of three.js, which is inside the bundles", () => {
  const licence = read("node_modules/three/LICENSE").trim();
  assert.ok(read("NOTICE").includes(licence));
});
