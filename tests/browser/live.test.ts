// Tests live streams in a page: each frame is the surface of its integers, without a gap and without new GPU objects.

import assert from "node:assert/strict";
import { test } from "node:test";
import { assertSamePicture, boundsOfQuantised, difference, savePicture } from "./compare.ts";
import { exampleOf, meshOf, shapeOf, type GridExample } from "./generators/grids.ts";
import { until, withPage, type View } from "./harness.ts";
import { decodePng } from "./png.ts";
import { referencePicture } from "./reference.ts";
import type { TestServer } from "./server.ts";
import { pageOf, siteOfGenerated } from "./sites.ts";
import { TestStream } from "./testStream.ts";

const site = (): string => siteOfGenerated("trefoil", "--profile", "classic");

/** A waving sheet at a moment. */
function wave(moment: number, columns = 40, rows = 30): GridExample {
  return exampleOf("geometryImage", columns, rows, [0, 0, 0], [3, 3, 3], 2, 3, (u, v) => [
    u,
    1 - v,
    0.5 + 0.1 * Math.sin(7 * u + moment) + 0.1 * Math.cos(5 * v - moment),
  ]);
}

const geometry = (attributes = ""): string =>
  `<ImageGeometry coord="live/sheet" solid="false" ${attributes}></ImageGeometry>`;

function pageWith(example: GridExample, replace: (shape: string) => string): string {
  return pageOf(site())
    .replace(/<link rel="preload"[^>]*>/g, "")
    .replace(/<Shape[\s\S]*<\/Shape>/i, () => replace(shapeOf(example)))
    .replace(/<Viewpoint[^>]*>/i, `<Viewpoint position="0.6 1.6 5.2" orientation="-1 0.1 0 0.3" fieldOfView="0.75">`);
}

async function referenceOf(example: GridExample): Promise<Parameters<typeof assertSamePicture>[2]> {
  const html = pageWith(example, (shape) => shape.replace("<ImageGeometry", '<ImageGeometry solid="false"'));
  return referencePicture(html, [
    meshOf(
      example,
      [...example.files.values()].map((file) => decodePng(file)),
    ),
  ]);
}

/** In the page, before its document: keeps frames and outages of the shape and counts what allocates GPU memory. */
function recordStream(): void {
  const counts = { objects: 0, uploads: 0 };
  const [frames, outages] = [[] as unknown[], [] as unknown[]];
  Object.assign(window, { gpu: counts, frames, outages });
  const record = (type: string, callback: (event: CustomEvent<{ type: string }>) => void): void => {
    const listener = (event: Event): void => {
      if ((event.target as Element | null)?.localName === "shape") callback(event as CustomEvent<{ type: string }>);
    };
    addEventListener(type, listener, true);
  };
  record("frame", ({ detail }) => frames.push(detail));
  record("error", ({ detail }) => outages.push(detail.type));
  const prototype = WebGL2RenderingContext.prototype as unknown as Record<string, (...args: unknown[]) => unknown>;
  for (const [names, count] of [
    [["createTexture", "createBuffer", "createVertexArray", "texStorage2D", "texImage2D", "bufferData"], "objects"],
    [["texSubImage2D"], "uploads"],
  ] as const)
    for (const name of names) {
      const original = prototype[name]!;
      prototype[name] = function (this: unknown, ...args: unknown[]) {
        counts[count] += 1;
        return original.apply(this, args);
      };
    }
}

const allocations = ({ page }: View): Promise<{ objects: number; uploads: number }> =>
  page.evaluate(() => ({ ...(window as unknown as { gpu: { objects: number; uploads: number } }).gpu }));

interface FrameDetail {
  number: number;
  time: number;
  skipped: number;
}

/** Waits until a frame of the page displays the newest frame of the stream. */
async function displayed(view: View, stream: TestStream): Promise<FrameDetail[]> {
  let frames: FrameDetail[] = [];
  await until(`frame ${stream.number} is displayed`, async () => {
    frames = await view.page.evaluate(() => (window as unknown as { frames: FrameDetail[] }).frames);
    return frames.at(-1)?.number === stream.number;
  });
  return frames;
}

