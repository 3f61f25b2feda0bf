import assert from "node:assert/strict";
import type { TestContext } from "node:test";
import { test } from "node:test";
import type { SceneDeliveries } from "../delivery/requestWithinBudget.ts";
import { DeliveryControl } from "./deliveryControl.ts";

/** A control of deliveries whose state the test sets, under a clock that it sets, too. */
function control({ mock }: TestContext) {
  mock.timers.enable({ apis: ["setTimeout"] });
  const state = { areLoaded: false, startedCount: 1, requests: 0, questions: 0 };
  const deliveries = {
    geometries: {
      get followView() {
        state.questions += 1;
        return !state.areLoaded;
      },
      get startedCount() {
        return state.startedCount;
      },
      storedBytes: 0,
      followViews: () => undefined,
      request: () => (state.requests += 1),
    },
    textures: { areExhausted: true, startedCount: 0, storedBytes: 0, request: () => undefined },
  } as unknown as SceneDeliveries;
  const controlled = new DeliveryControl({
    deliveries,
    view: () => undefined,
    sceneTextures: () => new Set(),
    takeMoved: () => [],
    onRequests: () => undefined,
  });
  controlled.start();
  /** Shapes move in each of sixty frames; returns the requests and the questions that this has caused. */
  const moveShapes = (): Pick<typeof state, "requests" | "questions"> => {
    const { requests, questions } = state;
    for (let frame = 0; frame < 60; ++frame) {
      controlled.followMoves();
      mock.timers.tick(16);
    }
    return { requests: state.requests - requests, questions: state.questions - questions };
  };
  return { state, controlled, moveShapes };
}

test("shapes that move change the order of requests about ten times a second while files are loaded", (context) => {
  const { moveShapes } = control(context);
  const { requests } = moveShapes();
  assert.ok(requests >= 8 && requests <= 10, `${requests} requests`);
});

test("where everything has loaded, shapes that move ask the deliveries once", (context) => {
  const { state, moveShapes } = control(context);
  state.areLoaded = true;
  assert.deepEqual(moveShapes(), { requests: 0, questions: 1 });
  assert.deepEqual(moveShapes(), { requests: 0, questions: 0 });
});

test("another delivery, and a request for another reason, end the rest", (context) => {
  const { state, controlled, moveShapes } = control(context);
  state.areLoaded = true;
  moveShapes();
  state.startedCount += 1;
  assert.equal(moveShapes().questions, 1);
  state.areLoaded = false;
  controlled.request();
  assert.ok(moveShapes().requests >= 8);
});
