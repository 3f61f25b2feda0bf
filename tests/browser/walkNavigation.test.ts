// Tests WALK in the generated hall: in through the door, down the stairs, onto the stage, and not through walls.

import assert from "node:assert/strict";
import type { ViewElement } from "../../web/src/dom/imgeoView.ts";
import { hallSite } from "./exampleSites.ts";
import { focusView } from "./gestures.ts";
import { until, withPage, type View } from "./harness.ts";
import { soakTest } from "./soak.ts";

interface Eye {
  x: number;
  y: number;
  z: number;
}

/** Dimensions of the generated hall in meters. */
const rowDepth = 0.95,
  rowRise = 0.16,
  firstRow = 5,
  rows = 4;
const back = firstRow + (rows - 0.5) * rowDepth;

/** Height of the floor in the aisle. */
function floorAt(z: number): number {
  return rowRise * Math.min(Math.max(Math.round((z - firstRow) / rowDepth), 0), rows - 1);
}

/** Records every position of the camera in the page. */
function recordPositions(): void {
  const eyes: unknown[] = [];
  Object.assign(window, { eyes });
  document.addEventListener("DOMContentLoaded", () => {
    const x3d = document.querySelector<ViewElement>("x3d")!;
    x3d.addEventListener("camera-change", () => eyes.push({ ...x3d.getCameraPosition() }));
  });
}

async function eyeIn({ page }: View): Promise<Eye> {
  return page.evaluate(() => ({ ...document.querySelector<ViewElement>("x3d")!.getCameraPosition() }));
}

/** Holds a key until the camera has reached a position, and for some more frames, in which it must not move on. */
async function holdUntil(view: View, key: string, what: string, isThere: (eye: Eye) => boolean): Promise<Eye> {
  await view.page.keyboard.down(key);
  await until(what, async () => isThere(await eyeIn(view)));
  await view.page.evaluate(async () => {
    for (let count = 0; count < 8; ++count) await new Promise(requestAnimationFrame);
  });
  await view.page.keyboard.up(key);
  return eyeIn(view);
}

const assertNear = (actual: number, expected: number, tolerance: number, what: string): void => {
  assert.ok(Math.abs(actual - expected) <= tolerance, `${what}: ${actual} is not ${expected}`);
};

soakTest("WALK leads into the hall, down its stairs and up to the stage, and not through walls", async () => {
  await withPage(hallSite(rows), { before: recordPositions, size: { width: 240, height: 180 } }, async (view) => {
    await view.promise("complete");
    await focusView(view);
    const door = await eyeIn(view);
    assertNear(door.z, back + 2.5, 1e-6, "the viewpoint before the door");
    const front = await holdUntil(view, "ArrowUp", "the camera is before the stage", ({ y, z }) => z < 1.9 && y < 1.65);
    assertNear(front.z, 1.5 + 0.25, 0.15, "before the stage");
    assertNear(front.y, 1.6, 0.05, "on the floor before the stage");

    const eyes = await view.page.evaluate(() => (window as unknown as { eyes: Eye[] }).eyes);
    const walked = eyes.filter(({ z }) => z < back - 0.3);
    assert.ok(walked.length > 5, `${walked.length} frames`);
    for (const { y, z } of walked) {
      const floor = Math.min(floorAt(z - 0.3), floorAt(z + 0.3));
      assert.ok(y > floor + 1.6 - rowRise - 0.05, `at z = ${z} the camera's y is ${y}, that of the floor ${floor}`);
    }

    // Up the steps of the stage.
    await view.page.evaluate(() => {
      document.querySelector<ViewElement>("x3d")!.bindViewpoint("Before the steps");
    });
    const wall = await holdUntil(
      view,
      "ArrowUp",
      "the camera is on the stage, before the wall",
      ({ y, z }) => z < -3.6 && y > 2.45,
    );
    assertNear(wall.y, 0.9 + 1.6, 0.05, "on the stage");
    assertNear(wall.z, -4 + 0.25, 0.1, "before the wall");

    const framesOfTen = (): Promise<number> =>
      view.page.evaluate(async () => {
        const frames = (): number => document.querySelector<ViewElement>("x3d")!.statistics!.frames;
        const before = frames();
        for (let count = 0; count < 10; ++count) await new Promise(requestAnimationFrame);
        return frames() - before;
      });
    await until("no frames are drawn after walking", async () => (await framesOfTen()) === 0);
  });
});
