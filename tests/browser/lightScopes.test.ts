// Tests the scope of lights: walls that face the viewer have the colours of the lights in their groups, drawn one by
// one and in a batch, while the document changes.

import assert from "node:assert/strict";
import { test } from "node:test";
import { withPage, type View } from "./harness.ts";
import { sceneOf } from "./scenes.ts";
import { siteOfGenerated } from "./sites.ts";

type Color = readonly [number, number, number];

const size = { width: 320, height: 160 };
/** Scene units between two walls, and across the picture. */
const apart = 2,
  across = 12;
const names = ["alone", "outer", "inner", "spot", "last"] as const;
type Name = (typeof names)[number];

const centerOf = (name: Name): number => apart * (names.indexOf(name) - 2);

function wall(name: Name): string {
  const [left, right] = [centerOf(name) - 0.8, centerOf(name) + 0.8];
  return `<Shape id="${name}"><Appearance><Material diffuseColor="1 1 1" ambientIntensity="1"></Material></Appearance><IndexedFaceSet coordIndex="0 1 2 3">
    <Coordinate point="${left} -1 0 ${right} -1 0 ${right} 1 0 ${left} 1 0"></Coordinate></IndexedFaceSet></Shape>`;
}

/** So far away that the light is nearly parallel. */
const faraway = 'location="0 0 1000" radius="2000"';
const scene = `<NavigationInfo headlight="false"></NavigationInfo>
  <OrthoViewpoint position="0 0 5" fieldOfView="${-across / 2} ${-across / 4} ${across / 2} ${across / 4}"></OrthoViewpoint>
  <DirectionalLight color="0.2 0.2 0.2"></DirectionalLight>
  ${wall("alone")}
  <Group id="group"><PointLight id="red" global="false" color="0.5 0 0" ${faraway}></PointLight>${wall("outer")}
    <Transform id="deep"><DirectionalLight id="green" color="0 0.4 0" ambientIntensity="0.5"></DirectionalLight>${wall("inner")}</Transform></Group>
  <Group><SpotLight id="blue" global="false" color="0 0 0.5" ${faraway} beamWidth="0.7" cutOffAngle="0.8"></SpotLight>${wall("spot")}</Group>
  ${wall("last")}`;

/** The colour by the global light alone, and the colours of all walls at first. */
const dark: Color = [0.2, 0.2, 0.2];
const initialColors: Readonly<Record<Name, Color>> = {
  alone: dark,
  outer: [0.7, 0.2, 0.2],
  inner: [0.7, 0.8, 0.2],
  spot: [0.2, 0.2, 0.7],
  last: dark,
};

async function assertColors(view: View, what: string, expected: Readonly<Record<Name, Color>>): Promise<void> {
  const { data, width, height, channels } = await view.picture();
  const seen = Object.fromEntries(
    names.map((name) => {
      const at = (Math.floor(height / 2) * width + Math.floor(width * (0.5 + centerOf(name) / across))) * channels;
      return [name, Array.from(data.subarray(at, at + 3), (value) => Math.round(value / 2.55) / 100)];
    }),
  );
  assert.deepEqual(seen, expected, what);
}

test("lights that are not global light only their groups, follow the document, and do so in batches", async () => {
  const site = sceneOf("light-scopes", { trefoil: siteOfGenerated("trefoil", "--profile", "classic") }, scene);
  await withPage(site, { size }, async (view) => {
    await view.promise("complete");
    await assertColors(view, "drawn one by one", initialColors);

    await view.page.evaluate(() => {
      document.querySelector("#red")!.setAttribute("global", "true");
      document.querySelector("#deep")!.append(document.querySelector("#last")!);
      document.querySelector("#blue")!.remove();
    });
    await assertColors(view, "after changes", {
      alone: [0.7, 0.2, 0.2],
      outer: [0.7, 0.2, 0.2],
      inner: [0.7, 0.8, 0.2],
      spot: [0.7, 0.2, 0.2],
      last: [0.7, 0.8, 0.2],
    });

    await view.page.evaluate(() => {
      // Enough further shapes for batches; their group, with a light of its own, comes first.
      const walls = Array.from(
        { length: 16 },
        () => "<Shape><Appearance><Material></Material></Appearance><Box size='0.01 0.01 0.01'></Box></Shape>",
      );
      document
        .querySelector("#alone")!
        .insertAdjacentHTML(
          "beforebegin",
          `<Group><DirectionalLight color="1 1 1"></DirectionalLight>${walls.join("")}</Group>`,
        );
      document.querySelector("#red")!.setAttribute("global", "false");
      document.querySelector("scene")!.append(document.querySelector("#last")!);
    });
    await assertColors(view, "in a batch", { ...initialColors, spot: dark });
    const drawCalls = await view.page.evaluate(
      () => (document.querySelector("x3d") as unknown as { statistics: { drawCalls: number } }).statistics.drawCalls,
    );
    assert.ok(drawCalls <= 3, `${drawCalls} draws: they are batched`);

    await view.page.evaluate(() => {
      for (const light of Array.from(document.querySelectorAll("scene > group > directionallight"))) light.remove();
      document.querySelector("#green")!.setAttribute("on", "false");
      document.querySelector("#group")!.prepend(document.querySelector("#alone")!);
    });
    await assertColors(view, "in a batch, after changes", {
      alone: [0.7, 0.2, 0.2],
      outer: [0.7, 0.2, 0.2],
      inner: [0.7, 0.2, 0.2],
      spot: dark,
      last: dark,
    });
    await view.page.evaluate(() => {
      document.querySelector("#red")!.remove();
    });
    await assertColors(view, "without any light of a group", {
      alone: dark,
      outer: dark,
      inner: dark,
      spot: dark,
      last: dark,
    });
  });
});
