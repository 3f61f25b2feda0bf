// Tests that vertex data is kept on the GPU only, and is uploaded in pieces; and the budget of GPU memory.

import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { assertSamePicture } from "./compare.ts";
import { settle, withPage, type View } from "./harness.ts";
import type { Picture } from "./png.ts";
import { sceneOf, shapeInFolder } from "./scenes.ts";
import { siteOfGenerated } from "./sites.ts";
import { soakTest } from "./soak.ts";

interface Memory {
  /** All arrays that were sent to WebGL or read as images; `context`: the number of the WebGL context, -1 without one. */
  seen: { bytes: number; array: WeakRef<ArrayBuffer>; context: number }[];
  /** Bytes of the textures and buffers that exist now, and their maximum so far. */
  gpuBytes: number;
  maxGpuBytes: number;
}

/** Self-contained: records memory from outside of the runtime. */
function recordMemory(): void {
  const memory: Memory = { seen: [], gpuBytes: 0, maxGpuBytes: 0 };
  Object.assign(window, { memory });
  const contexts: unknown[] = [];
  const numberOf = (context: unknown): number =>
    contexts.includes(context) ? contexts.indexOf(context) : contexts.push(context) - 1;
  const recordArray = (data: unknown, context?: unknown): void => {
    if (!ArrayBuffer.isView(data)) return;
    const array = new WeakRef(data.buffer as ArrayBuffer);
    memory.seen.push({ bytes: data.byteLength, array, context: context === undefined ? -1 : numberOf(context) });
  };
  const gl = WebGL2RenderingContext.prototype;
  const methods = gl as unknown as Record<string, (...args: unknown[]) => unknown>;
  const after = (name: string, note: (gl: WebGL2RenderingContext, args: unknown[]) => void): void => {
    const original = methods[name]!;
    methods[name] = function (...args) {
      note(this as unknown as WebGL2RenderingContext, args);
      return original.apply(this, args);
    };
  };
  const sizes = new Map<unknown, number>();
  const setSize = (object: unknown, bytes: number): void => {
    memory.gpuBytes += bytes - (sizes.get(object) ?? 0);
    sizes.set(object, bytes);
    memory.maxGpuBytes = Math.max(memory.maxGpuBytes, memory.gpuBytes);
  };
  const bindings: Record<number, number> = {
    [gl.COPY_WRITE_BUFFER]: 0x8f37,
    [gl.ARRAY_BUFFER]: gl.ARRAY_BUFFER_BINDING,
    [gl.ELEMENT_ARRAY_BUFFER]: gl.ELEMENT_ARRAY_BUFFER_BINDING,
  };
  after("bufferSubData", (context, [, , data]) => {
    recordArray(data, context);
  });
  after("bufferData", (context, [target, data]) => {
    recordArray(data, context);
    const binding = bindings[target as number];
    if (binding)
      setSize(context.getParameter(binding), typeof data === "number" ? data : (data as ArrayBufferView).byteLength);
  });
  after("texStorage2D", (context, [target, , , width, height]) => {
    if (target === gl.TEXTURE_2D)
      setSize(context.getParameter(gl.TEXTURE_BINDING_2D), Number(width) * Number(height) * 4);
  });
  for (const name of ["deleteBuffer", "deleteTexture"])
    after(name, (_, [object]) => {
      if (sizes.has(object)) setSize(object, 0);
    });
  window.Blob = class extends Blob {
    constructor(parts: BlobPart[] = [], options?: BlobPropertyBag) {
      super(parts, options);
      parts.forEach((part) => {
        recordArray(part);
      });
    }
  };
}

const memoryOf = (view: View): Promise<Memory> =>
  view.page.evaluate(() => (window as unknown as { memory: Memory }).memory);

describe("a scene that has loaded", () => {
  test("keeps no decoded images open", async () => {
    await withPage(
      siteOfGenerated("trefoil-colors", "--profile", "classic", "--patch-vertices", "1000"),
      {},
      async (view) => {
        await view.promise("complete");
        await settle(view.page);
        const { live } = await view.observed();
        assert.equal(live.bitmaps, 0);
        assert.ok(live.textures > 10);
      },
    );
  });
});

