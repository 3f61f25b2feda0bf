// Tests sequences with stored normals, colours and values in a page: shaders read each frame from images on the GPU, as
// those of SIG classic, and every frame has the colours and values of its file.

import assert from "node:assert/strict";
import { breath, heatRange, rate } from "./breath.ts";
import { assertSamePicture, boundsOfInput, savePicture } from "./compare.ts";
import { until, withPage, type View } from "./harness.ts";
import { gpuCalls, recordStream, type FrameDetail } from "./livePage.ts";
import { areaWeightedNormals, type PlainMesh } from "./meshes.ts";
import { referencePicture } from "./reference.ts";
import type { PlainPatch } from "./siteDecoder.ts";
import { pageOf, siteOfFrames, variantOf } from "./sites.ts";
import { soakTest } from "./soak.ts";

/** Frames with normals, and with colours that change along the sphere and in time. */
const frames: readonly Required<Pick<PlainMesh, "normals" | "colors" | "positions">>[] = breath.map((mesh, number) => ({
  ...mesh,
  normals: areaWeightedNormals(mesh),
  colors: Uint8Array.from(mesh.positions, (_, i) =>
    Math.round(127.5 + 127.5 * Math.sin(2.2 * mesh.positions[i]! + 2.1 * (i % 3) + 0.6 * number)),
  ),
}));

const [cool, warm] = heatRange;

/** A frame as plain buffers; its colours are those of the file, or its heat from black to white. */
function patchOf(number: number, isHeat: boolean): PlainPatch {
  const { positions, normals, colors } = frames[number]!;
  const heat = breath[number]!.numbers!.heat!;
  return {
    positions,
    normals,
    colors: Float32Array.from(colors, (byte, i) =>
      isHeat ? (heat[Math.floor(i / 3)]! - cool) / (warm - cool) : byte / 255,
    ),
    triangles: breath[number]!.triangles,
    lines: new Uint32Array(),
    points: new Uint32Array(),
  };
}

async function seek({ page }: View, number: number): Promise<void> {
  await page.evaluate((seconds) => {
    document.querySelector("x3d")!.setAttribute("sequence-time", String(seconds));
  }, number / rate);
  await until(`frame ${number} is displayed`, async () => {
    const recorded = await page.evaluate(() => (window as unknown as { frames: FrameDetail[] }).frames);
    return recorded.at(-1)?.number === number;
  });
}

soakTest("colours and values of each frame are read from images on the GPU", async () => {
  const options = ["--rate", String(rate), "--keep-attributes", "heat", "--normal-bits", "16"];
  const converted = siteOfFrames("breath-images", frames as readonly PlainMesh[], ...options);
  const site = variantOf(converted, "still", (page) => page.replace(/<x3d/i, '<x3d sequence-time="0"'));
  await withPage(site, { before: recordStream }, async (view) => {
    await view.promise("complete");
    await seek(view, 1);
    const before = await gpuCalls(view);
    const show = async (number: number, isHeat: boolean): Promise<void> => {
      await seek(view, number);
      const name = `sequence images ${number} ${isHeat ? "values" : "colours"}`;
      const picture = await view.picture();
      savePicture(name, picture);
      assertSamePicture(name, picture, await referencePicture(pageOf(site), [patchOf(number, isHeat)]), boundsOfInput);
    };
    for (const number of [17, 4]) await show(number, false);
    const after = await gpuCalls(view);
    assert.equal(after.objects, before.objects, "frames allocate memory on the GPU");
    assert.equal(after.arrays, before.arrays, "frames are arrays");
    assert.ok(after.images > before.images, "frames are no images");
    await view.page.evaluate(() => {
      const shape = document.querySelector("shape")!;
      shape.setAttribute("colorBy", "heat");
      shape.setAttribute("colorMap", "0 0 0, 1 1 1");
    });
    await view.promise("complete");
    for (const number of [9, 21]) await show(number, true);
  });
});
