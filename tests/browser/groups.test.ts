// Groups that do more than hold their children.

import assert from "node:assert/strict";
import { test } from "node:test";
import { withPage, type View } from "./harness.ts";
import { sceneOf } from "./scenes.ts";
import { siteOfGenerated } from "./sites.ts";

const size = { width: 320, height: 240 };
const paint = (color: string): string => `<Appearance><UnlitMaterial emissiveColor="${color}"></UnlitMaterial></Appearance>`;
/** Of no thickness: seen from its side it is nothing. */
const panel = `<Shape>${paint("1 0 0")}<IndexedFaceSet solid="false" coordIndex="0 1 2 3"><Coordinate point="-1 -1 0 1 -1 0 1 1 0 -1 1 0"></Coordinate></IndexedFaceSet></Shape>`;
const views = { ahead: 0, aside: 1.5708, behind: 2.5 };
const scene = `<NavigationInfo transitionType="TELEPORT"></NavigationInfo><Background skyColor="0 0 0"></Background>
  ${Object.entries(views).map(([name, angle]) => `<Viewpoint description="${name}" position="${8 * Math.sin(angle)} 0 ${8 * Math.cos(angle)}" orientation="0 1 0 ${angle}"></Viewpoint>`).join("")}
  <Transform id="around" rotation="0 1 0 0.7"><Billboard>${panel}</Billboard></Transform>`;

async function redPixels(view: View): Promise<number> {
  const { data, channels } = await view.picture();
  let count = 0;
  for (let at = 0; at < data.length; at += channels) if (data[at]! > 128 && data[at + 1]! < 64) count += 1;
  return count;
}

test("a billboard is seen from the front from everywhere, drawn by itself and with others", async () => {
  const site = sceneOf("groups", { trefoil: siteOfGenerated("trefoil", "--profile", "classic") }, scene);
  await withPage(site, { size }, async (view) => {
    await view.promise("complete");
    // Two units at a distance of 8, in 240 pixels of a field of view of 45 degrees.
    const whole = (size.height / 2 / Math.tan(0.7854 / 2) / 8 * 2) ** 2;
    const assertSeen = async (how: string): Promise<void> => {
      for (const name of Object.keys(views)) {
        await view.page.evaluate((description) => { (document.querySelector("x3d") as unknown as { bindViewpoint: (name: string) => void }).bindViewpoint(description); }, name);
        const seen = await redPixels(view);
        assert.ok(Math.abs(seen / whole - 1) < 0.03, `${how}, ${name}: ${seen} pixels instead of ${whole.toFixed(0)}`);
      }
    };
    await assertSeen("by itself");
    await view.page.evaluate(() => {
      const others = Array.from({ length: 16 }, () => "<Shape><Appearance><Material></Material></Appearance><Box size='0.01 0.01 0.01'></Box></Shape>");
      document.querySelector("billboard")!.insertAdjacentHTML("beforeend", others.join(""));
    });
    await assertSeen("with others");
    await view.page.evaluate(() => { document.querySelector("billboard")!.setAttribute("axisOfRotation", "0 0 1"); });
    const unturned = await redPixels(view);
    assert.ok(unturned < 0.97 * whole, `${unturned} pixels of what cannot turn`);
  });
});
