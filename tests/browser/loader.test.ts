// Tests the loader in a three.js app: the app's lights, shadows, tone mapping and colour space apply to the scene as
// to plain buffers.

import assert from "node:assert/strict";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { before, describe, test } from "node:test";
import type { Page } from "playwright-core";
import { alphaPage, hideDecoder, loseColors } from "./alphaScene.ts";
import { bundleApp } from "./appBundles.ts";
import { serveApp } from "./appPage.ts";
import { assertSamePicture, difference } from "./compare.ts";
import { largePictureSize, until, withPage, type PageOptions, type View } from "./harness.ts";
import { shapeOf } from "./generators/grids.ts";
import { plainOf as liveBuffersOf, wave } from "./livePage.ts";
import type { AppRequest, PlainBuffers } from "./loaderPage.ts";
import { mappedMesh, type Mapping } from "./mappedGrid.ts";
import { readPly } from "./meshes.ts";
import { outputDirectory } from "./paths.ts";
import { decodePng, encodePng, type Picture } from "./png.ts";
import { referenceSettingsOf, patchOfInput } from "./reference.ts";
import { gate } from "./server.ts";
import { ranksOfFiles, type PlainPatch } from "./siteDecoder.ts";
import { meshFile, pageOf, siteOf, siteOfGenerated, type GeneratedMesh } from "./sites.ts";
import { TestStream } from "./testStream.ts";
import { isSoak, soakTest } from "./soak.ts";

const bundles = { "app.js": "tests/browser/loaderPage.ts", "worker.js": "web/src/workers/worker.ts" };
const directory = join(outputDirectory, "loader");

before(async () => {
  await bundleApp(bundles, directory);
});

/** An app beside a site, with the worker at the URL that the app sets. */
async function withApp(site: string, options: PageOptions, use: (view: View) => Promise<void>): Promise<void> {
  const server: PageOptions["server"] = (server) => {
    serveApp(server, "/", directory, Object.keys(bundles));
    options.server?.(server);
  };
  await withPage(site, { size: largePictureSize, ...options, server }, async (view) => {
    await until("the app runs", async () => view.page.evaluate(() => "app" in window));
    await view.page.evaluate(() => {
      window.app.loader.setWorkerUrl("/worker.js");
    });
    await use(view);
  });
}

async function draw(
  page: Page,
  light: AppRequest["light"],
  what: AppRequest["what"],
  castShadow = true,
): Promise<Picture> {
  await page.evaluate((request) => window.app.draw(request), { light, what, castShadow });
  return decodePng(await page.screenshot());
}

function plainOf(mesh: GeneratedMesh): PlainBuffers {
  const { positions, normals, colors, triangles, lines } = patchOfInput(readPly(readFileSync(meshFile(mesh))));
  return {
    positions: [...positions],
    ...(normals && { normals: [...normals] }),
    ...(colors && { colors: [...colors] }),
    triangles: [...triangles],
    lines: [...lines],
  };
}

interface Case {
  mesh: GeneratedMesh;
  options: string[];
  lights?: AppRequest["light"][];
  keepsVertices?: boolean;
  /** Whether only `make soak` runs it. */
  isLong?: boolean;
}

const cases: Case[] = [
  { mesh: "trefoil", options: ["--profile", "classic"], lights: ["directional", "spot", "point"], isLong: true },
  { mesh: "trefoil", options: ["--profile", "classic"], keepsVertices: true, isLong: true },
  {
    mesh: "trefoil",
    options: ["--profile", "classic", "--normals", "octahedral", "--primitives", "strips", "--patch-vertices", "1000"],
    isLong: true,
  },
  { mesh: "trefoil", options: ["--profile", "compact"], lights: ["directional", "point"] },
  {
    mesh: "trefoil",
    options: ["--container", "bg", "--normals", "spherical"],
    lights: ["directional", "point"],
    isLong: true,
  },
  { mesh: "trefoil-colors", options: ["--profile", "classic"], isLong: true },
  { mesh: "trefoil-colors", options: ["--container", "bg"], isLong: true },
  { mesh: "points", options: ["--profile", "classic"], isLong: true },
  { mesh: "coil", options: ["--profile", "compact"], isLong: true },
  { mesh: "coil", options: ["--profile", "classic"], isLong: true },
];

