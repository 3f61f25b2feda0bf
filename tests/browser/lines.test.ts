// Tests lines that LineProperties make wide. Every pixel is compared with geometry: on the screen a line covers all
// points within half its width of the segment between its ends, and its colour is interpolated between theirs.

import assert from "node:assert/strict";
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { describe, test } from "node:test";
import { savePicture } from "./compare.ts";
import { withPage, type View } from "./harness.ts";
import { writePly } from "./meshes.ts";
import { outputDirectory } from "./paths.ts";
import { type Picture } from "./png.ts";
import { sceneOf, shapeInFolder } from "./scenes.ts";
import { siteOf } from "./sites.ts";

type Pair = [number, number];
type Color = [number, number, number];

/** Zigzags with sharp and blunt joints; each vertex has a colour. */
const corners: Pair[] = [
  [-0.9, -0.7],
  [-0.3, 0.8],
  [0, -0.8],
  [0.5, -0.1],
  [0.9, 0.8],
];
const colors: Color[] = [
  [255, 0, 0],
  [0, 255, 0],
  [90, 90, 255],
  [255, 255, 0],
  [0, 255, 255],
];
const viewDistance = 10;
const pictureSize = { width: 400, height: 300 };
const [ratio, width] = [2, 6];

const zigzag = (): string => {
  mkdirSync(outputDirectory, { recursive: true });
  const path = join(outputDirectory, "zigzag.ply");
  const lines = corners.slice(1).flatMap((_, i) => [i, i + 1]);
  writeFileSync(
    path,
    writePly({
      positions: Float32Array.from(corners.flatMap(([x, y]) => [x, y, 0])),
      colors: Uint8Array.from(colors.flat()),
      triangles: new Uint32Array(0),
      lines: Uint32Array.from(lines),
    }),
  );
  return path;
};

