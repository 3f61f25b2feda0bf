// Tests live streams in a page: each frame is the surface of its integers, without a gap and without new GPU objects.

import assert from "node:assert/strict";
import { test } from "node:test";
import { assertSamePicture, boundsOfQuantised, difference, savePicture } from "./compare.ts";
import { exampleOf, type GridExample } from "./generators/grids.ts";
import { center } from "./gestures.ts";
import { until, type View } from "./harness.ts";
import { liveServer } from "./liveServer.ts";
import { displayed, gpuCalls, plainOf, showsNewest, wave, withLivePage, type LiveView } from "./livePage.ts";
import { areaWeightedNormals } from "./meshes.ts";
import { encodePng, type Picture } from "./png.ts";
import type { PlainPatch } from "./siteDecoder.ts";
import { isSoak, soakTest } from "./soak.ts";
import { TestStream } from "./testStream.ts";

/** A surface, mirrored in x and scaled around the origin. */
function mirrored(mesh: PlainPatch, scale: number): PlainPatch {
  const mirror = (array: Float32Array, factor: number): Float32Array =>
    array.map((value, i) => (i % 3 === 0 ? -1 : 1) * factor * value);
  const triangles = mesh.triangles.slice();
  for (let n = 0; n < triangles.length; n += 3) triangles.subarray(n + 1, n + 3).reverse();
  return { ...mesh, positions: mirror(mesh.positions, scale), normals: mirror(mesh.normals!, 1), triangles };
}

/** Waits until the page has fetched a module of the runtime and has run it. */
async function loadsModule({ page }: View, name: string): Promise<void> {
  const urlOf = (start: string): string | undefined =>
    performance.getEntriesByType("resource").find((entry) => entry.name.includes(start))?.name;
  await until(`${name} is requested`, async () => (await page.evaluate(urlOf, name)) !== undefined);
  await page.evaluate((url) => import(url ?? ""), await page.evaluate(urlOf, name));
}

test("a live stream is drawn frame by frame", async () => {
  await withLivePage({ expectedErrors: /live\/sheet/ }, async (view) => {
    const { stream, outages } = view;
    const show = (example: GridExample, name: string): Promise<void> => view.show(plainOf(example), name);
    await show(wave(0), "live: the first frame");

    // Frames are drawn into the same objects.
    stream.publish(wave(0.1));
    await displayed(view, stream);
    const before = await gpuCalls(view);
    const lastFrame = isSoak ? 40 : 10;
    for (let n = 2; n <= lastFrame; ++n) {
      stream.publish(wave(n / 10));
      await displayed(view, stream);
    }
    const after = await gpuCalls(view);
    assert.equal(after.objects, before.objects, "frames allocate memory on the GPU");
    assert.ok(after.images >= before.images + 2 * (lastFrame - 1), `${after.images - before.images} uploads`);
    await show(wave(lastFrame / 10), "live: a later frame");
    const hit = await pickedDepth(view);
    assert.ok(hit !== undefined && Math.abs(hit) < 0.7, `picked at z ${hit}`);

    // Operators map every frame, in drawing and picking, into the same objects.
    await view.setGeometry({ operators: "negate(x) scale(0.8)" });
    await loadsModule(view, "imgeo-operators");
    stream.publish(wave(4.1));
    await displayed(view, stream);
    const mapped = await gpuCalls(view);
    stream.publish(wave(6));
    await displayed(view, stream);
    assert.equal((await gpuCalls(view)).objects, mapped.objects, "mapped frames allocate memory on the GPU");
    await view.show(mirrored(plainOf(wave(6)), 0.8), "live: mapped by operators");
    const mappedHit = await pickedDepth(view);
    assert.ok(mappedHit !== undefined && Math.abs(mappedHit) < 0.56, `picked at z ${mappedHit}`);
    await view.setGeometry({ operators: "negate(x) scale(0.6)" });
    await view.show(mirrored(plainOf(wave(6)), 0.6), "live: mapped by other operators between two frames");
    await view.setGeometry({ operators: undefined });

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
    await until("no request is open", () => view.server.requestsOf(/frames/).every(({ state }) => state !== "waiting"));
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
  });
});

