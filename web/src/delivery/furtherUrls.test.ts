import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { geometryOf, indices, record, records, siteOf } from "./delivery.testing.ts";
import type { Answer } from "./delivery.testing.ts";

const image = (field: string, ...urls: string[]) =>
  `<ImageTexture containerField="${field}" url='${urls.map((url) => `"${url}"`).join(" ")}'/>`;

const webPage = new TextEncoder().encode("<!DOCTYPE html>");

/** Loads a geometry of classic whose coordinates have these URLs. */
async function loaded(decode: string, urls: string[], files: Record<string, Answer>) {
  const site = siteOf({ "i.png": indices, ...files }, 1);
  const { stages, errors, settled } = record(
    geometryOf(`<ImageGeometry recordCount="500" vertexCount="600" implicitMeshSize="256 4" decode="${decode}">
      ${image("coord", ...urls)}${image("index", "i.png")}</ImageGeometry>`),
    site.pool,
  );
  await settled;
  const requested = site.requested.filter((name) => name !== "i.png");
  return { requested, stage: stages.at(-1)?.stage.name, errors: errors.map(({ message }) => message) };
}

for (const decode of ["gpu", "cpu"])
  describe(`the URLs of an image that the ${decode} decodes`, () => {
    test("are requested in order until one leads to an image", async () => {
      const { requested, stage, errors } = await loaded(decode, ["lost.png", "page.png", "a.png", "b.png"], {
        "page.png": webPage,
        "a.png": records,
        "b.png": records,
      });
      assert.deepEqual([requested, stage, errors], [["lost.png", "page.png", "a.png"], "full", []]);
    });

    test("are one error, which names all, where none does", async () => {
      const { stage, errors } = await loaded(decode, ["lost.png", "page.png"], { "page.png": webPage });
      assert.equal(stage, undefined);
      assert.equal(errors.length, 1);
      assert.match(errors[0] ?? "", /^lost\.png: the server answered 404; page\.png: /);
    });
  });

test("the URLs of a typed array are requested in order, also where it holds normals", async () => {
  const site = siteOf({ "c.bin": new Uint8Array(new Uint16Array(3 * 4).buffer) }, 1);
  const { stages, errors, settled } = record(
    geometryOf(`<BinaryGeometry coordType="Uint16" normalAsSphericalCoordinates="true" vertexCount="3"
      coord='"lost.bin#0+8" "c.bin#0+8"'/>`),
    site.pool,
  );
  await settled;
  const full = stages.at(-1)?.stage;
  assert.deepEqual([full?.name, errors, site.requested], ["full", [], ["lost.bin", "c.bin"]]);
  assert.ok(full?.kind === "buffers" && full.attributes.normal);
});
