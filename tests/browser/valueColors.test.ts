// Compares shapes coloured by vertex attributes with plain buffers that have the colours of the values.

import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { assertSamePicture, boundsOfInput, difference, isWithin } from "./compare.ts";
import { until, withPage, type View } from "./harness.ts";
import { trefoil, withNumbers } from "./meshes.ts";
import type { Picture } from "./png.ts";
import { patchOfInput, referencePicture } from "./reference.ts";
import { gate } from "./server.ts";
import { pageOf, siteOfGenerated } from "./sites.ts";
import { soakTest } from "./soak.ts";

type Color = [number, number, number];
type Server = (server: View["server"]) => void;

const mesh = withNumbers(trefoil());
const { height, away_0: x, away_1: y, away_2: z } = mesh.numbers as Record<string, Float32Array>;
const away = Float32Array.from(x!, (_, i) => Math.hypot(x![i]!, y![i]!, z![i]!));

const siteKeepingAll = (...options: string[]): string =>
  siteOfGenerated("trefoil-numbers", "--keep-attributes", "all", ...options);
const withFields =
  (fields: string): Server =>
  (server) =>
    void server.when(/^\/$/, { replace: (html) => html.toString().replace("<Shape ", `<Shape ${fields} `) });

/** Plain buffers whose vertex colours are interpolated between those of the values `min` and `max`. */
async function expectedPicture(
  site: string,
  values: Float32Array,
  [min, max]: [number, number],
  [from, to]: [Color, Color],
): Promise<Picture> {
  const colors = Float32Array.from({ length: 3 * values.length }, (_, i) => {
    const share = Math.min(1, Math.max(0, (values[Math.floor(i / 3)]! - min) / (max - min)));
    return from[i % 3]! + (to[i % 3]! - from[i % 3]!) * share;
  });
  return await referencePicture(pageOf(site), [{ ...patchOfInput(mesh), colors }]);
}

const spread: [number, number] = [Math.min(...height!), Math.max(...height!)];
/** As 8 bits store them: these steps alone take the difference from the input's picture beyond its bound. */
const heightOf8Bits = height!.map((value) => {
  const step = (spread[1] - spread[0]) / 255;
  return spread[0] + Math.round((value - spread[0]) / step) * step;
});
const black: Color = [0, 0, 0];
const white: Color = [1, 1, 1];
const ends: [Color, Color] = [
  [0.1, 0.2, 0.9],
  [1, 0.6, 0],
];
const colorMap = `colorMap="${ends.join(", ").replaceAll(",", " ")}"`;

