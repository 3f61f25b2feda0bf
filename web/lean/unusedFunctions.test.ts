// Tests which functions the bundler of the runtime empties.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { withoutUnusedFunctions } from "./unusedFunctions.ts";

const sourceOf = (path: string): string =>
  readFileSync(join(import.meta.dirname, "../../node_modules/three/src", path), "utf8");

test("a function that pages never call throws its name; others stay as they are", () => {
  const path = "objects/Points.js";
  const before = sourceOf(path);
  const after = withoutUnusedFunctions(path, before);
  assert.match(after, /\tcopy\( source, recursive \) \{ throw Error\("copy"\); \}/);
  assert.match(after, /\tupdateMorphTargets\(\) \{\}/);
  assert.ok(after.includes("raycast( raycaster, intersects ) {"));
  assert.equal(withoutUnusedFunctions("objects/Group.js", before), before);
});

test("a version of three.js without such a function stops the build", () => {
  assert.throws(() => withoutUnusedFunctions("scenes/Scene.js", "class Scene {}"), /Scene\.js has 0 functions copy/);
});
