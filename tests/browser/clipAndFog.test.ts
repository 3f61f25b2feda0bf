// Tests ClipPlane, Fog, LocalFog and FogCoordinate: walls that face the viewer have the colours that X3D's equations
// give, drawn one by one and in a batch, and what is clipped is not picked.

import assert from "node:assert/strict";
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { withPage, type View } from "./harness.ts";
import { outputDirectory } from "./paths.ts";
import type { Picture } from "./png.ts";
import { sceneOf } from "./scenes.ts";
import { pageOf, shapeIn, siteOf } from "./sites.ts";

const size = { width: 320, height: 160 };
/** The eye's distance from the walls, and half of the visible height there. */
const eye = 10,
  halfHeight = 2;
const fieldOfView = 2 * Math.atan(halfHeight / eye);
const range = 40;

/** The share of fog at the lower and the upper edge of a wall with a FogCoordinate. */
const depths = [0.2, 0.8] as const;
const fogCoordinate = `<FogCoordinate depth="${depths[0]} ${depths[0]} ${depths[1]}"></FogCoordinate>`;

/** `children`: further nodes of the geometry. */
const wall = (id: string, center: number, children = ""): string =>
  `<Shape id="${id}"><Appearance><UnlitMaterial emissiveColor="1 0 0"></UnlitMaterial></Appearance><IndexedFaceSet solid="false" coordIndex="0 1 2 3">
    <Coordinate point="${center - 0.9} -1 0 ${center + 0.9} -1 0 ${center + 0.9} 1 0 ${center - 0.9} 1 0"></Coordinate>${children}</IndexedFaceSet></Shape>`;

