// Tests which methods the bundler of the runtime removes from three.js.
import assert from "node:assert/strict";
import { test } from "node:test";
import { bundledSite } from "./bundledSite.testing.ts";
import { unusedMethodsOf, withoutMethods } from "./unusedMethods.ts";

const unusedIn = (...modules: string[]): string[] => [...unusedMethodsOf(modules)].sort();

test("a method that no code mentions is unused", () => {
  assert.deepEqual(unusedIn("class A { drawn() {} hidden() {} }", "new A().drawn();"), ["hidden"]);
});

test("methods that only unused methods call are unused, recursive ones too", () => {
  const program = "class A { a() { this.b(); } b() { this.a(); } c() { this.d(); } d() {} } new A().c();";
  assert.deepEqual(unusedIn(program), ["a", "b"]);
});

test("functions that a constructor function assigns to its object are methods", () => {
  assert.deepEqual(unusedIn("function A() { this.a = function () { this.b(); }; this.b = function () {}; } new A();"), [
    "a",
    "b",
  ]);
});

test("a name in a text, a pattern or an object may be that of a method", () => {
  const methods = "class A { a() {} b() {} c() {} d() {} e() {} get f() { return 1; } }";
  assert.deepEqual(unusedIn(`${methods} new A()["a"](); const { b } = new A(); const o = { c: 1 }; x[\`d\`]; o?.f;`), [
    "e",
  ]);
});

test("names that the language calls, and computed ones, are kept", () => {
  assert.deepEqual(unusedIn("class A { constructor() {} toString() {} [Symbol.iterator]() {} static [x]() {} }"), []);
});

test("only the unused methods are removed from a module", () => {
  const module = "class A {\n  a() { return class { b() {} }; }\n  set b(x) {}\n  c() {}\n}\n";
  assert.equal(withoutMethods(module, new Set(["a", "b"])), "class A {\n  \n  \n  c() {}\n}\n");
  assert.equal(withoutMethods(module, new Set()), module);
});

test("the site's modules contain methods of three.js that they call, and no others", async () => {
  const text = [...(await bundledSite()).values()].join("\n");
  for (const called of ["updateMatrixWorld", "setFromMatrixPosition", "updateProjectionMatrix", "copyTextureToTexture"])
    assert.ok(text.includes(called), called);
  for (const uncalled of ["getHexString", "computeTangents", "forceContextRestore", "setFromCylindricalCoords"])
    assert.ok(!text.includes(uncalled), uncalled);
});
