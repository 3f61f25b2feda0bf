import assert from "node:assert/strict";
import { test } from "node:test";
import { Redelivery } from "./redelivery.ts";

/** A scene that records what it is asked for. `fails`: whether the GPU fails the test of reading images. */
function makeScene(fails: boolean) {
  const calls: string[] = [];
  const warnings: string[] = [];
  const record = (call: string) => () => {
    calls.push(call);
  };
  const scene = {
    shapes: { suspend: record("suspend shapes"), join: record("join shapes") },
    surroundings: { suspend: record("suspend surroundings"), follow: record("join surroundings") },
    core: { control: { request: record("request") } },
    onRequests: record("complete"),
    warn: (message: string) => warnings.push(message),
  };
  const renderer = { uploads: { freeSpares: record("free") }, frames: { request: record("frame") } };
  const test = { readsTextures: true, isDue: false, run: () => Promise.resolve(fails) };
  const disposed = new AbortController();
  const redelivery = new Redelivery(scene, renderer, test, disposed.signal);
  return { calls, warnings, redelivery, test, disposed };
}

const again = ["join shapes", "join surroundings", "request", "frame"];

test("a lost context removes what is displayed, with a warning; a restored one requests it again", () => {
  const { calls, warnings, redelivery, disposed } = makeScene(false);
  const canvas = new EventTarget();
  redelivery.start(canvas);
  canvas.dispatchEvent(new Event("webglcontextlost"));
  assert.deepEqual(calls, ["suspend shapes", "suspend surroundings", "free"]);
  assert.match(warnings.join(), /lost its WebGL context/);
  canvas.dispatchEvent(new Event("webglcontextrestored"));
  assert.deepEqual(calls.slice(3), again);
  disposed.abort();
  canvas.dispatchEvent(new Event("webglcontextlost"));
  assert.equal(calls.length, 3 + again.length);
});

for (const fails of [false, true])
  test(`a GPU that reads images ${fails ? "wrongly" : "exactly"} is tested, then shapes complete`, async () => {
    const { calls, warnings, redelivery, test } = makeScene(fails);
    redelivery.onFrame();
    assert.deepEqual(calls, []);
    test.isDue = true;
    redelivery.onFrame();
    await Promise.resolve();
    await Promise.resolve();
    assert.deepEqual(calls, fails ? ["suspend shapes", ...again, "complete"] : ["complete"]);
    assert.equal(warnings.length, fails ? 1 : 0);
  });

test("a test that ends after the scene has been disposed of has no effect", async () => {
  const { calls, redelivery, test, disposed } = makeScene(true);
  test.isDue = true;
  redelivery.onFrame();
  disposed.abort();
  await Promise.resolve();
  await Promise.resolve();
  assert.deepEqual(calls, []);
});

test("a GPU without texture units for vertices is a warning from the beginning", () => {
  const warnings: string[] = [];
  const nothing = (): void => undefined;
  new Redelivery(
    {
      shapes: { suspend: nothing, join: nothing },
      surroundings: { suspend: nothing, follow: nothing },
      core: { control: { request: nothing } },
      onRequests: nothing,
      warn: (message) => warnings.push(message),
    },
    { uploads: { freeSpares: nothing }, frames: { request: nothing } },
    { readsTextures: false, isDue: false, run: () => Promise.resolve(false) },
    new AbortController().signal,
  );
  assert.match(warnings.join(), /cannot be read exactly/);
});
