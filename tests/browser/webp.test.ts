// Tests that a browser reads lossless WebP images of vertex data exactly, on the GPU and in workers, and attributes of
// several images.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, test } from "node:test";
import { crc32 } from "node:zlib";
import { build } from "esbuild";
import { assertSamePicture, boundsOfQuantised } from "./compare.ts";
import { withPage, type View } from "./harness.ts";
import { repository } from "./paths.ts";
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

const vectors = join(repository, "vectors/webp");

interface Verdict {
  readonly width: number;
  readonly crc32?: string;
}

interface PixelDecoder {
  decodePixels(bytes: Uint8Array): Promise<{ data: Uint8Array }>;
}

/** A script that defines `pixelDecoder`, which decodes files to bytes. */
async function decoderScript(): Promise<string> {
  const { outputFiles } = await build({
    stdin: {
      contents: `export { decodePixels } from "./web/src/decode/imagePixels.ts";`,
      resolveDir: repository,
      loader: "ts",
    },
    bundle: true,
    format: "iife",
    globalName: "pixelDecoder",
    write: false,
  });
  return outputFiles[0]!.text;
}

describe("lossless WebP", () => {
  test("has the picture of PNG, read by the shader and in workers, and its files decode to every byte", async () => {
    const options = ["--profile", "classic", "--normals", "spherical", "--normal-bits", "16"];
    const png = siteOfGenerated("trefoil-colors", ...options);
    const webp = siteOfGenerated("trefoil-colors", ...options, "--images", "webp");
    const expected = await pictureOf(png);
    assertSamePicture("png", expected, await referencePicture(pageOf(png), decodeSite(png)), boundsOfQuantised);
    const script = await decoderScript();
    await withPage(webp, {}, async (view) => {
      await view.promise("complete");
      assertSamePicture("webp on the GPU", await view.picture(), expected, { mean: 0 });
      const verdicts = JSON.parse(readFileSync(join(vectors, "verdicts.json"), "utf8")) as Record<string, Verdict>;
      const read = Object.entries(verdicts).filter(([, verdict]) => verdict.crc32 !== undefined);
      assert.equal(read.length, 4);
      await view.page.evaluate(`${script}; globalThis.pixelDecoder = pixelDecoder`);
      for (const [name, { crc32: checksum }] of read) {
        const pixels = await view.page.evaluate(
          async (bytes) => {
            const { pixelDecoder } = globalThis as unknown as { pixelDecoder: PixelDecoder };
            return Array.from((await pixelDecoder.decodePixels(Uint8Array.from(bytes))).data);
          },
          [...readFileSync(join(vectors, name))],
        );
        assert.equal(crc32(Uint8Array.from(pixels)).toString(16).padStart(8, "0"), checksum, name);
      }
    });
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
