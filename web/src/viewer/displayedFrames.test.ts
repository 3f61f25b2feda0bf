import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { GeometryDescription } from "../document/description.ts";
import { DisplayedFrames } from "./displayedFrames.ts";

const streamAt = (url: string) => ({ patches: [{ coord: [{ url }] }] }) as unknown as GeometryDescription;
const frame = (number: number, epoch = 0) => ({ number, epoch, time: number / 10 });

describe("the displayed frames of a stream", () => {
  test("are counted with those that were skipped, each once", () => {
    const frames = new DisplayedFrames();
    const stream = streamAt("live/a");
    assert.deepEqual(frames.display(stream, frame(4)), { number: 4, time: 0.4, skipped: 0 });
    assert.equal(frames.display(stream, frame(4)), undefined);
    assert.deepEqual(frames.display(stream, frame(5)), { number: 5, time: 0.5, skipped: 0 });
    assert.deepEqual(frames.display(streamAt("live/a"), frame(9)), { number: 9, time: 0.9, skipped: 3 });
    assert.equal(frames.display(stream, frame(0, 9))?.skipped, 0);
  });

  test("are counted anew for another stream", () => {
    const frames = new DisplayedFrames();
    frames.display(streamAt("live/a"), frame(4));
    assert.deepEqual(frames.display(streamAt("live/b"), frame(4)), { number: 4, time: 0.4, skipped: 0 });
  });

  test("are followed by no earlier one of the same stream and epoch", () => {
    const frames = new DisplayedFrames();
    const stream = streamAt("live/a");
    assert.equal(frames.isEarlier(stream, frame(3)), false);
    frames.display(stream, frame(4));
    assert.equal(frames.isEarlier(stream, frame(3)), true);
    assert.equal(frames.isEarlier(stream, frame(4)), false);
    assert.equal(frames.isEarlier(stream, frame(3, 1)), false);
    assert.equal(frames.isEarlier(stream, undefined), false);
    assert.equal(frames.isEarlier(streamAt("live/b"), frame(3)), false);
  });
});
