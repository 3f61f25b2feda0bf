import assert from "node:assert/strict";
import { test } from "node:test";
import { everything, sigFiles, sigPatch, siteOf } from "../delivery/delivery.testing.ts";
import { shapesOf } from "../document/description.ts";
import { elementsOf } from "../document/elements.testing.ts";
import { readScene } from "../document/readScene.ts";
import type { SceneRenderer } from "../render/sceneRenderer.ts";
import { sceneDeliveriesOf } from "../viewer/viewerCore.ts";
import { PageShapes } from "./pageShapes.ts";

/** The shapes of a scene, each with files of its own, and counts of the frames that they request from the renderer. */
function loadingShapes(count: number) {
  const markup = Array.from(
    { length: count },
    (_, n) => `<Shape><ImageGeometry>${sigPatch(n)}</ImageGeometry></Shape>`,
  );
  const descriptions = shapesOf(readScene(elementsOf(`<X3D>${markup.join("")}</X3D>`)).root);
  const loadEvents: string[] = [];
  for (const { element } of descriptions) {
    Object.assign(element, {
      dispatchEvent: ({ type }: Event) => {
        if (type === "load") loadEvents.push(type);
        return true;
      },
    });
  }
  const frames = { immediate: 0, paced: 0 };
  const renderer = {
    isContextLost: false,
    scene: {
      setStage: () => {
        frames.paced += 1;
      },
    },
    frames: {
      request: () => {
        frames.immediate += 1;
      },
      requestPaced: () => {
        frames.paced += 1;
      },
    },
  } as unknown as SceneRenderer;
  const { pool } = siteOf(sigFiles(count));
  const deliveries = sceneDeliveriesOf(pool);
  const shapes = new PageShapes(
    renderer,
    deliveries,
    {
      onStage: () => undefined,
      onError: (error) => {
        throw error;
      },
      maySettle: () => true,
    },
    [],
  );
  shapes.follow({
    shapes: new Map(descriptions.map((shape) => [shape.element, shape])),
    removed: [],
    instances: new Map(),
  });
  deliveries.geometries.request(() => everything);
  return { shapes, frames, loadEvents };
}

test("shapes request paced frames for stages and completion, and the last shape an immediate frame", async () => {
  const { shapes, frames, loadEvents } = loadingShapes(20);
  while (shapes.isLoading)
    await new Promise((resolve) => {
      setTimeout(resolve, 1);
    });
  assert.deepEqual(loadEvents, []); // events wait for the frame
  assert.equal(frames.immediate, 1);
  assert.ok(frames.paced > 20 * 4); // one for each file, and one for each completion but the last
  shapes.onFrame();
  assert.equal(loadEvents.length, 20);
  assert.ok(shapes.isQuiet);
});

test("shapes refine a preview that displays none of their patches, or an earlier stage of them", async () => {
  const { shapes } = loadingShapes(1);
  const [element] = Array.from(shapes, (shape) => shape.element);
  assert.ok(element);
  const refines = (patches: readonly number[], stage: "base" | "full"): boolean =>
    shapes.refines({ element, patches, stage });
  assert.deepEqual([refines([0], "base"), refines([], "base")], [false, false], "nothing has arrived");
  while (shapes.isLoading)
    await new Promise((resolve) => {
      setTimeout(resolve, 1);
    });
  assert.deepEqual([refines([0], "base"), refines([], "base"), refines([0], "full")], [true, true, false]);
});
