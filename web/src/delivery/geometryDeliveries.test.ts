import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { elementsOf } from "../document/elements.testing.ts";
import { shapesOf } from "../document/description.ts";
import { readScene } from "../document/readScene.ts";
import { Scheduler } from "../scheduler/scheduler.ts";
import type { DeliveryListener } from "./geometryDelivery.ts";
import { ResourcePool } from "./resourcePool.ts";
import { bgDelivery } from "./encodings/bg/bgDelivery.ts";
import { addEncodings } from "./encodings/encodings.ts";
import { GeometryDeliveries } from "./geometryDeliveries.ts";

addEncodings({ bg: bgDelivery });

const [geometry] = shapesOf(
  readScene(elementsOf(`<X3D><Shape><BinaryGeometry vertexCount="3" coord="c.bin" normal="n.bin"/></Shape></X3D>`))
    .root,
).map((shape) => shape.geometry);

/**
 * Deliveries from a server that has coordinates but no normals and answers after `respond`, and the URLs requested from
 * it.
 */
function deliveriesOf() {
  assert.ok(geometry);
  const requested: string[] = [];
  let aborted = 0;
  const answer = Promise.withResolvers<undefined>();
  const fetchFile = async (url: string, signal: AbortSignal): Promise<Response> => {
    requested.push(url);
    signal.addEventListener("abort", () => {
      aborted += 1;
      answer.reject(signal.reason as Error);
    });
    await answer.promise;
    return url === "c.bin" ? new Response(new Uint8Array(36)) : new Response("", { status: 404 });
  };
  const deliveries = new GeometryDeliveries(
    new ResourcePool({
      scheduler: new Scheduler(6),
      makeImage: () => Promise.reject(new Error("no images here")),
      readsTextures: () => Promise.resolve(true),
      maxTextureSize: 2048,
      runJob: () => Promise.reject(new Error("no jobs here")),
      makeWritableImage: () => {
        throw new Error("no streams here");
      },
      makeWritableArray: () => {
        throw new Error("no streams here");
      },
      makeTextureImage: () => Promise.reject(new Error("no texture images here")),
      storeBytes: ({ byteLength }) => Promise.resolve({ byteLength, close: () => undefined }),
      download: {
        fetch: (url, init) => fetchFile(url as string, init?.signal ?? new AbortController().signal),
        idleTimeoutMs: 20_000,
        retries: 0,
        backoffMs: 1,
      },
      resolve: (url) => url,
      onTransfer: () => undefined,
    }),
  );
  /** Requests all files of all joined geometries. */
  const requestAll = () => {
    deliveries.request(() => () => 1);
  };
  return {
    geometry,
    deliveries,
    requestAll,
    requested,
    aborted: () => aborted,
    respond: () => {
      answer.resolve(undefined);
    },
  };
}

/** A listener that records stage names, URLs of failed files and "settled" in `log`. */
function makeRecorder() {
  const log: string[] = [];
  const settled = Promise.withResolvers<undefined>();
  const stages: unknown[] = [];
  const listener: DeliveryListener = {
    onStage: (_, stage) => {
      log.push(stage?.name ?? "nothing");
      stages.push(stage);
    },
    onError: (error) => {
      log.push(error.url);
    },
    onSettled: () => {
      log.push("settled");
      settled.resolve(undefined);
    },
  };
  return { log, stages, listener, settled: settled.promise };
}

describe("a geometry that several shapes use", () => {
  test("is requested once, and reports its stages and errors also to listeners that join later", async () => {
    const { geometry, deliveries, requestAll, requested, respond } = deliveriesOf();
    const [early, alsoEarly, late] = [makeRecorder(), makeRecorder(), makeRecorder()];
    deliveries.join(geometry, early.listener);
    deliveries.join(geometry, alsoEarly.listener);
    requestAll();
    respond();
    await Promise.all([early.settled, alsoEarly.settled]);
    deliveries.join(geometry, late.listener);
    assert.deepEqual(late.log, []);
    await late.settled;
    assert.deepEqual(late.log, ["surface", "n.bin", "settled"]);
    for (const { log } of [early, alsoEarly]) assert.deepEqual(log.toSorted(), late.log.toSorted());
    assert.equal(late.stages[0], early.stages[0]); // the same object, so its arrays are stored once
    assert.deepEqual(requested, ["c.bin", "n.bin"]);
  });

  test("is aborted when its last listener leaves, and calls no listener that has left", async () => {
    const { geometry, deliveries, requestAll, requested, aborted } = deliveriesOf();
    const [first, second] = [makeRecorder(), makeRecorder()];
    const firstJoin = deliveries.join(geometry, first.listener);
    const secondJoin = deliveries.join(geometry, second.listener);
    requestAll();
    await new Promise((resolve) => setTimeout(resolve));
    assert.equal(requested.length, 2);
    firstJoin.cancel();
    firstJoin.cancel();
    assert.equal(aborted(), 0);
    secondJoin.cancel();
    assert.equal(aborted(), 2);
    // A third listener requests the geometry again, and leaves before any stage.
    const thirdJoin = deliveries.join(geometry, makeRecorder().listener);
    requestAll();
    thirdJoin.cancel();
    await new Promise((resolve) => setTimeout(resolve, 5));
    assert.deepEqual([first.log, second.log], [[], []]);
  });
});
