// Tests sequences and videos of the same frames in a page: every frame is the mesh of its file, whatever the clock, a
// script or the page asks for, and frames take no further memory of the GPU.

import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { breath, breathSite, frameCount, heatRange, patchOfFrame, rate } from "./breath.ts";
import { assertSamePicture, boundsOfInput, savePicture } from "./compare.ts";
import { until, withPage, type View } from "./harness.ts";
import { gpuCalls, recordStream, type FrameDetail } from "./livePage.ts";
import { sphere, withoutNormals, type PlainMesh } from "./meshes.ts";
import { referencePicture } from "./reference.ts";
import { startServer, type TestServer } from "./server.ts";
import type { PlainPatch } from "./siteDecoder.ts";
import { pageOf, siteOfFrames, variantOf } from "./sites.ts";
import { soakTest } from "./soak.ts";

/** A copy whose <x3d> has these attributes. */
const siteWith = (name: string, attributes: string): string =>
  variantOf(breathSite(), name, (page) => page.replace(/<x3d/i, `<x3d ${attributes}`));

/** Where surfaces cross, a few pixels show the other one. */
const boundsOfCrossing = { ...boundsOfInput, offShare: 0.0005 };

/** Compares the picture with that of a frame, or of several meshes. */
async function show(view: View, name: string, ...patches: PlainPatch[]): Promise<void> {
  const picture = await view.picture();
  savePicture(name, picture);
  const bounds = patches.length > 1 ? boundsOfCrossing : boundsOfInput;
  assertSamePicture(name, picture, await referencePicture(pageOf(breathSite()), patches), bounds);
}

const recorded = ({ page }: View): Promise<FrameDetail[]> =>
  page.evaluate(() => (window as unknown as { frames: FrameDetail[] }).frames);

async function displays(view: View, number: number): Promise<void> {
  await until(`frame ${number} is displayed`, async () => (await recorded(view)).at(-1)?.number === number);
}

const setAttribute = ({ page }: View, selector: string, name: string, value: string | undefined): Promise<void> =>
  page.evaluate(
    ({ selector: select, name: attribute, value: text }) => {
      const element = document.querySelector(select);
      if (text === undefined) element?.removeAttribute(attribute);
      else element?.setAttribute(attribute, text);
    },
    { selector, name, value },
  );

/** The path of a file of frames. */
function fileOfFrames(file: number): string {
  const folder = join(breathSite(), "geometry");
  const index = readdirSync(folder).find((name) => name.endsWith(".json"))!;
  const { files } = JSON.parse(readFileSync(join(folder, index), "utf8")) as { files: { url: string }[] };
  return files[file]!.url;
}

const framesDrawn = ({ page }: View): Promise<number> =>
  page.evaluate(
    () => (document.querySelector("x3d") as unknown as { statistics: { frames: number } }).statistics.frames,
  );

/** Nothing is drawn, and no frame follows. */
async function assertStands(view: View, what: string): Promise<void> {
  await view.picture(); // what is under way has been drawn
  const before = [await framesDrawn(view), (await recorded(view)).length];
  await view.page.waitForTimeout(400);
  assert.deepEqual([await framesDrawn(view), (await recorded(view)).length], before, what);
}

async function plays(view: View): Promise<void> {
  const { length } = await recorded(view);
  await until("it plays", async () => (await recorded(view)).length > length + 2);
}

/** While a file is late the last whole frame stays; the due one follows when it has come. */
async function assertWaitsForFile(view: View, release: () => void): Promise<void> {
  await setAttribute(view, "x3d", "sequence-time", "0.9");
  await displays(view, 9);
  await setAttribute(view, "x3d", "sequence-time", "1.2");
  await view.page.waitForTimeout(300);
  await show(view, "sequence: while a file is late", patchOfFrame(9));
  release();
  await displays(view, 12);
  assert.deepEqual(
    (await recorded(view)).map(({ number }) => number),
    [0, 9, 12],
  );
}

