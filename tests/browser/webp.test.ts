// Tests that lossless WebP images of vertex data are read exactly, on the GPU and in workers, and attributes of several
// images.

import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { assertSamePicture, boundsOfQuantised } from "./compare.ts";
import { withPage, type View } from "./harness.ts";
import type { Picture } from "./png.ts";
import { referencePicture } from "./reference.ts";
import { decodeSite } from "./siteDecoder.ts";
import { pageOf, siteOfGenerated } from "./sites.ts";
import { soakTest } from "./soak.ts";

const onCpu = (server: View["server"]): void =>
  void server.when(/^\/$/, { replace: (html) => html.toString().replaceAll(/<ImageGeometry/gi, `$& decode="cpu"`) });

async function pictureOf(site: string, server?: (server: View["server"]) => void): Promise<Picture> {
  let picture: Picture | undefined;
  await withPage(site, server ? { server } : {}, async (view) => {
    await view.promise("complete");
    picture = await view.picture();
  });
  assert.ok(picture);
  return picture;
}

describe("lossless WebP", () => {
  test("has the picture of PNG, read by the shader and in workers", async () => {
    const options = ["--profile", "classic", "--normals", "spherical", "--normal-bits", "16"];
    const png = siteOfGenerated("trefoil-colors", ...options);
    const webp = siteOfGenerated("trefoil-colors", ...options, "--images", "webp");
    const expected = await pictureOf(png);
    assertSamePicture("png", expected, await referencePicture(pageOf(png), decodeSite(png)), boundsOfQuantised);
    assertSamePicture("webp on the GPU", await pictureOf(webp), expected, { mean: 0 });
    assertSamePicture("webp in workers", await pictureOf(webp, onCpu), expected, { mean: 0.0005 });
  });

  soakTest("holds normals and colours of several images, which workers read", async () => {
    const options = ["--profile", "classic", "--normal-bits", "16", "--color-bits", "24"];
    const png = siteOfGenerated("trefoil-colors", ...options);
    const webp = siteOfGenerated("trefoil-colors", ...options, "--images", "webp");
    const reference = await referencePicture(pageOf(png), decodeSite(png));
    assertSamePicture("several images", await pictureOf(webp), reference, boundsOfQuantised);
  });
});
