import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { maxDownloadBytes } from "../scheduler/download.ts";
import { endlessBody } from "./endlessBody.testing.ts";
import { fetchFile } from "./fetchFile.ts";

const url = "https://a.test/patches.sig";

describe("a file that a worker fetches", () => {
  test("comes from the browser's cache where it can", async (context) => {
    const caches: (RequestCache | undefined)[] = [];
    context.mock.method(globalThis, "fetch", (_: string, { cache }: RequestInit) => {
      caches.push(cache);
      return Promise.resolve(new Response(Uint8Array.of(1, 2, 3)));
    });
    assert.deepEqual(await fetchFile(url), Uint8Array.of(1, 2, 3));
    assert.deepEqual(caches, ["force-cache"]);
  });

  test("is refused by the limit of the page's downloads, and its transfer ends", async (context) => {
    const chunk = new Uint8Array(2 ** 24);
    const endless = endlessBody(chunk);
    context.mock.method(globalThis, "fetch", () => Promise.resolve(new Response(endless.body)));
    await assert.rejects(fetchFile(url), { name: "RequestError", kind: "limit" });
    assert.ok(endless.isCancelled);
    assert.ok(endless.sentBytes <= maxDownloadBytes + 4 * chunk.length, `${endless.sentBytes} bytes`);
  });

  test("is missing where the server lacks it", async (context) => {
    context.mock.method(globalThis, "fetch", () => Promise.resolve(new Response("no", { status: 404 })));
    await assert.rejects(fetchFile(url), { name: "RequestError", kind: "http", status: 404 });
  });
});
