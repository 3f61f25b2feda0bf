import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { before, describe, test } from "node:test";
import { decodeBases } from "../decode/compact/decodeBases.ts";
import { runJob } from "../workers/worker.ts";
import type { PatchBuffers } from "../decode/compact/patchBuffers.ts";
import { elementsOf } from "../document/elements.testing.ts";
import { SceneReader } from "../document/sceneReader.ts";
import { unsetCamera } from "../navigation/orbit.ts";
import { PreviewMeshes } from "./previewMeshes.ts";
import type { PreviewShape } from "./previewScene.ts";
import { previewSceneOf } from "./previewScene.ts";

const vectors = join(import.meta.dirname, "../../../vectors");
const bytesOf = (name: string) => new Uint8Array(readFileSync(join(vectors, name)));
const [baseUrl, patchUrl] = ["http://site/b.png", "http://site/p.png"];

/** A shape of three patches, each with all triangles of a sphere, and a base of three segments. */
function sphereShape(recordCount = 178): PreviewShape {
  const patch = (n: number) =>
    `<GeometryPatch bboxCenter="0 0 0" bboxSize="2 2 2" recordCount="${recordCount}" vertexCount="1056"
      data="p.png#${n}"/>`;
  const geometry = `<ImageGeometry profile="compact" position="0 0 0" size="2 2 2" base="b.png">${[0, 1, 2]
    .map(patch)
    .join("")}</ImageGeometry>`;
  const scene = new SceneReader(elementsOf(`<X3D><Scene><Shape>${geometry}</Shape></Scene></X3D>`)).read();
  const [shape] = previewSceneOf(scene, unsetCamera)?.shapes ?? [];
  return shape ?? assert.fail("the scene has no preview");
}

async function spherePatch(): Promise<PatchBuffers> {
  const input = bytesOf("compact-1/sphere.png");
  const [patch] = (await runJob({ name: "compactPatches", input })) as readonly PatchBuffers[];
  return patch ?? assert.fail("no patch");
}

describe("the meshes of a preview", () => {
  before(() => {
    Object.assign(globalThis, { document: { baseURI: "http://site/" } });
  });

  test("display a shape by its base until all of its patches are here", async () => {
    const [shape, meshes, patch] = [sphereShape(), new PreviewMeshes(), await spherePatch()];
    assert.deepEqual([meshes.has(shape), meshes.knowsBase(shape), meshes.meshesOf(shape)], [false, false, undefined]);
    const bases = await decodeBases(bytesOf("compact-2/base.png"));
    meshes.addBases(baseUrl, bases);
    assert.deepEqual([meshes.has(shape), meshes.knowsBase(shape)], [true, true]);
    assert.deepEqual(meshes.meshesOf(shape), [{ buffers: bases[0]?.whole }]);
    assert.deepEqual(meshes.displayedOf(shape), { element: shape.element, patches: [0, 1, 2], stage: "base" });
    meshes.add(patchUrl, { byteLength: 1, patches: [patch, patch] });
    assert.equal(meshes.displayedOf(shape).stage, "base", "one patch is missing");
    meshes.add(patchUrl, { byteLength: 1, patches: [patch, patch, patch] });
    assert.deepEqual(meshes.displayedOf(shape), { element: shape.element, patches: [0, 1, 2], stage: "full" });
    assert.deepEqual(
      meshes.meshesOf(shape)?.map(({ buffers }) => buffers === patch),
      [true, true, true],
    );
    meshes.clear();
    assert.equal(meshes.has(shape), false);
  });

  test("are enough without the base, and are none where they contradict the document", async () => {
    const patch = await spherePatch();
    for (const [recordCount, isDrawn] of [
      [178, true],
      [177, false],
    ] as const) {
      const [shape, meshes] = [sphereShape(recordCount), new PreviewMeshes()];
      meshes.add(patchUrl, { byteLength: 1, patches: [patch, patch, patch] });
      assert.deepEqual([meshes.has(shape), meshes.meshesOf(shape) !== undefined], [isDrawn, isDrawn]);
    }
  });

  test("are none where the base has other segments than the shape has patches", async () => {
    const shape = sphereShape();
    const [first, second] = shape.geometry.patches;
    assert.ok(first && second);
    const other = { ...shape, geometry: { ...shape.geometry, patches: [first, second] } };
    const meshes = new PreviewMeshes();
    meshes.addBases(baseUrl, await decodeBases(bytesOf("compact-2/base.png")));
    assert.deepEqual([meshes.has(other), meshes.meshesOf(other)], [true, undefined]);
  });
});
