// Tests which properties of three.js the bundler of the runtime takes for unset.
import assert from "node:assert/strict";
import { test } from "node:test";
import { bundledSite } from "./bundledSite.testing.ts";
import { unsetPropertiesOf, withoutProperties } from "./unsetProperties.ts";

const names = new Set(["a", "b", "c", "d", "e"]);
const unsetIn = (...modules: string[]): string[] => [...unsetPropertiesOf(modules, names, new Set(["e"]))].flat();
const reads = "f(x.a, x.b);";

test("a property that no module sets is undefined", () => {
  assert.deepEqual(unsetIn(reads, "x.b = 1;"), ["a", "undefined"]);
});

test("one that is only set to false is false, and undefined if it is only set to undefined", () => {
  assert.deepEqual(unsetIn(reads, "x.a = false; y = { a: false, b: undefined };"), ["a", "false", "b", "undefined"]);
  assert.deepEqual(unsetIn(reads, "x.a = false; x.a = true; class A { b; }"), ["b", "undefined"]);
});

test("null, zero and empty texts count as false, and a copy of the same property of another object as nothing", () => {
  for (const [set, ...expected] of [
    ["x.a = null; x.a = 0; x.a = '';", "a", "false"],
    ["x.a = y.a;", "a", "undefined"],
    ["x.a = false; x.a = y.a;", "a", "false"],
    ["x.a = y.c; y.c = 1;"],
    ["x.a = /a/;"],
  ] as const)
    assert.deepEqual(unsetIn("f(x.a);", set), expected, set);
});

test("a property that is set or deleted stays, whatever its value", () => {
  const module = "x.a = y; delete x.a;";
  assert.equal(withoutProperties(module, new Map([["a", "undefined"]] as const)), module);
});

test("operators, loops, patterns, methods and texts may set a property to anything", () => {
  for (const set of ["++x.b", "x.b ||= false", "for (x.b of y);", "[x.b] = y", "({ z: x.b } = y)", "({ b } = x)"])
    assert.deepEqual(unsetIn(reads, set), ["a", "undefined"], set);
  for (const set of ["class A { b() {} }", "class A { b = 1 }", "x['b'] = 1", "set(`b`)", "y = { b: z }"])
    assert.deepEqual(unsetIn(reads, set), ["a", "undefined"], set);
});

test("names that modules of three.js do not set, or that browsers' objects have, are kept", () => {
  assert.deepEqual(unsetIn("f(x.a, x.e, x.renderbufferStorageMultisampleEXT);"), ["a", "undefined"]);
});

test("reading an unset property is replaced by its value, unless that would leave out a call", () => {
  const unset = new Map([["a", "undefined"]] as const);
  assert.equal(
    withoutProperties("if (x.y.a === true || f().a) g(x[a]);", unset),
    "if (undefined === true || f().a) g(x[a]);",
  );
});

test("a property that is only set to false is replaced only where code asks if it is true", () => {
  const unset = new Map([["a", "false"]] as const);
  const asking = "if (x.a) y(); z = x.a ? 1 : 2; z = x.a && y; z = !x.a; z = x.a === true;";
  assert.equal(withoutProperties(asking, unset), asking.replaceAll("x.a", "false"));
  const others = "z = x.a; z = x.a === undefined; z = x.a ?? true; z = y && x.a;";
  assert.equal(withoutProperties(others, unset), others);
});

test("the site's modules have no branches for objects that are not in them, and keep calls of WebGL's extensions", async () => {
  const text = [...(await bundledSite()).values()].join("\n");
  for (const flag of ["isSkinnedMesh", "isMeshStandardMaterial", "isXRRenderTarget"])
    assert.ok(!text.includes(flag), flag);
  for (const kept of ["isMeshPhongMaterial", "isCubeTexture", "clipControlEXT"]) assert.ok(text.includes(kept), kept);
});
