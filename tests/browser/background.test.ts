// Tests backgrounds: their pictures, which sides they fill, what their transparency shows, and which one is bound.

import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { withPage, type View } from "./harness.ts";
import { encodePng } from "./png.ts";
import { sceneOf } from "./scenes.ts";
import { siteOfGenerated } from "./sites.ts";

const size = { width: 240, height: 240 };
const red = encodePng({ width: 1, height: 1, channels: 3, data: Uint8Array.of(255, 0, 0) });

// The field of view is a right angle, so that the picture ahead fills the canvas.
const scene = `<NavigationInfo transitionType="TELEPORT" headlight="false"></NavigationInfo>
  <Viewpoint fieldOfView="1.5708" position="0 0 5"></Viewpoint>
  <Transform rotation="0 1 0 1.5708" scale="2 3 4" translation="7 8 9">
    <Background id="pictures" skyColor="0 0 1" rightUrl='"red.png"' leftUrl='"lost.png"'></Background></Transform>
  <Transform id="turned"><TextureBackground id="textures" skyColor="0 0 1" groundColor="0 0 1" groundAngle="1.5708">
    <PixelTexture containerField="frontTexture" image="1 2 4 0x00ff0080 0x00ff00ff"></PixelTexture></TextureBackground></Transform>
  <Background id="clear" skyColor="1 1 1" transparency="0.5"></Background>
  <Shape><Appearance><UnlitMaterial emissiveColor="0 0 0"></UnlitMaterial></Appearance><Sphere radius="0.5"></Sphere></Shape>`;

async function colorAt(view: View, x: number, y: number): Promise<readonly number[]> {
  const { data, width, channels } = await view.picture();
  return Array.from(data.subarray((y * width + x) * channels, (y * width + x) * channels + 3));
}

/** Waits until a picture has loaded. */
async function untilColorIs(view: View, [x, y]: readonly [number, number], color: readonly number[]): Promise<void> {
  let seen: readonly number[] = [];
  for (const end = Date.now() + 10_000; Date.now() < end;) {
    seen = await colorAt(view, x, y);
    if (color.every((value, i) => value === seen[i])) return;
    await view.page.waitForTimeout(50);
  }
  assert.deepEqual(seen, color);
}

const bind = (view: View, id: string, value: string): Promise<void> =>
  view.page.evaluate(
    ([name, isBound]) => {
      document.getElementById(name!)!.setAttribute("set_bind", isBound!);
    },
    [id, value],
  );

test("backgrounds show pictures in front of their colours, turn with their groups and follow set_bind", async () => {
  const site = sceneOf("background", { trefoil: siteOfGenerated("trefoil", "--profile", "classic") }, scene);
  writeFileSync(join(site, "red.png"), red);
  await withPage(site, { size, expectedErrors: /404/ }, async (view) => {
    await view.page.waitForFunction(
      () => (document.querySelector("x3d") as { complete?: unknown }).complete !== undefined,
    );
    const errors = await view.page.evaluate(async () => {
      const x3d = document.querySelector("x3d") as unknown as {
        complete: Promise<unknown>;
        errors: { url: string; element: Element }[];
      };
      await x3d.complete.catch(() => undefined);
      return x3d.errors.map(({ url, element }) => [url.replace(/.*\//, ""), element.id]);
    });
    assert.deepEqual(errors, [["lost.png", "pictures"]]);
    assert.deepEqual(await colorAt(view, 10, 10), [255, 0, 0], "the right picture is ahead");
    assert.deepEqual(await colorAt(view, 120, 120), [0, 0, 0], "the shape is in front of it");

    await bind(view, "textures", "true");
    await untilColorIs(view, [120, 5], [0, 255, 0]);
    const [, green, blue] = await colorAt(view, 120, 235);
    assert.ok(Math.abs(green! - 128) <= 2 && Math.abs(blue! - 127) <= 2, `${green} ${blue}: the lower texel blends`);
    await view.page.evaluate(() => {
      document.getElementById("turned")!.setAttribute("rotation", "1 0 0 3.1416");
    });
    assert.deepEqual(await colorAt(view, 120, 5), [0, 0, 255], "the front is behind the viewer");

    await bind(view, "clear", "true");
    await view.page.evaluate(() => {
      document.body.style.background = document.querySelector<HTMLElement>("x3d")!.style.background = "black";
    });
    const [half] = await colorAt(view, 10, 10);
    assert.ok(Math.abs(half! - 128) <= 2, `${half}: half of the page shows through`);

    await bind(view, "clear", "false");
    await bind(view, "textures", "false");
    await untilColorIs(view, [10, 10], [255, 0, 0]); // the first is bound again
  });
});
