// Tests images that are decoded in workers instead of by the shader: the picture is the same, and workers are chosen
// by the document, by the limits of the GPU, or because the shader reads wrong values.

import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { assertSamePicture, boundsOfQuantised } from "./compare.ts";
import { until, withPage, type PageOptions, type View } from "./harness.ts";
import type { Picture } from "./png.ts";
import { referencePicture } from "./reference.ts";
import { gate } from "./server.ts";
import { decodeSite, ranksOfFiles } from "./siteDecoder.ts";
import { pageOf, siteOfGenerated, type GeneratedMesh } from "./sites.ts";
import { soakTest } from "./soak.ts";

const onCpu = (html: Buffer): string => html.toString().replaceAll(/<ImageGeometry/gi, `$& decode="cpu"`);
const cpuServer = (server: View["server"]): void => void server.when(/^\/$/, { replace: onCpu });

interface Result {
  picture: Picture;
  /** Number of textures after everything has loaded; without images on the GPU there are fewer. */
  textures: number;
  workers: number;
}

async function loadPage(site: string, options: PageOptions): Promise<Result> {
  let seen: Result | undefined;
  await withPage(site, options, async (view) => {
    await view.promise("complete");
    const picture = await view.picture();
    seen = { picture, textures: (await view.observed()).live.textures, workers: view.page.workers().length };
  });
  assert.ok(seen);
  return seen;
}

/** `isLong`: only `make soak` runs it. */
const cases: { mesh: GeneratedMesh; options: string[]; isLong?: boolean }[] = [
  ...["triangles", "strips"].map((primitives) => ({
    mesh: "trefoil-colors" as const,
    options: ["--primitives", primitives, "--patch-vertices", "1000"],
    isLong: primitives === "triangles",
  })),
  { mesh: "trefoil-colors", options: ["--index", "off", "--primitives", "strips"], isLong: true },
  { mesh: "trefoil-plain", options: ["--position-bits", "12"], isLong: true },
  { mesh: "trefoil", options: ["--normals", "octahedral"], isLong: true },
  { mesh: "trefoil", options: ["--normals", "palette"], isLong: true },
  { mesh: "points", options: [], isLong: true },
  { mesh: "coil", options: ["--primitives", "strips"], isLong: true },
];

describe("the picture decoded on the CPU equals that of the GPU and of plain buffers", () => {
  for (const { mesh, options, isLong } of cases) {
    (isLong === true ? soakTest : test)([mesh, ...options].join(" "), async () => {
      const site = siteOfGenerated(mesh, "--profile", "classic", ...options);
      const gpu = await loadPage(site, {});
      const cpu = await loadPage(site, { server: cpuServer });
      assertSamePicture(`cpu and gpu ${mesh} ${options.join("")}`, cpu.picture, gpu.picture, { mean: 0.0005 });
      assertSamePicture(
        `cpu ${mesh} ${options.join("")}`,
        cpu.picture,
        await referencePicture(pageOf(site), decodeSite(site)),
        boundsOfQuantised,
      );
      assert.ok(gpu.textures > cpu.textures, `${gpu.textures} and ${cpu.textures} textures`);
      assert.ok(gpu.workers === 0 && cpu.workers > 0, `${gpu.workers} and ${cpu.workers} workers`);
    });
  }

  soakTest("with the first coordinate byte alone", async () => {
    const site = siteOfGenerated("trefoil-colors", "--profile", "classic");
    const pictures: Picture[] = [];
    for (const decode of [undefined, cpuServer]) {
      const { closed } = gate();
      const held = [...ranksOfFiles(pageOf(site))].filter(([, rank]) => rank > 3).map(([url]) => `/${url}`);
      const server = (server: View["server"]): void => {
        decode?.(server);
        server.when((path) => held.includes(path), { hold: closed });
      };
      await withPage(site, { server }, async (view) => {
        await until("the shape is shaded", async () =>
          (await view.observed()).events.some(({ target, detail }) => target === "shape" && detail.stage === "shaded"),
        );
        pictures.push(await view.picture());
      });
    }
    assertSamePicture("coarse on the CPU", pictures[1]!, pictures[0]!, { mean: 0.0005 });
  });
});

/** Self-contained: makes the vertex shader read slightly wrong values. */
function readWrongValues(): void {
  const gl = WebGL2RenderingContext.prototype as unknown as Record<string, (...args: unknown[]) => unknown>;
  const shaderSource = gl.shaderSource!;
  gl.shaderSource = function (shader, source) {
    return shaderSource.call(this, shader, String(source).replace("rgb * 255.0 + 0.5", "rgb * 254.0 + 0.5"));
  };
}