const inline = (
  points: readonly (readonly number[])[],
  inColors = false,
): string => `<IndexedLineSet coordIndex="${points.map((_, i) => i).join(" ")} -1">
  <Coordinate point="${points.flat().join(" ")}"></Coordinate>${
    inColors
      ? `<Color color="${colors
          .flat()
          .map((byte) => byte / 255)
          .join(" ")}"></Color>`
      : ""
  }</IndexedLineSet>`;
const properties = (attributes: string): string =>
  `<Appearance><Material emissiveColor="1 1 1"></Material><LineProperties ${attributes}></LineProperties></Appearance>`;
const wide = properties(`linewidthScaleFactor="${width}"`);

const optionLists: string[][] = [
  ["--profile", "classic"],
  ["--profile", "classic", "--primitives", "strips"],
  ["--profile", "classic", "--index", "off"],
  ["--container", "bg"],
  ["--container", "bg", "--primitives", "strips", "--layout", "interleaved"],
  ["--profile", "compact"],
];
const perRow = 4;
const positionOf = (n: number): Pair => [2.2 * (n % perRow) - 3.3, 2.2 - 2.2 * Math.floor(n / perRow)];

function zigzags(sites: readonly string[]): string {
  const shapes = sites.map((site, n) =>
    shapeInFolder(site, `z${n}`)
      .replaceAll(/(["'])geometry\//g, `$1z${n}/geometry/`)
      .replace(/<Appearance[\s\S]*<\/Appearance>/i, wide),
  );
  shapes.push(shapes[0]!.replace(/<ImageGeometry/i, '$& decode="cpu"'));
  shapes.push(
    `<Shape>${wide}${inline(
      corners.map(([x, y]) => [x, y, 0]),
      true,
    )}</Shape>`,
  );
  // One is mirrored, and one is rotated out of the plane.
  const transforms = shapes.map((_, n) => (n === 1 ? 'scale="-1 1 1"' : n === 3 ? 'scale="1 1 -3"' : ""));
  return shapes
    .map((shape, n) => `<Transform translation="${positionOf(n).join(" ")} 0" ${transforms[n]!}>${shape}</Transform>`)
    .join("\n");
}

const dashWidth = 2;
const past = { behind: [1.5, -1.5, 25], ahead: [3.4, -2.6, -8] } as const;
const dot: Pair = [1.2, -3];

/** A line from behind the camera to far ahead of it; three types of lines in the bottom row; and a dot. */
const others = (): string => `
  <Shape id="past">${wide}${inline([past.behind, past.ahead])}</Shape>
  <Shape id="dashed">${properties(`linetype="2" linewidthScaleFactor="${dashWidth}"`)}${inline([
    [-4.4, -2.4, 0],
    [-2, -2.4, 0],
    [0, -2.4, 0],
  ])}</Shape>
  <Shape id="thin">${properties('linewidthScaleFactor="1"')}${inline([
    [-4.4, -2.8, 0],
    [0, -2.8, 0],
  ])}</Shape>
  <Shape id="off">${properties('linewidthScaleFactor="9" applied="false"')}${inline([
    [-4.4, -3.1, 0],
    [0, -3.1, 0],
  ])}</Shape>
  <Shape id="dot">${wide}${inline([
    [...dot, 0],
    [...dot, 0],
  ])}</Shape>`;

const scale = (pictureSize.height * ratio) / 2 / Math.tan(0.7854 / 2);
/** Projects a point at a distance from the camera to device pixels. */
function onScreen([x, y]: Pair, distance = viewDistance): Pair {
  return [
    (pictureSize.width * ratio) / 2 + (x * scale) / distance,
    (pictureSize.height * ratio) / 2 - (y * scale) / distance,
  ];
}

interface Segment {
  from: Pair;
  to: Pair;
  colors: [Color, Color];
  width: number;
}

/** Distance of a point from a segment, and its position along it, 0 … 1. */
function nearest({ from, to }: Segment, [x, y]: Pair): { away: number; along: number } {
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
  const along = Math.min(1, Math.max(0, ((x - from[0]) * dx + (y - from[1]) * dy) / (dx * dx + dy * dy || 1)));
  return { away: Math.hypot(x - from[0] - along * dx, y - from[1] - along * dy), along };
}

function segments(): Segment[] {
  const white: [Color, Color] = [
    [255, 255, 255],
    [255, 255, 255],
  ];
  const zigzagged = Array.from({ length: optionLists.length + 2 }, (_, n) => {
    const [x, y] = positionOf(n);
    const at = corners.map(([u, v]) => onScreen([x + (n === 1 ? -u : u), y + v]));
    return at
      .slice(1)
      .map((to, i): Segment => ({ from: at[i]!, to, colors: [colors[i]!, colors[i + 1]!], width: width * ratio }));
  });
  // Clipped just before the eye, far outside of the picture.
  const [[x, y, z], [u, v, w]] = [past.behind, past.ahead];
  const share = (z - viewDistance + 0.001) / (z - w);
  const from = onScreen([x + (u - x) * share, y + (v - y) * share], 0.001);
  return [
    ...zigzagged.flat(),
    { from, to: onScreen([u, v], viewDistance - w), colors: white, width: width * ratio },
    { from: onScreen(dot), to: onScreen(dot), colors: white, width: width * ratio },
  ];
}

const colorAt = ({ data, channels, width }: Picture, x: number, y: number): Color =>
  [0, 1, 2].map((channel) => data[(y * width + x) * channels + channel]!) as Color;

/** Whether a row of pixels has only dashed and thin lines. */
const isRowOfThinLines = (y: number): boolean =>
  [-2.4, -2.8, -3.1].some((row) => Math.abs(y - onScreen([0, row])[1]) < 7);

/** Compares a third of the pixels, except those on borders of lines. */
function assertDrawn(picture: Picture, drawn: readonly Segment[]): void {
  let lit = 0;
  for (let y = 0; y < picture.height; ++y) {
    for (let x = y % 3; x < picture.width; x += 3) {
      if (isRowOfThinLines(y)) continue;
      const here = drawn.map((segment) => ({ segment, ...nearest(segment, [x + 0.5, y + 0.5]) }));
      if (here.some(({ segment, away }) => Math.abs(away - segment.width / 2) < 1)) continue;
      const within = here.filter(({ segment, away }) => away < segment.width / 2);
      const [only] = within;
      const found = colorAt(picture, x, y);
      if (only === undefined) assert.deepEqual(found, [0, 0, 0], `at ${x} ${y} nothing is drawn`);
      else if (within.length > 1) assert.ok(Math.max(...found) > 80, `at ${x} ${y} there is a joint`);
      else {
        lit += 1;
        const [begin, end] = only.segment.colors;
        begin.forEach((channel, i) => {
          const expected = channel + (end[i]! - channel) * only.along;
          assert.ok(
            Math.abs(found[i]! - expected) < 8,
            `at ${x} ${y}: ${found.join()}, channel ${i} should be ${expected.toFixed()}`,
          );
        });
      }
    }
  }
  assert.ok(lit > 4_000, `${lit} pixels`);
}

/** Begin and end of each run of lit pixels along a row, in the left half. */
function runsAlong(picture: Picture, row: number): Pair[] {
  const runs: Pair[] = [];
  const y = Math.floor(onScreen([0, row])[1]);
  for (let x = 0, wasLit = false; x < picture.width / 2 + 20; ++x) {
    const isLit = colorAt(picture, x, y)[0] > 127;
    if (isLit && !wasLit) runs.push([x, x + 1]);
    else if (isLit) runs.at(-1)![1] = x + 1;
    wasLit = isLit;
  }
  return runs;
}

/** Height of the lit pixels in a column. */
function heightOf(picture: Picture, [x, row]: Pair): number {
  const [column, middle] = onScreen([x, row]).map(Math.floor) as Pair;
  return Array.from({ length: 13 }, (_, i) => colorAt(picture, column, middle - 6 + i)[0]).filter((value) => value > 60)
    .length;
}

const hitAt = (view: View, [x, y]: Pair): Promise<boolean> =>
  view.page.evaluate(
    (pixel) =>
      (
        document.querySelector("x3d") as unknown as { positionAndNormalFromPoint: (x: number, y: number) => unknown }
      ).positionAndNormalFromPoint(pixel[0], pixel[1]) !== null,
    [x / ratio, y / ratio] as const,
  );

describe("wide lines", () => {
  test("cover all points within half their width, from every container, clipped at the camera and dashed, and are hit there", async () => {
    const sites = optionLists.map((options) => siteOf(zigzag(), ...options));
    const directory = sceneOf(
      "lines-wide",
      Object.fromEntries(sites.map((site, n) => [`z${n}`, site])),
      `<NavigationInfo type='"EXAMINE" "ANY"'></NavigationInfo><Background skyColor="0 0 0"></Background>
       <Viewpoint position="0 0 ${viewDistance}" fieldOfView="0.7854"></Viewpoint>${zigzags(sites)}${others()}`,
    );
    await withPage(directory, { size: pictureSize, deviceScaleFactor: ratio }, async (view) => {
      await view.promise("complete");
      const picture = await view.picture();
      savePicture("lines-wide", picture);
      const drawn = segments();
      assertDrawn(picture, drawn);
      await assertHit(view, drawn);
      assertDashes(picture);
      for (const row of [-2.8, -3.1])
        assert.ok(heightOf(picture, [-2, row]) <= 2, `a line of ${row} has the minimum width`);
      await view.page.evaluate(() => {
        document.querySelector("#thin lineproperties")?.setAttribute("linewidthScaleFactor", "3");
        document.querySelector("#dashed lineproperties")?.remove();
      });
      const changed = await view.picture();
      savePicture("lines-changed", changed);
      assert.ok(heightOf(changed, [-2, -2.8]) >= 6, "it has become wide");
      assert.ok(heightOf(changed, [-2, -2.4]) <= 2, "it has become thin");
      const runs = runsAlong(changed, -2.4);
      // Mesa leaves out the pixel in which two lines of GL meet.
      assert.ok(
        runs.every(([begin], i) => i === 0 || begin - runs[i - 1]![1] <= 1),
        "it has become solid",
      );
    });
  });
});

function assertDashes(picture: Picture): void {
  const runs = runsAlong(picture, -2.4).slice(1, -1); // the ends are round
  assert.ok(runs.length >= 4, `${runs.length} dashes`);
  runs.forEach(([begin, end], i) => {
    assert.ok(Math.abs(end - begin - 6 * dashWidth * ratio) <= 1, `a dash of ${end - begin} pixels`);
    assert.ok(
      i === 0 || Math.abs(begin - runs[i - 1]![0] - 10 * dashWidth * ratio) <= 1,
      "dashes run on across joints",
    );
  });
}

/** Picks slightly inside and outside of the borders of one segment of each zigzag. */
async function assertHit(view: View, drawn: readonly Segment[]): Promise<void> {
  for (let n = 0; n < optionLists.length + 2; ++n) {
    const { from, to, width: across } = drawn[n * (corners.length - 1) + (n % (corners.length - 1))]!;
    const length = Math.hypot(to[0] - from[0], to[1] - from[1]);
    const middle = 0.5;
    const beside = (pixels: number): Pair => [
      from[0] + middle * (to[0] - from[0]) - ((to[1] - from[1]) / length) * pixels,
      from[1] + middle * (to[1] - from[1]) + ((to[0] - from[0]) / length) * pixels,
    ];
    for (const side of [-1, 1]) {
      assert.ok(await hitAt(view, beside(side * (across / 2 - 2))), `not hit inside at ${beside(0).join()}`);
      assert.ok(!(await hitAt(view, beside(side * (across / 2 + 2)))), `hit outside at ${beside(0).join()}`);
    }
  }
}