soakTest("a live stream goes on in another epoch, after an outage and after a restart of its server", async () => {
  // A killed server refuses connections, resets them or ends them without an answer.
  const expectedErrors = /500|410|404|live\/(sheet|cloth)|ERR_(CONNECTION|SOCKET|EMPTY_RESPONSE)/;
  await withLivePage({ expectedErrors }, async (view) => {
    const { stream, outages } = view;
    const show = (example: GridExample, name: string): Promise<void> => view.show(plainOf(example), name);
    // Another epoch has other vertices.
    stream.begin(wave(5, 25, 60));
    stream.publish(wave(5, 25, 60));
    await displayed(view, stream);
    await show(wave(5, 25, 60), "live: another epoch");
    const beforeEpoch = await gpuCalls(view);
    stream.begin(wave(6, 25, 60));
    stream.publish(wave(6, 25, 60));
    await displayed(view, stream);
    await show(wave(6, 25, 60), "live: an epoch with the same vertices");
    assert.equal((await gpuCalls(view)).objects, beforeEpoch.objects, "an equal epoch allocates memory on the GPU");
    // A server that is gone for a while: the requests that wait still get their frames.
    stream.failingStatus = 500;
    stream.publish(wave(7, 25, 60));
    await until("the outage is reported", async () => (await outages()).length > 0);
    await show(wave(7, 25, 60), "live: during an outage");
    stream.failingStatus = undefined;
    stream.publish(wave(8, 25, 60));
    await displayed(view, stream);
    await show(wave(8, 25, 60), "live: after an outage");
    assert.deepEqual(await outages(), ["http"]);
    assert.equal((await view.events("load", "shape")).length, 1);
    await surviveRestart(view);
  });
});

soakTest("a live stream has colours, values and normals, and is drawn as points", async () => {
  await withLivePage({}, async (view) => {
    const { stream, outages } = view;
    // A page without lights shows streamed colours as they are.
    const flat = exampleOf("geometryImage", 4, 4, [0, 0, 0], [3, 3, 3], 2, 3, (u, v) => [u, 1 - v, 0.5]);
    const centerColor = async (): Promise<number[]> => {
      const { data, width, height, channels } = await view.picture();
      const at = (Math.floor(height / 2) * width + Math.floor(0.42 * width)) * channels;
      return Array.from(data.subarray(at, at + 3));
    };
    const constant = (value: number): number[] => Array.from({ length: 16 }, () => value);
    const setMaterial = (html: string): Promise<void> =>
      view.page.evaluate((text) => {
        document.querySelector("material, unlitmaterial")!.outerHTML = text;
      }, html);
    const setShape = (attributes: Record<string, string | undefined>): Promise<void> =>
      view.page.evaluate((changes) => {
        const shape = document.querySelector("shape")!;
        for (const [name, value] of Object.entries(changes))
          if (value === undefined) shape.removeAttribute(name);
          else shape.setAttribute(name, value);
      }, attributes);
    const shades: number[] = [];
    for (const decode of ["auto", "cpu"]) {
      await view.setGeometry({ decode });
      await setMaterial("<UnlitMaterial></UnlitMaterial>");
      stream.begin(flat, { colorComponents: 3 });
      stream.publish(flat, [200, 100, 50].map(constant));
      await displayed(view, stream);
      assert.deepEqual(await centerColor(), [200, 100, 50]);
      await setShape({ colorBy: "value", colorMap: "0 0 0, 1 1 1" });
      stream.begin(flat, { valueComponents: 1, valueBits: 12, valueRange: [[-1, 3]] });
      stream.publish(flat, [constant(819)]);
      await displayed(view, stream);
      assert.deepEqual(await centerColor(), [51, 51, 51]);
      await setShape({ colorBy: undefined });
      await setMaterial('<Material diffuseColor="0.3 0.3 0.3"></Material>');
      const shadeOf = async (u: number, v: number): Promise<number> => {
        stream.begin(flat, { normalBits: 8 });
        stream.publish(flat, [u, v].map(constant));
        await displayed(view, stream);
        return (await centerColor())[0]!;
      };
      const [facing, down] = [await shadeOf(127, 127), await shadeOf(127, 0)];
      assert.ok(facing > down + 20, `${facing} facing the viewer, ${down} facing down`);
      shades.push(facing, down);
    }
    assert.deepEqual(shades.slice(2), shades.slice(0, 2));
    await view.setGeometry({ decode: undefined });
    await view.promise("complete", "shape");

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
    assert.deepEqual(await outages(), []);
  });
});

