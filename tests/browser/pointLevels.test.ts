// Point clouds with levels of detail: pictures without gaps, memory and requests, and hits.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { assertSamePicture, savePicture } from "./compare.ts";
import { screenshotOf, settle, until, withPage, type View } from "./harness.ts";
import { groupFilesOf, magentaInside, onMagenta, seenFrom, statisticsOf } from "./levelPages.ts";
import type { ShapePointerEvent } from "../../web/src/dom/index.ts";
import { converter, outputDirectory } from "./paths.ts";
import type { Picture } from "./png.ts";
import { siteOf, variantOf } from "./sites.ts";
import { soakTest } from "./soak.ts";

const pointCount = 60_000;

function cloud(): string {
  const file = join(outputDirectory, "cloud.ply");
  mkdirSync(outputDirectory, { recursive: true });
  execFileSync(converter, ["sample", "relief", "--points", `${pointCount}`, "-o", file], { stdio: "ignore" });
  return file;
}

let source: string | undefined;
const options = ["--no-pictures", "--keep-attributes", "all", "--levels", "always", "--group-triangles", "1024"];
const cloudSite = (): string => siteOf((source ??= cloud()), ...options);

/** The page from a viewpoint, before a magenta backdrop, within a budget in MB. */
const seenWithin =
  (position: string, orientation: string, budget?: number) =>
  (page: string): string =>
    onMagenta(seenFrom(page, position, orientation)).replace(
      /<X3D /i,
      budget === undefined ? "<X3D " : `<X3D budget="${budget}" `,
    );

soakTest("a cloud shows no gaps, far, near, of coarse groups within a small budget and while it loads", async () => {
  const views = [
    ["far", "0 0 3", "0 0 1 0", undefined],
    ["near", "0.5 0 1.4", "0 1 0 0.2", undefined],
    ["budget", "0 0 3", "0 0 1 0", 0.1],
  ] as const;
  for (const [name, position, orientation, budget] of views) {
    const server = (server: View["server"]): void => {
      server.useLink({ bitsPerSecond: 3e6, roundTripMs: 40 });
    };
    await withPage(
      variantOf(cloudSite(), name, seenWithin(position, orientation, budget)),
      { server },
      async (view) => {
        await view.promise("firstImage");
        const first = await screenshotOf(view.page);
        savePicture(`point levels ${name} first`, first);
        assert.equal(magentaInside(first), 0, `${name}, first image`);
        await view.promise("complete");
        await settle(view.page);
        const picture = await view.picture();
        savePicture(`point levels ${name}`, picture);
        assert.equal(magentaInside(picture), 0, name);
        const { bufferBytes, levels } = await statisticsOf(view);
        assert.equal(levels.bytes, bufferBytes);
        if (budget === undefined) assert.ok(levels.errorInPixels <= 1, `${levels.errorInPixels} pixels`);
        else assert.ok(levels.errorInPixels > 1 && bufferBytes <= budget * 1e6, `${bufferBytes} bytes`);
        const requested = groupFilesOf(view);
        assert.deepEqual(requested, [...new Set(requested)], "a file was requested twice");
      },
    );
  }
});

test("coarse groups have the picture of the whole cloud, about", async () => {
  const pictures: Picture[] = [];
  for (const budget of [undefined, 0.2]) {
    const site = variantOf(cloudSite(), `compared-${budget ?? "whole"}`, seenWithin("0 0 3", "0 0 1 0", budget));
    await withPage(site, {}, async (view) => {
      await view.promise("complete");
      await settle(view.page);
      pictures.push(await view.picture());
    });
  }
  assertSamePicture("point levels coarse", pictures[1]!, pictures[0]!, { mean: 3, offShare: 0.05 });
});

soakTest(
  "groups that a moved camera does not need leave a full GPU, and hits have their group and accuracy",
  async () => {
    const site = variantOf(cloudSite(), "moved", seenWithin("0.5 0 1.4", "0 1 0 0.2", 0.3));
    await withPage(site, {}, async (view) => {
      await view.promise("complete");
      await view.page.evaluate(() => {
        const viewpoint = document.querySelector("viewpoint");
        viewpoint?.setAttribute("position", "-0.5 0 -1.4");
        viewpoint?.setAttribute("orientation", "0 1 0 3.34");
      });
      const before = groupFilesOf(view).length;
      await until("more groups", () => Promise.resolve(groupFilesOf(view).length > before));
      await settle(view.page);
      const { bufferBytes } = await statisticsOf(view);
      assert.ok(bufferBytes <= 0.3e6, `${bufferBytes} bytes`);

      await view.page.evaluate(() => {
        document.querySelector("x3d")!.addEventListener("click", (event) => {
          const { patch, vertexId, triangleId, accuracy, worldPosition } = event as unknown as ShapePointerEvent;
          const { x, y, z } = worldPosition;
          Object.assign(globalThis, { hit: { patch, vertexId, triangleId, accuracy, radius: Math.hypot(x, y, z) } });
        });
      });
      const box = await view.page.evaluate(
        () => document.querySelector("x3d")!.getBoundingClientRect().toJSON() as DOMRect,
      );
      await view.page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
      const hitOf = () =>
        view.page.evaluate(
          () =>
            (globalThis as { hit?: { patch: number; triangleId: unknown; accuracy: number | null; radius: number } })
              .hit,
        );
      await until("the click", async () => (await hitOf()) !== undefined);
      const hit = await hitOf();
      assert.ok(hit && hit.patch >= 0 && hit.triangleId === null, JSON.stringify(hit));
      assert.ok(hit.accuracy !== null && hit.accuracy < 0.1, JSON.stringify(hit));
      assert.ok(Math.abs(hit.radius - 1) < 0.25, JSON.stringify(hit));
    });
  },
);