describe("vertex data", () => {
  for (const [what, mesh, options, attribute] of [
    ["of images", "trefoil-colors", ["--profile", "classic"], ""],
    ["of arrays", "trefoil-colors", ["--container", "bg", "--layout", "separate"], ""],
    ["of arrays of records", "trefoil-colors", ["--container", "bg", "--layout", "interleaved"], ""],
    ["of images that workers decode", "trefoil-colors", ["--profile", "classic"], 'decode="cpu"'],
    // 36,864 vertices of eight bytes and 73,728 triangles: both are more than one piece.
    ["of compact", "sphere-large", ["--profile", "compact"], ""],
  ] as const) {
    (what === "of images" ? test : soakTest)(`${what} are not kept in JavaScript`, async () => {
      const isLarge = mesh === "sphere-large";
      const site = siteOfGenerated(mesh, ...(isLarge ? [] : ["--patch-vertices", "1000"]), ...options);
      const server = (server: View["server"]): void => {
        server.when(/^\/$/, { replace: (html) => html.toString().replace(/<ImageGeometry/i, `$& ${attribute}`) });
      };
      await withPage(site, { before: recordMemory, server }, async (view) => {
        await view.promise("complete");
        await settle(view.page);
        const { seen, largest, kept } = await view.page.evaluate(async () => {
          const { memory, gc } = window as unknown as { memory: Memory; gc: () => void };
          const sum = (arrays: Memory["seen"]): number => arrays.reduce((bytes, each) => bytes + each.bytes, 0);
          const all = sum(memory.seen);
          // The preview, which draws small meshes where the runtime comes later, uploads them whole, to a context before.
          const last = Math.max(...memory.seen.map(({ context }) => context));
          const largestPiece = Math.max(
            ...memory.seen.filter(({ context }) => context === last).map(({ bytes }) => bytes),
          );
          for (let turn = 0; turn < 20 && memory.seen.length > 0; ++turn) {
            await new Promise((resolve) => setTimeout(resolve, 50)); // a WeakRef that was read keeps its target until the end of the task
            gc();
            memory.seen = memory.seen.filter(({ array }) => array.deref() !== undefined);
          }
          return { seen: all, largest: largestPiece, kept: sum(memory.seen) };
        });
        assert.ok(seen > 20_000, `${seen} bytes were sent to the GPU`);
        if (isLarge) assert.ok(seen > 2 ** 19 && largest <= 2 ** 18, `${seen} bytes in pieces of up to ${largest}`);
        // The warm-up of previews uploads one vertex and one triangle that are not part of the scene.
        assert.ok(kept <= (isLarge ? 18 : 0), `${kept} bytes are kept`);
      });
    });
  }
});

describe("a budget", () => {
  /** Two knots far apart, and a viewpoint in front of each. */
  const scene = (site: string, attributes: string): string => {
    const at = (x: number): string =>
      `<Transform translation="${x} 0 0">${shapeInFolder(site, "knot", `id="at${x}"`).replaceAll("knot/", `knot${x}/`)}</Transform>`;
    const point = (x: number): string => `<Viewpoint description="at ${x}" position="${x} 0 12"></Viewpoint>`;
    return sceneOf(
      `budget-${attributes.replaceAll(/\W+/g, "-")}`,
      { knot0: site, knot500: site },
      `${point(0)}${point(500)}${at(0)}${at(500)}`,
      attributes,
    );
  };

  async function pictures(directory: string, check: (view: View, x: number) => Promise<void>): Promise<Picture[]> {
    const seen: Picture[] = [];
    await withPage(directory, { before: recordMemory }, async (view) => {
      await view.promise("complete");
      for (const x of [0, 500, 0]) {
        await view.page.evaluate((name) => {
          (document.querySelector("x3d") as unknown as { bindViewpoint: (name: string) => void }).bindViewpoint(name);
        }, `at ${x}`);
        const stateOf = async (): Promise<string> =>
          `${view.server.requests.length} ${(await memoryOf(view)).gpuBytes}`;
        for (let before = ""; before !== (before = await stateOf());) {
          await settle(view.page);
          await view.page.evaluate(() => new Promise((resolve) => setTimeout(resolve, 200)));
        }
        seen.push(await view.picture());
        await check(view, x);
      }
    });
    return seen;
  }

  for (const container of ["sig", "bg"]) {
    soakTest(`keeps visible data, frees other data, and becomes stable: ${container}`, async () => {
      const site = siteOfGenerated(
        "trefoil",
        "--profile",
        "classic",
        "--patch-vertices",
        "700",
        "--container",
        container,
      );
      let all = 0;
      const expected = await pictures(scene(site, `id="${container}"`), async (view) => {
        all = (await memoryOf(view)).gpuBytes;
      });
      const budget = 0.6 * all;
      let requests = 0;
      const found = await pictures(scene(site, `id="${container}" budget="${budget / 1e6}"`), async (view, x) => {
        const { gpuBytes, maxGpuBytes } = await memoryOf(view);
        assert.ok(gpuBytes <= budget && gpuBytes > 0.4 * all, `${gpuBytes} bytes of ${budget}`);
        // A stage of buffers is uploaded before the stage that it replaces is freed.
        assert.ok(maxGpuBytes <= budget * 1.1, `up to ${maxGpuBytes} bytes of ${budget}`);
        const { length } = view.server.requests;
        assert.ok(x === 0 || length > requests, "nothing was fetched again");
        requests = length;
      });
      found.forEach((picture, n) => {
        assertSamePicture(`budget ${container} ${n}`, picture, expected[n]!, { mean: 0 });
      });
    });
  }
});