/** A further Shape of the same geometry shows the same frame; both are coloured by the values of the frame. */
async function assertIsUsedAndColoured(view: View, seek: (number: number) => Promise<void>): Promise<void> {
  await view.page.evaluate(() => {
    const shape = document.querySelector("shape")!;
    shape.querySelector("imagegeometry")!.setAttribute("DEF", "breath");
    const copy = document.createElement("transform");
    copy.setAttribute("translation", "0.4 0.3 0");
    copy.innerHTML = '<shape id="copy"></shape>';
    copy.firstElementChild!.append(shape.querySelector("appearance")!.cloneNode(true));
    const geometry = document.createElement("imagegeometry");
    geometry.setAttribute("USE", "breath");
    copy.firstElementChild!.append(geometry);
    shape.parentElement!.append(copy);
  });
  const movedPatch = (patch: PlainPatch): PlainPatch => ({
    ...patch,
    positions: patch.positions.map((coordinate, i) => coordinate + [0.4, 0.3, 0][i % 3]!),
  });
  await seek(5);
  await show(view, "sequence: in two shapes", patchOfFrame(5), movedPatch(patchOfFrame(5)));
  for (const shape of ["shape", "#copy"]) {
    await setAttribute(view, shape, "colorBy", "heat");
    await setAttribute(view, shape, "colorMap", "0 0 0, 1 1 1");
  }
  await view.promise("complete");
  const colored = (number: number): PlainPatch => {
    const [min, max] = heatRange;
    const heat = breath[number]!.numbers!.heat!;
    return {
      ...patchOfFrame(number),
      colors: Float32Array.from({ length: 3 * heat.length }, (_, i) => (heat[Math.floor(i / 3)]! - min) / (max - min)),
    };
  };
  for (const number of [5, 14]) {
    if (number !== 5) await seek(number);
    await show(view, `sequence: coloured by values ${number}`, colored(number), movedPatch(colored(number)));
  }
}

/** Clocks stand where the user prefers reduced motion, while paused, and in a hidden tab, and nothing is drawn then. */
async function assertStandsOnDemand(view: View): Promise<void> {
  const setHidden = (isHidden: boolean): Promise<void> =>
    view.page.evaluate((hidden) => {
      Object.defineProperty(document, "hidden", { value: hidden, configurable: true });
      document.dispatchEvent(new Event("visibilitychange"));
    }, isHidden);
  await assertStands(view, "a sequence plays although the user prefers reduced motion");
  await setAttribute(view, "x3d", "paused", "false");
  await plays(view);
  await setAttribute(view, "x3d", "paused", "");
  await assertStands(view, "a paused sequence is drawn");
  await setAttribute(view, "x3d", "paused", "false");
  await plays(view);
  await setHidden(true);
  await assertStands(view, "a sequence in a hidden tab is drawn");
  await setHidden(false);
  await plays(view);
}

test("a sequence is displayed frame by frame", async () => {
  const late = Promise.withResolvers<undefined>();
  const server = (server: TestServer): void =>
    void server.when((path) => path.endsWith(fileOfFrames(1)), { hold: late.promise });
  const site = siteWith("still", 'sequence-time="0"');
  await withPage(site, { before: recordStream, server }, async (view) => {
    await view.promise("complete");
    await displays(view, 0);
    await show(view, "sequence: the first frame", patchOfFrame(0));
    await assertWaitsForFile(view, () => {
      late.resolve(undefined);
    });

    const seek = async (number: number): Promise<void> => {
      await setAttribute(view, "x3d", "sequence-time", String(number / rate));
      await displays(view, number);
    };
    await seek(1);
    const before = await gpuCalls(view);
    for (const number of [2, 3, 4, 9, 10, 11, 24, 0, 17]) await seek(number);
    assert.equal((await gpuCalls(view)).objects, before.objects, "frames allocate memory on the GPU");
    await show(view, "sequence: in the second file", patchOfFrame(17));
    const hit = await view.page.evaluate(() => {
      const x3d = document.querySelector<
        HTMLElement & {
          positionAndNormalFromPoint: (
            x: number,
            y: number,
          ) => { position: { x: number; y: number; z: number } } | null;
        }
      >("x3d")!;
      return x3d.positionAndNormalFromPoint(innerWidth / 2, innerHeight / 2)?.position;
    });
    const radius = Math.max(...patchOfFrame(17).positions);
    const distance = hit && Math.hypot(hit.x, hit.y, hit.z);
    assert.ok(distance !== undefined && distance > 0.5 * radius && distance < 1.5 * radius, `picked ${distance}`);

    const picked = await gpuCalls(view); // picking has images of its own

    // Without the attribute the sequence follows its clock, and the first frame follows the last.
    await setAttribute(view, "x3d", "sequence-time", undefined);
    await assertStandsOnDemand(view);
    await until("the clock has come to the beginning again", async () => {
      const numbers = (await recorded(view)).map(({ number }) => number);
      const last = numbers.lastIndexOf(17);
      return numbers.slice(last).some((number, i, all) => number < (all[i - 1] ?? 0) && i > 1);
    });
    // A script scrubs by the sensor, and by the interpolator.
    await setAttribute(view, "timesensor", "enabled", "false");
    await setAttribute(view, "timesensor", "set_fraction", "0.5");
    await displays(view, 12);
    await show(view, "sequence: scrubbed by its clock", patchOfFrame(12));
    await setAttribute(view, "coordinateinterpolator", "set_fraction", "1");
    await displays(view, 24);
    await show(view, "sequence: the last frame", patchOfFrame(24));
    assert.equal((await gpuCalls(view)).objects, picked.objects, "playing allocates memory on the GPU");
    assert.equal((await view.events("load", "shape")).length, 1);
    await assertIsUsedAndColoured(view, seek);
  });
});