/** The real server is killed and started again: the picture stays, one event says why, and frames go on. */
async function surviveRestart(view: LiveView): Promise<void> {
  const server = await liveServer();
  const newest = (): Promise<number> =>
    view.page.evaluate(() => (window as unknown as { frames: { number: number }[] }).frames.at(-1)?.number ?? 0);
  await server.start();
  try {
    await view.setGeometry({ coord: server.url, primType: undefined, vertexCount: undefined });
    const startOfEpochs = 1e9; // epochs of the server are times, those of TestStream small numbers
    await until("the server's frames are displayed", async () => (await newest()) > startOfEpochs);
    const before = (await view.outages()).length;
    await server.kill();
    await until("the outage is reported", async () => (await view.outages()).length > before);
    const last = await newest();
    const picture = await view.picture();
    savePicture("live: the server is gone", picture);
    await new Promise((resolve) => setTimeout(resolve, 500));
    assert.equal(difference(await view.picture(), picture).mean, 0, "the picture stays while the server is gone");
    await server.start();
    await until("frames of the new process are displayed", async () => (await newest()) > last);
    assert.deepEqual((await view.outages()).slice(before), ["network"]);
  } finally {
    await server.kill();
  }
}

/** The z coordinate of what is in the middle of the picture. */
async function pickedDepth({ page }: View): Promise<number | undefined> {
  return page.evaluate(({ x, y }) => {
    interface View {
      positionAndNormalFromPoint(x: number, y: number): { position: { z: number } } | null;
    }
    return (document.querySelector("imgeo-view") as unknown as View).positionAndNormalFromPoint(x, y)?.position.z;
  }, center);
}

/** The triangles of a grid as the index image of SIG classic, with 24-bit indices in rows of 256. */
function indexImageOf({ triangles }: PlainPatch): Buffer {
  const height = Math.ceil(triangles.length / 256);
  const data = new Uint8Array(3 * 256 * height);
  triangles.forEach((vertex, n) => {
    data.set([vertex & 255, (vertex >> 8) & 255, vertex >> 16], 3 * n);
  });
  return encodePng({ width: 256, height, channels: 3, data });
}

soakTest("another lattice and another stream take the GPU objects of the one before, or free them", async () => {
  await withLivePage({}, async (view) => {
    const { stream, show, setGeometry, server } = view;
    const sheet = (size: number, moment: number): GridExample =>
      exampleOf("geometryImage", 40, 30, [0.1, 0, 0], [size, size, size], 2, 3, (u, v) => [
        0.2 + 0.6 * u,
        0.8 - 0.6 * v,
        0.5 + 0.1 * Math.sin(7 * u + moment),
      ]);
    const second = new TestStream(server, "second");
    for (const decode of isSoak ? [undefined, "cpu"] : [undefined]) {
      await setGeometry({ coord: "live/sheet", decode });
      const publish = async (to: TestStream, example: GridExample, name: string): Promise<void> => {
        to.publish(example);
        await displayed(view, to);
        await show(plainOf(example), `live, decode ${decode ?? "auto"}: ${name}`);
      };
      /** A page keeps the memory of what was replaced for two seconds. */
      const liveObjects = async (): Promise<string> => {
        let live = "";
        const read = async (): Promise<string> => JSON.stringify((await view.observed()).live);
        await until("objects are freed", async () => {
          await new Promise((resolve) => setTimeout(resolve, 2500));
          const before = live;
          return before === (live = await read());
        });
        return live;
      };
      stream.begin(sheet(3, 0));
      await publish(stream, sheet(3, 0), "a lattice");
      const live = await liveObjects();
      const before = await gpuCalls(view);

      stream.begin(sheet(4, 1));
      await publish(stream, sheet(4, 1), "another box");
      second.begin(sheet(3.5, 3));
      second.publish(sheet(3.5, 3));
      await setGeometry({ coord: "live/second" });
      await publish(second, sheet(3.5, 4), "another stream");
      assert.equal((await gpuCalls(view)).objects, before.objects, "an equal layout allocates memory on the GPU");

      second.begin(wave(0, 60, 50));
      await publish(second, wave(0, 60, 50), "another layout");
      assert.ok((await gpuCalls(view)).objects > before.objects);
      assert.equal(await liveObjects(), live, "objects of the layout before are not freed");
      stream.begin(sheet(3, 5));
      stream.publish(sheet(3, 5));
      await setGeometry({ coord: "live/sheet" });
      await publish(stream, sheet(3, 5), "a stream of another layout");
      assert.equal(await liveObjects(), live, "objects of the stream before are not freed");
    }
  });
});