describe("a container whose URL changes", () => {
  /** Points of 12 bytes. */
  const cloud = (vertexCount: number, shift: number): Buffer => {
    const coords = Float32Array.from({ length: 3 * vertexCount }, (_, n) => Math.sin(n + shift));
    return Buffer.from(coords.buffer);
  };
  for (const [what, vertexCount, sets] of [
    ["of at most 4 MiB has one set of GPU objects throughout", 100_000, 1],
    ["of more than 4 MiB has two sets for a moment, and then one", 500_000, 2],
  ] as const) {
    soakTest(what, async (context) => {
      const geometry = `<BinaryGeometry coord="cloud/0.bin" primType="POINTS" vertexCount="${vertexCount}" size="2 2 2"></BinaryGeometry>`;
      const directory = sceneOf(
        `replaced-${vertexCount}`,
        { q: siteOfGenerated("trefoil", "--profile", "classic") },
        `<Viewpoint position="0 0 6"></Viewpoint><Shape>${geometry}</Shape>`,
      );
      const server = (server: View["server"]): void => {
        for (let n = 0; n < 4; ++n) server.put(`/cloud/${n}.bin`, cloud(vertexCount, n));
      };
      await withPage(directory, { before: recordMemory, server }, async (view) => {
        await view.promise("complete");
        await settle(view.page);
        const { gpuBytes: before } = await memoryOf(view);
        const cloudBytes = 12 * vertexCount;
        assert.ok(before >= cloudBytes && before < 1.1 * cloudBytes, `${before} bytes for ${cloudBytes}`);
        await view.page.evaluate(() => {
          const { memory } = window as unknown as { memory: Memory };
          memory.maxGpuBytes = memory.gpuBytes;
        });
        for (let n = 1; n < 4; ++n) {
          await view.page.evaluate((url) => {
            document.querySelector("binarygeometry")!.setAttribute("coord", url);
          }, `cloud/${n}.bin`);
          await view.promise("complete", "shape");
          await settle(view.page);
        }
        await new Promise((resolve) => setTimeout(resolve, 2500)); // spare objects are kept for two seconds
        const { gpuBytes, maxGpuBytes } = await memoryOf(view);
        const others = before - cloudBytes;
        context.diagnostic(`up to ${maxGpuBytes - others} bytes, ${gpuBytes - others} in the end, of ${cloudBytes}`);
        assert.equal(maxGpuBytes, before + (sets - 1) * cloudBytes);
        assert.equal(gpuBytes, before);
      });
    });
  }
});

soakTest("a large image is uploaded in bands of rows", async () => {
  const before = (): void => {
    const uploads: number[] = [];
    (window as unknown as { uploads: number[] }).uploads = uploads;
    const gl = WebGL2RenderingContext.prototype as unknown as Record<string, (...args: unknown[]) => void>;
    const upload = gl.texSubImage2D;
    gl.texSubImage2D = function (...args) {
      uploads.push(Number(args[4]) * Number(args[5]) * 4);
      upload?.apply(this, args);
    };
  };
  // 36,864 vertices and 73,728 triangles: an index of 221,184 texels.
  await withPage(siteOfGenerated("sphere-large", "--profile", "classic"), { before }, async (view) => {
    await view.promise("complete");
    const uploads = await view.page.evaluate(() => (window as unknown as { uploads: number[] }).uploads);
    assert.ok(Math.max(...uploads) <= 2 ** 18, `a piece of ${Math.max(...uploads)} bytes`);
    assert.ok(uploads.reduce((sum, bytes) => sum + bytes) > 221_184 * 4);
  });
});
