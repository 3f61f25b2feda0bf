import assert from "node:assert/strict";
import { test } from "node:test";
import type { CutMesh } from "../../levels/cut.ts";
import { chooseCut } from "../../levels/cut.ts";
import { indexOf, randomMesh } from "../../levels/levels.testing.ts";
import { perspectiveView } from "../../levels/levelViews.testing.ts";
import { errorInPixels } from "../../levels/projectedError.ts";
import { SharedCut, sharedCutOf, type SharedMesh } from "./sharedCut.ts";

const tolerance = 0.001;
const budget = 400_000;

class TestMesh implements SharedMesh {
  mesh: CutMesh | undefined;
  updates = 0;

  cutMesh(): CutMesh | undefined {
    return this.mesh;
  }
  followSharedCut(): void {
    ++this.updates;
  }
}

function cutMeshAt(distance: number, seed: number): CutMesh {
  const index = indexOf(randomMesh(seed, 3000, 10).levels);
  const view = perspectiveView([32768, 32768, 32768 + distance], {});
  const none = new Set<number>();
  return { index, errorInPixels: errorInPixels(index, [view]), open: none, absent: none, bytesPerVertex: 12 };
}

test("a mesh alone has the cut of all memory", () => {
  const mesh = new TestMesh();
  mesh.mesh = cutMeshAt(20_000, 2);
  const shared = new SharedCut(tolerance);
  shared.follow(mesh, budget);
  const { target, bytes, maxBytes } = shared.cutOf(mesh);
  const alone = chooseCut([mesh.mesh], { tolerance, budget });
  assert.deepEqual(target, alone.meshes[0]?.target);
  assert.deepEqual([bytes, maxBytes], [alone.bytes, budget]);
});

test("a near mesh takes what a far one does not need, and together they stay within the memory", () => {
  const [near, far] = [new TestMesh(), new TestMesh()];
  near.mesh = cutMeshAt(20_000, 2);
  far.mesh = cutMeshAt(900_000, 11);
  const shared = new SharedCut(tolerance);
  for (const mesh of [near, far]) shared.follow(mesh, budget);
  const [nearCut, farCut] = [shared.cutOf(near), shared.cutOf(far)];
  assert.ok(nearCut.maxBytes > 0.6 * budget, `${nearCut.maxBytes}`);
  assert.ok(nearCut.maxBytes + farCut.maxBytes <= budget + 1e-6);
  assert.ok(nearCut.bytes <= nearCut.maxBytes && farCut.bytes <= farCut.maxBytes);
});

test("a mesh whose index has not arrived is left an equal part, and the others are told when it arrives", async () => {
  const [first, second] = [new TestMesh(), new TestMesh()];
  first.mesh = cutMeshAt(900_000, 2);
  const shared = new SharedCut(tolerance);
  for (const mesh of [first, second]) shared.follow(mesh, budget);
  assert.equal(shared.cutOf(first).maxBytes, budget / 2);
  assert.equal(shared.cutOf(second).maxBytes, budget / 2);
  await Promise.resolve();
  first.updates = 0;
  second.mesh = cutMeshAt(20_000, 11);
  shared.invalidate();
  assert.ok(shared.cutOf(second).maxBytes > budget / 2);
  await Promise.resolve();
  assert.deepEqual([first.updates, second.updates], [1, 1]); // the second: of the first choice, as of a new mesh
  shared.invalidate();
  shared.cutOf(second);
  await Promise.resolve();
  assert.equal(first.updates, 1, "nothing has changed");
});

test("a mesh that is removed leaves its memory to the others; scenes have cuts of their own", () => {
  const [near, far] = [new TestMesh(), new TestMesh()];
  near.mesh = cutMeshAt(20_000, 2);
  far.mesh = cutMeshAt(30_000, 11);
  const [scene, other] = [{}, {}];
  const shared = sharedCutOf(scene, tolerance);
  assert.equal(sharedCutOf(scene, tolerance), shared);
  assert.notEqual(sharedCutOf(other, tolerance), shared);
  for (const mesh of [near, far]) shared.follow(mesh, budget);
  assert.ok(shared.cutOf(near).maxBytes < budget);
  shared.remove(far);
  assert.equal(shared.cutOf(near).maxBytes, budget);
});
