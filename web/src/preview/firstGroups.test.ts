import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { basename, join } from "node:path";
import { describe, test } from "node:test";
import type { Base } from "../decode/compact/baseBuffers.ts";
import type { LevelGroup } from "../decode/compact/levelGroup.ts";
import { TestRandom } from "../decode/compact/rangeEncoder.testing.ts";
import { elementsOf } from "../document/elements.testing.ts";
import { SceneReader } from "../document/sceneReader.ts";
import { chooseCut, tolerance } from "../levels/cut.ts";
import { addPageFile, groupUrl, levelPageUrl, readLevelIndex } from "../levels/levelFiles.ts";
import type { LevelIndex } from "../levels/levelIndex.ts";
import { fraction } from "../levels/levels.testing.ts";
import { levelViewsOf } from "../levels/levelViews.ts";
import { expectedBytesPerVertex } from "../levels/meshMemory.ts";
import { errorInPixels } from "../levels/projectedError.ts";
import { unsetCamera } from "../navigation/orbit.ts";
import type { Camera } from "../scheduler/viewMetrics.ts";
import type { EarlyLoading } from "./earlyLoading.ts";
import { chooseFirstGroups } from "./firstGroups.ts";
import { previewCameraOf } from "./previewRenderer.ts";
import type { PreviewScene } from "./previewScene.ts";
import { previewSceneOf } from "./previewScene.ts";

const vectors = join(import.meta.dirname, "../../../vectors/levels-1");
const fileOf = (url: string) => new Uint8Array(readFileSync(join(vectors, basename(url))));
const absolute = (url: string) => `http://site/${url}`;

/** A scene with two instances of the mesh with this index, of a width of 2, seen from a distance. */
function sceneOf(name: string, distance: number): { scene: PreviewScene; camera: Camera } {
  const document = elementsOf(`<X3D><Scene>
    <Viewpoint position="0 0 ${distance}"/>
    <Shape DEF="s"><ImageGeometry profile="compact" positionBits="18" position="0 0 0" size="2 2 2"
      levels="${name}.png" base="0/0.png" bboxCenter="0 0 0" bboxSize="2 2 2"/></Shape>
    <Transform translation="3 0 -1"><Shape USE="s"/></Transform></Scene></X3D>`);
  const scene = previewSceneOf(new SceneReader(document).read(), unsetCamera);
  if (scene === undefined) assert.fail("the scene has no preview");
  return { scene, camera: previewCameraOf(scene, 800, 600) };
}

/** Gives the files of the vectors, and tells which have been requested. */
function vectorFiles(): { early: Pick<EarlyLoading, "request">; requested: string[] } {
  const requested: string[] = [];
  const request: EarlyLoading["request"] = ({ kind, url }) => {
    assert.equal(kind, "bytes");
    requested.push(basename(url));
    const bytes = fileOf(url);
    return { isNear: Promise.resolve(), decoded: Promise.resolve({ byteLength: bytes.length, bytes }) };
  };
  return { early: { request }, requested };
}

async function wholeIndexOf(name: string): Promise<LevelIndex> {
  const index = await readLevelIndex(fileOf(`${name}.png`));
  for (let page = 1; page < index.pageCount; ++page)
    await addPageFile(index, page, fileOf(levelPageUrl(`${name}.png`, page)));
  return index;
}

/** A group as its file holds it, with triangles of no content. */
function decodedGroup(index: LevelIndex, group: number): LevelGroup {
  const [triangles, children] = [index.triangles(group), index.children(group).length];
  const starts = Array.from({ length: Math.max(1, children) }, (_, i) => Math.floor((i * triangles) / children) || 0);
  return {
    buffers: {
      topology: "triangles",
      positionBits: 18,
      vertexCount: index.vertices(group),
      index: new Uint16Array(3 * triangles),
      coord: { array: new Uint32Array(0), components: 3, stride: 3, offset: 0 },
      attributes: {},
      others: [],
    } as unknown as LevelGroup["buffers"],
    segmentStarts: Int32Array.from([...starts, triangles]),
    hasSegments: children > 0,
  };
}

