// The configuration of docs/live.md in a real nginx: many viewers, who get frames from its cache.

import assert from "node:assert/strict";
import { setTimeout as pause } from "node:timers/promises";
import { test } from "node:test";
import { findNginx, startNginx, type Nginx } from "./live/nginx.ts";
import { startStream } from "./live/stream.ts";
import { startViewer, transportTo, type ViewerOptions } from "./live/viewers.ts";

const nginx = findNginx();
const viewerCount = 20;
const rate = 20;

async function until(condition: () => boolean): Promise<void> {
  const deadline = Date.now() + 60_000;
  while (!condition()) {
    assert.ok(Date.now() < deadline, "the viewers displayed no frames for a minute");
    await pause(50);
  }
}

/** Whether at most one of five requests for the newest frame reaches the server. It may be gone before the last. */
async function isServedFromCache(front: Nginx, viewer: ViewerOptions): Promise<boolean> {
  const transport = transportTo(viewer);
  const { number } = (await (await transport.fetch(`${viewer.url}/latest`)).json()) as { number: number };
  const before = front.counts();
  const statuses: number[] = [];
  for (let n = 0; n < 5; ++n) statuses.push((await transport.fetch(`${viewer.url}/frames/${number}`)).status);
  transport.close();
  await until(() => front.counts().frames >= before.frames + 5); // nginx writes a line after each response
  return statuses.every((status) => status === 200) && front.counts().passed <= before.passed + 1;
}

for (const isHttp2 of [false, true])
  test(
    `nginx of docs/live.md serves ${viewerCount} viewers over HTTP/${isHttp2 ? "2" : "1.1"}, and frames from its cache`,
    { skip: nginx === undefined && "nginx is not installed" },
    async (t) => {
      const stream = await startStream(["cloth", "--grid", "16", "--rate", `${rate}`]);
      t.after(() => stream.stop());
      const front = await startNginx(nginx ?? "", stream.port);
      t.after(() => front.stop());
      const url = `https://localhost:${front.port}/live/cloth`;
      const options = { url, certificate: front.certificate, isHttp2 };
      const viewers = Array.from({ length: viewerCount }, () => startViewer(options));
      const stopViewers = (): void => {
        for (const viewer of viewers) viewer.stop();
      };
      t.after(stopViewers);
      // They begin at different moments; requests are counted from then on.
      await until(() => viewers.every(({ shown }) => shown.length > 2));
      const before = front.counts();
      const [first] = viewers.map(({ shown }) => shown.at(-1) ?? 0);
      await until(() => viewers.every(({ shown }) => (shown.at(-1) ?? 0) > (first ?? 0) + 3 * rate));
      const after = front.counts();
      const frames = (viewers[0]?.shown.at(-1) ?? 0) - (first ?? 0);
      stopViewers();
      let isCached = false;
      for (let attempt = 0; attempt < 20 && !isCached; ++attempt) isCached = await isServedFromCache(front, options);
      const requests = after.frames - before.frames;
      const passed = after.passed - before.passed;
      const ages = viewers.flatMap(({ ages }) => ages.slice(rate)).sort((a, b) => a - b);
      const ageAt = (share: number): string => `${ages[Math.floor(share * ages.length)]?.toFixed(1)} ms`;
      t.diagnostic(
        `${frames} frames, ${requests} requests, ${(passed / frames).toFixed(2)} a frame reached the server; ` +
          `age ${ageAt(0.5)} (median), ${ageAt(0.95)} (19 of 20); ${JSON.stringify(after.statuses)}`,
      );
      // How many of the viewers' requests do depends on the time that the machine has for them.
      assert.ok(isCached, "of five requests for one frame several reached the server");
      for (const { shown, outages } of viewers) {
        assert.deepEqual(outages, []);
        assert.ok(shown.every((number, n) => n === 0 || number > (shown[n - 1] ?? 0)));
      }
    },
  );