soakTest("a live stream is drawn from buffers as from images, and with normals of its triangles", async () => {
  await withLivePage({}, async (view) => {
    const { stream, show, setGeometry, server } = view;
    let moment = 0;
    const publish = async (): Promise<GridExample> => {
      moment += 0.1;
      stream.publish(wave(moment));
      await displayed(view, stream);
      return wave(moment);
    };
    /** Publishes frames, and asserts that they take the memory of the frames before. */
    const publishSeveral = async (count: number): Promise<GridExample> => {
      await publish();
      const before = await gpuCalls(view);
      for (let n = 1; n < count; ++n) await publish();
      const after = await gpuCalls(view);
      assert.equal(after.objects, before.objects, "frames allocate memory on the GPU");
      assert.ok(after.arrays >= before.arrays + 2 * (count - 1), `${after.arrays - before.arrays} uploads of arrays`);
      assert.equal(after.images, before.images);
      return publish();
    };
    const pickMiddle = async (example: GridExample): Promise<void> => {
      const z = (await pickedDepth(view)) ?? Infinity;
      const { positions } = plainOf(example);
      const depths = Array.from({ length: positions.length / 3 }, (_, n) => positions[3 * n + 2]!);
      assert.ok(z >= Math.min(...depths) && z <= Math.max(...depths), `picked at z ${z}`);
    };

    // The surface is the same wherever its frames are decoded; the back of a surface is lit as its front.
    for (const attributes of [{ decode: "cpu" }, { decode: undefined, ccw: "false" }]) {
      await setGeometry(attributes);
      await view.promise("complete", "shape");
      const example = await publishSeveral(10);
      await show(plainOf(example), `live: ${JSON.stringify(attributes)}`);
      await pickMiddle(example);
    }

    const noIndex = { index: undefined, indexType: undefined, primType: undefined, vertexCount: undefined };
    // Triangles of an index image: normals are sums of those of the triangles around each vertex.
    const triangles = (example: GridExample): PlainPatch => {
      const plain = plainOf(example);
      return { ...plain, normals: areaWeightedNormals({ positions: plain.positions, triangles: plain.triangles }) };
    };
    const first = plainOf(wave(0));
    server.put("/index.png", indexImageOf(first));
    await setGeometry({
      ccw: undefined,
      index: "index.png",
      indexType: "Uint32",
      primType: "TRIANGLES",
      vertexCount: `${first.triangles.length}`,
      implicitMeshSize: "256",
    });
    await view.promise("complete", "shape");
    await show(triangles(wave(moment)), "live: an index, before the next frame");
    const example = await publishSeveral(10);
    await show(triangles(example), "live: an index");
    await pickMiddle(example);

    // Each frame is displayed or counted, over all these forms of the stream.
    const frames = await displayed(view, stream);
    const counted = frames.slice(1).reduce((sum, { skipped }) => sum + skipped + 1, 0);
    assert.equal(counted, stream.number - frames[0]!.number);

    // A page that nobody sees requests no frames, and goes on with the newest.
    const setHidden = (isHidden: boolean): Promise<void> =>
      view.page.evaluate((value) => {
        Object.defineProperty(document, "hidden", { configurable: true, get: () => value });
        document.dispatchEvent(new Event("visibilitychange"));
      }, isHidden);
    await setHidden(true);
    await until("no request is open", () => server.requestsOf(/frames/).every(({ state }) => state !== "waiting"));
    const requestCount = server.requestsOf(/live/).length;
    for (let n = 0; n < 5; ++n) stream.publish(wave(50 + n));
    await new Promise((resolve) => setTimeout(resolve, 200));
    assert.equal(server.requestsOf(/live/).length, requestCount, "a hidden page sends requests");
    await setHidden(false);
    const revealed = await displayed(view, stream);
    assert.equal(revealed.at(-1)!.skipped, 4);

    // Static images beside a stream: its texture coordinates are those of a geometry in files.
    const { columns, rows } = wave(0);
    const words = (value: number): [number, number] => [
      Math.round(65535 * value) >> 8,
      Math.round(65535 * value) & 255,
    ];
    const uv = Uint8Array.from(
      Array.from({ length: columns * rows }, (_, n) => {
        const [[u, uLow], [v, vLow]] = [
          words((n % columns) / (columns - 1)),
          words(Math.floor(n / columns) / (rows - 1)),
        ];
        return [u, v, uLow, vLow];
      }).flat(),
    );
    server.put("/uv.png", encodePng({ width: columns, height: rows, channels: 4, data: uv }));
    const checker = Uint8Array.from({ length: 3 * 64 }, (_, n) => (((n / 3) & 1) === ((n / 24) & 1) ? 250 : 20));
    server.put("/checker.png", encodePng({ width: 8, height: 8, channels: 3, data: checker }));
    const setTexture = (texture: string): Promise<void> =>
      view.page.evaluate((html) => {
        document.querySelector("imagetexture")?.remove();
        document.querySelector("appearance")!.insertAdjacentHTML("beforeend", html);
      }, texture);
    const plain = await view.picture();
    await setTexture('<ImageTexture url="checker.png"></ImageTexture>');
    const textured: Picture[] = [];
    for (const decode of [undefined, "cpu"]) {
      await setGeometry({ ...noIndex, decode, texCoord: "uv.png" });
      await view.promise("complete", "shape");
      stream.publish(wave(60));
      await displayed(view, stream);
      textured.push(await view.picture());
    }

    // A script that changes the files of a geometry: they take the GPU memory of those before.
    const filesOf = (n: number, example = wave(100 + n)): { example: GridExample; urls: string[] } => {
      const urls = [...example.files.values()].map((file, plane) => {
        server.put(`/sheet/${n}-${plane}.png`, file);
        return `sheet/${n}-${plane}.png`;
      });
      return { example, urls };
    };
    const image = {
      ...noIndex,
      implicitMeshMode: "geometryImage",
      implicitMeshSize: `${columns} ${rows}`,
      position: "0 0 0",
      size: "3 3 3",
    };
    const showImages = async (n: number, moment = 100 + n): Promise<GridExample> => {
      const { example, urls } = filesOf(n, wave(moment));
      await setGeometry({ ...image, coord: urls.map((url) => `"${url}"`).join(" ") });
      await view.promise("complete", "shape");
      return example;
    };
    const binary = (n: number): { example: GridExample; url: string } => {
      const example = wave(200 + n);
      const { positions, normals, triangles } = plainOf(example);
      server.put(
        `/sheet/${n}.bin`,
        Buffer.concat([positions, normals!, triangles].map(({ buffer }) => Buffer.from(buffer))),
      );
      return { example, url: `sheet/${n}.bin` };
    };
    const showBinary = async (n: number): Promise<GridExample> => {
      const { example, url } = binary(n);
      const bytes = 12 * columns * rows;
      await setGeometry({
        coord: url,
        coordType: "Float32",
        normal: `${url}#${bytes}`,
        normalType: "Float32",
        index: `${url}#${2 * bytes}`,
        indexType: "Uint32",
        primType: "TRIANGLES",
        vertexCount: `${first.triangles.length}`,
      });
      await view.promise("complete", "shape");
      return example;
    };
    /** Changes the files several times. */
    const changeSeveral = async (name: string, change: (n: number) => Promise<GridExample>): Promise<void> => {
      await change(0);
      await view.picture();
      const before = await gpuCalls(view);
      for (let n = 1; n < 9; ++n) await change(n);
      const example = await change(9);
      await show(plainOf(example), `changed files: ${name}`);
      assert.equal((await gpuCalls(view)).objects, before.objects, `${name}: changes allocate memory on the GPU`);
    };
    await showImages(10, 60);
    const inFiles = await view.picture();
    savePicture("live: textured", inFiles);
    for (const picture of textured) assertSamePicture("live: textured", picture, inFiles, boundsOfQuantised);
    assert.ok(difference(inFiles, plain).mean > 5, "the texture is not displayed");
    await setTexture("");
    await setGeometry({ decode: undefined, texCoord: undefined });
    await changeSeveral("images", showImages);

    // Faster than files load: each one that is whole is displayed, and the last one in the end.
    const urls = Array.from({ length: 60 }, (_, n) =>
      filesOf(300 + n)
        .urls.map((url) => `"${url}"`)
        .join(" "),
    );
    const [before, filesBefore] = [await gpuCalls(view), server.requestsOf(/sheet/).length];
    await view.page.evaluate(async (urls) => {
      for (const url of urls) {
        document.querySelector("imagegeometry")!.setAttribute("coord", url);
        await new Promise((resolve) => setTimeout(resolve, 16));
      }
    }, urls);
    const displayedCount = ((await gpuCalls(view)).images - before.images) / 2;
    assert.ok(displayedCount >= 5, `${displayedCount} of 60 geometries were displayed while they changed`);
    await view.promise("complete", "shape");
    await show(plainOf(wave(100 + 359)), "changed files: the last of sixty");
    // Two textures are created and get their memory, once, where the spare ones have been freed after two seconds.
    const allocated = (await gpuCalls(view)).objects - before.objects;
    assert.ok(allocated <= 4, `fast changes allocate memory on the GPU: ${allocated} calls`);
    const requests = server.requestsOf(/sheet/).slice(filesBefore);
    assert.ok(
      requests.every(({ state }) => state !== "aborted") && requests.length < 120,
      `${requests.length} requests`,
    );
    await setGeometry({ decode: "cpu" });
    await view.promise("complete", "shape");
    await changeSeveral("images in workers", showImages);
    const { url } = binary(0);
    await view.page.evaluate((url) => {
      document.querySelector("imagegeometry")!.outerHTML =
        `<BinaryGeometry solid="false" primType="POINTS" coordType="Float32" coord="${url}"></BinaryGeometry>`;
    }, url);
    await changeSeveral("typed arrays", showBinary);
  });
});

