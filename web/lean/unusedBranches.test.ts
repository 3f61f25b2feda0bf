// Tests which branches of GLSL the bundler of the runtime leaves out.
import assert from "node:assert/strict";
import { test } from "node:test";
import { withoutUnusedBranches } from "./unusedBranches.ts";

/** NEVER and NONE are never defined. */
const without = (...lines: string[]): string[] =>
  withoutUnusedBranches(lines.join("\n"), (name) => name === "NEVER" || name === "NONE").split("\n");

test("a branch for a name that is never defined is left out", () => {
  assert.deepEqual(without("a", "#ifdef NEVER", "b", "#endif", "c"), ["a", "c"]);
  assert.deepEqual(without("#ifdef NEVER", "a", "#else", "b", "#endif"), ["b"]);
  assert.deepEqual(without("#ifndef NEVER", "a", "#else", "b", "#endif"), ["a"]);
});

test("a branch for a name that may be defined stays as it is", () => {
  const lines = ["#ifdef SOME", "a", "#elif defined( OTHER ) && N > 2", "b", "#else", "c", "#endif"];
  assert.deepEqual(without(...lines), lines);
});

test("branches around and within one that is left out are kept or left out by themselves", () => {
  const lines = ["#ifdef SOME", "#ifdef NEVER", "#ifdef SOME", "a", "#endif", "#else", "b", "#endif", "#endif"];
  assert.deepEqual(without(...lines), ["#ifdef SOME", "b", "#endif"]);
});

test("the first branch that is left begins with #if, and one that always holds is the last", () => {
  assert.deepEqual(
    without("#ifdef NEVER", "a", "#elif defined( SOME )", "b", "#elif ! defined( NONE )", "c", "#else", "d", "#endif"),
    ["#if defined( SOME )", "b", "#else", "c", "#endif"],
  );
});

test("conditions are computed as far as they are known", () => {
  const isLeft = (condition: string): boolean => without(`#if ${condition}`, "a", "#endif").includes("a");
  for (const condition of ["defined( NEVER ) && N > 1", "NEVER > 0", "defined NEVER || ( NONE > 0 )", "! ( 1 )"])
    assert.equal(isLeft(condition), false, condition);
  for (const condition of ["defined( NEVER ) || N > 1", "NEVER < 1", "N < NEVER", "defined( SOME ) && 1"])
    assert.equal(isLeft(condition), true, condition);
});

test("conditionals of which no line is left are left out", () => {
  assert.deepEqual(without("#ifdef SOME", "#ifdef NEVER", "a", "#endif", "", "#endif", "b"), ["b"]);
});
