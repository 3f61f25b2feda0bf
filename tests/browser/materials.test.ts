// Tests X3D 4's materials. If a surface faces light and eye, glTF's reflectance has a simple form, which this file
// implements independently: H, L, V and N are equal, the distribution is 1/alpha^2, the visibility is 1/4, and X3D's
// light of intensity 1 has the radiance pi.

import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { withPage, type View } from "./harness.ts";
import { siteOfGenerated, variantOf } from "./sites.ts";
import { soakTest } from "./soak.ts";

type Color = [number, number, number];

/** A sphere lit by the headlight alone. */
function headlitSphere(): string {
  return variantOf(siteOfGenerated("sphere", "--profile", "classic"), "headlit", (page) =>
    page.replace(/<DirectionalLight[^>]*><\/DirectionalLight>/g, ""),
  );
}

/** The colour in the center of the picture with this material. */
async function colorOf(view: View, material: string): Promise<Color> {
  await view.page.evaluate((markup) => {
    document.querySelector("appearance")!.innerHTML = markup;
  }, material);
  const { data, width, height, channels } = await view.picture();
  const at = (Math.floor(height / 2) * width + Math.floor(width / 2)) * channels;
  return [data[at] ?? 0, data[at + 1] ?? 0, data[at + 2] ?? 0];
}

/** Encodes a linear value as sRGB (IEC 61966-2-1). */
function encoded(linear: number): number {
  const clamped = Math.min(Math.max(linear, 0), 1);
  return 255 * (clamped <= 0.0031308 ? 12.92 * clamped : 1.055 * clamped ** (1 / 2.4) - 0.055);
}

/** Reflected color of a dielectric that faces light and eye (glTF 2.0, appendix B). */
function facing(baseColor: Color, roughness: number): Color {
  const fresnel = 0.04;
  const mirrored = fresnel / roughness ** 4 / 4;
  return baseColor.map((channel) => encoded((1 - fresnel) * channel + mirrored)) as Color;
}

function assertColor(actual: Color, expected: Color, what: string): void {
  const farthest = Math.max(...actual.map((channel, i) => Math.abs(channel - (expected[i] ?? 0))));
  assert.ok(farthest <= 3, `${what}: ${actual.join(" ")} instead of ${expected.join(" ")}`);
}

describe("a material of X3D 4", () => {
  test("is physical, unlit or Phong, and can be replaced", async () => {
    await withPage(headlitSphere(), {}, async (view) => {
      await view.promise("complete");
      for (const roughness of [1, 0.7]) {
        const baseColor: Color = [0.5, 0.25, 0];
        const markup = `<PhysicalMaterial baseColor="${baseColor.join(" ")}" metallic="0" roughness="${roughness}"></PhysicalMaterial>`;
        assertColor(await colorOf(view, markup), facing(baseColor, roughness), markup);
      }
      assertColor(
        await colorOf(view, '<UnlitMaterial emissiveColor="0.2 0.4 0.6"></UnlitMaterial>'),
        [51, 102, 153],
        "unlit",
      );
      assertColor(await colorOf(view, '<Material diffuseColor="0.2 0.4 0.6"></Material>'), [51, 102, 153], "Phong's");
      const [red, green] = await colorOf(
        view,
        '<PhysicalMaterial baseColor="1 0.2 0.2" metallic="1" roughness="1"></PhysicalMaterial>',
      );
      assert.ok(red > 100 && red > 1.5 * green, `a metal is ${red} ${green}: it reflects the room in its colour`);

      // Geometry in the document: a box around the sphere.
      await view.page.evaluate(() => {
        document.querySelector("scene")!.insertAdjacentHTML(
          "beforeend",
          `<Shape id="box"><Appearance>
          <UnlitMaterial emissiveColor="1 0 1"></UnlitMaterial></Appearance><Box size="2.5 2.5 2.5"></Box></Shape>`,
        );
      });
      await view.promise("complete", "#box");
      const requestCount = view.server.requests.length;
      assertColor(await colorOf(view, '<Material diffuseColor="0 1 0"></Material>'), [255, 0, 255], "the box");
      assert.equal(view.server.requests.length, requestCount);
    });
  });

  soakTest("is lit by point and spot lights", async () => {
    await withPage(headlitSphere(), {}, async (view) => {
      await view.promise("complete");
      await view.page.evaluate(() => {
        document.querySelector("navigationinfo")!.setAttribute("headlight", "false");
        document.querySelector("scene")!.append(document.createElement("Group"));
      });
      for (const [light, isLit] of [
        ['<PointLight location="0 0 100" radius="1000"></PointLight>', true],
        ['<PointLight location="0 0 100" attenuation="0 0 1" intensity="100" radius="1000"></PointLight>', false],
        ['<SpotLight location="0 0 100" radius="1000"></SpotLight>', true],
        ['<SpotLight location="0 0 100" direction="0 1 0" cutOffAngle="0.5" radius="1000"></SpotLight>', false],
      ] as const) {
        await view.page.evaluate((markup) => {
          document.querySelector("scene > group")!.innerHTML = markup;
        }, light);
        const [red] = await colorOf(view, '<Material diffuseColor="1 1 1"></Material>');
        assert.equal(red > 128, isLit, `${light}: ${red}`);
      }
    });
  });
});
