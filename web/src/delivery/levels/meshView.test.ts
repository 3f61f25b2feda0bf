import assert from "node:assert/strict";
import { test } from "node:test";
import type { CutMesh } from "../../levels/cut.ts";
import { chooseCut, groupMemory, tolerance } from "../../levels/cut.ts";
import { illegalityOf, indexOf, randomMesh } from "../../levels/levels.testing.ts";
import { perspectiveView } from "../../levels/levelViews.testing.ts";
import type { GeometryView } from "../geometryView.ts";
import { geometryOf } from "../delivery.testing.ts";
import { MeshView } from "./meshView.ts";
import type { SharedMeshCut } from "./sharedCut.ts";

const identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
/** A box whose lattice steps are units of the scene. */
const geometry = geometryOf(
  `<ImageGeometry profile="compact" positionBits="16" levels="levels.png"
    position="32767.5 32767.5 32767.5" size="65535 65535 65535"/>`,
);
const { levels } = randomMesh(4, 800, 10);
const index = indexOf(levels);
const [child = 0] = index.children(0);

/** As seen from this distance of the center. */
function viewAt(distance: number, focus?: GeometryView["focus"]): GeometryView {
  const { camera } = perspectiveView([32768, 32768, 32768 + distance], { pixelsPerUnit: 60_000 });
  return { views: [{ camera, isOrthographic: false }], instances: [{ sceneFromShape: identity }], focus };
}

/** Views at these distances, every 100 ms. */
function viewsAt(...distances: readonly number[]): MeshView {
  const view = new MeshView(geometry);
  distances.forEach((distance, n) => {
    view.follow(viewAt(distance), 1000 + 100 * n);
  });
  return view;
}

function meshOf(view: MeshView): CutMesh {
  const none = new Set<number>();
  return { index, errorInPixels: view.errorsInPixels(index), open: none, absent: none, bytesPerVertex: 12 };
}

function cutOf(mesh: CutMesh, maxBytes: number): SharedMeshCut {
  const { meshes, bytes } = chooseCut([mesh], { tolerance, budget: maxBytes });
  return { ...(meshes[0] ?? assert.fail()), bytes, maxBytes };
}

test("a mesh that nobody sees needs its root alone, and a nearer one has larger errors", () => {
  const unseen = new MeshView(geometry).errorsInPixels(index);
  assert.deepEqual([unseen(0), unseen(child)], [Infinity, 0]);
  const errorAt = (distance: number): number => viewsAt(distance).errorsInPixels(index)(child);
  const [near, far] = [errorAt(100_000), errorAt(1_000_000)];
  assert.ok(near > 5 * far && far > 0, `${near} and ${far} pixels`);
});

test("a focus makes the errors larger by which groups are chosen, and not those in the views", () => {
  const view = viewsAt(1_000_000);
  const without = view.errorsInPixels(index)(child);
  assert.equal(view.errorsAroundFocus(index)(child), without);
  view.follow(viewAt(1_000_000, levels.groups[child]?.center), 2000);
  assert.equal(view.errorsInPixels(index)(child), without);
  assert.ok(view.errorsAroundFocus(index)(child) > 1000 * without);
});

test("groups ahead of a moving camera extend its cut to a legal one, within a quarter of the memory", () => {
  const steps = [900_000, 800_000, 700_000]; // and at 200,000 in half a second
  const view = viewsAt(...steps);
  const mesh = meshOf(view);
  let before = 0;
  for (const maxBytes of [50_000, 100_000, 1e9]) {
    const cut = cutOf(mesh, maxBytes);
    const ahead = view.groupsAhead(mesh, cut);
    const bytes = [...ahead].reduce((sum, group) => sum + groupMemory(mesh, group), 0);
    assert.ok(bytes <= maxBytes / 4 && cut.bytes + bytes <= maxBytes, `${bytes} of ${maxBytes} bytes`);
    assert.equal(illegalityOf(levels, new Set([...cut.target, ...ahead])), undefined);
    for (const group of ahead) assert.ok(!cut.target.has(group));
    assert.ok(ahead.size >= before, `${ahead.size} groups in ${maxBytes} bytes`);
    before = ahead.size;
  }
  const nearer = cutOf(meshOf(viewsAt(200_000)), 1e9).target;
  const cut = cutOf(mesh, 1e9);
  assert.deepEqual(new Set([...cut.target, ...view.groupsAhead(mesh, cut)]), nearer, "without a limit all of them");
  assert.ok(before > 5, `${before} groups`);
});

test("no groups are ahead of a camera that rests, jumps, or moves away", () => {
  for (const view of [new MeshView(geometry), viewsAt(2e5, 2e5, 2e5), viewsAt(9e5, 2e5), viewsAt(2e5, 3e5, 4e5)]) {
    const mesh = meshOf(view);
    assert.equal(view.groupsAhead(mesh, cutOf(mesh, 1e9)).size, 0);
  }
});
