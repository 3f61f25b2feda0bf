// Tests many small shapes whose vertices are in one file: it is requested once, and each shape follows its element,
// can be picked, and gets the state and the errors of the file.

import assert from "node:assert/strict";
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import type { ViewElement } from "../../web/src/dom/imgeoView.ts";
import { writeShapes } from "./generators/shapes.ts";
import { pictureSize, settle, until, withPage, type View } from "./harness.ts";
import { outputDirectory } from "./paths.ts";
import { siteOf, variantOf } from "./sites.ts";
import { soakTest } from "./soak.ts";

const side = 12;
const count = side * side;
const distance = 45;
const middle = (3 * (side - 1)) / 2;
const pixelsPerUnit = pictureSize.height / 2 / Math.tan(0.4) / distance;

/** The site with a viewpoint straight above. */
function site(): string {
  mkdirSync(outputDirectory, { recursive: true });
  const file = join(outputDirectory, "many-shapes.obj");
  writeShapes(count, file);
  const viewpoint = `<Viewpoint position="${middle} ${middle} ${distance}" fieldOfView="0.8"></Viewpoint>`;
  return variantOf(siteOf(file, "--profile", "compact"), "above", (page) =>
    page.replace(/<Viewpoint[\s\S]*?<\/Viewpoint>/i, viewpoint).replaceAll(/<Shape DEF="(\w+)"/g, '$& id="$1"'),
  );
}

/** The ids of the shapes that are displayed at the grid positions `numbers`, shifted by `offset` along x. */
async function shapesAt({ page }: View, numbers: readonly number[], offset = 0): Promise<(string | undefined)[]> {
  await settle(page);
  const pixels = numbers.map(
    (n) =>
      [
        pictureSize.width / 2 + (3 * (n % side) + offset - middle) * pixelsPerUnit,
        pictureSize.height / 2 - (3 * Math.floor(n / side) - middle) * pixelsPerUnit,
      ] as const,
  );
  return page.evaluate(
    (at) => at.map(([x, y]) => document.querySelector<ViewElement>("x3d")!.positionAndNormalFromPoint(x, y)?.shape.id),
    pixels,
  );
}

const nameOf = (n: number): string => `shape${n}`;

soakTest("shapes of one file load with one request, and each follows its element", async () => {
  await withPage(site(), {}, async (view) => {
    await view.promise("complete");
    assert.equal(new Set(view.server.requestsOf(/geometry/).map(({ path }) => path)).size, 1);
    const progressText = view.page.evaluate(() =>
      document
        .querySelector("imgeo-view")!
        .shadowRoot!.querySelector("[role=progressbar]")!
        .getAttribute("aria-valuetext"),
    );
    assert.equal(await progressText, "100 %, all details are shown");
    const all = Array.from({ length: count }, (_, n) => n);
    assert.deepEqual(await shapesAt(view, all), all.map(nameOf));
    await view.page.evaluate(() => {
      document.querySelector("#shape30")!.setAttribute("visible", "false");
      document.querySelector("#shape31")!.remove();
      const moved = document.querySelector("#shape70")!;
      const transform = document.createElement("Transform");
      transform.setAttribute("translation", "1.5 0 0");
      moved.replaceWith(transform);
      transform.append(moved);
    });
    assert.deepEqual(await shapesAt(view, [30, 31, 32]), [undefined, undefined, "shape32"]);
    await until("the shape has moved", async () => (await shapesAt(view, [70], 1.5))[0] === "shape70");
    const states = await view.page.evaluate(() =>
      Array.from(
        (document.querySelector("#shape100") as unknown as { resources: Iterable<{ state: string }> }).resources,
        ({ state }) => state,
      ),
    );
    assert.deepEqual(states, ["ready"]);
  });
});

test("a file that is missing is an error of each shape that shares it", async () => {
  const server = (server: View["server"]): void => {
    server.when(/geometry/, { status: 404 });
  };
  await withPage(site(), { server, expectedErrors: /Failed to load resource|imgeo/ }, async (view) => {
    await until("all have got an error", async () => (await view.events("error", "x3d")).length === count);
    for (const name of ["shape0", "shape99"])
      assert.equal((await view.events("error", `shape#${name}`)).length, 1, name);
  });
});