describe("a scene in a three.js app has the same picture as plain buffers", () => {
  for (const { mesh, options, lights = ["directional" as const], keepsVertices = false, isLong } of cases) {
    (isLong === true ? soakTest : test)(
      [mesh, ...options, ...(keepsVertices ? ["keeping vertices"] : [])].join(" "),
      async () => {
        const site = siteOfGenerated(mesh, ...options);
        await withApp(site, {}, async ({ page, server }) => {
          await page.evaluate((keep) => window.app.loader.setKeepVertices(keep), keepsVertices);
          const { diffuseColor, shininess } = referenceSettingsOf(pageOf(site)).material;
          await page.evaluate(
            ([mesh, material]) => {
              window.app.setPlain(mesh, material);
            },
            [plainOf(mesh), { diffuseColor, shininess }] as const,
          );
          await page.evaluate(() => window.app.load());
          // three.js' shader of shadow maps leaves the size of points undefined.
          const castsShadow = mesh !== "points";
          for (const light of lights) {
            const expected = await draw(page, light, "plain", castsShadow);
            const name = `loader ${mesh} ${options.join("")} ${keepsVertices ? "kept " : ""}${light}`;
            // Shadow edges may differ by a texel of the shadow map.
            const own = await draw(page, light, "scene", castsShadow);
            assertSamePicture(name, own, expected, { mean: 0.06, offShare: 0.001 });
            const [empty, unshadowed] = [await draw(page, light, "nothing"), await draw(page, light, "plain", false)];
            assert.ok(difference(expected, empty).mean > 0.5, "the reference is empty");
            if (mesh.startsWith("trefoil"))
              assert.ok(difference(expected, unshadowed).mean > 1, "the reference has no shadow");
          }
          const usesWorker = keepsVertices || options.includes("compact");
          assert.equal(server.requestsOf(/^\/worker\.js$/).length > 0, usesWorker);
        });
      },
    );
  }
});

