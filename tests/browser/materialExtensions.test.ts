// Compares materials with glTF's extensions with three.js' MeshPhysicalMaterial, from the same glTF file.

import assert from "node:assert/strict";
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { draw, serveThree } from "../gltf/compare.ts";
import { materialSamples, sampleDocument } from "../gltf/samples.ts";
import { difference } from "./compare.ts";
import { browser } from "./harness.ts";
import { outputDirectory } from "./paths.ts";
import { decodePng } from "./png.ts";
import { startServer } from "./server.ts";
import { siteOf } from "./sites.ts";
import { isSoak } from "./soak.ts";

test("materials with glTF's extensions look as three.js draws them", async () => {
  const folder = join(outputDirectory, "material-extensions");
  mkdirSync(folder, { recursive: true });
  const file = join(folder, "extensions.gltf");
  const names = isSoak ? ["clearcoat", "sheen", "iridescence", "volume"] : ["clearcoat", "volume"];
  const materials = names.map((name) => materialSamples[name]?.[0] ?? {});
  writeFileSync(file, sampleDocument(materials));
  const server = await startServer(join(outputDirectory, "sites"));
  try {
    await serveThree(server);
    const drawn = await draw(await browser(), server, file, siteOf(file));
    assert.ok("three" in drawn, "GLTFLoader reads the file");
    const { mean, offShare } = difference(decodePng(drawn.imgeo), decodePng(drawn.three));
    assert.ok(mean < 2, `the mean difference is ${mean.toFixed(2)}`);
    assert.ok(offShare < 0.05, `${(100 * offShare).toFixed(1)} % of the pixels differ by more than 16`);
  } finally {
    await server.close();
  }
});
