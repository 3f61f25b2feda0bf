// Tests sequences of wide lines and of large points in a page: each frame is the picture of X3D's own nodes with the
// coordinates of its file.

import assert from "node:assert/strict";
import { assertSamePicture, difference, savePicture } from "./compare.ts";
import { until, withPage } from "./harness.ts";
import { recordStream, type FrameDetail } from "./livePage.ts";
import type { PlainMesh } from "./meshes.ts";
import type { Picture } from "./png.ts";
import { pageOf, siteOfFrames, variantOf } from "./sites.ts";
import { soakTest } from "./soak.ts";

const rate = 6;
const width = 8;
const corners = [
  [-0.9, -0.7],
  [-0.3, 0.8],
  [0, -0.8],
  [0.5, -0.1],
  [0.9, 0.8],
] as const;

/** A zigzag, or its corners, that rises and falls. */
function framesOf(isOfLines: boolean): readonly PlainMesh[] {
  return Array.from({ length: 12 }, (_, frame) => ({
    positions: Float32Array.from(corners.flatMap(([x, y]) => [x, y * Math.cos(frame / 2), 0.3 * Math.sin(frame)])),
    triangles: new Uint32Array(0),
    ...(isOfLines && { lines: Uint32Array.from(corners.slice(1).flatMap((__, i) => [i, i + 1])) }),
  }));
}

const appearance = `<Appearance><Material emissiveColor="1 0.8 0.2"></Material>
<LineProperties linewidthScaleFactor="${width}"></LineProperties>
<PointProperties pointSizeScaleFactor="${width}"></PointProperties></Appearance>`;

/** The page with its mesh written as an IndexedLineSet or a PointSet. */
function staticPage(page: string, { positions, lines }: PlainMesh): string {
  const coordinate = `<Coordinate point="${positions.join(" ")}"></Coordinate>`;
  const geometry = lines
    ? `<IndexedLineSet coordIndex="${corners.map((_, i) => i).join(" ")} -1">${coordinate}</IndexedLineSet>`
    : `<PointSet>${coordinate}</PointSet>`;
  return page.replace(/<ImageGeometry[\s\S]*<\/ImageGeometry>/i, geometry).replace(/<ROUTE[^>]*>\s*<\/ROUTE>/gi, "");
}

for (const [name, isOfLines] of [
  ["wide lines", true],
  ["large points", false],
] as const)
  soakTest(`${name} of a sequence are those of X3D's own nodes, in each frame`, async () => {
    const frames = framesOf(isOfLines);
    const site = siteOfFrames(`sequence-${name.replace(" ", "-")}`, frames, "--rate", String(rate));
    const styled = pageOf(site).replace(/<Appearance[\s\S]*?<\/Appearance>/i, appearance);
    assert.ok(styled.includes(appearance));
    const expected: Picture[] = [];
    for (const frame of [4, 9]) {
      const page = variantOf(site, `static-${frame}`, () => staticPage(styled, frames[frame]!));
      await withPage(page, {}, async (view) => {
        await view.promise("complete");
        expected.push(await view.picture());
      });
    }
    const apart = difference(expected[0]!, expected[1]!).mean;
    assert.ok(apart > 0, "the frames look alike");
    const still = variantOf(site, "still", () => styled.replace(/<x3d/i, '<x3d sequence-time="0"'));
    await withPage(still, { before: recordStream }, async (view) => {
      await view.promise("complete");
      for (const [index, frame] of [4, 9].entries()) {
        await view.page.evaluate(
          (seconds) => {
            document.querySelector("x3d")!.setAttribute("sequence-time", String(seconds));
          },
          (frame + 0.5) / rate,
        );
        await until(`frame ${frame} is displayed`, async () => {
          const shown = await view.page.evaluate(() => (window as unknown as { frames: FrameDetail[] }).frames);
          return shown.at(-1)?.number === frame;
        });
        const picture = await view.picture();
        savePicture(`sequence ${name} ${frame}`, picture);
        assertSamePicture(`sequence ${name} ${frame}`, picture, expected[index]!, {
          mean: apart / 20,
          offShare: 0.0005,
        });
      }
    });
  });
