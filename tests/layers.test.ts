// Checks every #include of src/ and every import of web/src/ against docs/layers.txt, and finds cycles between files.
// Unit tests follow the rules of the code beside them; in addition they may use node's modules, the shared test data of
// tests/ and what a row "tests of FOLDER" lists.
import assert from "node:assert/strict";
import { existsSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join, normalize } from "node:path";
import { test } from "node:test";

type Layers = Map<string, Set<string>>;

const root = join(import.meta.dirname, "..");

/** Reads lines of the form "folder: names that it may use"; `#` starts a comment. */
function readLayers(text: string): Layers {
  const layers: Layers = new Map();
  for (const line of text.split("\n")) {
    if (line.startsWith("#") || line.trim() === "") continue;
    const [folder, uses] = line.split(":");
    assert.ok(folder !== undefined && uses !== undefined, `docs/layers.txt: no folder in "${line}"`);
    layers.set(folder, new Set(uses.split(/\s+/).filter((name) => name !== "")));
  }
  return layers;
}

/** The folder of the table that a file (or an imported path) belongs to. */
function layerOf(layers: Layers, path: string): string | undefined {
  return [...layers.keys()].find((folder) => path.startsWith(`${folder}/`));
}

interface Use {
  line: number;
  /** A path from the repository's root, or the name of a package. */
  target: string;
}

function usesOfCpp(text: string): Use[] {
  const uses: Use[] = [];
  for (const [index, line] of text.split("\n").entries()) {
    const included = /^\s*#\s*include\s*"([^"]+)"/.exec(line)?.[1];
    // Public headers are included as "imgeo/name.h", others by their path from src/.
    const folder = included?.startsWith("imgeo/") ? "include" : "src";
    if (included !== undefined) uses.push({ line: index + 1, target: `${folder}/${included}` });
  }
  return uses;
}

function usesOfTypeScript(path: string, text: string): Use[] {
  const uses: Use[] = [];
  const pattern = new RegExp(
    String.raw`(?:^\s*import\s+(?:[^;"'\x60]*?\bfrom\s*)?` + // import … from "x", import "x"
      String.raw`|^\s*export\s+(?:type\s+)?(?:\{[^}]*\}|\*(?:\s+as\s+\w+)?)\s*from\s*` +
      String.raw`|\bimport\s*\(\s*|\bnew\s+URL\s*\(\s*)["'\x60]([^"'\x60]+)["'\x60]`,
    "gm",
  );
  for (const match of text.matchAll(pattern)) {
    const name = match[1] ?? "";
    // The line of the name itself: an import may span several.
    const line = text.slice(0, match.index + match[0].length).split("\n").length;
    if (name.startsWith(".")) uses.push({ line, target: normalize(join(dirname(path), name)) });
    else if (/^[@a-z]/.test(name) && !match[0].includes("URL")) uses.push({ line, target: name });
  }
  return uses;
}

/** One sentence per rule that is broken, starting with file:line. */
function checkFile(layers: Layers, path: string, text: string): string[] {
  const layer = layerOf(layers, path);
  if (layer === undefined) return [`${path}:1: its folder is not in docs/layers.txt`];
  const isCpp = /\.(h|cpp)$/.test(path);
  const isTest = /(\.test(ing)?\.ts|_test\.cpp|\/testing\.h)$/.test(path);
  const allowed = [layers.get(layer), isTest ? layers.get(`tests of ${layer}`) : undefined];
  const findings: string[] = [];
  for (const { line, target } of isCpp ? usesOfCpp(text) : usesOfTypeScript(path, text)) {
    const used = layerOf(layers, target) ?? packageOf(target);
    if (used === layer || allowed.some((names) => names?.has(used))) continue;
    if (isTest && /^(node:|tests\/)/.test(target)) continue;
    findings.push(`${path}:${line}: ${layer} may not use ${used}`);
  }
  return findings;
}

