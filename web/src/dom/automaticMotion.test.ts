import assert from "node:assert/strict";
import { afterEach, beforeEach, describe, test } from "node:test";
import { AutoRotation } from "../navigation/autoRotation.ts";
import type { MovingView } from "./automaticMotion.ts";
import { AutomaticMotion } from "./automaticMotion.ts";

const settings = {
  "auto-rotate": true,
  "auto-rotate-delay": 1e6,
  "rotation-per-second": 1,
  paused: undefined as boolean | undefined,
};

describe("automatic motion", () => {
  let preference: EventTarget & { matches: boolean };
  beforeEach(() => {
    preference = Object.assign(new EventTarget(), { matches: false });
    Object.assign(globalThis, { matchMedia: () => preference });
  });
  const rotations: AutoRotation[] = [];
  afterEach(() => {
    for (const rotation of rotations.splice(0)) rotation.stop(); // no timer outlives its test
    Reflect.deleteProperty(globalThis, "matchMedia");
  });

  /** A view with these settings. */
  function viewOf(changed: Partial<typeof settings>, aborter = new AbortController()) {
    const autoRotation = new AutoRotation(() => undefined);
    rotations.push(autoRotation);
    const cameraController = { autoRotation, isInstant: false };
    const shown = { isVisible: true };
    const clocks: { isPaused: boolean; mayStart: boolean }[] = [];
    const setMotion = (isPaused: boolean, mayStart: boolean): void => {
      clocks.push({ isPaused, mayStart });
    };
    const view: MovingView = {
      viewer: { cameraController, scene: { animation: { setMotion } } },
      settings: () => ({ ...settings, ...changed }),
      isSceneVisible: () => shown.isVisible,
    };
    const motion = new AutomaticMotion(view, aborter.signal);
    motion.update();
    return { motion, autoRotation, cameraController, shown, clocks, aborter };
  }

  function prefer(isReduced: boolean): void {
    preference.matches = isReduced;
    preference.dispatchEvent(Object.assign(new Event("change"), { matches: isReduced }));
  }

  test("rotates with `auto-rotate` once the scene is visible", () => {
    const { motion, autoRotation, shown } = viewOf({});
    assert.deepEqual([autoRotation.isStopped, autoRotation.delayMs, autoRotation.radiansPerSecond], [false, 1e6, 1]);
    shown.isVisible = false;
    motion.updateRotation();
    assert.ok(autoRotation.isStopped);
    assert.ok(viewOf({ "auto-rotate": false }).autoRotation.isStopped);
  });

  test("follows what the user prefers until the view is disposed of", () => {
    const { autoRotation, cameraController, clocks, aborter } = viewOf({});
    prefer(true);
    assert.deepEqual([autoRotation.isStopped, cameraController.isInstant], [true, true]);
    assert.deepEqual(clocks.at(-1), { isPaused: false, mayStart: false });
    prefer(false);
    assert.deepEqual([autoRotation.isStopped, cameraController.isInstant], [false, false]);
    autoRotation.stop();
    aborter.abort();
    prefer(true);
    assert.equal(cameraController.isInstant, false);
  });

  test("stops all clocks with `paused`; `paused=false` starts those that the user prefers not to start", () => {
    preference.matches = true;
    assert.deepEqual(viewOf({ paused: true }).clocks, [{ isPaused: true, mayStart: false }]);
    assert.deepEqual(viewOf({ paused: false }).clocks, [{ isPaused: false, mayStart: true }]);
    preference.matches = false;
    assert.deepEqual(viewOf({}).clocks, [{ isPaused: false, mayStart: true }]);
  });
});