/** Bytes of JavaScript's heap, and of array buffers, after garbage collection. */
async function heapOf({ page }: View): Promise<{ heap: number; buffers: number }> {
  await page.evaluate(() => {
    (window as unknown as { frames: unknown[] }).frames.splice(0); // the test's own
    window.observed.events.splice(0);
  });
  const session = await page.context().newCDPSession(page);
  for (let n = 0; n < 3; ++n) await session.send("HeapProfiler.collectGarbage");
  const usage = await session.send("Runtime.getHeapUsage");
  await session.detach();
  const { usedSize, backingStorageSize } = usage;
  return { heap: usedSize, buffers: backingStorageSize };
}

/** Frames of the test that `make soak` runs. */
const longFrameCount = Number(process.env.IMGEO_FRAMES ?? 10_000);
/** The browser compiles code while it shows the first ones. */
const warmUpFrameCount = 1000;

soakTest("thousands of frames leave nothing behind", async () => {
  for (const decode of ["gpu", "cpu"])
    await withLivePage({}, async (view) => {
      await view.setGeometry({ decode });
      await view.promise("complete", "shape");
      const examples = Array.from({ length: 32 }, (_, n) => wave(n / 5));
      const publish = async (count: number): Promise<void> => {
        for (let n = 0; n < count; ++n) {
          view.stream.publish(examples[n % examples.length]!);
          await showsNewest(view, view.stream);
        }
      };
      await publish(warmUpFrameCount);
      const before = { ...(await heapOf(view)), ...(await gpuCalls(view)) };
      await publish(longFrameCount);
      const after = { ...(await heapOf(view)), ...(await gpuCalls(view)) };
      console.log(`decode="${decode}", ${longFrameCount} frames:`, before, after);
      assert.equal(after.objects, before.objects, "frames allocate memory on the GPU");
      // An object that stays for each frame would take more. What remains is compiled code and the browser's own lists
      // of requests, which end at a few hundred.
      assert.ok(after.heap - before.heap < 64 * longFrameCount, `the heap grew by ${after.heap - before.heap} bytes`);
      assert.ok(after.buffers - before.buffers < 2 ** 16, `buffers grew by ${after.buffers - before.buffers} bytes`);
    });
});
