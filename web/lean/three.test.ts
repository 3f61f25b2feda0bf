// Tests which module of a site contains what of three.js.
import assert from "node:assert/strict";
import { test } from "node:test";
import { bundleSite } from "../bundle.ts";

test("what only a part uses of three.js is in its module, and three.js' clipping planes are in none", async () => {
  const site = await bundleSite();
  const modulesWith = (text: string): string[] =>
    Array.from(site).flatMap(([name, code]) => (code.includes(text) ? [name] : []));
  assert.deepEqual(modulesWith("updateCoordinateSystem"), ["imgeo-environment"]); // of CubeCamera
  assert.deepEqual(modulesWith("clippingPlanes["), []);
  assert.ok(modulesWith("MeshPhongMaterial").includes("imgeo-scene"));
});