describe("a shape coloured by an attribute", () => {
  const cases: [what: string, options: string[], fields?: string][] = [
    ["stored in patches of compact", ["--patch-vertices", "1000", "--normal-bits", "10"]],
    ["stored in two byte planes", ["--profile", "classic"]],
    [
      "stored in one byte plane, in many patches of strips",
      ["--attribute-bits", "8", "--patch-vertices", "1000", "--primitives", "strips"],
    ],
    ["stored in three byte planes, without an index", ["--attribute-bits", "24", "--index", "off"]],
    ["stored in three byte planes, decoded in workers", ["--profile", "classic", "--attribute-bits", "24"], "cpu"],
    ["stored in arrays", ["--container", "bg"]],
  ];
  for (const [what, options, decode] of cases) {
    (what === "stored in patches of compact" ? test : soakTest)(`${what} has the colours of its values`, async () => {
      const site = siteKeepingAll(...options);
      const values = options.join(" ").includes("--attribute-bits 8") ? heightOf8Bits : height!;
      const expected = await expectedPicture(site, values, spread, ends);
      const server: Server = (server) =>
        void server.when(/^\/$/, {
          replace: (html) =>
            html
              .toString()
              .replace("<Shape ", `<Shape colorBy="height" ${colorMap} `)
              .replaceAll("<ImageGeometry", decode ? `$& decode="${decode}"` : "$&"),
        });
      await withPage(site, { server }, async (view) => {
        await view.promise("complete");
        assertSamePicture(`values ${what}`, await view.picture(), expected, boundsOfInput);
      });
    });
  }

  soakTest(
    "of three components has the colours of its length, and follows changes of the document at once",
    async () => {
      const site = siteKeepingAll("--attribute-bits", "24", "--normal-bits", "10");
      await withPage(
        site,
        { server: withFields(`colorBy="away" colorMap="gray" colorRange="0.5 4"`) },
        async (view) => {
          await view.promise("complete");
          const first = await view.picture();
          assertSamePicture(
            "values length",
            first,
            await expectedPicture(site, away, [0.5, 4], [black, white]),
            boundsOfInput,
          );
          const requestCount = view.requestedPaths.length;
          await view.page.evaluate(() => {
            const shape = document.querySelector("shape")!;
            shape.setAttribute("colorMap", "1 1 1 0 0 0");
            shape.setAttribute("colorRange", "0 5");
          });
          const second = await view.picture();
          assertSamePicture(
            "values changed",
            second,
            await expectedPicture(site, away, [0, 5], [white, black]),
            boundsOfInput,
          );
          assert.equal(view.requestedPaths.length, requestCount, "files were requested again");
          assert.ok(!isWithin(difference(first, second), boundsOfInput));
          await view.page.evaluate(() => {
            document.querySelector("shape")!.setAttribute("colorBy", "height");
          });
          await view.page.evaluate(() => {
            document.querySelector("shape")!.removeAttribute("colorRange");
          });
          await view.page.waitForFunction(
            () =>
              (document.querySelector("imgeo-view") as unknown as { statistics: { openRequests: number } }).statistics
                .openRequests === 0,
          );
          await view.promise("complete", "shape");
          assertSamePicture(
            "values of another attribute",
            await view.picture(),
            await expectedPicture(site, height!, spread, [white, black]),
            boundsOfInput,
          );
        },
      );
    },
  );

  test("requests the module for values before the runtime has arrived", async () => {
    const { closed, open } = gate();
    const server: Server = (server) => {
      withFields(`colorBy="height" colorMap="gray"`)(server);
      server.when(/imgeo-scene-/, { hold: closed });
    };
    await withPage(siteKeepingAll("--normal-bits", "10"), { server }, async (view) => {
      await until("the module is requested", () => view.server.requestsOf(/imgeo-values-/).length > 0);
      open();
      await view.promise("complete");
      assert.equal(view.server.requestsOf(/imgeo-values-/).length, 1);
    });
  });

  soakTest(
    "from a change of the document on has its colours, also when the module for values fails at first",
    async () => {
      const site = siteKeepingAll("--normal-bits", "10");
      await withPage(site, { expectedErrors: /503|could not be loaded/ }, async (view) => {
        await view.promise("complete");
        assert.equal(view.server.requestsOf(/imgeo-values-/).length, 0);
        const allow = view.server.when(/imgeo-values-/, { status: 503 });
        const setField = (name: string, value: string): Promise<void> =>
          view.page.evaluate(
            ([field, text]) => {
              document.querySelector("shape")!.setAttribute(field!, text!);
            },
            [name, value],
          );
        const failure = view.page.waitForEvent("console", (message) =>
          message.text().includes("the module of a part of the runtime could not be loaded"),
        );
        await setField("colorBy", "height");
        const isComplete = await view.page.evaluate(() => {
          const pending = new Promise((resolve) => setTimeout(resolve, 100, false));
          const complete = (document.querySelector("x3d") as unknown as { complete: Promise<unknown> }).complete;
          return Promise.race([complete.then(() => true), pending]);
        });
        assert.ok(!isComplete, "the scene is complete before its module has been loaded");
        await failure;
        allow();
        await setField("colorMap", "gray");
        await until(
          "the module is requested again, after three attempts",
          () => view.server.requestsOf(/imgeo-values-/).length === 4,
        );
        await view.promise("complete");
        const expected = await expectedPicture(site, height!, spread, [black, white]);
        assertSamePicture("values of a change", await view.picture(), expected, boundsOfInput);
      });
    },
  );

  soakTest("without colorBy has the picture of a shape without attributes, which are not requested", async () => {
    const pictures: Picture[] = [];
    for (const site of [
      siteKeepingAll("--profile", "classic"),
      siteOfGenerated("trefoil-numbers", "--profile", "classic"),
    ]) {
      await withPage(site, {}, async (view) => {
        await view.promise("complete");
        pictures.push(await view.picture());
        const files = /attrib='([^']*)'/.exec(pageOf(site))?.[1] ?? "";
        for (const url of view.requestedPaths) assert.ok(!files.includes(url) || url === "", `${url} was requested`);
      });
    }
    assertSamePicture("values unused", pictures[0]!, pictures[1]!, { mean: 0, offShare: 0 });
  });
});
