// Tests that shapes coloured by values, each over a range of its own, and wide lines, each of its own width, are drawn
// in batches, and have the same picture as when each is drawn alone, as in scenes of few shapes.

import assert from "node:assert/strict";
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import type { ViewElement } from "../../web/src/dom/imgeoView.ts";
import { assertSamePicture, boundsOfQuantised, difference, isWithin, savePicture } from "./compare.ts";
import { drawsOfFrame, pictureSize, withPage } from "./harness.ts";
import { writePly } from "./meshes.ts";
import { outputDirectory } from "./paths.ts";
import { sceneOf } from "./scenes.ts";
import { pageOf, shapeIn, siteOf, siteOfGenerated } from "./sites.ts";
import { soakTest } from "./soak.ts";

const away = 10;
/** Half of the visible extents at z = 0, along x and y. */
const [right, top] = [(away * Math.tan(0.4) * pictureSize.width) / pictureSize.height, away * Math.tan(0.4)];
const black = "<Background skyColor='0 0 0'></Background>";
const viewpoint = `<Viewpoint position="0 0 ${away}" fieldOfView="0.8"></Viewpoint>`;

/** A shape's geometry element. */
function geometryOf(shape: string): string {
  return /<ImageGeometry[\s\S]*<\/ImageGeometry>/i.exec(shape)?.[0] ?? assert.fail("the site has no ImageGeometry");
}

const at = (x: number, y: number, inner: string, scale = "1 1 1") =>
  `<Transform translation="${x} ${y} 0" scale="${scale}">${inner}</Transform>`;
const lit = '<Appearance><Material diffuseColor="1 1 1" shininess="0.3"></Material></Appearance>';
const lines = (fields: string, color = "1 1 1", more = "") =>
  `<Appearance><Material emissiveColor="${color}" ${more}></Material><LineProperties ${fields}></LineProperties></Appearance>`;
const strip = (points: string, name = "") =>
  `<IndexedLineSet ${name} coordIndex="0 1 2 -1"><Coordinate point="${points}"></Coordinate></IndexedLineSet>`;

/** Knots coloured by values: three geometries in buffers, and two instances of one in images. */
function knots(buffers: string, images: string): string {
  const knot = (id: string, fields: string, geometry: string, x: number, y: number) =>
    at(x, y, `<Shape id="${id}" colorBy="height" ${fields}>${lit}${geometry}</Shape>`, "0.4 0.4 0.4");
  return (
    knot("warm", 'colorMap="coolwarm"', geometryOf(buffers), -4, 2) +
    knot("narrow", 'colorMap="coolwarm" colorRange="-1 0.5"', geometryOf(buffers), -1.4, 2) +
    knot("turned", 'colorMap="coolwarm" colorRange="4 -2"', geometryOf(buffers), 1.4, 2) +
    knot("first", 'colorMap="gray"', geometryOf(images).replace("<ImageGeometry", '$& DEF="knot"'), 4, 2) +
    knot("second", 'colorMap="gray" colorRange="0 1"', '<ImageGeometry USE="knot"></ImageGeometry>', 4, -1)
  );
}

/** Wide lines in buffers (some dashed, some transparent, one at the picture's border) and in images. */
function wideLines(images: string): string {
  const zigzag = "-1 -0.6 0 0 0.6 0 1 -0.6 0";
  const others =
    at(-4, -0.6, `<Shape id="thick">${lines('linewidthScaleFactor="14"', "1 0.5 0")}${strip(zigzag)}</Shape>`) +
    at(
      -1.4,
      -0.6,
      `<Shape id="slim">${lines('linewidthScaleFactor="5"', "0.2 1 0.4")}${strip(zigzag)}</Shape>`,
      "-1 1.4 1",
    ) +
    at(
      1.4,
      -0.6,
      `<Shape id="dashed">${lines('linewidthScaleFactor="6" linetype="2"', "1 1 0")}${strip(zigzag)}</Shape>`,
    ) +
    at(
      right + 0.03,
      0,
      `<Shape>${lines('linewidthScaleFactor="12"', "0 1 1")}${strip(`0 -2 0 0 0 0 0 ${top} 0`)}</Shape>`,
    );
  const blended =
    at(
      -4,
      -2.6,
      `<Shape>${lines('linewidthScaleFactor="20"', "1 0 0", 'transparency="0.5"')}${strip(zigzag, 'DEF="veil"')}</Shape>`,
    ) +
    at(
      -3.6,
      -2.6,
      `<Shape>${lines('linewidthScaleFactor="10"', "0 0.4 1", 'transparency="0.3"')}<IndexedLineSet USE="veil"></IndexedLineSet></Shape>`,
    );
  const own = geometryOf(images).replace("<ImageGeometry", '$& DEF="strokes"');
  const again = '<ImageGeometry USE="strokes"></ImageGeometry>';
  return (
    others +
    blended +
    [own, again, again]
      .map((geometry, n) =>
        at(
          2 * n - 0.8,
          -2.8,
          `<Shape>${lines(`linewidthScaleFactor="${3 + 4 * n}"`, `1 ${n / 2} 1`)}${geometry}</Shape>`,
          n === 1 ? "-0.8 0.6 1" : "0.8 0.8 1",
        ),
      )
      .join("")
  );
}