soakTest("live streams and operators in a three.js app are drawn and cast shadows as plain buffers", async () => {
  let stream!: TestStream;
  const server = (server: View["server"]): void => {
    stream = new TestStream(server, "sheet");
    server.put(
      "/scene.x3d",
      `<X3D><Scene><Shape><Appearance><Material diffuseColor="0.7 0.6 0.4"/></Appearance>
        <ImageGeometry coord="live/sheet" solid="false"/></Shape></Scene></X3D>`,
    );
  };
  await withApp(siteOfGenerated("trefoil", "--profile", "classic"), { server }, async ({ page, server }) => {
    const setPlain = ({ positions, normals, triangles }: PlainPatch): Promise<void> =>
      page.evaluate(
        (mesh) => {
          window.app.setPlain(mesh, { diffuseColor: [0.7, 0.6, 0.4], shininess: 0.2 });
        },
        {
          positions: [...positions],
          normals: [...normals!],
          triangles: [...triangles],
          isDoubleSided: true,
          lines: [],
        },
      );
    const reload = (keepsVertices: boolean): Promise<void> =>
      page.evaluate((keep) => {
        window.app.dispose();
        window.app.loader.setKeepVertices(keep);
        return window.app.load();
      }, keepsVertices);
    for (const keepsVertices of isSoak ? [false, true] : [false]) {
      stream.begin(wave(0));
      stream.publish(wave(0));
      await reload(keepsVertices);
      for (const moment of [0, 2, 4]) {
        if (moment > 0) stream.publish(wave(moment));
        const mesh = liveBuffersOf(wave(moment));
        const { positions } = mesh;
        await setPlain(mesh);
        const expected = await draw(page, "directional", "plain");
        let picture = await draw(page, "directional", "scene");
        await until("the frame is displayed", async () => {
          picture = await draw(page, "directional", "scene");
          return difference(picture, expected).mean < 0.1;
        });
        const name = `loader live ${keepsVertices ? "kept " : ""}${moment}`;
        assertSamePicture(name, picture, expected, { mean: 0.06, offShare: 0.001 });
        const unshadowed = await draw(page, "directional", "plain", false);
        const shadow = difference(expected, unshadowed).mean;
        assert.ok(shadow > 0.3, `the shadow changes the reference by ${shadow}`);
        await draw(page, "directional", "scene");
        const { gpu, ray } = await page.evaluate(() => window.app.pick(320, 200));
        const depths = Array.from({ length: positions.length / 3 }, (_, n) => positions[3 * n + 2]!);
        const z = gpu?.point[2] ?? NaN;
        assert.ok(z >= Math.min(...depths) - 1e-3 && z <= Math.max(...depths) + 1e-3, `picked at z ${z}`);
        if (keepsVertices)
          ray!.point.forEach((coordinate, axis) => {
            assert.ok(
              Math.abs(coordinate - gpu!.point[axis]!) < 0.01,
              `${String(ray!.point)} and ${String(gpu!.point)}`,
            );
          });
      }
    }

    // Operators: the references are mapped by hand, in the sheet's box, whose centre is the origin.
    const example = wave(0);
    for (const [path, body] of example.files) server.put(path, body);
    for (const [operators, map, blurRadius] of [
      [
        "negate(x) scale(0.7 0.9 0.8)",
        ([x, y, z], [a, b, c]) => [
          [-0.7 * x, 0.9 * y, 0.8 * z],
          [-a / 0.7, b / 0.9, c / 0.8],
        ],
        0,
      ],
      [
        "blur(3.5) swizzle(yxz)",
        ([x, y, z], [a, b, c]) => [
          [y, x, z],
          [b, a, c],
        ],
        3.5,
      ],
    ] as readonly (readonly [string, Mapping, number])[]) {
      const shape = shapeOf(example, `operators="${operators}" solid="false"`).replace(/ specularColor="[^"]*"/, "");
      server.put("/scene.x3d", `<X3D><Scene>${shape}</Scene></X3D>`);
      const mesh = mappedMesh(example, map, true, blurRadius);
      await setPlain(mesh);
      const expected = await draw(page, "directional", "plain");
      const unshadowed = await draw(page, "directional", "plain", false);
      const shadow = difference(expected, unshadowed).mean;
      assert.ok(shadow > 0.3, `the shadow changes the reference by ${shadow}`);
      for (const keepsVertices of isSoak ? [false, true] : [true]) {
        await reload(keepsVertices);
        const name = `loader ${operators}${keepsVertices ? " kept" : ""}`;
        assertSamePicture(name, await draw(page, "directional", "scene"), expected, { mean: 0.06, offShare: 0.001 });
      }
    }
  });
});

soakTest("a texture is applied to a surface with the right orientation", async () => {
  mkdirSync(outputDirectory, { recursive: true });
  const quad = join(outputDirectory, "textured.ply");
  const corners = [
    [-3, -3],
    [3, -3],
    [3, 3],
    [-3, 3],
  ].map(([x, y]) => `${x} ${y} 0 0 0 1 ${(x! + 3) / 6} ${(y! + 3) / 6}`);
  const properties = ["x", "y", "z", "nx", "ny", "nz", "s", "t"].map((name) => `property float ${name}\n`).join("");
  writeFileSync(
    quad,
    `ply\nformat ascii 1.0\nelement vertex 4\n${properties}element face 2\nproperty list uchar int vertex_indices\nend_header\n${corners.join("\n")}\n3 0 1 2\n3 0 2 3\n`,
  );
  // The texture is red on the left and blue on the right.
  const picture = encodePng({ width: 2, height: 1, channels: 3, data: Uint8Array.from([230, 20, 20, 20, 20, 230]) });
  const nearest = '<TextureProperties magnificationFilter="NEAREST_PIXEL" minificationFilter="NEAREST_PIXEL"/>';
  const textured = (xml: Buffer): string =>
    xml
      .toString()
      .replace(
        /<Appearance[\s\S]*?<\/Appearance>/,
        `<Appearance><Material diffuseColor="1 1 1"/><ImageTexture url="two.png">${nearest}</ImageTexture></Appearance>`,
      );
  for (const options of [
    ["--profile", "classic"],
    ["--profile", "compact"],
    ["--container", "bg"],
  ]) {
    await withApp(siteOf(quad, ...options), {}, async ({ page, server }) => {
      server.put("/two.png", picture);
      server.when(/^\/scene\.x3d$/, { replace: textured });
      await page.evaluate(() => window.app.load());
      const seen = await draw(page, "directional", "scene");
      const colored = (channel: 0 | 2, left: number, right: number): number => {
        let count = 0;
        for (let y = 0; y < seen.height; ++y) {
          for (let x = left; x < right; ++x) {
            const at = (y * seen.width + x) * seen.channels;
            if (seen.data[at + channel]! > 3 * seen.data[at + 2 - channel]!) count += 1;
          }
        }
        return count;
      };
      const middle = seen.width / 2;
      const [red, blue] = [colored(0, 0, seen.width), colored(2, 0, seen.width)];
      assert.ok(red > 5000 && blue > 5000, `${red} red pixels and ${blue} blue ones`);
      assert.ok(
        colored(0, 0, middle) > 0.8 * red && colored(2, middle, seen.width) > 0.8 * blue,
        "the picture is the other way round",
      );
    });
  }
});

