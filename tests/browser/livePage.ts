// A page with one live stream of a waving sheet, and what a test sees of it: frames, outages, GPU memory, pictures.

import { assertSamePicture, boundsOfQuantised, savePicture } from "./compare.ts";
import { exampleOf, meshOf, shapeOf, type GridExample } from "./generators/grids.ts";
import { until, withPage, type View } from "./harness.ts";
import { decodePng, type Picture } from "./png.ts";
import { referencePicture } from "./reference.ts";
import type { TestServer } from "./server.ts";
import type { PlainPatch } from "./siteDecoder.ts";
import { pageOf, siteOfGenerated } from "./sites.ts";
import { TestStream } from "./testStream.ts";

const site = (): string => siteOfGenerated("trefoil", "--profile", "classic");

/** A waving sheet at a moment. */
export function wave(moment: number, columns = 40, rows = 30): GridExample {
  return exampleOf("geometryImage", columns, rows, [0, 0, 0], [3, 3, 3], 2, 3, (u, v) => [
    u,
    1 - v,
    0.5 + 0.1 * Math.sin(7 * u + moment) + 0.1 * Math.cos(5 * v - moment),
  ]);
}

const geometry = (): string => `<ImageGeometry coord="live/sheet" solid="false"></ImageGeometry>`;

function pageWith(example: GridExample, replace: (shape: string) => string): string {
  return pageOf(site())
    .replace(/<link rel="preload"[^>]*>/g, "")
    .replace(/<Shape[\s\S]*<\/Shape>/i, () => replace(shapeOf(example)))
    .replace(/<Viewpoint[^>]*>/i, `<Viewpoint position="0.6 1.6 5.2" orientation="-1 0.1 0 0.3" fieldOfView="0.75">`);
}

/** The sheet as plain buffers. */
export function plainOf(example: GridExample): PlainPatch {
  return meshOf(
    example,
    [...example.files.values()].map((file) => decodePng(file)),
  );
}

async function referenceOf(patch: PlainPatch): Promise<Picture> {
  const html = pageWith(wave(0), (shape) => shape.replace("<ImageGeometry", '<ImageGeometry solid="false"'));
  return referencePicture(html, [patch]);
}

/** In the page, before its document: keeps frames and outages of the shape and counts what allocates GPU memory. */
export function recordStream(): void {
  const counts = { objects: 0, images: 0, arrays: 0 };
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
    [["texSubImage2D"], "images"],
    [["bufferSubData"], "arrays"],
  ] as const)
    for (const name of names) {
      const original = prototype[name]!;
      prototype[name] = function (this: unknown, ...args: unknown[]) {
        counts[count] += 1;
        return original.apply(this, args);
      };
    }
}

/** Calls to WebGL so far: that allocate memory, and that replace texels or elements of arrays. */
export interface GpuCalls {
  objects: number;
  images: number;
  arrays: number;
}

export const gpuCalls = ({ page }: View): Promise<GpuCalls> =>
  page.evaluate(() => ({ ...(window as unknown as { gpu: GpuCalls }).gpu }));

export interface FrameDetail {
  number: number;
  time: number;
  skipped: number;
}

interface Recorded {
  frames: FrameDetail[];
}

/** Waits until a frame of the page displays the newest frame of the stream. */
export async function showsNewest({ page }: View, stream: TestStream): Promise<void> {
  await until(
    `frame ${stream.number} is displayed`,
    async () => (await page.evaluate(() => (window as unknown as Recorded).frames.at(-1)?.number)) === stream.number,
  );
}

/** Waits for the newest frame; returns all that have been displayed. */
export async function displayed(view: View, stream: TestStream): Promise<FrameDetail[]> {
  await showsNewest(view, stream);
  return view.page.evaluate(() => (window as unknown as Recorded).frames);
}

export interface LiveView extends View {
  stream: TestStream;
  /** Compares the picture with that of the sheet in three.js. */
  show: (patch: PlainPatch, name: string) => Promise<void>;
  /** Sets attributes of the geometry; undefined: removes. */
  setGeometry: (attributes: Record<string, string | undefined>) => Promise<void>;
  /** The kinds of errors so far. */
  outages: () => Promise<string[]>;
}

/** Opens a page that draws the stream, whose first frame is `wave(0)`. */
export async function withLivePage(
  { expectedErrors }: { expectedErrors?: RegExp },
  use: (view: LiveView) => Promise<void>,
): Promise<void> {
  let stream!: TestStream;
  const server = (server: TestServer): void => {
    stream = new TestStream(server, "sheet");
    stream.begin(wave(0));
    stream.publish(wave(0));
    const html = pageWith(wave(0), (shape) => shape.replace(/<ImageGeometry[\s\S]*<\/ImageGeometry>/, geometry()));
    server.when(/^\/$/, { replace: () => html });
    server.contentPolicy = "default-src 'self'; connect-src 'self' http://127.0.0.1:*"; // streams of other servers
  };
  const options = { server, before: recordStream, isCrossOrigin: true, ...(expectedErrors && { expectedErrors }) };
  await withPage(site(), options, async (view) => {
    await view.promise("complete");
    await view.promise("complete", "shape");
    await displayed(view, stream);
    await use({
      ...view,
      stream,
      outages: () => view.page.evaluate(() => (window as unknown as { outages: string[] }).outages),
      async show(patch, name) {
        const picture = await view.picture();
        savePicture(name, picture);
        assertSamePicture(name, picture, await referenceOf(patch), boundsOfQuantised);
      },
      async setGeometry(attributes) {
        await view.page.evaluate((changes) => {
          const geometry = document.querySelector("imagegeometry, binarygeometry")!;
          for (const [name, value] of Object.entries(changes))
            if (value === undefined) geometry.removeAttribute(name);
            else geometry.setAttribute(name, value);
        }, attributes);
      },
    });
  });
}
