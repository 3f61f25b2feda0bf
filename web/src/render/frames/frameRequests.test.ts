import assert from "node:assert/strict";
import { afterEach, beforeEach, describe, test } from "node:test";
import { FrameRequests } from "./frameRequests.ts";

/** Animation frames that have been requested and not cancelled, by their handles. */
const pending = new Map<number, () => void>();
let handles = 0;

function passAnimationFrame(): void {
  const callbacks = [...pending.values()];
  pending.clear();
  for (const callback of callbacks) callback();
}

/** Frames of a GPU that needs no time. */
function makeFrames(): { frames: FrameRequests; counts: { requests: number; draws: number }; draw: () => void } {
  const counts = { requests: 0, draws: 0 };
  const gl = { fenceSync: () => null, flush: () => undefined, deleteSync: () => undefined };
  const draw = (): void => {
    frames.begin();
    counts.draws += 1;
    frames.end(performance.now());
  };
  const onRequest = (): void => {
    counts.requests += 1;
  };
  const frames = new FrameRequests(gl as unknown as WebGL2RenderingContext, { onRequest, draw });
  return { frames, counts, draw };
}

describe("frames", () => {
  const { requestAnimationFrame: request, cancelAnimationFrame: cancel } = globalThis;
  beforeEach(() => {
    globalThis.requestAnimationFrame = (callback) => {
      handles += 1;
      pending.set(handles, () => {
        callback(0);
      });
      return handles;
    };
    globalThis.cancelAnimationFrame = (handle) => {
      pending.delete(handle);
    };
  });
  afterEach(() => {
    pending.clear();
    Object.assign(globalThis, { requestAnimationFrame: request, cancelAnimationFrame: cancel });
  });

  test("are drawn once for all changes before an animation frame, and not without one", () => {
    const { frames, counts } = makeFrames();
    frames.request();
    frames.request();
    frames.requestPaced();
    assert.deepEqual(counts, { requests: 3, draws: 0 });
    passAnimationFrame();
    assert.equal(counts.draws, 1);
    passAnimationFrame();
    assert.equal(counts.draws, 1);
    frames.request();
    passAnimationFrame();
    assert.equal(counts.draws, 2);
  });

  test("that are drawn at once show what has been requested", () => {
    const { frames, counts, draw } = makeFrames();
    frames.requestPaced();
    assert.ok(frames.isPacedFramePending);
    draw();
    assert.ok(!frames.isPacedFramePending);
    passAnimationFrame();
    assert.equal(counts.draws, 1);
  });

  test("that are requested while one is drawn follow it", () => {
    const { frames, counts, draw } = makeFrames();
    frames.request();
    frames.begin();
    frames.request();
    frames.end(performance.now());
    passAnimationFrame();
    assert.equal(counts.draws, 1);
    draw();
    assert.equal(pending.size, 0);
  });

  test("are not drawn after they have been cancelled", () => {
    const { frames, counts } = makeFrames();
    frames.request();
    frames.cancel();
    passAnimationFrame();
    assert.equal(counts.draws, 0);
  });
});