describe("images are decoded on the CPU automatically", () => {
  const site = (): string => siteOfGenerated("trefoil-colors", "--profile", "classic");

  async function assertFallsBack(name: string, before: () => void): Promise<void> {
    const messages: string[] = [];
    const expected = await referencePicture(pageOf(site()), decodeSite(site()));
    await withPage(site(), { before }, async (view) => {
      view.page.on("console", (message) => messages.push(message.text()));
      await view.promise("complete");
      assertSamePicture(name, await view.picture(), expected, boundsOfQuantised);
      assert.ok(view.page.workers().length > 0, "nothing was decoded in workers");
      assert.ok(
        messages.some((message) => message.includes("decoded in workers")),
        messages.join("; "),
      );
    });
  }

  soakTest("if vertex shaders have too few texture units", async () => {
    await assertFallsBack("few units", () => {
      const gl = WebGL2RenderingContext.prototype as unknown as Record<string, (...args: unknown[]) => unknown>;
      const getParameter = gl.getParameter!;
      gl.getParameter = function (name) {
        return name === WebGL2RenderingContext.MAX_VERTEX_TEXTURE_IMAGE_UNITS ? 4 : getParameter.call(this, name);
      };
    });
  });

  test("if the shader reads wrong values", async () => {
    await assertFallsBack("wrong shader", readWrongValues);
  });

  soakTest("if the browser premultiplies alpha although told not to", async () => {
    await assertFallsBack("premultiplied", () => {
      const make = window.createImageBitmap.bind(window);
      window.createImageBitmap = (image: ImageBitmapSource) => make(image, { premultiplyAlpha: "premultiply" });
    });
  });

  soakTest("if a texture would exceed the maximum texture size", async () => {
    const before = (): void => {
      const gl = WebGL2RenderingContext.prototype as unknown as Record<string, (...args: unknown[]) => unknown>;
      const getParameter = gl.getParameter!;
      gl.getParameter = function (name) {
        return name === WebGL2RenderingContext.MAX_TEXTURE_SIZE ? 512 : getParameter.call(this, name);
      };
    };
    // Index images are 1024 wide.
    const { picture, workers } = await loadPage(site(), { before });
    assertSamePicture(
      "large texture",
      picture,
      await referencePicture(pageOf(site()), decodeSite(site())),
      boundsOfQuantised,
    );
    assert.ok(workers > 0, "nothing was decoded in workers");
  });

  soakTest("but not if the document requires the shader", async () => {
    const server = (server: View["server"]): void => {
      server.when(/^\/$/, { replace: (html) => html.toString().replace(/<ImageGeometry/i, `$& decode="gpu"`) });
    };
    const { workers } = await loadPage(site(), { server, before: readWrongValues });
    assert.equal(workers, 0);
  });
});

test("the main thread decodes if workers cannot be started", async () => {
  const site = siteOfGenerated("trefoil-colors", "--profile", "classic");
  const expected = await referencePicture(pageOf(site), decodeSite(site));
  for (const before of [
    () => {
      window.Worker = function () {
        throw new DOMException("not here", "SecurityError");
      } as unknown as typeof Worker;
    },
    () => {
      window.Worker = class extends Worker {
        constructor() {
          super("/missing.js", { type: "module" });
        }
      };
    },
  ]) {
    const { picture } = await loadPage(site, { server: cpuServer, before, expectedErrors: /missing\.js|404/ });
    assertSamePicture("without workers", picture, expected, boundsOfQuantised);
  }
});

test("a damaged file is reported, and the rest is displayed", async () => {
  const site = siteOfGenerated("trefoil-colors", "--profile", "classic");
  const [normal] = [...ranksOfFiles(pageOf(site))].find(([, rank]) => rank === 2)!;
  const server = (server: View["server"]): void => {
    cpuServer(server);
    server.when((path) => path === `/${normal}`, { truncateTo: 300 });
  };
  await withPage(site, { server, expectedErrors: /imgeo/ }, async (view) => {
    await view.promise("complete");
    const [error] = await view.events("error", "shape");
    assert.deepEqual([error?.detail.type, error?.detail.url], ["truncated", normal]);
    // If everything is decoded before the first frame, its first image already is the surface.
    const { events } = await view.observed();
    const stages = events
      .filter(({ target, type }) => target === "shape" && (type === "first-image" || type === "refine"))
      .map(({ detail }) => detail.stage);
    assert.equal(stages.at(-1), "surface");
  });
});
