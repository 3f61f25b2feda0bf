// The configuration of docs/live.md in a real nginx: many viewers, one request to the server for each frame.

import assert from "node:assert/strict";
import { setTimeout as pause } from "node:timers/promises";
import { test } from "node:test";
import { findNginx, startNginx } from "./live/nginx.ts";
import { startStream } from "./live/stream.ts";
import { startViewer } from "./live/viewers.ts";

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

for (const isHttp2 of [false, true])
  test(
    `nginx of docs/live.md serves ${viewerCount} viewers over HTTP/${isHttp2 ? "2" : "1.1"} from one request a frame`,
    { skip: nginx === undefined && "nginx is not installed" },
    async (t) => {
      const stream = await startStream(["cloth", "--grid", "16", "--rate", `${rate}`]);
      const front = await startNginx(nginx ?? "", stream.port);
      const url = `https://localhost:${front.port}/live/cloth`;
      const viewers = Array.from({ length: viewerCount }, () =>
        startViewer({ url, certificate: front.certificate, isHttp2 }),
      );
      // They begin at different moments; requests are counted from then on.
      await until(() => viewers.every(({ shown }) => shown.length > 2));
      const before = front.counts();
      const [first] = viewers.map(({ shown }) => shown.at(-1) ?? 0);
      await until(() => viewers.every(({ shown }) => (shown.at(-1) ?? 0) > (first ?? 0) + 3 * rate));
      const after = front.counts();
      const frames = (viewers[0]?.shown.at(-1) ?? 0) - (first ?? 0);
      for (const viewer of viewers) viewer.stop();
      await front.stop();
      await stream.stop();
      const requests = after.frames - before.frames;
      const passed = after.passed - before.passed;
      const ages = viewers.flatMap(({ ages }) => ages.slice(rate)).sort((a, b) => a - b);
      const ageAt = (share: number): string => `${ages[Math.floor(share * ages.length)]?.toFixed(1)} ms`;
      t.diagnostic(
        `${frames} frames, ${requests} requests, ${(passed / frames).toFixed(2)} a frame reached the server; ` +
          `age ${ageAt(0.5)} (median), ${ageAt(0.95)} (19 of 20); ${JSON.stringify(after.statuses)}`,
      );
      assert.ok(passed < requests / 4, `${passed} of ${requests} requests reached the server`);
      for (const { shown, outages } of viewers) {
        assert.deepEqual(outages, []);
        assert.ok(shown.every((number, n) => n === 0 || number > (shown[n - 1] ?? 0)));
      }
    },
  );
