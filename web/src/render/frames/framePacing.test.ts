import assert from "node:assert/strict";
import { afterEach, beforeEach, describe, mock, test } from "node:test";
import { FramePacer } from "./framePacing.ts";

/** A simulated GPU that needs `frameMs` for each frame, and a renderer that draws on request. */
function makeRenderer(frameMs: number): { pacer: FramePacer; frames: number[]; draw: () => void; request: () => void } {
  const fenceTimes: number[] = [];
  const gl = {
    TIMEOUT_EXPIRED: 1,
    SYNC_GPU_COMMANDS_COMPLETE: 2,
    fenceSync: () => fenceTimes.push(performance.now()) - 1,
    clientWaitSync: (fence: number) => (performance.now() - (fenceTimes[fence] ?? 0) < frameMs ? 1 : 3),
    flush: () => undefined,
    deleteSync: () => undefined,
    isContextLost: () => false,
  };
  const pacer = new FramePacer(gl as unknown as WebGL2RenderingContext);
  const frames: number[] = [];
  const draw = (): void => {
    const now = performance.now();
    pacer.begin();
    frames.push(now);
    pacer.end(now);
  };
  return {
    pacer,
    frames,
    draw,
    request: () => {
      pacer.request(draw);
    },
  };
}

let now = 0;

async function passTime(milliseconds: number): Promise<void> {
  for (let ms = 0; ms < milliseconds; ++ms) {
    now += 1;
    mock.timers.tick(1);
    for (let turn = 0; turn < 4; ++turn) await Promise.resolve();
  }
}

describe("frames that only refine the picture", () => {
  beforeEach(() => {
    mock.timers.enable({ apis: ["setTimeout"] });
    mock.method(performance, "now", () => now);
  });
  afterEach(() => {
    mock.timers.reset();
    mock.restoreAll();
  });

  test("leave a slow GPU idle for two thirds of the time, and draw every change", async () => {
    const { frames, request } = makeRenderer(100);
    for (let ms = 0; ms < 1000; ms += 10) {
      request();
      await passTime(10);
    }
    assert.ok(frames.length >= 3 && frames.length <= 4, `${frames.length} frames in a second`);
    frames.slice(1).forEach((at, i) => {
      assert.ok(at - (frames[i] ?? 0) >= 300);
    });
    const before = frames.length;
    request();
    await passTime(1000);
    assert.equal(frames.length, before + 1);
  });

  test("are drawn at every request if the GPU is fast", async () => {
    const { frames, request } = makeRenderer(4);
    for (let ms = 0; ms < 1000; ms += 20) {
      request();
      await passTime(20);
    }
    assert.equal(frames.length, 50);
  });

  test("do not delay other frames, and are skipped when another frame has shown their changes", async () => {
    const { frames, request, draw } = makeRenderer(100);
    request();
    request(); // is delayed
    draw();
    draw();
    assert.equal(frames.length, 3);
    await passTime(1000);
    assert.equal(frames.length, 3);
  });
});