/** In the page, before its document: keeps the vertices that were uploaded last, and notes on the console. */
function recordVertices(vertexCount: number): void {
  const prototype = WebGL2RenderingContext.prototype as unknown as Record<string, (...args: unknown[]) => unknown>;
  for (const name of ["bufferSubData", "bufferData"]) {
    const original = prototype[name]!;
    prototype[name] = function (this: unknown, ...args: unknown[]) {
      const array = args.find((arg) => arg instanceof Uint16Array);
      if (array?.length === 4 * vertexCount) Object.assign(window, { vertices: Array.from(array) });
      return original.apply(this, args);
    };
  }
  const notes: string[] = [];
  const { info } = console;
  console.info = (...words: unknown[]) => {
    notes.push(words.join(" "));
    info(...words);
  };
  Object.assign(window, { notes });
}

/** Coordinates of vertices as texts, sorted: the order of vertices in a site is its own. */
const sortedTriples = (values: ArrayLike<number>, stride: number): string[] =>
  Array.from({ length: values.length / stride }, (_, i) =>
    [0, 1, 2].map((axis) => values[stride * i + axis]!).join(" "),
  ).sort();

/** The integers that a frame's file has on the lattice of the sequence. */
function storedTriples(directory: string, number: number): string[] {
  const file = readdirSync(join(directory, "geometry")).find((name) => name.endsWith(".json"))!;
  const { origin, step } = JSON.parse(readFileSync(join(directory, "geometry", file), "utf8")) as {
    origin: number[];
    step: number;
  };
  const { positions } = breath[number]!;
  return sortedTriples(
    Array.from(positions, (value, i) => Math.floor((Math.fround(value) - origin[i % 3]!) * (1 / step) + 0.5)),
    3,
  );
}

const vertexCount = breath[0]!.positions.length / 3;
const videoSite = (): string => siteOfFrames("breath", breath, "--rate", String(rate), "--as", "video");
const videoSiteWith = (name: string, attributes: string): string =>
  variantOf(videoSite(), name, (page) => page.replace(/<x3d/i, `<x3d ${attributes}`));

async function seekExactly(view: View, number: number): Promise<void> {
  await setAttribute(view, "x3d", "sequence-time", String(number / rate));
  await displays(view, number);
  const vertices = await view.page.evaluate(() => (window as unknown as { vertices: number[] }).vertices);
  const [shown, stored] = [sortedTriples(vertices, 4), storedTriples(videoSite(), number)];
  const different = stored.filter((triple, i) => shown[i] !== triple).length;
  assert.equal(different, 0, `${different} of ${stored.length} vertices of frame ${number}, as ${shown[0]}`);
}

const notesOf = ({ page }: View): Promise<string[]> =>
  page.evaluate(() => (window as unknown as { notes: string[] }).notes);

const prepareVideo = `(${recordStream.toString()})(); (${recordVertices.toString()})(${vertexCount});`;

