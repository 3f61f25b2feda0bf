import assert from "node:assert/strict";
import { afterEach, beforeEach, describe, mock, test } from "node:test";
import type { BufferUpload } from "../render/uploads/bufferProvider.ts";
import type { SceneRenderer } from "../render/sceneRenderer.ts";
import { UploadPipeline } from "./uploadPipeline.ts";

const megabyte = 2 ** 20;

/** Uploads arrays in steps of one megabyte. */
class FakeRenderer {
  readonly uploads = this;
  isEmpty = false;
  uploadedBytes = 0;
  closedCount = 0;

  beginBuffer({ byteLength }: { byteLength: number }): BufferUpload {
    const uploadStep = (): void => {
      this.uploadedBytes += megabyte;
    };
    function* steps(): Generator<number, void, void> {
      for (let left = byteLength; left > 0; left -= megabyte) {
        uploadStep();
        yield megabyte;
      }
    }
    return {
      bytes: {
        byteLength,
        close: () => {
          this.closedCount += 1;
        },
      },
      steps: steps(),
    };
  }
}

describe("the upload pipeline", () => {
  let frames: (() => void)[] = [];
  const page = {
    requestAnimationFrame: (callback: () => void) => frames.push(callback),
    cancelAnimationFrame: () => undefined,
    document: { hidden: false },
  };

  beforeEach(() => {
    frames = [];
    mock.timers.enable({ apis: ["setTimeout"] });
    Object.assign(globalThis, page);
  });
  afterEach(() => {
    mock.timers.reset();
    for (const name of Object.keys(page)) Reflect.deleteProperty(globalThis, name);
  });

  const nextFrame = async (): Promise<void> => {
    frames.shift()?.();
    await Promise.resolve();
  };

  const store = (renderer: FakeRenderer, megabytes: number, signal = new AbortController().signal) =>
    new UploadPipeline(renderer as unknown as SceneRenderer, () =>
      Promise.reject(new Error("no jobs here")),
    ).storeBytes(new Uint8Array(megabytes * megabyte), "vertices", signal);

  test("uploads at most 4 MiB before each frame until all is uploaded", async () => {
    const renderer = new FakeRenderer();
    const stored = store(renderer, 11);
    const maxBytes = 4 * megabyte;
    assert.equal(renderer.uploadedBytes, 0, "nothing is uploaded before a frame");
    const bytesByFrame: number[] = [];
    const sum = (): number => bytesByFrame.reduce((all, bytes) => all + bytes, 0);
    while (sum() < 11 * megabyte) {
      await nextFrame();
      bytesByFrame.push(renderer.uploadedBytes - sum());
    }
    await nextFrame(); // finds that no step is left
    assert.ok(
      bytesByFrame.length >= 3 && bytesByFrame.every((bytes) => bytes > 0 && bytes <= maxBytes),
      `${bytesByFrame.join(", ")} bytes before a frame`,
    );
    assert.equal((await stored).byteLength, 11 * megabyte);
    assert.equal(renderer.closedCount, 0);
  });

  test("does not wait for frames while the scene is empty", async () => {
    const renderer = new FakeRenderer();
    renderer.isEmpty = true;
    const stored = store(renderer, 1);
    assert.deepEqual(frames, []);
    for (let turn = 0; turn < 9; ++turn) mock.timers.tick(0);
    await stored;
  });

  test("frees the memory of an aborted upload", async () => {
    const renderer = new FakeRenderer();
    const aborter = new AbortController();
    const stored = store(renderer, 11, aborter.signal);
    await nextFrame();
    aborter.abort(new Error("removed"));
    const { uploadedBytes } = renderer;
    await Promise.all([assert.rejects(stored, { message: "removed" }), nextFrame()]);
    assert.deepEqual([renderer.uploadedBytes, renderer.closedCount], [uploadedBytes, 1]);
  });
});
