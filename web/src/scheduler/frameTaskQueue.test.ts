import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { FrameTaskQueue } from "./frameTaskQueue.ts";

/** Steps of these sizes in bytes; calls `note` with the number of each. */
function* stepsOf(bytes: number[], note: (number: number) => void): Generator<number> {
  for (const [index, each] of bytes.entries()) {
    note(index + 1);
    yield each;
  }
}

/** A queue with frames that the test triggers, and a clock on which each step takes a millisecond. */
function framesOf(bytesPerFrame: number, millisecondsPerFrame: number) {
  let due: ((isHidden: boolean) => void) | undefined;
  let clock = 0;
  const done: string[] = [];
  const work = new FrameTaskQueue({
    bytesPerFrame,
    millisecondsPerFrame,
    now: () => clock,
    requestFrame: (callback) => {
      due = callback;
    },
  });
  return {
    work,
    done,
    /** Steps named a1, a2, …, of these sizes in bytes. */
    steps: (name: string, bytes: number[]) =>
      stepsOf(bytes, (number) => {
        clock += 1;
        done.push(`${name}${number}`);
      }),
    /** The steps that run before the next frame; undefined if no frame was requested. */
    frame: (isHidden = false): string[] | undefined => {
      const callback = due;
      due = undefined;
      const before = done.length;
      callback?.(isHidden);
      return callback && done.slice(before);
    },
  };
}

const { signal } = new AbortController();

describe("work before frames", () => {
  test("stops at the limit of bytes, and continues before the next frame", async () => {
    const { work, steps, frame } = framesOf(10, 1000);
    const first = work.run(steps("a", [4, 4, 4, 4]), signal);
    const second = work.run(steps("b", [4]), signal);
    assert.deepEqual(frame(), ["a1", "a2", "a3"]);
    assert.deepEqual(frame(), ["a4", "b1"]);
    await Promise.all([first, second]);
    assert.equal(frame(), undefined);
  });

  test("stops at the limit of time", () => {
    const { work, steps, frame } = framesOf(1000, 2);
    void work.run(steps("a", [1, 1, 1]), signal);
    assert.deepEqual(frame(), ["a1", "a2"]);
    assert.deepEqual(frame(), ["a3"]);
  });

  test("runs at least one step, however large it is and however late the frame", () => {
    const { work, steps, frame } = framesOf(10, 0);
    void work.run(steps("a", [99, 99]), signal);
    assert.deepEqual(frame(), ["a1"]);
    assert.deepEqual(frame(), ["a2"]);
  });

  test("runs completely where the page is hidden", () => {
    const { work, steps, frame } = framesOf(1, 1);
    void work.run(steps("a", [9, 9]), signal);
    void work.run(steps("b", [9]), signal);
    assert.deepEqual(frame(true), ["a1", "a2", "b1"]);
  });

  test("begins before a later frame, never at once", () => {
    const { work, steps, done } = framesOf(10, 10);
    void work.run(steps("a", [1]), signal);
    assert.deepEqual(done, []);
  });

  test("runs no further step after an abort, and other work continues", async () => {
    const { work, steps, frame } = framesOf(4, 10);
    const aborter = new AbortController();
    const aborted = work.run(steps("a", [4, 4, 4]), aborter.signal);
    const other = work.run(steps("b", [4]), signal);
    assert.deepEqual(frame(), ["a1"]);
    aborter.abort(new Error("removed"));
    assert.deepEqual(frame(), ["b1"]);
    frame();
    await assert.rejects(aborted, { message: "removed" });
    await other;
  });

  test("rejects with the error of a step, and other work continues", async () => {
    const { work, steps, frame } = framesOf(10, 10);
    const failing = work.run(
      (function* (): Generator<number> {
        throw new Error("no room");
      })(),
      signal,
    );
    const other = work.run(steps("b", [4]), signal);
    assert.deepEqual(frame(), ["b1"]);
    await assert.rejects(failing, { message: "no room" });
    await other;
  });
});