soakTest("a lossless video is displayed frame by frame, each bit of it", async () => {
  const site = videoSiteWith("video", 'sequence-time="0" paused="false"');
  await withPage(site, { before: { content: prepareVideo } }, async (view) => {
    await view.promise("complete");
    for (const number of [0, 1, 2, 9, 10, 11, 24, 0, 17, 3]) await seekExactly(view, number);
    await show(view, "video: a frame that was sought", patchOfFrame(3));
    assert.deepEqual(await notesOf(view), []);
    assert.deepEqual(
      view.requestedPaths.filter((path) => /igf|webm/.test(path)).map((path) => path.replace(/.*\./, "")),
      ["webm"],
    );

    // The movie plays by itself, over its end, and stands when it is told to.
    await view.page.evaluate(() => {
      document.querySelector("route")!.remove();
      document.querySelector("timesensor")!.remove();
      const movie = document.querySelector("movietexture")!;
      movie.setAttribute("speed", "2");
      movie.setAttribute("loop", "true");
    });
    await setAttribute(view, "x3d", "sequence-time", undefined);
    await until("the movie has come to its beginning again", async () => {
      const numbers = (await recorded(view)).map(({ number }) => number);
      return numbers.some((number, i) => i > 11 && numbers[i - 1]! > 20 && number < 4);
    });
    await setAttribute(view, "x3d", "paused", "true");
    await setAttribute(view, "movietexture", "set_fraction", "0.5");
    await displays(view, 12);
  });
});

soakTest("where a video cannot be decoded exactly, or is not lossless, its frames are displayed", async () => {
  const breaks = `${prepareVideo}
    const { copyTo } = VideoFrame.prototype;
    VideoFrame.prototype.copyTo = async function (bytes, ...options) {
      const planes = await copyTo.call(this, bytes, ...options);
      bytes[40] ^= 1;
      return planes;
    };`;
  await withPage(videoSiteWith("inexact", 'sequence-time="0"'), { before: { content: breaks } }, async (view) => {
    await view.promise("complete");
    for (const number of [0, 12, 24]) await seekExactly(view, number);
    const notes = await notesOf(view);
    assert.equal(notes.length, 1);
    assert.match(notes[0]!, /plays no lossless videos of vertices, and gets their frames instead: has pixels in frame/);
    assert.deepEqual(
      view.requestedPaths.filter((path) => path.endsWith("webm")),
      [],
    );
    assert.equal(await view.page.evaluate(() => (window as unknown as { outages: unknown[] }).outages.length), 0);
  });
});

soakTest("a video that is cut is reported once, and its frames are displayed", async () => {
  const options = {
    before: { content: prepareVideo },
    expectedErrors: /webm/,
    server: (server: TestServer): void => {
      server.when(/webm$/, { replace: (bytes) => bytes.subarray(0, bytes.length - 1) });
    },
  };
  await withPage(videoSiteWith("cut", 'sequence-time="0"'), options, async (view) => {
    await view.promise("complete");
    for (const number of [0, 12, 24]) await seekExactly(view, number);
    assert.equal(await view.page.evaluate(() => (window as unknown as { outages: unknown[] }).outages.length), 1);
    assert.deepEqual(await notesOf(view), []);
  });
});

/** In the page, before its document: from the request of the video on, decoding changes pixels, as after lossy coding. */
const losePixels = `
  const { copyTo } = VideoFrame.prototype;
  const { fetch } = window;
  let isLossy = false;
  window.fetch = (...request) => {
    isLossy ||= String(request[0]).endsWith(".webm");
    return fetch(...request);
  };
  VideoFrame.prototype.copyTo = async function (bytes, ...options) {
    const planes = await copyTo.call(this, bytes, ...options);
    if (isLossy) bytes[100] ^= 1;
    return planes;
  };`;

const otherVideo = (name: string, meshes: readonly PlainMesh[]): Buffer => {
  const folder = join(siteOfFrames(name, meshes, "--rate", String(rate), "--as", "video"), "geometry");
  return readFileSync(
    join(
      folder,
      readdirSync(folder).find((file) => file.endsWith(".webm"))!,
    ),
  );
};

/** What may be wrong with a video, and the sentence that says so. */
const unusable: Readonly<Record<string, { readonly replace?: () => Buffer; readonly sentence: RegExp }>> = {
  "that is lossy": { sentence: /is not lossless/ },
  "of another size": {
    replace: () =>
      otherVideo(
        "small",
        Array.from({ length: frameCount }, () => withoutNormals(sphere(8))),
      ),
    sentence: /has images of \d+ x \d+ pixels; those of its frames have \d+ x \d+/,
  },
  "with fewer frames": {
    replace: () => otherVideo("short", breath.slice(0, 12)),
    sentence: /has 12 images; its index states 25 frames/,
  },
  "of another origin without CORS": { sentence: /could not be fetched|CORS|Failed to fetch/ },
};