soakTest("textures with alpha have the same picture where the browser's bitmaps lose colours", async () => {
  const site = alphaPage("loader-alpha");
  const [scene] = /<X3D[\s\S]*<\/X3D>/i.exec(pageOf(site)) ?? [];
  assert.ok(scene);
  const pictureWith = async (...changes: readonly (() => void)[]): Promise<Picture> => {
    let picture: Picture | undefined;
    const before = { content: changes.map((change) => `(${change.toString()})();`).join("\n") };
    await withApp(site, { before }, async ({ page, server }) => {
      server.put("/scene.x3d", scene);
      await page.evaluate(() => window.app.load());
      picture = await draw(page, "directional", "scene");
    });
    assert.ok(picture);
    return picture;
  };
  const expected = await pictureWith();
  assert.ok(difference(await pictureWith(loseColors), expected).mean > 2, "the browser loses colours");
  assertSamePicture("loader alpha", await pictureWith(loseColors, hideDecoder), expected, { mean: 0 });
});

const classic = (): string => siteOfGenerated("trefoil", "--profile", "classic");
const filesOf = (site: string): string[] =>
  [...ranksOfFiles(pageOf(site)).keys()].map((url) => url.replace(/.*\//, ""));
const isGeometry = (path: string): boolean => path.startsWith("/geometry/");

describe("the loader keeps three's conventions", () => {
  test("its manager gets the document and every file as an item, once each, and the end", async () => {
    const site = classic();
    await withApp(site, {}, async ({ page }) => {
      for (const document of ["scene.x3d", "index.html"]) {
        const lines = await page.evaluate((name) => window.app.log(name), document);
        for (const item of [document, ...filesOf(site)]) {
          assert.deepEqual(
            lines.filter((line) => line.endsWith(` ${item}`)),
            [`start ${item}`, `end ${item}`],
          );
        }
        assert.ok(lines.indexOf("onLoad") < lines.indexOf("complete"));
        assert.ok(lines.indexOf("onLoad") < lines.indexOf("manager.onLoad"));
        assert.ok(lines.includes("progress"));
        assert.equal(lines.filter((line) => line === "manager.onLoad").length, 1);
        assert.ok(!lines.some((line) => line.startsWith("error") || line.startsWith("onError")));
      }
    });
  });

  test("a missing or malformed document is an error that names it", async () => {
    // Chromium's page about malformed XML has inline styles.
    const expectedErrors = /404|inline style|localhost|ERR_FAILED/;
    await withApp(classic(), { expectedErrors }, async ({ page, server }) => {
      server.put("/none.html", "<p>nothing here");
      server.put("/broken.x3d", "<X3D><Scene></X3D>");
      for (const [url, message] of [
        ["absent.x3d", /absent\.x3d: the server answered 404/],
        ["none.html", /none\.html has no X3D/],
        ["broken.x3d", /broken\.x3d is not well-formed/],
      ] as const) {
        const lines = await page.evaluate((name) => window.app.log(name), url);
        assert.match(lines.find((line) => line.startsWith("onError")) ?? "", message);
        assert.deepEqual(
          lines.filter((line) => line.endsWith(` ${url}`) && !line.startsWith("onError")),
          [`start ${url}`, `error ${url}`, `end ${url}`],
        );
      }
      // Browsers say nothing of an answer without a CORS header but that there is none.
      const foreign = server.origin.replace("127.0.0.1", "localhost") + "scene.x3d";
      const refused = await page.evaluate(
        (url) =>
          window.app.loader
            .setPath("")
            .loadAsync(url)
            .then(() => "there", String),
        foreign,
      );
      assert.ok(refused.includes(`${foreign}: Failed to fetch; another origin must allow it`), refused);
      // A missing worker is an error as well.
      const withoutWorker = await page.evaluate(() =>
        window.app.loader
          .setWorkerUrl("/nowhere.js")
          .setKeepVertices(true)
          .loadAsync("scene.x3d")
          .then(
            () => "there",
            (error: unknown) => String(error),
          ),
      );
      assert.match(withoutWorker, /cannot be loaded from http:.*\/nowhere\.js .*setWorkerUrl/);
    });
  });

  test("a failed file is the manager's error, and the rest of the scene loads; without any file loading fails", async () => {
    const site = classic();
    const [, index] = filesOf(site);
    await withApp(site, { expectedErrors: /404/ }, async ({ page, server }) => {
      const restore = server.when((path) => path.endsWith(index!), { status: 404 });
      const partly = await page.evaluate(() => window.app.log("scene.x3d"));
      assert.deepEqual(
        partly.filter((line) => line.startsWith("error")),
        [`error ${index!}`],
      );
      assert.ok(partly.includes("onLoad") && partly.includes("complete"));
      restore();
      server.when(isGeometry, { status: 404 });
      const none = await page.evaluate(() => window.app.log("scene.x3d"));
      assert.match(none.find((line) => line.startsWith("onError")) ?? "", /404/);
      assert.ok(!none.includes("onLoad"));
    });
  });

  test("an abort ends requests and the promise, and loaded objects stay", async () => {
    const { closed, open } = gate();
    await withApp(classic(), {}, async ({ page, server, observed }) => {
      const [first, ...later] = filesOf(classic());
      server.when(isGeometry, { hold: closed });
      const log = page.evaluate(() => window.app.log("scene.x3d"));
      await until("files are requested", () => server.requestsOf(/^\/geometry\//).length > 0);
      await page.evaluate(() => {
        window.app.abort();
      });
      const nothing = await log;
      assert.match(nothing.find((line) => line.startsWith("onError")) ?? "", /AbortError/);
      assert.equal(nothing.at(-1), "manager.onLoad"); // every item has ended
      await until("requests end", () => server.requestsOf(/^\/geometry\//).every(({ state }) => state === "aborted"));
      assert.equal((await observed()).live.bitmaps, 0);

      const pass = server.when((path) => path.endsWith(first!), {});
      const partial = page.evaluate(() => {
        const { loader } = window.app;
        return loader.loadAsync("scene.x3d").then(async (scene) => {
          const complete = scene.complete.then(
            () => "resolved",
            (error: unknown) => (error as Error).name,
          );
          loader.abort();
          const shown: string[] = [];
          scene.traverse(({ type }) => {
            if (type !== "Group") shown.push(type);
          });
          return { complete: await complete, shown };
        });
      });
      assert.deepEqual(await partial, { complete: "AbortError", shown: ["Points"] });
      for (const file of later) {
        await until(`the request of ${file} is aborted`, () =>
          server.requestsOf(new RegExp(file)).every(({ state }) => state === "aborted"),
        );
      }
      pass();
      open();
    });
  });

  soakTest("dispose frees all resources", async () => {
    for (const site of [classic(), siteOfGenerated("trefoil", "--profile", "compact")]) {
      await withApp(site, {}, async ({ page, observed }) => {
        await draw(page, "directional", "nothing");
        const left = [];
        for (let round = 0; round < 3; ++round) {
          await page.evaluate(() => window.app.load());
          await draw(page, "directional", "scene");
          await page.evaluate(() => window.app.pick(320, 200));
          const held = (await observed()).live;
          await page.evaluate(() => {
            window.app.dispose();
          });
          // The app creates its floor and its shadow map again each time; the scene must leave nothing else.
          const { live } = await observed();
          assert.ok(live.textures + live.buffers < held.textures + held.buffers);
          left.push({ textures: live.textures, buffers: live.buffers, bitmaps: live.bitmaps });
        }
        const before = (await observed()).live;
        await draw(page, "directional", "nothing");
        const { live } = await observed();
        const app = { textures: live.textures - before.textures, buffers: live.buffers - before.buffers };
        assert.equal(left[2]!.textures - left[1]!.textures, app.textures);
        assert.equal(left[2]!.buffers - left[1]!.buffers, app.buffers);
        assert.equal(live.bitmaps, 0);
      });
    }
  });

  test("the app can use materials, shadows, names and the box", async () => {
    await withApp(classic(), {}, async ({ page }) => {
      const { size, sizeOfObjects, ...found } = await page.evaluate(() => window.app.inspect());
      assert.deepEqual(found, { meshes: 1, toon: true, casting: true, byName: true, lights: false });
      assert.ok((size as number[]).every((edge) => edge > 2 && edge < 7));
      (size as number[]).forEach((edge, axis) => {
        assert.ok(Math.abs(edge - (sizeOfObjects as number[])[axis]!) < 1e-3);
      });
    });
  });

  soakTest("the GPU picks the object at a pixel, and Raycaster finds the same where vertices are kept", async () => {
    for (const [options, keeps] of [
      [["--profile", "classic"], true],
      [["--profile", "compact"], false],
      ...(isSoak
        ? ([
            [["--profile", "classic"], false],
            [["--container", "bg"], false],
          ] as const)
        : []),
    ] as const) {
      await withApp(siteOfGenerated("trefoil", ...options), {}, async ({ page }) => {
        await page.evaluate((keep) => window.app.loader.setKeepVertices(keep), keeps);
        await page.evaluate(() => window.app.load());
        const before = await draw(page, "directional", "scene");
        const hasVertices = keeps || !options.includes("classic" as never);
        let [hits, sameTriangles] = [0, 0];
        for (const [x, y] of [
          [320, 150],
          [250, 200],
          [400, 220],
          [330, 260],
          [5, 5],
          [635, 475],
        ] as const) {
          const { gpu, ray } = await page.evaluate(([x, y]) => window.app.pick(x, y), [x, y] as const);
          if (gpu === undefined) {
            assert.equal(ray, undefined);
            continue;
          }
          hits += 1;
          assert.equal(gpu.name, "trefoil");
          if (!hasVertices) {
            assert.equal(ray, undefined);
            continue;
          }
          assert.equal(ray?.name, gpu.name);
          if (ray.triangle === gpu.triangle) sameTriangles += 1;
          assert.ok(Math.hypot(...gpu.point.map((part, axis) => part - ray.point[axis]!)) < 1e-2);
        }
        assert.ok(hits >= 2 && hits < 6, `${hits} hits`);
        // GPUs round vertices to a fraction of a pixel: at an edge the neighbour may be hit.
        if (hasVertices) assert.ok(sameTriangles >= hits - 1, `${sameTriangles} of ${hits} triangles are the ray's`);
        // The state of the app's renderer has not changed.
        assert.equal(difference(before, await draw(page, "directional", "scene")).largest, 0);
      });
    }
  });
});

test("documents of Inlines load with the scene, and levels of a LOD when cameras need them", async () => {
  const site = siteOfGenerated("trefoil", "--profile", "compact");
  const unlit = (name: string, color: string): string =>
    `<Shape DEF="${name}"><Appearance><UnlitMaterial emissiveColor="${color}"/><ImageTexture url="two.png"/></Appearance><Box/></Shape>`;
  const x3d = (...nodes: string[]): string => `<X3D><Scene>${nodes.join("")}</Scene></X3D>`;
  const { closed, open } = gate();
  const server = (server: View["server"]): void => {
    server.put(
      "/world.x3d",
      x3d(
        `<Transform translation="0 3 0"><Inline DEF="part" url='"lost.x3d" "parts/part.x3d"'/></Transform>`,
        '<Inline url="gone.x3d"/><Inline url="world.x3d"/>',
        `<LOD DEF="levels" range="12"><Inline DEF="near" url="model.x3d"/>${unlit("far", "1 1 1")}</LOD>`,
      ),
    );
    server.put("/parts/part.x3d", x3d('<Inline url="part.x3d"/>', unlit("cube", "1 1 1")));
    server.put("/model.x3d", readFileSync(join(site, "scene.x3d")));
    for (const path of ["/two.png", "/parts/two.png"]) {
      server.put(
        path,
        encodePng({
          width: 1,
          height: 1,
          channels: 3,
          data: Uint8Array.from(path === "/two.png" ? [10, 10, 240] : [10, 240, 10]),
        }),
      );
    }
    server.when(/^\/model\.x3d$/, { hold: closed });
  };
  await withApp(site, { server, expectedErrors: /404/ }, async ({ page, server }) => {
    const lines = await page.evaluate(() => window.app.log("world.x3d"));
    for (const item of ["part.x3d", "lost.x3d", "gone.x3d"]) {
      const isLost = item !== "part.x3d";
      assert.deepEqual(
        lines.filter((line) => line.endsWith(` ${item}`)),
        [`start ${item}`, ...(isLost ? [`error ${item}`] : []), `end ${item}`],
      );
    }
    assert.deepEqual(
      lines.filter((line) => line.endsWith(" world.x3d")),
      ["start world.x3d", "end world.x3d"],
    );
    assert.equal(lines[lines.indexOf("onLoad") + 1], "showing cube, far");
    assert.equal(lines.filter((line) => line === "manager.onLoad").length, 1);
    assert.ok(!lines.some((line) => line.startsWith("onError")));
    assert.deepEqual(await page.evaluate(() => window.app.names()), {
      part: "Group",
      cube: "Group",
      levels: "LOD",
      near: "Group",
      far: "Group",
    });
    assert.equal(server.requestsOf(/two\.png$/).length, 2);
    assert.equal(server.requestsOf(/^\/(model\.x3d|geometry)/).length, 0);

    // Far away the last level is displayed; near as well, until all of the first level displays something.
    const drawFrom = (z: number): Promise<number> => page.evaluate((z) => window.app.drawFrom([0, 0, z]), z);
    const seen = async (): Promise<Picture> => decodePng(await page.screenshot());
    assert.equal(await drawFrom(15), 1);
    assert.deepEqual(await page.evaluate(() => window.app.pick(320, 240).ray?.name), "far");
    assert.equal(colorAt(await seen(), 320, 240), "blue");
    assert.equal(await drawFrom(9), 1);
    await until("the level is requested", () => server.requestsOf(/^\/model\.x3d$/).length === 1);
    assert.equal(await drawFrom(9), 1);
    open();
    await until(
      "the level is there",
      async () => (await drawFrom(9)) === 0 && (await page.evaluate(() => window.app.isSettled())),
    );
    const found = await page.evaluate(() => [window.app.pick(320, 300), window.app.pick(300, 50)]);
    assert.deepEqual(
      found.map(({ gpu, ray }) => [gpu?.name, ray?.name]),
      [
        ["trefoil", "trefoil"],
        ["cube", "cube"],
      ],
    );
    assert.equal(colorAt(await seen(), 300, 50), "green");

    // A loaded level is displayed in the first frame that needs it.
    const requestCount = server.requestsOf(/./).length;
    assert.equal(await drawFrom(15), 1);
    assert.equal(await drawFrom(9), 0);
    assert.equal(server.requestsOf(/./).length, requestCount);
  });
});

/** The dominant channel, which is the same with any tone mapping. */
function colorAt({ data, width, channels }: Picture, x: number, y: number): string {
  const at = (y * width + x) * channels;
  const pixel = Array.from(data.subarray(at, at + 3));
  const strong = pixel.flatMap((value, channel) => (value > 150 ? [channel] : []));
  return strong.length === 1 ? ["red", "green", "blue"][strong[0]!]! : pixel.join(" ");
}
