// Tests operators on geometry: the picture is that of mapped vertices, on the GPU and with vertices that workers
// decode, and no file is requested again.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { operatorsPage } from "../../examples/operators/page.ts";
import { assertSamePicture, boundsOfQuantised, difference, savePicture } from "./compare.ts";
import { shapeOf, sheet } from "./generators/grids.ts";
import { center } from "./gestures.ts";
import { pictureSize, until, withPage, type View } from "./harness.ts";
import { mappedMesh, type Mapping } from "./mappedGrid.ts";
import { encodePng, type Picture } from "./png.ts";
import { patchOfInput, referencePicture, referenceSettingsOf } from "./reference.ts";
import { readPly } from "./meshes.ts";
import { converter, outputDirectory, repository } from "./paths.ts";
import type { PlainPatch } from "./siteDecoder.ts";
import { coveragesOf, recordFrames, startRecording } from "./recordedFrames.ts";
import { firstHit, rayThrough } from "./rays.ts";
import { minus, type Vec3 } from "./vectors.ts";
import { gate } from "./server.ts";
import { pageOf, siteOfGenerated } from "./sites.ts";
import { isSoak, soakTest } from "./soak.ts";

const site = (): string => siteOfGenerated("trefoil", "--profile", "classic");
const example = sheet();

/**
 * Lists of operators; what they do in the sheet's box, which is 2 wide around the origin; whether they mirror; the radius
 * of their blur.
 */
const lists: readonly (readonly [
  operators: string,
  map: Mapping | undefined,
  isMirroring: boolean,
  blurRadius?: number,
])[] = [
  [
    "negate(y)",
    ([x, y, z], [a, b, c]) => [
      [x, -y, z],
      [a, -b, c],
    ],
    true,
  ],
  [
    "scale(0.7 0.9 0.8) swizzle(yxz) translate(0.05 -0.1 0)",
    ([x, y, z], [a, b, c]) => [
      [0.9 * y + 0.1, 0.7 * x - 0.2, 0.8 * z],
      [b / 0.9, a / 0.7, c / 0.8],
    ],
    true,
  ],
  [
    "swizzle(yzx) negate(xy)",
    ([x, y, z], [a, b, c]) => [
      [-y, -z, x],
      [-b, -c, a],
    ],
    false,
  ],
  ["gamma(1.3) solarize(0.8) posterise(200)", undefined, false],
  [
    "blur(3.5) negate(y)",
    ([x, y, z], [a, b, c]) => [
      [x, -y, z],
      [a, -b, c],
    ],
    true,
    3.5,
  ],
];

/** The columns of the sheet as lines, in an index image of two bytes. */
function columnLines(): { image: Buffer; vertexCount: number } {
  const { columns, rows } = example;
  const ends = Array.from({ length: columns * (rows - 1) }, (_, n) => [n, n + columns]).flat();
  const height = Math.ceil(ends.length / 256);
  const data = new Uint8Array(3 * 256 * height);
  ends.forEach((vertex, n) => {
    data.set([vertex & 255, vertex >> 8, 0], 3 * n);
  });
  return { image: encodePng({ width: 256, height, channels: 3, data }), vertexCount: ends.length };
}

function pageWith(attributes: string): string {
  return pageOf(site())
    .replace(/<link rel="preload"[^>]*>/g, "")
    .replace(/<Shape[\s\S]*<\/Shape>/i, () => shapeOf(example, attributes))
    .replace(/<Viewpoint[^>]*>/i, `<Viewpoint position="0.3 0.5 4.2" orientation="-1 0.1 0 0.1" fieldOfView="0.75">`);
}

async function hitAt(view: View, x: number, y: number): Promise<Vec3 | undefined> {
  return view.page.evaluate(
    (pixel) => {
      interface View {
        positionAndNormalFromPoint(x: number, y: number): { position: { x: number; y: number; z: number } } | null;
      }
      const position = (document.querySelector("imgeo-view") as unknown as View).positionAndNormalFromPoint(
        pixel.x,
        pixel.y,
      )?.position;
      return position && ([position.x, position.y, position.z] as const);
    },
    { x: x + 0.5, y: y + 0.5 },
  );
}