/** Sites of a wall with the FogCoordinate, by folder. Vertices of no face make it too large to stay in the page. */
function sitesOfWall(): Record<string, string> {
  mkdirSync(outputDirectory, { recursive: true });
  const file = join(outputDirectory, "fog-coordinate.x3d");
  const unused = Array.from({ length: 200 }, (_, i) => ` 9 9 ${i}`).join("");
  const shape = wall("wall", 0, fogCoordinate).replace(/(point="[^"]*)"/, `$1${unused}"`);
  writeFileSync(file, `<X3D><Scene>${shape}</Scene></X3D>`);
  return {
    classic: siteOf(file, "--profile", "classic"),
    compact: siteOf(file, "--profile", "compact"),
    bg: siteOf(file, "--container", "bg"),
  };
}

const deepWall = (center: number, shape: string): string =>
  `<Transform translation="${center} -1.5 0" scale="1 0.4 1">${shape}</Transform>`;
/** Where the walls with a FogCoordinate stand. */
const deepCenters = [-3, -1, 1, 3] as const;

const scene = `<NavigationInfo headlight="false"></NavigationInfo><Background skyColor="0 0 1"></Background>
  <Viewpoint position="0 0 ${eye}" fieldOfView="${fieldOfView}"></Viewpoint>
  <Fog id="fog" color="0 1 0" visibilityRange="${range}"></Fog><Fog id="thick" fogType="EXPONENTIAL" color="0 1 0" visibilityRange="${range}"></Fog>
  ${wall("plain", -2)}
  <Transform rotation="0 0 1 1.5708" scale="2 1 1"><ClipPlane id="plane" plane="1 0 0 0"></ClipPlane><Transform rotation="0 0 1 -1.5708">${wall("clipped", 0)}</Transform></Transform>
  <Transform scale="0.5 0.5 0.5" translation="2 0 0"><LocalFog id="local" color="0 0 0" visibilityRange="${4 * range}"></LocalFog>
    <Transform scale="2 2 2">${wall("local-wall", 0)}</Transform></Transform>
  ${deepWall(deepCenters[0], wall("deep", 0, fogCoordinate))}`;

/** The color, 0 … 1, of the point (x, y, 0). */
function colorAt({ data, width, height, channels }: Picture, x: number, y: number): readonly number[] {
  const unit = height / 2 / halfHeight;
  const at = (Math.floor(height / 2 - y * unit) * width + Math.floor(width / 2 + x * unit)) * channels;
  return Array.from(data.subarray(at, at + 3), (value) => value / 255);
}

function assertNear(seen: readonly number[], expected: readonly number[], what: string): void {
  const off = Math.max(...seen.map((value, i) => Math.abs(value - expected[i]!)));
  assert.ok(off < 0.01, `${what}: ${seen.join(" ")} instead of ${expected.join(" ")}`);
}

const linear = (distance: number, visible = range): number => Math.max(0, (visible - distance) / visible);
const exponential = (distance: number): number => Math.exp(-distance / (range - distance));

async function assertPicture(view: View, what: string, shareAt: (distance: number) => number): Promise<void> {
  const y = 0.6;
  const share = (x: number): number => shareAt(Math.hypot(x, y, eye));
  const picture = await view.picture();
  assertNear(colorAt(picture, -2, y), [share(-2), 1 - share(-2), 0], `${what}: fog`);
  assertNear(colorAt(picture, 0, y), [share(0), 1 - share(0), 0], `${what}: in front of the plane`);
  assertNear(colorAt(picture, 0, -y), [0, 0, 1], `${what}: behind the plane`);
  // In the middle of pixels, of walls from -1.9 to -1.1.
  for (const deepY of [-1.6125, -1.3875]) {
    const shareOfFog = depths[0] + ((depths[1] - depths[0]) * (deepY + 1.9)) / 0.8;
    for (const x of deepCenters)
      assertNear(colorAt(picture, x, deepY), [1 - shareOfFog, shareOfFog, 0], `${what}: by depth at ${x}`);
  }
  assertNear(colorAt(picture, 2, y), [linear(Math.hypot(2, y, eye), 2 * range), 0, 0], `${what}: local fog`);
}

const shapeAt = (view: View, x: number, y: number): Promise<string | undefined> =>
  view.page.evaluate(
    ([clientX, clientY]) =>
      (
        document.querySelector("imgeo-view") as unknown as {
          positionAndNormalFromPoint: (x: number, y: number) => { shape: Element } | null;
        }
      ).positionAndNormalFromPoint(clientX!, clientY!)?.shape.id,
    [size.width / 2 + x * (size.height / 2 / halfHeight), size.height / 2 - y * (size.height / 2 / halfHeight)],
  );

test("clip planes and fogs have their effect on their groups, follow the document, and do so in batches", async () => {
  const sites = sitesOfWall();
  const stored = Object.entries(sites).map(([folder, site], i) =>
    deepWall(deepCenters[i + 1] ?? 0, shapeIn(pageOf(site)).replaceAll("geometry/", `${folder}/geometry/`)),
  );
  const site = sceneOf("clip-and-fog", sites, scene + stored.join(""));
  await withPage(site, { size }, async (view) => {
    await view.promise("complete");
    await assertPicture(view, "one by one", linear);
    assert.equal(await shapeAt(view, 0, 0.6), "clipped");
    assert.equal(await shapeAt(view, 0, -0.6), undefined, "what is clipped is not picked");

    await view.page.evaluate(() => {
      const walls = Array.from(
        { length: 16 },
        () => "<Shape><Appearance><Material></Material></Appearance><Box size='0.01 0.01 0.01'></Box></Shape>",
      );
      document.querySelector("#plain")!.insertAdjacentHTML("beforebegin", `<Group>${walls.join("")}</Group>`);
      document.querySelector("#thick")!.setAttribute("set_bind", "true");
    });
    await assertPicture(view, "in a batch, in thick fog", exponential);
    assert.equal(await shapeAt(view, 0, -0.6), undefined, "nor in a batch");

    await view.page.evaluate(() => {
      document.querySelector("#fog")!.remove();
      document.querySelector("#thick")!.remove();
      document.querySelector("#local")!.setAttribute("enabled", "false");
      document.querySelector("#plane")!.setAttribute("enabled", "false");
    });
    const picture = await view.picture();
    for (const [x, y] of [
      [-2, 0.6],
      [0, -0.6],
      [2, 0.6],
    ] as const)
      assertNear(colorAt(picture, x, y), [1, 0, 0], `without any, at ${x}`);
    assert.equal(await shapeAt(view, 0, -0.6), "clipped");
  });
});
