// Tests which files of a sequence are held, and which of their frames are decoded and displayed, with the files of
// vectors/sequence-1.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, test } from "node:test";
import { jobs } from "../../decode/jobs.ts";
import type { RunJob } from "../../decode/jobs.ts";
import { DecodeError } from "../../decode/decodeError.ts";
import { framesOfFile } from "../../decode/sequence/sequenceFrames.ts";
import type { SequenceIndex } from "../../decode/sequence/sequenceIndex.ts";
import { readSequenceIndex } from "../../decode/sequence/sequenceIndex.ts";
import type { Content } from "../content.ts";
import type { ResourceRequest } from "../resource.ts";
import type { ResourceHandle } from "../resourcePool.ts";
import { FramesAhead } from "./framesAhead.ts";
import { PackedRuns } from "./packedRuns.ts";
import { maxBufferedBytes, SequenceFiles } from "./sequenceFiles.ts";

const directory = join(import.meta.dirname, "../../../../vectors/sequence-1");
const bytesOf = (name: string) => Uint8Array.from(readFileSync(join(directory, name)));
const index = readSequenceIndex(bytesOf("points.index.json"));
const file = index.files[0] ?? assert.fail();
const soon = () => new Promise((resolve) => setTimeout(resolve, 5));

/** The high bytes of the x coordinates of a frame, as its images have them. */
function integersOf(frame: number): number[] {
  const all = JSON.parse(readFileSync(join(directory, "points.json"), "utf8")) as number[][][];
  return all[frame]?.[0]?.map((value) => value >> 8) ?? [];
}

interface RecordedJob {
  readonly count: number;
  readonly from: number;
  readonly isContinued: boolean;
}

/** `job` resolves when the job that has begun last has ended. */
function framesAhead() {
  const frames = framesOfFile(bytesOf("points.igf"), file, index);
  const recorded: RecordedJob[] = [];
  const errors: unknown[] = [];
  let running: Promise<unknown> = Promise.resolve();
  const run = async (name: keyof typeof jobs, input: never, signal: AbortSignal) => {
    const { frames: packed, before, from } = input as { frames: unknown[]; before: unknown; from: number };
    recorded.push({ count: packed.length, from, isContinued: before !== undefined });
    const output = await jobs[name](input);
    signal.throwIfAborted();
    return output;
  };
  const runJob = ((name: keyof typeof jobs, input: never, signal: AbortSignal) => {
    const output = run(name, input, signal);
    running = output.catch(() => undefined).then(soon);
    return output;
  }) as RunJob;
  const ahead = new FramesAhead({
    index,
    runs: new PackedRuns({ index, framesOf: () => frames, runJob, form: () => ({ kind: "images" }) }),
    onFrames: () => undefined,
    onError: (_, error) => errors.push(error),
  });
  return { ahead, recorded, errors, job: () => running };
}

function take(ahead: FramesAhead, due: number, displayed: number | undefined): number | undefined {
  const frame = ahead.take(due, displayed);
  if (frame === undefined) return undefined;
  assert.ok("width" in frame);
  const texels = frame.coord[0] ?? assert.fail();
  const integers = integersOf(frame.header.number);
  assert.deepEqual(
    integers.map((_, vertex) => texels[4 * vertex]),
    integers,
  );
  return frame.header.number;
}