soakTest("operators map the vertices of every pass", async () => {
  const pictures: Picture[][] = [];
  for (const decode of isSoak ? ["gpu", "cpu"] : ["gpu"]) {
    const html = pageWith(`decode="${decode}"`);
    const server = (server: View["server"]): void => {
      for (const [path, body] of example.files) server.put(path, body);
      server.put("/lines.png", columnLines().image);
      server.when(/^\/$/, { replace: () => html });
    };
    await withPage(site(), { server }, async (view) => {
      await view.promise("complete");
      const plain = await view.picture();
      // The first operators of a page load the module that reads them.
      const requestCount = (): number =>
        view.server.requests.filter(({ path }) => !path.startsWith("/runtime/")).length;
      const countBefore = requestCount();
      const ofPage: Picture[] = [];
      for (const [operators, map, isMirroring, blurRadius = 0] of lists) {
        await view.page.evaluate((text) => {
          document.querySelector("imagegeometry")!.setAttribute("operators", text);
        }, operators);
        const picture = await view.picture();
        savePicture(`operators ${decode} ${operators}`, picture);
        assert.ok(difference(picture, plain).mean > 0.5, `${operators}: nothing has changed`);
        ofPage.push(picture);
        if (map === undefined) continue;
        const mesh = mappedMesh(example, map, isMirroring, blurRadius);
        if (decode === "gpu")
          assertSamePicture(operators, picture, await referencePicture(html, [mesh]), boundsOfQuantised);
        let hits = 0;
        for (const [dx, dy] of [
          [0, 0],
          [-22, -30],
          [22, 22],
        ] as const) {
          const [x, y] = [center.x + dx, center.y + dy];
          const expected = firstHit(rayThrough(referenceSettingsOf(html).viewpoint, pictureSize, x, y), [mesh]);
          const found = await hitAt(view, x, y);
          if (expected === undefined || found === undefined) continue;
          assert.ok(Math.hypot(...minus(found, expected.position)) < 1e-4, `${operators}: hit at ${found.join(" ")}`);
          ++hits;
        }
        assert.ok(hits > 0, `${operators}: nothing was hit`);
      }
      await view.page.evaluate(() => {
        document.querySelector("imagegeometry")!.removeAttribute("operators");
      });
      assertSamePicture(`without operators again on the ${decode}`, await view.picture(), plain, { mean: 0 });
      assert.equal(requestCount(), countBefore, "files were requested again");

      // Wide lines with a blur, which are instances.
      const drawLines = (operators: string): Promise<Picture> =>
        view.page
          .evaluate(
            ([operators, vertexCount]) => {
              document
                .querySelector("appearance")!
                .insertAdjacentHTML("beforeend", '<LineProperties linewidthScaleFactor="5"></LineProperties>');
              const geometry = document.querySelector("imagegeometry")!;
              for (const name of ["implicitMeshMode", "implicitMeshSize"]) geometry.removeAttribute(name);
              const attributes = { index: "lines.png", indexType: "Uint32", primType: "LINES", vertexCount, operators };
              for (const [name, value] of Object.entries(attributes)) geometry.setAttribute(name, `${value}`);
            },
            [operators, columnLines().vertexCount] as const,
          )
          .then(() => view.promise("complete", "shape"))
          .then(() => view.picture());
      const [sharp, blurredLines] = [await drawLines(""), await drawLines("blur(4)")];
      savePicture(`operators ${decode} blurred lines`, blurredLines);
      assert.ok(difference(sharp, blurredLines).mean > 0.3, "lines are not blurred");
      ofPage.push(sharp, blurredLines);
      pictures.push(ofPage);
    });
  }
  const [inShader, onCpu] = pictures;
  if (onCpu === undefined) return;
  for (const [n, name] of [...lists.map(([operators]) => operators), "lines", "blurred lines"].entries())
    assertSamePicture(`${name} on the cpu`, onCpu[n]!, inShader![n]!, boundsOfQuantised);
});

