// Tests which module of a site contains what of three.js.
import assert from "node:assert/strict";
import { test } from "node:test";
import { bundledSite } from "./bundledSite.testing.ts";
import { withoutUnusedMembers } from "./three.ts";

test("what only a part uses of three.js is in its module, and three.js' clipping planes are in none", async () => {
  const site = await bundledSite();
  const modulesWith = (text: string): string[] =>
    Array.from(site).flatMap(([name, code]) => (code.includes(text) ? [name] : []));
  assert.deepEqual(modulesWith("updateCoordinateSystem"), ["imgeo-environment"]); // of CubeCamera
  assert.deepEqual(modulesWith("clippingPlanes["), []);
  assert.ok(modulesWith("MeshPhongMaterial").includes("imgeo-scene"));
});

test("an object keeps only the members that other modules name after it", () => {
  const members = "\t/** Says what. */\n\tlerp: lerp,\n\tdamp: damp\n";
  const module = `function lerp() {}\nconst MathUtils = {\n${members}};\nexport { lerp, damp };`;
  const lean = withoutUnusedMembers("MathUtils", module, ["MathUtils.lerp(a, b, t);", "other.damp();"]);
  assert.match(lean, /\tlerp: lerp,\n/);
  assert.doesNotMatch(lean, /damp: damp/);
  assert.match(lean, /export \{ lerp, damp \};/);
  assert.throws(() => withoutUnusedMembers("Others", module, []), /three.js has no Others any more/);
});