describe("the first groups of a mesh with levels of detail", () => {
  test("are the cut that the runtime chooses for the same view, of pages that the view needs", async () => {
    const random = new TestRandom(7);
    const index = await wholeIndexOf("five-levels");
    const sizes = new Set<number>();
    let fewestPages = Infinity;
    for (let n = 0; n < 20; ++n) {
      const { scene, camera } = sceneOf("five-levels", 1.001 + fraction(random) ** 3);
      const views = scene.shapes.flatMap(({ geometry, sceneFromShape }) =>
        levelViewsOf(geometry, {
          views: [{ camera, isOrthographic: false }],
          instances: [{ sceneFromShape: sceneFromShape.elements }],
        }),
      );
      const none = new Set<number>();
      const mesh = { index, errorInPixels: errorInPixels(index, views), open: none, absent: none };
      const budget = n % 2 === 0 ? 1e9 : 4e6;
      const { meshes } = chooseCut([{ ...mesh, bytesPerVertex: expectedBytesPerVertex }], { tolerance, budget });
      const { early, requested } = vectorFiles();
      const chosen = await chooseFirstGroups(scene, camera, budget, absolute, early);
      const groups = chosen.groupsOf(absolute("five-levels.png"));
      assert.deepEqual(new Set(groups), meshes[0]?.target);
      assert.equal(new Set(requested).size, requested.length, "each page once");
      sizes.add(groups.length);
      fewestPages = Math.min(fewestPages, requested.length);
      const own = groups.filter((group) => group > 0);
      assert.deepEqual(
        chosen.requests.map(({ kind, url, expectedBytes }) => [kind, url, expectedBytes]),
        own.map((group) => ["group", groupUrl(absolute("five-levels.png"), group), index.bytes(group)]),
      );
    }
    assert.ok(sizes.size > 4 && fewestPages < index.pageCount, `${Array.from(sizes).join(" ")}; ${fewestPages} pages`);
  });

  test("are drawn when those of which something is drawn have been decoded, in the segments of closed children", async () => {
    const index = await wholeIndexOf("five-levels");
    const { scene, camera } = sceneOf("five-levels", 1.1);
    const chosen = await chooseFirstGroups(scene, camera, 6e6, absolute, vectorFiles().early);
    const url = absolute("five-levels.png");
    const target = new Set(chosen.groupsOf(url));
    const numberOf = new Map(Array.from(target, (group) => [groupUrl(url, group), group]));
    assert.ok(chosen.drawnRequests.length > 1 && chosen.drawnRequests.length < chosen.requests.length);
    for (const request of chosen.drawnRequests) {
      assert.equal(chosen.meshesOf(url, undefined), undefined);
      chosen.add(request.url, decodedGroup(index, numberOf.get(request.url) ?? NaN));
    }
    const meshes = chosen.meshesOf(url, undefined) ?? assert.fail("a group is missing");
    assert.equal(chosen.meshesOf(url, undefined), meshes, "the same arrays, which are on the GPU");
    const drawn = meshes.flatMap(({ ranges = [] }) => ranges).reduce((sum, { count }) => sum + count, 0);
    let expected = 0;
    for (const group of target) {
      const { segmentStarts } = decodedGroup(index, group);
      const children = Array.from(index.children(group));
      if (children.length === 0) expected += index.triangles(group);
      for (const [i, child] of children.entries())
        if (!target.has(child)) expected += (segmentStarts[i + 1] ?? NaN) - (segmentStarts[i] ?? NaN);
    }
    assert.equal(drawn, expected);
    chosen.clear();
    assert.equal(chosen.meshesOf(url, undefined), undefined);
  });

  test("are drawn of their root alone where the view needs no more", async () => {
    const index = await wholeIndexOf("five-levels");
    const { scene, camera } = sceneOf("five-levels", 1e7);
    const chosen = await chooseFirstGroups(scene, camera, 1e9, absolute, vectorFiles().early);
    const url = absolute("five-levels.png");
    assert.deepEqual([chosen.groupsOf(url), chosen.requests], [[0], []]);
    assert.equal(chosen.meshesOf(url, undefined), undefined);
    const { buffers } = decodedGroup(index, 0);
    const segmentCount = index.children(0).length;
    const segment = new Int32Array(index.triangles(0));
    const decoded = { buffers, segments: { segment, segmentCount } };
    const meshes = chosen.meshesOf(url, { decoded } as unknown as Base);
    assert.deepEqual(
      meshes?.flatMap(({ ranges }) => ranges),
      [{ first: 0, count: index.triangles(0) }],
    );
  });

  test("are not drawn where a file is another than the index states", async () => {
    const index = await wholeIndexOf("two-levels");
    const { scene, camera } = sceneOf("two-levels", 2);
    const url = absolute("two-levels.png");
    const chosen = await chooseFirstGroups(scene, camera, 1e9, absolute, vectorFiles().early);
    for (const group of chosen.groupsOf(url)) {
      const decoded = decodedGroup(index, group);
      chosen.add(groupUrl(url, group), { ...decoded, buffers: { ...decoded.buffers, vertexCount: 1 } });
    }
    assert.equal(chosen.meshesOf(url, undefined), undefined);
  });

  test("are not chosen for points and for groups with images", async () => {
    for (const name of ["points", "chips"]) {
      const { scene, camera } = sceneOf(name, 3);
      const choice = chooseFirstGroups(scene, camera, 1e9, absolute, vectorFiles().early);
      await assert.rejects(choice, { name: "DecodeError", message: /is no index of plain triangles/ });
    }
  });
});