/** The mesh of a site as the converter maps it. */
function transformedMesh(site: string, operators: string): PlainPatch {
  const path = join(outputDirectory, "transformed.ply");
  execFileSync(converter, ["transform", site, "-o", path, "--operators", operators], { stdio: "ignore" });
  return patchOfInput(readPly(readFileSync(path)));
}

soakTest("normals are those of the converter where slopes of operators multiply to tiny numbers", async () => {
  // Its corners stay, and the slopes at them are about 1e-31 or 9 in each axis.
  const cube = siteOfGenerated("cube", "--profile", "classic");
  await withPage(cube, {}, async (view) => {
    await view.promise("complete");
    for (const operators of ["gamma(9)", "gamma(9 8 7) negate()", "gamma(9) gamma(9) gamma(9) gamma(9)"]) {
      await setOperators(view, operators);
      const expected = await referencePicture(pageOf(cube), [transformedMesh(cube, operators)]);
      assertSamePicture(operators, await view.picture(), expected, boundsOfQuantised);
    }
  });
});

soakTest("the page of `make operators` maps the vertices in sequence and those of a geometry image", async () => {
  const grids = siteOfGenerated("trefoil", "--as", "geometry-image", "--grid", "96");
  const folder = join(repository, "examples/operators");
  const server = (server: View["server"]): void => {
    server.when(/^\/$/, { replace: () => operatorsPage(pageOf(site()), pageOf(grids), "Image operators") });
    for (const name of ["operators.js", "operators.css"]) server.put(`/${name}`, readFileSync(join(folder, name)));
    for (const name of readdirSync(join(grids, "geometry")))
      server.put(`/geometry/${name}`, readFileSync(join(grids, "geometry", name)));
  };
  await withPage(site(), { server, size: { width: 600, height: 400 } }, async (view) => {
    const { page } = view;
    await view.promise("complete");
    const setSlider = (name: string, value: number): Promise<void> =>
      page.locator(`input[name=${name}]`).evaluate((input, value) => {
        (input as HTMLInputElement).value = `${value}`;
        input.dispatchEvent(new Event("input", { bubbles: true }));
      }, value);
    const operators = (): Promise<(string | null)[]> =>
      page.evaluate(() =>
        Array.from(document.querySelectorAll("imagegeometry"), (geometry) => geometry.getAttribute("operators")),
      );
    const sharp = await view.picture();
    await setSlider("gamma", 1.5);
    await page.locator('input[name=negative][value="x"]').evaluate((box) => {
      (box as HTMLInputElement).click();
    });
    assert.deepEqual(await operators(), ["gamma(1.5) negative(x)", "gamma(1.5) negative(x)"]);
    const mapped = await view.picture();
    savePicture("operators page mapped", mapped);
    assert.ok(difference(sharp, mapped).mean > 1, "nothing has changed");
    await page.getByRole("button", { name: "Reset" }).evaluate((button) => {
      (button as HTMLButtonElement).click();
    });
    await until("the list is empty", async () => (await operators()).every((list) => list === ""));

    const requestCount = view.server.requests.length;
    const plain = await view.picture();
    await setSlider("blur", 2);
    const destroyed = await view.picture();
    savePicture("operators page blurred sequence", destroyed);
    assert.match(await page.locator(".note").innerText(), /neighbours are not neighbours on the surface/);
    assert.equal(view.server.requests.length, requestCount, "files were requested again");

    await page.getByLabel("a grid: a geometry image").evaluate((radio) => {
      (radio as HTMLInputElement).click();
    });
    await view.promise("complete", "shape:nth-of-type(2)");
    assert.match(await page.locator(".note").innerText(), /neighbours on the surface: the blur smooths it/);
    const smooth = await view.picture();
    savePicture("operators page blurred grid", smooth);
    await setSlider("blur", 0);
    const grid = await view.picture();
    const [destruction, smoothing] = [difference(plain, destroyed).mean, difference(grid, smooth).mean];
    assert.ok(smoothing > 0.02 && destruction > 5 * smoothing, `${destruction} and ${smoothing}`);
  });
});

