// Compares docs/glossary.md with the tree: the files that define its terms exist, and the words that it rules out
// occur in no identifier and no file name. No comment begins with "Of".
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, readFileSync } from "node:fs";
import { basename, join } from "node:path";
import { test } from "node:test";

const root = join(import.meta.dirname, "..");
const glossary = readFileSync(join(root, "docs/glossary.md"), "utf8");

/** The cells of a Markdown table's rows below the heading, without the table's own head. */
function rowsBelow(text: string, heading: string): string[][] {
  const section = (text.split(`\n## ${heading}\n`)[1] ?? "").split("\n## ")[0] ?? "";
  const lines = section.split("\n").filter((line) => line.startsWith("|"));
  return lines.slice(2).map((line) =>
    line
      .split("|")
      .slice(1, -1)
      .map((cell) => cell.trim()),
  );
}

function bannedWords(text: string): Set<string> {
  return new Set(rowsBelow(text, "Words that are not used").flatMap(([words]) => (words ?? "").split(/,\s*/)));
}

/** "leastPointSize", "LEAST_POINT_SIZE" and "least_point_size" are the words least, point, size. */
function wordsOf(identifier: string): string[] {
  return identifier
    .replace(/([a-z0-9])([A-Z])/g, "$1 $2")
    .replace(/([A-Z]+)([A-Z][a-z])/g, "$1 $2")
    .toLowerCase()
    .split(/[^a-z0-9]+/);
}

/** The text with comments, strings, included paths and CSS's place-… blanked; template literals keep GLSL. */
function codeOf(text: string): string {
  const blank = (match: string): string => match.replace(/[^\n]/g, " ");
  return text.replace(
    /\/\/[^\n]*|\/\*[\s\S]*?\*\/|"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)*'|^\s*#\s*include[^\n]*|^import[^;]*\sfrom\s[^\n]*|\bplace-(?:items|content|self)\b/gm,
    blank,
  );
}

interface Finding {
  line: number;
  identifier: string;
}

/** Identifiers with a banned word. `std::` names and members of the platform that contain one are `allowed`. */
function findingsIn(text: string, banned: ReadonlySet<string>, allowed: ReadonlySet<string>): Finding[] {
  const findings: Finding[] = [];
  for (const [index, line] of codeOf(text).split("\n").entries()) {
    for (const [identifier] of line.matchAll(/[A-Za-z_]\w*/g)) {
      if (!allowed.has(identifier) && wordsOf(identifier).some((word) => banned.has(word)))
        findings.push({ line: index + 1, identifier });
    }
  }
  return findings;
}

/**
 * Names of libraries and published interfaces; "look" in its standard sense, turning a first-person camera; least
 * squares.
 */
const allowed = new Set(["in_place", "in_place_type", "lookAt", "mLookAt", "leastSquaresFit"]);
for (const name of ["look", "lookRate", "lookRotation", "lookAheadSeconds"]) allowed.add(name);

function sourceFiles(): string[] {
  return execFileSync("git", ["ls-files", "--cached", "--others", "--exclude-standard"], {
    cwd: root,
    encoding: "utf8",
  })
    .split("\n")
    .filter((path) => /^(src|web|tests|bench|fuzz|examples|include|scripts)\/.*\.(h|cpp|ts)$/.test(path))
    .filter((path) => existsSync(join(root, path)));
}

const read = (path: string): string => readFileSync(join(root, path), "utf8");

test("no identifier contains a word that the glossary rules out", () => {
  const banned = bannedWords(glossary);
  assert.ok(banned.size > 10, "the glossary's table of words was not found");
  const findings = sourceFiles().flatMap((path) =>
    findingsIn(read(path), banned, allowed).map(({ line, identifier }) => `${path}:${line}: ${identifier}`),
  );
  assert.deepEqual(findings, []);
});

test("no file name contains a word that the glossary rules out", () => {
  const banned = bannedWords(glossary);
  assert.deepEqual(
    sourceFiles().filter((path) => wordsOf(basename(path)).some((word) => banned.has(word))),
    [],
  );
});

test("no comment begins with Of", () => {
  const findings = sourceFiles().flatMap((path) =>
    read(path)
      .split("\n")
      .flatMap((line, index) =>
        /(^|[^:"'`])(\/\/[/!<]*|\/\*\*?) *Of\b/.test(line) || /^\s*\* Of\b/.test(line) ? [`${path}:${index + 1}`] : [],
      ),
  );
  assert.deepEqual(findings, []);
});

test("every term of the glossary is defined in a file that exists", () => {
  const rows = rowsBelow(glossary, "Terms");
  assert.ok(rows.length > 0, "the glossary's table of terms was not found");
  for (const [term = "", meaning = "", paths = "", word = ""] of rows) {
    assert.ok(meaning !== "" && word !== "", `${term}: a cell is empty`);
    const named = [...paths.matchAll(/`([^`]+)`/g)].map((match) => match[1] ?? "");
    assert.ok(named.length > 0, `${term}: no file is named`);
    for (const path of named) assert.ok(existsSync(join(root, path)), `${term}: ${path} does not exist`);
  }
});

test("the check finds banned words in any spelling, and passes over comments and strings", () => {
  const banned = new Set(["place", "least"]);
  const text = [
    "const placeOf = 1; // a place",
    'const text = "place";',
    "int least_size = LEAST_SIZE;",
    "replace(placeholder, std::in_place);",
    "/* place */ const shader = `uniform float placeCount;`;",
  ].join("\n");
  assert.deepEqual(findingsIn(text, banned, new Set(["in_place"])), [
    { line: 1, identifier: "placeOf" },
    { line: 3, identifier: "least_size" },
    { line: 3, identifier: "LEAST_SIZE" },
    { line: 5, identifier: "placeCount" },
  ]);
});
