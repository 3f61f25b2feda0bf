// Compares Text nodes with the browser's own rendering of the same text in the same font, size and position.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, test } from "node:test";
import type { Page } from "playwright-core";
import { assertSamePicture, difference } from "./compare.ts";
import { largePictureSize, withPage } from "./harness.ts";
import { decodePng, type Picture } from "./png.ts";
import { repository } from "./paths.ts";
import { sceneOf } from "./scenes.ts";
import type { TestServer } from "./server.ts";
import { siteOfGenerated } from "./sites.ts";

const pixelsPerUnit = largePictureSize.height / 2 / Math.tan(0.7854 / 2) / 10;

interface Line {
  text: string;
  /** Left end of the baseline, and font size, in scene units. */
  x: number;
  y: number;
  size: number;
  font: string;
  color: string;
}

/** The picture of these lines drawn into a 2D canvas. */
async function canvasPicture(page: Page, lines: readonly Line[]): Promise<Picture> {
  const png = await page.evaluate(
    async ({ lines, pixelsPerUnit, width, height }) => {
      const canvas = document.createElement("canvas");
      [canvas.width, canvas.height] = [width, height];
      const context = canvas.getContext("2d")!;
      context.textRendering = "geometricPrecision";
      context.fillRect(0, 0, width, height);
      context.fillStyle = "rgb(51 0 51)";
      context.fillRect(width / 2 + pixelsPerUnit, height / 2 + pixelsPerUnit, 4 * pixelsPerUnit, 2 * pixelsPerUnit);
      context.fillStyle = "rgb(64 192 64)"; // the surface behind a transparent one
      context.fillRect(width / 2 - 5 * pixelsPerUnit, height / 2 + 2 * pixelsPerUnit, 2 * pixelsPerUnit, pixelsPerUnit);
      for (const { text, x, y, size, font, color } of lines) {
        context.font = font.replace("SIZE", `${size * pixelsPerUnit}px`);
        context.fillStyle = color;
        context.fillText(text, width / 2 + x * pixelsPerUnit, height / 2 - y * pixelsPerUnit);
      }
      const blob = await new Promise<Blob | null>((resolve) => {
        canvas.toBlob(resolve);
      });
      return Array.from(new Uint8Array(await blob!.arrayBuffer()));
    },
    { lines, pixelsPerUnit, ...largePictureSize },
  );
  return decodePng(Buffer.from(png));
}

const shape = (id: string, translation: string, string: string, style: string, appearance: string): string =>
  `<Transform translation="${translation}"><Shape id="${id}"><Appearance>${appearance}</Appearance><Text string='${string}'><FontStyle ${style}></FontStyle></Text></Shape></Transform>`;

