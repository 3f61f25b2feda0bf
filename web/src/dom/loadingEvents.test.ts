import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { Loadable } from "./loadingEvents.ts";
import { lowestStageOf, LoadingEvents } from "./loadingEvents.ts";

/** An element, and a log of the events that it gets. */
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
    (value) => (value === pending ? "pending" : "resolved"),
    () => "rejected",
  );
}

describe("the loading of an element", () => {
  test("sends first-image and refine after the frame that displays a stage, each once", async () => {
    const { element, log } = elementWithLog();
    const loading = new LoadingEvents(element);
    loading.onFrame(isShape);
    loading.reach("points");
    assert.deepEqual([log, await stateOf(element.firstImage)], [[], "pending"]);
    loading.onFrame(isShape);
    loading.onFrame(isShape);
    loading.reach("shaded");
    loading.reach("surface"); // a lower stage is ignored
    loading.updateProgress(half);
    loading.onFrame(isShape);
    loading.reach("full");
    loading.settle();
    assert.equal(await stateOf(element.complete), "pending");
    loading.onFrame(isShape);
    loading.onFrame(isShape);
    assert.deepEqual(log, ["first-image points", "progress points", "refine shaded", "refine full", "load"]);
    assert.deepEqual([await stateOf(element.firstImage), await stateOf(element.complete)], ["resolved", "resolved"]);
  });

  test("sends the same progress once", () => {
    const { element, log } = elementWithLog();
    const loading = new LoadingEvents(element);
    loading.updateProgress(half);
    loading.updateProgress({ ...half });
    assert.deepEqual(log, ["progress none"]);
  });

  test("rejects a shape's promise after an error, but resolves the scene's, after the error events", async () => {
    for (const [isOfScene, complete, lastEvent] of [
      [isShape, "rejected", "first-image points"],
      [isScene, "resolved", "load"],
    ] as const) {
      const { element, log } = elementWithLog();
      const loading = new LoadingEvents(element);
      loading.reach("points");
      loading.fail({ type: "http", url: "a.png", element, message: "a.png: 404" }, new Error("a.png: 404"));
      loading.settle();
      loading.onFrame(isOfScene);
      assert.equal(await stateOf(element.complete), complete);
      assert.equal(await stateOf(element.firstImage), "resolved");
      assert.equal(log.at(-1), lastEvent);
      assert.equal(log[0], "error");
    }
  });

  test("sends refine once for each finer stage after load", () => {
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

  test("lists errors on the element until it loads again", () => {
    const { element } = elementWithLog();
    const loading = new LoadingEvents(element);
    assert.deepEqual(element.errors, []);
    const detail = { type: "http", url: "a.png", element, message: "a.png: 404" };
    loading.fail(detail, new Error(detail.message));
    assert.deepEqual(element.errors, [detail]);
    new LoadingEvents(element);
    assert.deepEqual(element.errors, []);
  });

  test("rejects its promises and sends no event after it was abandoned", async () => {
    const { element, log } = elementWithLog();
    const loading = new LoadingEvents(element);
    loading.reach("points");
    loading.abandon();
    loading.settle();
    loading.onFrame(isShape);
    assert.deepEqual(log, []);
    await assert.rejects(element.complete, { name: "AbortError" });
  });

  test("puts new promises on the element when it begins to load again", () => {
    const { element } = elementWithLog();
    new LoadingEvents(element).abandon();
    const { complete } = element;
    new LoadingEvents(element);
    assert.notEqual(element.complete, complete);
  });
});

test('lowestStageOf gives the lowest stage, and "none" for no stages', () => {
  assert.equal(lowestStageOf(["full", "points", "shaded"]), "points");
  assert.equal(lowestStageOf(["full", "none"]), "none");
  assert.equal(lowestStageOf([]), "none");
});