for (const [name, { replace, sentence }] of Object.entries(unusable))
  soakTest(`a video ${name} is reported once, and its frames are displayed`, async () => {
    const foreign = name.includes("origin") ? await startServer(videoSite()) : undefined;
    const site = variantOf(videoSite(), name.replaceAll(" ", "-"), (page) =>
      page
        .replace(/<x3d/i, '<x3d sequence-time="0"')
        .replace(/"(geometry\/\w+\.webm)"/, (quoted, path: string) =>
          foreign ? `"${foreign.origin}${path}"` : quoted,
        ),
    );
    const lossy = name.includes("lossy") ? losePixels : "";
    const options = {
      before: { content: prepareVideo + lossy },
      expectedErrors: /webm|ERR_FAILED/,
      isCrossOrigin: foreign !== undefined,
      server: (server: TestServer): void => {
        if (foreign) server.contentPolicy = `default-src 'self'; connect-src 'self' ${foreign.origin}`;
        const video = replace?.();
        if (video) server.when(/webm$/, { replace: () => video });
      },
    };
    try {
      await withPage(site, options, async (view) => {
        await view.promise("complete");
        for (const number of [0, 12, 24]) await seekExactly(view, number);
        const outages = await view.page.evaluate(() => (window as unknown as { outages: unknown[] }).outages);
        assert.equal(outages.length, 1);
        const own = view.errors.filter((message) => message.includes("imgeo: ") && message.includes("webm"));
        assert.equal(own.length, 1, view.errors.join("\n"));
        assert.match(own[0]!, sentence);
        assert.deepEqual(await notesOf(view), []);
      });
    } finally {
      await foreign?.close();
    }
  });

soakTest("frames of a file that cannot be read are left out, and the others are displayed", async () => {
  const options = {
    before: recordStream,
    expectedErrors: /igf/,
    server: (server: TestServer): void => {
      server.when((path) => path.endsWith(fileOfFrames(1)), {
        replace: (bytes) => bytes.subarray(0, bytes.length - 1),
      });
    },
  };
  await withPage(siteWith("damaged", 'sequence-time="0"'), options, async (view) => {
    await view.promise("complete");
    await displays(view, 0);
    await until("the damaged file is reported", () =>
      view.page.evaluate(() => (window as unknown as { outages: string[] }).outages.length === 1),
    );
    await setAttribute(view, "x3d", "sequence-time", "1.5");
    await setAttribute(view, "x3d", "sequence-time", "2.2");
    await displays(view, 22);
    await show(view, "sequence: behind a file that is damaged", patchOfFrame(22));
    assert.deepEqual(
      (await recorded(view)).filter(({ number }) => number >= 10 && number < 20),
      [],
    );
  });
});

soakTest("ten thousand frames leave the heap and the memory of the GPU as they were", async () => {
  await withPage(siteWith("long", 'sequence-time="0"'), { before: recordStream }, async (view) => {
    await view.promise("complete");
    await displays(view, 0);
    const play = (count: number): Promise<number> =>
      view.page.evaluate(
        async ({ total, perSecond, frames }) => {
          const x3d = document.querySelector("x3d")!;
          const shown = (window as unknown as { frames: unknown[] }).frames;
          for (let played = 0, number = 0; played < total; ++played) {
            number = (number + 1) % frames;
            const length = shown.length;
            x3d.setAttribute("sequence-time", String(number / perSecond));
            while (shown.length === length) await new Promise(requestAnimationFrame);
            shown.length = 0;
          }
          return (performance as unknown as { memory: { usedJSHeapSize: number } }).memory.usedJSHeapSize;
        },
        { total: count, perSecond: rate, frames: frameCount },
      );
    await play(200);
    const [objects, heap] = [(await gpuCalls(view)).objects, await play(200)];
    const after = await play(9600);
    assert.equal((await gpuCalls(view)).objects, objects);
    assert.ok(after < heap + 20e6, `the heap has grown from ${heap} to ${after} bytes`);
  });
});
