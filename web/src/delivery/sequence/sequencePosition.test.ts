import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { durationOf, frameAt } from "./sequencePosition.ts";

const timing = { frameCount: 90, rate: 30 };

describe("a position in a sequence", () => {
  test("is in the frame that has begun last", () => {
    assert.equal(frameAt({ seconds: 1.02 }, timing), 30);
    assert.equal(frameAt({ fraction: 0.5 }, timing), 45);
    assert.equal(durationOf(timing), 3);
  });

  test("at the beginning of a frame is in that frame, although numbers are rounded", () => {
    for (let frame = 0; frame < timing.frameCount; ++frame) {
      assert.equal(frameAt({ seconds: frame / timing.rate }, timing), frame);
      assert.equal(frameAt({ fraction: frame / timing.frameCount }, timing), frame);
      assert.equal(frameAt({ seconds: frame * (1 / timing.rate) }, timing), frame);
    }
  });

  test("before the first or after the last frame is in that one", () => {
    for (const before of [{ seconds: -1 }, { fraction: -0.5 }]) assert.equal(frameAt(before, timing), 0);
    for (const after of [{ seconds: 3 }, { seconds: 100 }, { fraction: 1 }]) assert.equal(frameAt(after, timing), 89);
  });
});
