// Tests what the bundler of the runtime removes from GLSL.
import assert from "node:assert/strict";
import { test } from "node:test";
import { withLeanTemplates, withoutComments } from "./glsl.ts";

test("GLSL loses comments, indentation and empty lines", () => {
  assert.equal(withoutComments("/* a\nb */\n  x = 1.0; // c\n\n\n  y = x / 2.0;"), "\nx = 1.0;\ny = x / 2.0;");
});

test("so do templates after a comment that says so, around their expressions, and no others", () => {
  const module = (comment: string, indent: string): string =>
    `const a: string = /* glsl */ \`x;${comment}\n${indent}\${b(\`  // kept\`)}\n${indent}y \${c} z;\`; const d = \`  // kept\`;`;
  assert.equal(withLeanTemplates(module(" // left out", "  ")), module("", ""));
});

test("an expression in a comment stays there", () => {
  const module = "/* glsl */ `x; // as ${a}\n  // left out\ny;`";
  assert.equal(withLeanTemplates(module), "/* glsl */ `x; // as ${a}\ny;`");
});
