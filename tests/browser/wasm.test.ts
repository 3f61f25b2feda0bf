// Tests that workers decode compact with WebAssembly where their policy allows it, with the same pictures and warnings,
// and that nothing is tried, and so reported, where it does not.

import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { pictureOfSite, until, withPage, type PageOptions, type View } from "./harness.ts";
import { gate, type TestServer } from "./server.ts";
import { siteOfGenerated } from "./sites.ts";
import { soakTest } from "./soak.ts";

/** A closed surface of 136,000 triangles in ten patches. */
const site = (): string =>
  siteOfGenerated("trefoil-large", "--profile", "compact", "--patch-vertices", "10000", "--base", "0");

const allowing = "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; report-uri /report";
const forbidding = "default-src 'self'; report-uri /report";

const isDecoder = /imgeo-decoder-\w+\.wasm$/;
const isWorker = /imgeo-worker-\w+\.js$/;
const isPatch = /geometry\/.*\.png$/;

/** Has workers count the instances of WebAssembly modules. */
function countInstances(server: TestServer): void {
  const counting = `globalThis.instanceCount = 0;
    const { Instance } = WebAssembly;
    WebAssembly.Instance = class extends Instance {
      constructor(...parameters) { super(...parameters); ++globalThis.instanceCount; }
    };`;
  server.when(isWorker, { replace: (body) => counting + String(body) });
}

async function instanceCounts({ page }: View): Promise<number[]> {
  return Promise.all(
    page
      .workers()
      .map((worker) => worker.evaluate(() => (globalThis as { instanceCount?: number }).instanceCount ?? -1)),
  );
}

const options = (policy: string, more: (server: TestServer) => void = () => undefined): PageOptions => ({
  server: (server) => {
    server.contentPolicy = policy;
    countInstances(server);
    more(server);
  },
});

describe("workers", () => {
  test("decode with WebAssembly what comes after its module, to the same picture", async () => {
    const rest = gate();
    let patchCount = 0;
    // The others leave connections for the module.
    const isLater = (path: string): boolean => isPatch.test(path) && ++patchCount > 7;
    await withPage(
      site(),
      options(allowing, (server) => void server.when(isLater, { hold: rest.closed })),
      async (view) => {
        const { server } = view;
        await until("the decoder has come", () => server.requestsOf(isDecoder)[0]?.state === "answered");
        assert.ok(server.requests.findIndex(({ path }) => isPatch.test(path)) >= 0);
        rest.open();
        await view.promise("complete");
        assert.ok((await instanceCounts(view)).some((count) => count === 1));
        assert.equal(server.requestsOf(isDecoder).length, 1, "workers share the module");
        assert.deepEqual(server.requestsOf(/report/), []);
        assert.deepEqual(await view.picture(), await pictureOfSite(site()));
      },
    );
  });

  soakTest("decode groups of levels of detail with it, to the same picture", async () => {
    const levels = siteOfGenerated("trefoil-large", "--levels", "always", "--group-triangles", "8192");
    const groups = gate();
    const isGroup = (path: string): boolean => /\/0\/[1-9]\d*\.png$/.test(path);
    const holdGroups = (server: TestServer): void => void server.when(isGroup, { hold: groups.closed });
    await withPage(levels, options(allowing, holdGroups), async (view) => {
      await until("the decoder has come", () => view.server.requestsOf(isDecoder)[0]?.state === "answered");
      groups.open();
      await view.promise("complete");
      assert.ok(view.server.requests.some(({ path }) => isGroup(path)));
      assert.ok((await instanceCounts(view)).some((count) => count === 1));
      assert.deepEqual(await view.picture(), await pictureOfSite(levels));
    });
  });

  test("decode without it where their policy forbids it, and nothing is reported", async () => {
    await withPage(site(), options(forbidding), async (view) => {
      await view.promise("complete");
      assert.ok((await instanceCounts(view)).every((count) => count === 0));
      assert.deepEqual(view.server.requestsOf(/report/), []);
    });
  });

  soakTest("decode without it where it cannot be fetched", async () => {
    const page = options(allowing, (server) => void server.when(isDecoder, { drop: true }));
    await withPage(site(), { ...page, expectedErrors: /ERR_EMPTY_RESPONSE/ }, async (view) => {
      await view.promise("complete");
      assert.ok((await instanceCounts(view)).every((count) => count === 0));
    });
  });
});
