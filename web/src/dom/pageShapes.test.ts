import assert from "node:assert/strict";
import { test } from "node:test";
import { everything, sigFiles, sigPatch, siteOf } from "../delivery/delivery.testing.ts";
import { shapesOf } from "../document/description.ts";
import { elementsOf } from "../document/elements.testing.ts";
import { readScene } from "../document/readScene.ts";
import type { SceneRenderer } from "../render/sceneRenderer.ts";
import { sceneDeliveriesOf } from "../viewer/viewerCore.ts";
import { PageShapes } from "./pageShapes.ts";

/** A scene of as many shapes, each of a file set of its own, and what a renderer is asked for while they load. */
function loadsOf(count: number) {
  const markup = Array.from(
    { length: count },
    (_, n) => `<Shape><ImageGeometry>${sigPatch(n)}</ImageGeometry></Shape>`,
  );
  const shapes = shapesOf(readScene(elementsOf(`<X3D>${markup.join("")}</X3D>`)).root);
  const heard: string[] = [];
  for (const { element } of shapes) {
    Object.assign(element, {
      dispatchEvent: ({ type }: Event) => {
        if (type === "load") heard.push(type);
        return true;
      },
    });
  }
  const frames = { asked: 0, atPace: 0 };
  const renderer = {
    isContextLost: false,
    setStage: () => {
      frames.atPace += 1;
    },
    requestFrame: () => {
      frames.asked += 1;
    },
    requestFrameAtPace: () => {
      frames.atPace += 1;
    },
  } as unknown as SceneRenderer;
  const { pool } = siteOf(sigFiles(count));
  const deliveries = sceneDeliveriesOf(pool);
  const loads = new PageShapes(
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
  loads.follow({ shapes: new Map(shapes.map((shape) => [shape.element, shape])), removed: [], instances: new Map() });
  deliveries.geometries.request(() => everything);
  return { loads, frames, heard };
}

test("shapes that come, and those that are complete, ask for frames at the GPU's own pace, the last one at once", async () => {
  const { loads, frames, heard } = loadsOf(20);
  while (loads.isLoading)
    await new Promise((resolve) => {
      setTimeout(resolve, 1);
    });
  assert.deepEqual(heard, []); // events wait for the frame
  assert.equal(frames.asked, 1);
  assert.ok(frames.atPace > 20 * 4); // a stage for each file, and the end
  loads.onFrame();
  assert.equal(heard.length, 20);
  assert.ok(loads.isQuiet);
});