test("a live stream is drawn frame by frame", async () => {
  let stream!: TestStream;
  const start = (server: TestServer): void => {
    stream = new TestStream(server, "sheet");
    stream.begin(wave(0));
    stream.publish(wave(0));
    const html = pageWith(wave(0), (shape) => shape.replace(/<ImageGeometry[\s\S]*<\/ImageGeometry>/, geometry()));
    server.when(/^\/$/, { replace: () => html });
  };
  await withPage(
    site(),
    { server: start, before: recordStream, expectedErrors: /500|410|404|live\/sheet/ },
    async (view) => {
      const outages = (): Promise<string[]> =>
        view.page.evaluate(() => (window as unknown as { outages: string[] }).outages);
      const show = async (example: GridExample, name: string): Promise<void> => {
        const picture = await view.picture();
        savePicture(name, picture);
        assertSamePicture(name, picture, await referenceOf(example), boundsOfQuantised);
      };

      await view.promise("complete");
      await view.promise("complete", "shape");
      await displayed(view, stream);
      await show(wave(0), "live: the first frame");

      // Frames are drawn into the same objects.
      stream.publish(wave(0.1));
      await displayed(view, stream);
      const before = await allocations(view);
      for (let n = 2; n <= 40; ++n) {
        stream.publish(wave(n / 10));
        await displayed(view, stream);
      }
      const after = await allocations(view);
      assert.equal(after.objects, before.objects, "frames allocate memory on the GPU");
      assert.ok(after.uploads >= before.uploads + 2 * 39, `${after.uploads - before.uploads} uploads`);
      await show(wave(4), "live: a later frame");
      const hit = await view.page.evaluate(() => {
        interface View {
          positionAndNormalFromPoint(x: number, y: number): { position: { z: number } } | null;
        }
        return (document.querySelector("imgeo-view") as unknown as View).positionAndNormalFromPoint(320, 240)?.position
          .z;
      });
      assert.ok(hit !== undefined && Math.abs(hit) < 0.7, `picked at z ${hit}`);

      // Frames that are late are skipped.
      for (let n = 0; n < 20; ++n) stream.publish(wave(n));
      const frames = await displayed(view, stream);
      const last = frames.at(-1)!;
      assert.equal(last.time, last.number / 30);
      const numbers = frames.map(({ number }) => number);
      assert.deepEqual(
        numbers,
        Array.from(new Set(numbers)).sort((a, b) => a - b),
        "frames are out of order",
      );
      assert.equal(
        frames.slice(1).reduce((sum, { skipped }) => sum + skipped + 1, 0),
        numbers.at(-1)! - numbers[0]!,
        "skipped frames are not counted",
      );
      await show(wave(19), "live: after skipped frames");

      // A pause and a frame that is damaged leave the picture as it is.
      await view.page.evaluate(() => {
        document.querySelector("imagegeometry")!.setAttribute("paused", "true");
      });
      await until("no request is open", () =>
        view.server.requestsOf(/frames/).every(({ state }) => state !== "waiting"),
      );
      const requestCount = view.server.requestsOf(/live/).length;
      for (let n = 0; n < 3; ++n) stream.publish(wave(n));
      await show(wave(19), "live: paused");
      assert.equal(view.server.requestsOf(/live/).length, requestCount, "a paused viewer sends requests");
      await view.page.evaluate(() => {
        document.querySelector("imagegeometry")!.setAttribute("paused", "false");
      });
      await displayed(view, stream);
      await show(wave(2), "live: after the pause");
      assert.deepEqual(await outages(), []);
      stream.publish(wave(3), [], (bytes) => bytes.slice(0, -1));
      await until("the damaged frame is reported", async () => (await outages()).length > 0);
      await show(wave(2), "live: after a damaged frame");
      stream.publish(wave(4));
      await displayed(view, stream);
      assert.deepEqual(await outages(), ["truncated"]);

      // Another epoch has other vertices.
      stream.begin(wave(5, 25, 60));
      stream.publish(wave(5, 25, 60));
      await displayed(view, stream);
      await show(wave(5, 25, 60), "live: another epoch");
      // A server that is gone for a while: the requests that wait still get their frames.
      stream.failingStatus = 500;
      stream.publish(wave(7, 25, 60));
      await until("the outage is reported", async () => (await outages()).length > 1);
      await show(wave(7, 25, 60), "live: during an outage");
      stream.failingStatus = undefined;
      stream.publish(wave(8, 25, 60));
      await displayed(view, stream);
      await show(wave(8, 25, 60), "live: after an outage");
      assert.deepEqual(await outages(), ["truncated", "http"]);
      assert.equal((await view.events("load", "shape")).length, 1);

      // Streamed colours, values and normals; a page without lights shows them as they are.
      const flat = exampleOf("geometryImage", 4, 4, [0, 0, 0], [3, 3, 3], 2, 3, (u, v) => [u, 1 - v, 0.5]);
      const center = async (): Promise<number[]> => {
        const { data, width, height, channels } = await view.picture();
        const at = (Math.floor(height / 2) * width + Math.floor(0.42 * width)) * channels;
        return Array.from(data.subarray(at, at + 3));
      };
      const constant = (value: number): number[] => Array.from({ length: 16 }, () => value);
      await view.page.evaluate(() => {
        document.querySelector("material")!.outerHTML = "<UnlitMaterial></UnlitMaterial>";
      });
      stream.begin(flat, { colorComponents: 3 });
      stream.publish(flat, [200, 100, 50].map(constant));
      await displayed(view, stream);
      assert.deepEqual(await center(), [200, 100, 50]);
      await view.page.evaluate(() => {
        document.querySelector("shape")!.setAttribute("colorBy", "value");
        document.querySelector("shape")!.setAttribute("colorMap", "0 0 0, 1 1 1");
        document.querySelector("shape")!.setAttribute("colorRange", "-1 3");
      });
      stream.begin(flat, { valueComponents: 1, valueBits: 12, valueRange: [[-1, 3]] });
      stream.publish(flat, [constant(819)]);
      await displayed(view, stream);
      assert.deepEqual(await center(), [51, 51, 51]);
      await view.page.evaluate(() => {
        document.querySelector("shape")!.removeAttribute("colorBy");
        document.querySelector("unlitmaterial")!.outerHTML = '<Material diffuseColor="0.3 0.3 0.3"></Material>';
      });
      const shadeOf = async (u: number, v: number): Promise<number> => {
        stream.begin(flat, { normalBits: 8 });
        stream.publish(flat, [u, v].map(constant));
        await displayed(view, stream);
        return (await center())[0]!;
      };
      const [facing, down] = [await shadeOf(127, 127), await shadeOf(127, 0)];
      assert.ok(facing > down + 20, `${facing} facing the viewer, ${down} facing down`);

      // The same stream as points, in another geometry.
      const surface = await view.picture();
      await view.page.evaluate(() => {
        document.querySelector("imagegeometry")!.setAttribute("primType", "POINTS");
        document.querySelector("imagegeometry")!.setAttribute("vertexCount", "16");
      });
      await view.promise("complete", "shape");
      const points = await view.picture();
      savePicture("live: points", points);
      assert.ok(difference(points, surface).mean > 3, "the surface is still displayed");
      assert.deepEqual(await outages(), ["truncated", "http"]);
    },
  );
});