describe("frames ahead", () => {
  test("are decoded in one run, and each is displayed when it is due", async () => {
    const { ahead, recorded, job } = framesAhead();
    ahead.decode(0, undefined);
    assert.equal(take(ahead, 0, undefined), undefined);
    await job();
    for (let due = 0; due < 5; ++due) assert.equal(take(ahead, due, due === 0 ? undefined : due - 1), due);
    assert.deepEqual(recorded, [{ count: 5, from: 0, isContinued: false }]);
  });

  test("after a seek begin with the frames that the due one needs, which are not displayed", async () => {
    const { ahead, recorded, job } = framesAhead();
    ahead.decode(3, undefined);
    await job();
    assert.equal(take(ahead, 3, undefined), 3);
    assert.deepEqual(recorded, [{ count: 5, from: 3, isContinued: false }]);
    // Frames before the due one follow when the sequence comes to its beginning.
    ahead.decode(3, 3);
    await job();
    assert.equal(take(ahead, 4, 3), 4);
    assert.equal(take(ahead, 0, 4), 0);
    assert.equal(recorded.length, 2);
  });

  test("that are late are displayed late, and never after a later one", async () => {
    const { ahead, job } = framesAhead();
    ahead.decode(0, undefined);
    await job();
    for (const due of [0, 1, 3, 4]) assert.equal(take(ahead, due, undefined), due);
    assert.equal(take(ahead, 4, 4), undefined);
    assert.equal(take(ahead, 4, 1), 2);
    assert.equal(take(ahead, 4, 2), undefined);
  });

  test("are forgotten, with what is being decoded, where another form is asked for", async () => {
    const { ahead, errors, job } = framesAhead();
    ahead.decode(0, undefined);
    ahead.clear();
    await job();
    assert.equal(take(ahead, 0, undefined), undefined);
    ahead.decode(0, undefined);
    await job();
    assert.equal(take(ahead, 0, undefined), 0);
    assert.deepEqual(errors, []);
  });
});

/** A sequence of files of one frame, and a pool whose downloads the test ends. */
function filesOf(sizes: readonly number[]) {
  const long: SequenceIndex = {
    ...index,
    files: sizes.map((bytes, first) => ({ url: `${first}.igf`, first, frames: 1, bytes })),
    frameCount: sizes.length,
  };
  const open = new Map<string, { priority: number; content: PromiseWithResolvers<Content> }>();
  const errors: [unknown, string][] = [];
  const acquire = ({ url, priority }: ResourceRequest): ResourceHandle => {
    const entry = { priority, content: Promise.withResolvers<Content>() };
    open.set(url, entry);
    return {
      transfer: { url, state: "loading", loadedBytes: 0, totalBytes: 0, tries: 1, error: undefined },
      content: entry.content.promise,
      setPriority: (value) => {
        entry.priority = value;
      },
      fail: () => undefined,
      finish: () => undefined,
      release: () => open.delete(url),
    };
  };
  const files = new SequenceFiles(
    long,
    (n) => `${n}.igf`,
    { acquire },
    { onFile: () => undefined, onError: (error, url) => errors.push([error, url]) },
  );
  return { files, open, errors };
}

describe("files of a sequence", () => {
  const third = Math.floor(maxBufferedBytes / 3);

  test("are requested ahead within a budget, those that come first at higher priorities", () => {
    const { files, open } = filesOf([third, third, third, third, third]);
    files.follow(3, 64);
    assert.deepEqual(
      Array.from(open, ([url, { priority }]) => [url, priority]),
      [
        ["3.igf", 64],
        ["4.igf", 16],
        ["0.igf", 4],
      ],
    );
    files.follow(4, 64);
    assert.deepEqual(Array.from(open.keys()), ["4.igf", "0.igf", "1.igf"]);
    assert.equal(open.get("0.igf")?.priority, 16);
    files.clear();
    assert.equal(open.size, 0);
  });

  test("are the present one and the next, however large", () => {
    const { files, open } = filesOf([maxBufferedBytes, maxBufferedBytes, maxBufferedBytes]);
    files.follow(0, 1);
    assert.deepEqual(Array.from(open.keys()), ["0.igf", "1.igf"]);
  });

  test("that are cut are reported once and not requested again", async () => {
    const { files, open, errors } = filesOf([643, 643]);
    files.follow(0, 1);
    open.get("0.igf")?.content.resolve({ kind: "bytes", bytes: bytesOf("points.igf").slice(0, 60) });
    await soon();
    assert.deepEqual(files.framesOf(0), []);
    assert.equal(files.framesOf(1), undefined);
    files.follow(1, 1);
    files.follow(0, 1);
    assert.deepEqual(Array.from(open.keys()), ["1.igf"]);
    assert.equal(errors.length, 1);
    assert.ok(errors[0]?.[0] instanceof DecodeError);
    assert.equal(errors[0][1], "0.igf");
  });
});