/** Shapes behind the camera: with them there are enough shapes for batches. */
const crowd = `<Transform id="crowd" translation="0 0 ${2 * away}">${Array.from({ length: 16 }, (_, n) => at(n, 0, "<Shape><Box size='0.1 0.1 0.1'></Box></Shape>")).join("")}</Transform>`;

function strokesFile(): string {
  mkdirSync(outputDirectory, { recursive: true });
  const path = join(outputDirectory, "strokes.ply");
  const positions = Float32Array.from([-1, -1, 0, -0.5, 1, 0, 0, -1, 0, 0.5, 1, 0, 1, -1, 0]);
  writeFileSync(
    path,
    writePly({ positions, triangles: new Uint32Array(0), lines: Uint32Array.from([0, 1, 1, 2, 2, 3, 3, 4]) }),
  );
  return path;
}

soakTest(
  "shapes coloured by values and wide lines are batched in a scene of many shapes, with the same picture as drawn alone",
  async () => {
    const sites = {
      buffers: siteOfGenerated("trefoil-numbers", "--keep-attributes", "all", "--normal-bits", "10"),
      images: siteOfGenerated(
        "trefoil-numbers",
        "--keep-attributes",
        "all",
        "--profile",
        "classic",
        "--position-bits",
        "8",
      ), // 8 bits: a second byte would not be requested for knots as small as these
      strokes: siteOf(strokesFile(), "--profile", "classic", "--position-bits", "8"),
    };
    const shape = (name: keyof typeof sites) =>
      shapeIn(pageOf(sites[name])).replaceAll(/(["'])geometry\//g, `$1${name}/geometry/`);
    const scene = `<NavigationInfo type='"EXAMINE" "ANY"'></NavigationInfo>${black}${viewpoint}
    ${knots(shape("buffers"), shape("images"))}${wideLines(shape("strokes"))}${crowd}`;
    await withPage(sceneOf("batched-appearances", sites, scene), {}, async (view) => {
      await view.promise("complete");
      const first = await view.picture();
      savePicture("batched-appearances", first);
      // Clear, buffers with values, images with values, lines, dashed lines, transparent lines, lines in images, and
      // mirrored lines in images.
      const maxDraws = 1 + 1 + 2 + 1 + 1 + 1 + 1 + 2;
      assert.ok((await drawsOfFrame(view)) <= maxDraws, `${await drawsOfFrame(view)} draws`);
      await view.page.evaluate(() => {
        const set = (selector: string, name: string, value: string) => {
          document.querySelector(selector)!.setAttribute(name, value);
        };
        set("#warm", "colorRange", "-3 0");
        set("#second", "colorRange", "-1 2");
        set("#narrow", "colorMap", "1 0 0, 0 1 0, 0 0 1");
        set("#thick lineproperties", "linewidthScaleFactor", "9");
        set("#slim lineproperties", "linetype", "3");
      });
      const together = await view.picture();
      savePicture("batched-appearances-changed", together);
      assert.ok(!isWithin(difference(first, together), boundsOfQuantised), "the changes are visible");
      await view.page.evaluate(() => {
        document.querySelector("#crowd")!.remove();
      });
      const alone = await view.picture();
      assert.ok((await drawsOfFrame(view)) >= 15, `${await drawsOfFrame(view)} draws`);
      assertSamePicture("batched-appearances-alone", together, alone, boundsOfQuantised);
      await view.page.evaluate(() => {
        document.querySelector("x3d")!.setAttribute("draw-as", "points");
      });
      const points = await view.picture();
      savePicture("batched-appearances-points", points);
      assert.ok(!isWithin(difference(alone, points), boundsOfQuantised), "surfaces are displayed as points");
      await view.page.evaluate((text) => {
        document.querySelector("scene")!.insertAdjacentHTML("beforeend", text);
      }, crowd);
      assertSamePicture("batched-appearances-points", await view.picture(), points, boundsOfQuantised);
      assert.ok((await drawsOfFrame(view)) <= maxDraws + 1, "they are batched again");
      await view.page.evaluate(() => {
        for (const transform of document.querySelectorAll("scene > transform")) transform.remove();
      });
      await view.picture();
      assert.deepEqual(
        await view.page.evaluate(() => {
          const { geometries, bufferBytes, textureBytes } = document.querySelector<ViewElement>("x3d")!.statistics!;
          return { geometries, bufferBytes, textureBytes };
        }),
        { geometries: 0, bufferBytes: 0, textureBytes: 0 },
        "their GPU memory is freed",
      );
      for (const picture of [together, alone]) {
        const last = (Math.floor(picture.height / 2) * picture.width + picture.width - 1) * picture.channels;
        assert.deepEqual(
          Array.from(picture.data.subarray(last, last + 3)),
          [0, 255, 255],
          "a line beyond the border reaches into the picture",
        );
      }
    });
  },
);