async function setOperators({ page }: View, operators: string): Promise<void> {
  await page.evaluate((text) => {
    document.querySelector("imagegeometry")!.setAttribute("operators", text);
  }, operators);
}

/** The numbers of covered pixels that a page has displayed, in their order. */
async function distinctCoverages(view: View): Promise<number[]> {
  return (await coveragesOf(view)).filter((count, frame, counts) => count !== counts[frame - 1]);
}

/** Waits for so many frames that something that has been requested is drawn. */
async function drawFrames({ page }: View): Promise<void> {
  await page.evaluate(async () => {
    for (let frame = 0; frame < 4; ++frame) await new Promise(requestAnimationFrame);
  });
}

test("the first operators are drawn when their module has arrived, and no other picture before", async () => {
  await withPage(site(), { before: recordFrames }, async (view) => {
    await view.promise("complete");
    await view.picture();
    await startRecording(view);
    const { closed, open } = gate();
    view.server.when(/imgeo-operators-/, { hold: closed });
    await setOperators(view, "scale(0.9)");
    await until("the module is requested", () => view.server.requestsOf(/imgeo-operators-/).length > 0);
    await setOperators(view, "negate(x) scale(0.5)");
    await drawFrames(view);
    const before = await distinctCoverages(view);
    assert.equal(before.length, 1, `pixels covered: ${before.join()}`);
    open();
    savePicture("operators later", await view.picture());
    const [plain, mapped, ...others] = await distinctCoverages(view);
    assert.ok(mapped! > 0.15 * plain! && mapped! < 0.35 * plain!, `${mapped} of ${plain} pixels are covered`);
    assert.deepEqual(others, []);
  });
});

test("operators of a document are displayed though a busy server refuses their module twice", async () => {
  let requestCount = 0;
  const server = (server: View["server"]): void => {
    server.when(/^\/(index\.html)?$/, {
      replace: (body) => String(body).replace("<ImageGeometry", '$& operators="scale(0.5)"'),
    });
    server.when((path) => path.includes("imgeo-operators-") && ++requestCount <= 2, { status: 503 });
  };
  await withPage(site(), { server, expectedErrors: /Failed to load resource/ }, async (view) => {
    await view.promise("complete");
    assert.equal(requestCount, 3);
    const mapped = await view.picture();
    await setOperators(view, "");
    assert.ok(difference(mapped, await view.picture()).mean > 1, "they are displayed");
  });
});

soakTest("where the module of operators cannot be loaded, one error says so, and the scene stays", async () => {
  const expectedErrors = /Failed to load resource|imgeo-operators-/;
  await withPage(site(), { before: recordFrames, expectedErrors }, async (view) => {
    await view.promise("complete");
    await view.picture();
    await startRecording(view);
    const allow = view.server.when(/imgeo-operators-/, { status: 503 });
    const messages = (): string[] => view.errors.filter((message) => message.startsWith("imgeo:"));
    for (const count of [1, 2]) {
      await setOperators(view, `scale(0.${count})`);
      await until("it has failed", () => view.server.requestsOf(/imgeo-operators-/).length === 3 * count);
      await until("an error says so", () => messages().length > 0);
      await drawFrames(view);
    }
    assert.equal(messages().length, 1, messages().join("\n"));
    assert.match(messages()[0]!, /the module of a part of the runtime could not be loaded: .*imgeo-operators-/);
    const before = await distinctCoverages(view);
    assert.equal(before.length, 1, `pixels covered: ${before.join()}`);
    allow();
    await setOperators(view, "scale(0.5)");
    await view.picture();
    assert.equal((await distinctCoverages(view)).length, 2);
  });
});
