import assert from "node:assert/strict";
import { test } from "node:test";
import type { Camera, WebGLRenderer } from "three";
import { ArrayCamera, Group, OrthographicCamera, PerspectiveCamera, Vector4, type Vector2 } from "three";
import { SceneCameras } from "./sceneCameras.ts";

function rendererOf(height: number, session?: Camera): WebGLRenderer {
  const partial = {
    xr: { isPresenting: session !== undefined, getCamera: () => session },
    getDrawingBufferSize: (size: Vector2) => size.set(2 * height, height),
  };
  return partial as unknown as WebGLRenderer;
}

const microtasks = (): Promise<void> => new Promise((resolve) => void setTimeout(resolve));

function cameraAt(x: number): PerspectiveCamera {
  const camera = new PerspectiveCamera(90, 2, 0.5, 10);
  camera.position.x = x;
  return camera;
}

test("cameras of one task count together, those of a later task replace them, and the same ones change nothing", async () => {
  let changes = 0;
  const cameras = new SceneCameras(() => ++changes);
  const scene = new Group();
  const add = async (...xs: number[]): Promise<number[]> => {
    for (const x of xs) cameras.add(cameraAt(x), rendererOf(100), scene);
    await microtasks();
    return cameras.views.map(({ camera }) => camera.position[0]);
  };
  assert.deepEqual(await add(1, 2), [1, 2]);
  assert.deepEqual(await add(1, 2), [1, 2]);
  assert.equal(changes, 1);
  assert.deepEqual(await add(2), [2]);
  assert.equal(changes, 2);
  scene.position.y = 3;
  await add(2);
  assert.equal(changes, 3, "the scene has moved");
  assert.deepEqual(cameras.views[0]?.worldFromScene?.[13], 3);
});

test("pixels of a unit are those of the drawing buffer, also without perspective", async () => {
  const cameras = new SceneCameras(() => undefined);
  cameras.add(cameraAt(0), rendererOf(100), new Group());
  cameras.add(new OrthographicCamera(-8, 8, 4, -4), rendererOf(100), new Group());
  await microtasks();
  const [perspective, orthographic] = cameras.views;
  // At distance 1, 90 degrees are 2 units high.
  assert.ok(Math.abs((perspective?.camera.pixelsPerUnit ?? 0) - 50) < 1e-9);
  assert.equal(perspective?.isOrthographic, false);
  assert.equal(perspective.camera.near, 0.5);
  assert.ok(Math.abs((orthographic?.camera.pixelsPerUnit ?? 0) - 12.5) < 1e-9);
  assert.equal(orthographic?.isOrthographic, true);
});

test("in a session its cameras count, each by the height of its viewport; a canvas without area has no view", async () => {
  const cameras = new SceneCameras(() => undefined);
  const eyes = [cameraAt(-1), cameraAt(1)].map((eye, n) =>
    Object.assign(eye, { viewport: new Vector4(0, 0, 40, 200 + n) }),
  );
  for (const eye of eyes) eye.updateMatrixWorld();
  cameras.add(cameraAt(7), rendererOf(100, new ArrayCamera(eyes)), new Group());
  await microtasks();
  assert.deepEqual(
    cameras.views.map(({ camera }) => [camera.position[0], Math.round(2 * camera.pixelsPerUnit)]),
    [
      [-1, 200],
      [1, 201],
    ],
  );
  cameras.add(cameraAt(7), rendererOf(0), new Group());
  await microtasks();
  assert.deepEqual(cameras.views, []);
});