describe("a text", () => {
  test("looks as in a 2D canvas, small and large, lit and unlit, is transparent between its glyphs, is hit within its lines, and changes with its fields and when its font has loaded", async () => {
    const scene = `<NavigationInfo type='"EXAMINE" "ANY"'></NavigationInfo><Background skyColor="0 0 0"></Background><Viewpoint position="0 0 10" fieldOfView="0.7854"></Viewpoint>
      ${shape("lit", "-5 2.5 0", '"Hall" "of seats"', 'size="1.2" spacing="1.1"', '<Material diffuseColor="1 0.6 0.2" ambientIntensity="0"></Material>')}
      ${shape("bold", "-5 -0.4 0", '"near by"', `family='"SANS"' data-style="BOLD" size="0.6"`, "")}
      ${shape("small", "-5 -1.4 0", '"Seen from afar, and still to be read"', `family='"TYPEWRITER"' size="0.32"`, '<UnlitMaterial emissiveColor="0.5 1 0.5"></UnlitMaterial>')}
      ${shape("large", "0.6 -3 0", '"Qg"', 'size="5" data-style="ITALIC"', '<Material diffuseColor="0.3 0.5 1" ambientIntensity="0"></Material>')}
      <Transform translation="3 -2 -0.001"><Shape id="behind"><Appearance><UnlitMaterial emissiveColor="0.2 0 0.2"></UnlitMaterial></Appearance><Box size="4 2 0.001"></Box></Shape></Transform>
      <Shape><Appearance><UnlitMaterial><PixelTexture containerField="emissiveTexture" image="2 1 4 0xffffff00 0x40c040ff">
        <TextureProperties magnificationFilter="NEAREST_PIXEL" minificationFilter="NEAREST_PIXEL"></TextureProperties></PixelTexture></UnlitMaterial></Appearance>
        <IndexedFaceSet coordIndex="0 1 2 3 -1 4 5 6 7 -1" texCoordIndex="0 0 0 0 -1 1 1 1 1 -1"><TextureCoordinate point="0.25 0.5 0.75 0.5"></TextureCoordinate>
          <Coordinate point="-5 -3 0.01 -3 -3 0.01 -3 -2 0.01 -5 -2 0.01 -5 -3 0 -3 -3 0 -3 -2 0 -5 -2 0"></Coordinate></IndexedFaceSet></Shape>`;
    const lines: Line[] = [
      { text: "Hall", x: -5, y: 2.5, size: 1.2, font: "SIZE serif", color: "rgb(255 153 51)" },
      { text: "of seats", x: -5, y: 2.5 - 1.32, size: 1.2, font: "SIZE serif", color: "rgb(255 153 51)" },
      { text: "near by", x: -5, y: -0.4, size: 0.6, font: "bold SIZE sans-serif", color: "white" },
      {
        text: "Seen from afar, and still to be read",
        x: -5,
        y: -1.4,
        size: 0.32,
        font: "SIZE monospace",
        color: "rgb(128 255 128)",
      },
      { text: "Qg", x: 0.6, y: -3, size: 5, font: "italic SIZE serif", color: "rgb(77 128 255)" },
    ];
    const lateFont = readFileSync(join(repository, "node_modules/x_ite/dist/assets/fonts/Droid/DroidSerif-Bold.woff2"));
    let sendFont = (): void => undefined;
    const prepare = (server: TestServer): void => {
      server.put("/late.woff2", lateFont);
      server.when(/late/, {
        hold: new Promise<void>((resolve) => {
          sendFont = resolve;
        }),
      });
    };
    await withPage(
      sceneOf("text", { grid: siteOfGenerated("sphere-small") }, scene),
      { server: prepare, size: largePictureSize },
      async ({ page, promise, picture }) => {
        await promise("complete");
        const [shown, expected] = [await picture(), await canvasPicture(page, lines)];
        // Both have edges one pixel wide. The mean difference is 0.65, and 10 if glyphs are at other positions.
        assertSamePicture("text", shown, expected, { mean: 1 });
        const hit = (x: number, y: number): Promise<string | undefined> =>
          page.evaluate(
            ([x, y]) =>
              (
                document.querySelector("x3d") as unknown as {
                  positionAndNormalFromPoint: (x: number, y: number) => { shape: Element } | null;
                }
              ).positionAndNormalFromPoint(x!, y!)?.shape.id,
            [largePictureSize.width / 2 + x * pixelsPerUnit, largePictureSize.height / 2 - y * pixelsPerUnit],
          );
        // The empty corner above the "a" of "Hall", beside the text, and through the hole of the Q the surface behind
        // it.
        assert.deepEqual(
          [await hit(-3.9, 3.3), await hit(-1, 3.3), await hit(-4.9, -0.2), await hit(2, 0)],
          ["lit", undefined, "bold", "large"],
        );

        await page.evaluate(() => {
          document.querySelector("#large text")!.setAttribute("string", "");
          document.querySelector("#lit text")!.setAttribute("string", '"Foyer"');
          document.querySelector("#bold fontstyle")!.setAttribute("size", "0.9");
        });
        await Promise.all(["#lit", "#bold"].map((changed) => promise("complete", changed)));
        const changed = lines
          .filter(({ text }) => text !== "Qg" && text !== "of seats")
          .map((line) => ({
            ...line,
            text: line.text === "Hall" ? "Foyer" : line.text,
            size: line.text === "near by" ? 0.9 : line.size,
          }));
        assertSamePicture("text-changed", await picture(), await canvasPicture(page, changed), { mean: 0.6 });

        await page.evaluate(() => {
          document.fonts.add(new FontFace("Late", "url(/late.woff2)"));
          document.querySelector("#bold fontstyle")!.setAttribute("family", '"Late" "SANS"');
          document.querySelector("#bold fontstyle")!.setAttribute("data-style", "PLAIN");
        });
        await promise("complete", "#bold");
        // No picture of this state: Playwright takes none while a font is loading.
        // Listeners added after the scene's run after the scene has requested the new glyphs.
        const fontLoad = await page.evaluateHandle(() => ({
          font: new Promise((resolve) => {
            document.fonts.addEventListener("loadingdone", resolve, { once: true });
          }),
        }));
        sendFont();
        await fontLoad.evaluate(async ({ font }) => {
          await font;
        });
        await promise("complete", "#bold");
        const canvasPictureWith = (font: string): Promise<Picture> =>
          canvasPicture(
            page,
            changed.map((line) => (line.text === "near by" ? { ...line, font } : line)),
          );
        const withFont = await picture();
        assertSamePicture("text-font-loaded", withFont, await canvasPictureWith('SIZE "Late"'), { mean: 0.6 });
        assert.ok(difference(withFont, await canvasPictureWith("SIZE sans-serif")).mean > 0.6);
      },
    );
  });
});
