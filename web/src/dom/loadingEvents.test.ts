import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { Loadable } from "./loadingEvents.ts";
import { lowestStageOf, LoadingEvents } from "./loadingEvents.ts";

/** An element that keeps what it is told. */
function elementWithLog() {
  const element = new EventTarget() as Element & Loadable;
  const log: string[] = [];
  for (const type of ["progress", "first-image", "refine", "load", "error"]) {
    element.addEventListener(type, (event) => {
      assert.equal(event.bubbles, false);
      const { stage } = (event as CustomEvent<{ stage?: string }>).detail;
      log.push(stage === undefined ? type : `${type} ${stage}`);
    });
  }
  return { element, log };
}

const half = { totalProgress: 0.5, loadedBytes: 5, totalBytes: 10 };
const isScene = true;
const isShape = false;

async function stateOf(promise: Promise<unknown>): Promise<string> {
  const pending = {};
  return Promise.race([promise, Promise.resolve(pending)]).then(
    (value) => (value === pending ? "pending" : "kept"),
    () => "broken",
  );
}

describe("loading", () => {
  test("tells of a picture after the frame that shows it, and of each rise once", async () => {
    const { element, log } = elementWithLog();
    const loading = new LoadingEvents(element);
    loading.onFrame(isShape);
    loading.reach("points");
    assert.deepEqual([log, await stateOf(element.firstImage)], [[], "pending"]);
    loading.onFrame(isShape);
    loading.onFrame(isShape);
    loading.reach("shaded");
    loading.reach("surface"); // a stage never falls
    loading.updateProgress(half);
    loading.onFrame(isShape);
    loading.reach("full");
    loading.settle();
    assert.equal(await stateOf(element.complete), "pending");
    loading.onFrame(isShape);
    loading.onFrame(isShape);
    assert.deepEqual(log, ["first-image points", "progress points", "refine shaded", "refine full", "load"]);
    assert.deepEqual([await stateOf(element.firstImage), await stateOf(element.complete)], ["kept", "kept"]);
  });

  test("tells the same progress once", () => {
    const { element, log } = elementWithLog();
    const loading = new LoadingEvents(element);
    loading.updateProgress(half);
    loading.updateProgress({ ...half });
    assert.deepEqual(log, ["progress none"]);
  });

  test("that failed breaks a shape's promise but keeps the scene's, after the error events", async () => {
    for (const [who, complete, last] of [
      [isShape, "broken", "error"],
      [isScene, "kept", "load"],
    ] as const) {
      const { element, log } = elementWithLog();
      const loading = new LoadingEvents(element);
      loading.reach("points");
      loading.fail({ type: "http", url: "a.png", element, message: "a.png: 404" }, new Error("a.png: 404"));
      loading.settle();
      loading.onFrame(who);
      assert.equal(await stateOf(element.complete), complete);
      assert.equal(await stateOf(element.firstImage), "kept");
      assert.equal(log.at(-1), last === "error" ? "first-image points" : last);
      assert.equal(log[0], "error");
    }
  });

  test("goes on to tell of finer stages after its end, once each", () => {
    const { element, log } = elementWithLog();
    const loading = new LoadingEvents(element);
    loading.reach("shaded");
    loading.settle();
    loading.onFrame(isShape);
    loading.reach("full");
    loading.onFrame(isShape);
    loading.onFrame(isShape);
    assert.deepEqual(log, ["first-image shaded", "load", "refine full"]);
    loading.abandon();
    loading.onFrame(isShape);
    assert.equal(log.length, 3);
  });

  test("keeps what failed on the element", () => {
    const { element } = elementWithLog();
    const loading = new LoadingEvents(element);
    assert.deepEqual(element.errors, []);
    const detail = { type: "http", url: "a.png", element, message: "a.png: 404" };
    loading.fail(detail, new Error(detail.message));
    assert.deepEqual(element.errors, [detail]);
    new LoadingEvents(element);
    assert.deepEqual(element.errors, []);
  });

  test("that is abandoned breaks its promises and falls silent", async () => {
    const { element, log } = elementWithLog();
    const loading = new LoadingEvents(element);
    loading.reach("points");
    loading.abandon();
    loading.settle();
    loading.onFrame(isShape);
    assert.deepEqual(log, []);
    await assert.rejects(element.complete, { name: "AbortError" });
  });

  test("that begins anew puts new promises on the element", () => {
    const { element } = elementWithLog();
    new LoadingEvents(element).abandon();
    const { complete } = element;
    new LoadingEvents(element);
    assert.notEqual(element.complete, complete);
  });
});

test("a scene is as far as its last shape", () => {
  assert.equal(lowestStageOf(["full", "points", "shaded"]), "points");
  assert.equal(lowestStageOf(["full", "none"]), "none");
  assert.equal(lowestStageOf([]), "none");
});
