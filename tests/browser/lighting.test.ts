// Tests light and sky against X3D's equations, pixel by pixel. tests/conformance compares them and more with other
// runtimes.

import assert from "node:assert/strict";
import { test } from "node:test";
import { withPage } from "./harness.ts";
import { sceneOf } from "./scenes.ts";
import { siteOfGenerated } from "./sites.ts";

/** The camera and the lamp are at these z, the wall at 0. */
const eye = 5,
  fieldOfView = 0.8,
  lamp = 2;
const attenuation = [0.5, 0.25, 0.1] as const;
const beamWidth = 0.25,
  cutOffAngle = 0.55;
/** Half of the wall's extents. */
const edge = 1.5;
const skyAngles = [1.4, 1.8] as const;
const sky = [
  [0, 0, 1],
  [0, 1, 0],
  [1, 0, 0],
] as const;
const wall = `<IndexedFaceSet coordIndex="0 1 2 3"><Coordinate point="-${edge} -${edge} 0 ${edge} -${edge} 0 ${edge} ${edge} 0 -${edge} ${edge} 0"></Coordinate></IndexedFaceSet>`;
const scene = `<NavigationInfo headlight="false"></NavigationInfo><Viewpoint position="0 0 ${eye}" fieldOfView="${fieldOfView}"></Viewpoint>
  <Background skyAngle="${skyAngles.join(" ")}" skyColor="${sky.flat().join(" ")}"></Background>
  <Transform translation="0 0 ${lamp}"><SpotLight location="0 0 0" direction="0 0 -1" beamWidth="${beamWidth}" cutOffAngle="${cutOffAngle}" attenuation="${attenuation.join(" ")}" radius="2.3"></SpotLight></Transform>
  <Shape><Appearance><Material diffuseColor="1 1 1" ambientIntensity="0"></Material></Appearance>${wall}</Shape>`;

/**
 * Brightness of a white wall at a distance `aside` from the point that the lamp points at: ISO/IEC 19775-1, 17.2.2.4.
 */
function lit(aside: number): number {
  const distance = Math.hypot(aside, lamp);
  if (distance > 2.3) return 0;
  const angle = Math.atan2(aside, lamp);
  const spot = angle > cutOffAngle ? 0 : Math.min((cutOffAngle - angle) / (cutOffAngle - beamWidth), 1);
  const falloff = 1 / Math.max(attenuation[0] + attenuation[1] * distance + attenuation[2] * distance ** 2, 1);
  return spot * falloff * (lamp / distance);
}

function skyAt(angle: number): readonly number[] {
  const stops = [0, ...skyAngles];
  const upper = stops.findIndex((stop) => stop >= angle);
  if (upper < 0) return sky[2];
  const share = upper === 0 ? 1 : (angle - stops[upper - 1]!) / (stops[upper]! - stops[upper - 1]!);
  return sky[upper]!.map((value, i) => (upper === 0 ? value : (1 - share) * sky[upper - 1]![i]! + share * value));
}

test("a spot light is attenuated by distance and angle, and the sky has its gradient, as X3D specifies", async () => {
  const site = sceneOf("lighting", { trefoil: siteOfGenerated("trefoil", "--profile", "classic") }, scene);
  await withPage(site, { size: { width: 320, height: 240 } }, async (view) => {
    await view.promise("complete");
    const { data, width, height, channels } = await view.picture();
    const slope = (pixel: number, from: number): number =>
      ((pixel + 0.5 - from / 2) / (height / 2)) * Math.tan(fieldOfView / 2);
    let litCount = 0,
      skyCount = 0;
    for (let y = 0; y < height; ++y) {
      for (let x = 0; x < width; ++x) {
        const [right, down] = [slope(x, width), slope(y, height)];
        const inPlane = Math.max(Math.abs(right), Math.abs(down)) * eye;
        if (Math.abs(inPlane - edge) < 0.05) continue; // antialiased edge
        const seen = Array.from(data.subarray((y * width + x) * channels, (y * width + x) * channels + 3));
        const isWall = inPlane < edge;
        const aside = Math.hypot(right, down) * eye;
        const expected = isWall
          ? [1, 1, 1].map(() => lit(aside))
          : skyAt(Math.acos(-down / Math.hypot(right, down, 1)));
        // Pixels at the light's radius are partly lit.
        if (isWall && Math.abs(Math.hypot(aside, lamp) - 2.3) < 0.02) continue;
        const off = Math.max(...seen.map((value, i) => Math.abs(value - 255 * expected[i]!)));
        assert.ok(
          off <= 3,
          `(${x}, ${y}) is ${seen.join(" ")} instead of ${expected.map((value) => Math.round(255 * value)).join(" ")}`,
        );
        if (!isWall) skyCount += 1;
        else if (seen[0]! > 0) litCount += 1;
      }
    }
    assert.ok(litCount > 1000 && skyCount > 5000, `${litCount} pixels are lit, ${skyCount} are sky`);
  });
});