/** "three/addons/x.js" belongs to the package three; a path that is no layer stays itself. */
function packageOf(target: string): string {
  if (/^(src|web|tests|node_modules)\//.test(target)) return target;
  return target
    .split("/")
    .slice(0, target.startsWith("@") ? 2 : 1)
    .join("/");
}

/** Every source file below `tree`, as paths from its root. */
function sourceFiles(tree: string): string[] {
  return ["include", "src", "web/src"]
    .filter((folder) => existsSync(join(tree, folder)))
    .flatMap((folder) =>
      readdirSync(join(tree, folder), { recursive: true, encoding: "utf8" })
        .filter((name) => /\.(h|cpp|ts)$/.test(name))
        .map((name) => `${folder}/${name}`),
    );
}

function checkTree(tree: string): string[] {
  const layers = readLayers(readFileSync(join(tree, "docs/layers.txt"), "utf8"));
  return sourceFiles(tree).flatMap((path) => checkFile(layers, path, readFileSync(join(tree, path), "utf8")));
}

/** Import and include cycles between files, each as "a -> b -> a"; type-only imports count. */
function checkCycles(tree: string): string[] {
  const uses = new Map(
    sourceFiles(tree).map((path): [string, string[]] => {
      const text = readFileSync(join(tree, path), "utf8");
      const found = /\.(h|cpp)$/.test(path) ? usesOfCpp(text) : usesOfTypeScript(path, text);
      return [path, found.map(({ target }) => target)];
    }),
  );
  const cycles: string[] = [];
  const isFinished = new Map<string, boolean>();
  const visit = (path: string, trail: readonly string[]) => {
    if (isFinished.get(path) === true) return;
    if (isFinished.get(path) === false) {
      cycles.push([...trail.slice(trail.indexOf(path)), path].join(" -> "));
      return;
    }
    isFinished.set(path, false);
    for (const target of uses.get(path) ?? []) if (uses.has(target)) visit(target, [...trail, path]);
    isFinished.set(path, true);
  };
  for (const path of uses.keys()) visit(path, []);
  return cycles;
}

/** Finds rows that use a folder of a later row. */
function checkOrder(layers: Layers): string[] {
  const above = new Set<string>();
  const findings: string[] = [];
  for (const [folder, uses] of layers) {
    for (const used of uses) {
      if (used.includes("/") && !above.has(used)) findings.push(`${folder} uses ${used}, which is not above it`);
    }
    above.add(folder);
  }
  return findings;
}

function withTree(files: Record<string, string>, body: (tree: string) => void): void {
  const tree = mkdtempSync(join(tmpdir(), "layers-"));
  try {
    for (const [path, text] of Object.entries(files)) {
      mkdirSync(dirname(join(tree, path)), { recursive: true });
      writeFileSync(join(tree, path), text);
    }
    body(tree);
  } finally {
    rmSync(tree, { recursive: true });
  }
}

const smallTable =
  "# who may use whom\nsrc/base:\nsrc/image: src/base\nsrc/scene: src/base\ntests of src/scene: src/image\nweb/src/decode:\nweb/src/render: web/src/decode three\n";

test("every include and import keeps to docs/layers.txt", () => {
  assert.ok(sourceFiles(root).length > 10, "the sources were not found");
  assert.deepEqual(checkTree(root), []);
});

test("no file of src or web/src includes or imports itself by way of others", () => {
  assert.deepEqual(checkCycles(root), []);
});

test("docs/layers.txt has no cycle: a folder uses only those above it", () => {
  assert.deepEqual(checkOrder(readLayers(readFileSync(join(root, "docs/layers.txt"), "utf8"))), []);
});

test("docs/layers.txt has a row for every folder of src and web/src, or for its subfolders", () => {
  const layers = readLayers(readFileSync(join(root, "docs/layers.txt"), "utf8"));
  const folders = ["src", "web/src"].flatMap((folder) =>
    readdirSync(join(root, folder), { withFileTypes: true })
      .filter((entry) => entry.isDirectory())
      .map((entry) => `${folder}/${entry.name}`),
  );
  assert.deepEqual(
    folders.filter((folder) => ![...layers.keys()].some((row) => row === folder || row.startsWith(`${folder}/`))),
    [],
  );
});

test("the check finds what breaks the rules, and names its line", () => {
  const tree = {
    "docs/layers.txt": smallTable,
    "src/base/a.h": '#pragma once\n#include "scene/b.h"\n',
    "src/scene/b.h": '#include "base/a.h"\n#include <vector>\n#include "image/i.h"\n',
    "src/image/i_test.cpp": '#include "image/i.h"\n#include "scene/b.h"\n',
    "src/stray/c.cpp": "\n",
    "web/src/decode/png.ts": 'import {\n  Scene,\n} from "three";\nimport { x } from "../render/x.ts";\n',
    "web/src/decode/lazy.ts":
      'const late = await import("../render/x.ts");\nexport * from "../render/x.ts";\nimport "three/addons/a.js";\n',
    "web/src/decode/file.ts": 'import { open } from "node:fs";\nimport { y } from "../../../tests/y.ts";\n',
    "web/src/render/x.ts": 'import type { Texture } from "three";\nimport { png } from "../decode/png.ts";\n',
  };
  withTree(tree, (path) => {
    assert.deepEqual(checkTree(path).sort(), [
      "src/base/a.h:2: src/base may not use src/scene",
      "src/image/i_test.cpp:2: src/image may not use src/scene",
      "src/scene/b.h:3: src/scene may not use src/image",
      "src/stray/c.cpp:1: its folder is not in docs/layers.txt",
      "web/src/decode/file.ts:1: web/src/decode may not use node:fs",
      "web/src/decode/file.ts:2: web/src/decode may not use tests/y.ts",
      "web/src/decode/lazy.ts:1: web/src/decode may not use web/src/render",
      "web/src/decode/lazy.ts:2: web/src/decode may not use web/src/render",
      "web/src/decode/lazy.ts:3: web/src/decode may not use three",
      "web/src/decode/png.ts:3: web/src/decode may not use three",
      "web/src/decode/png.ts:4: web/src/decode may not use web/src/render",
    ]);
  });
});

test("the check finds cycles of imports and includes, type-only imports included", () => {
  const tree = {
    "src/base/a.h": '#include "base/b.h"\n#include "base/d.h"\n',
    "src/base/b.h": '#include "base/c.h"\n',
    "src/base/c.h": '#include "base/a.h"\n',
    "src/base/d.h": "#include <vector>\n",
    "web/src/decode/png.ts": 'import type { Zlib } from "./zlib.ts";\n',
    "web/src/decode/zlib.ts": 'export { png } from "./png.ts";\n',
    "web/src/decode/strips.ts": 'import { png } from "./png.ts";\n',
  };
  withTree(tree, (path) => {
    assert.deepEqual(checkCycles(path), [
      "src/base/a.h -> src/base/b.h -> src/base/c.h -> src/base/a.h",
      "web/src/decode/png.ts -> web/src/decode/zlib.ts -> web/src/decode/png.ts",
    ]);
  });
});

test("a tree that keeps to the rules passes, node's modules in its tests too", () => {
  const tree = {
    "docs/layers.txt": smallTable,
    "web/src/decode/stage.ts": 'export type Name = "three" | "node:fs";\nexport const tag = "three";\n',
    "src/scene/b.cpp": '#include "scene/b.h"\n#include "base/a.h"\n',
    "src/scene/b_test.cpp": '#include "scene/b.h"\n#include "image/i.h"\n',
    "web/src/render/x.test.ts": 'import { test } from "node:test";\nimport { png } from "../decode/png.ts";\n',
  };
  withTree(tree, (path) => {
    assert.deepEqual(checkTree(path), []);
  });
});

test("a table with a cycle is found", () => {
  assert.deepEqual(checkOrder(readLayers("src/a: src/b\nsrc/b: src/a\n")), ["src/a uses src/b, which is not above it"]);
});
