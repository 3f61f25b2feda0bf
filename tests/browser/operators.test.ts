// Tests operators on geometry: the picture is that of mapped vertices, on the GPU and with vertices that workers
// decode, and no file is requested again.

import assert from "node:assert/strict";
import { test } from "node:test";
import { assertSamePicture, boundsOfQuantised, difference, savePicture } from "./compare.ts";
import { meshOf, shapeOf, sheet, surfaceOver } from "./generators/grids.ts";
import { pictureSize, withPage, type View } from "./harness.ts";
import { decodePng, type Picture } from "./png.ts";
import { firstHit, minus, rayThrough, type Vec3 } from "./rays.ts";
import { referencePicture, referenceSettingsOf } from "./reference.ts";
import type { PlainPatch } from "./siteDecoder.ts";
import { pageOf, siteOfGenerated } from "./sites.ts";

const site = (): string => siteOfGenerated("trefoil", "--profile", "classic");
const example = sheet();

/** In units of the sheet's box, which is 2 wide around the origin: the point and the direction of a normal. */
type Mapping = (point: Vec3, normal: Vec3) => readonly [point: Vec3, normal: Vec3];

/** Lists of operators with their meaning, written out, whether they mirror, and the radius of their blur. */
const lists: readonly (readonly [
  operators: string,
  map: Mapping | undefined,
  isMirroring: boolean,
  blurRadius?: number,
])[] = [
  [
    "negate(y)",
    ([x, y, z], [a, b, c]) => [
      [x, -y, z],
      [a, -b, c],
    ],
    true,
  ],
  [
    "scale(0.7 0.9 0.8) swizzle(yxz) translate(0.05 -0.1 0)",
    ([x, y, z], [a, b, c]) => [
      [0.9 * y + 0.1, 0.7 * x - 0.2, 0.8 * z],
      [b / 0.9, a / 0.7, c / 0.8],
    ],
    true,
  ],
  [
    "swizzle(yzx) negate(xy)",
    ([x, y, z], [a, b, c]) => [
      [-y, -z, x],
      [-b, -c, a],
    ],
    false,
  ],
  ["gamma(1.3) solarize(0.8) posterise(200)", undefined, false],
  [
    "blur(3.5) negate(y)",
    ([x, y, z], [a, b, c]) => [
      [x, -y, z],
      [a, -b, c],
    ],
    true,
    3.5,
  ],
];

/** The weighted mean of the neighbours of each vertex: as many on both sides, where the grid ends. */
function blurredPositions(positions: Float32Array, radius: number): Float32Array {
  const { columns, rows } = example;
  const reach = Math.ceil(radius);
  return positions.map((_, i) => {
    const [column, row] = [Math.floor(i / 3) % columns, Math.floor(i / 3 / columns)];
    const across = Math.min(reach, column, columns - 1 - column);
    const down = Math.min(reach, row, rows - 1 - row);
    let [sum, total] = [0, 0];
    for (let y = -down; y <= down; ++y)
      for (let x = -across; x <= across; ++x) {
        const weight = Math.exp((-2 * (x * x + y * y)) / radius ** 2);
        sum += weight * positions[i + 3 * (y * columns + x)]!;
        total += weight;
      }
    return sum / total;
  });
}

function mappedMesh(map: Mapping, isMirroring: boolean, blurRadius: number): PlainPatch {
  const sharp = meshOf(
    example,
    [...example.files.values()].map((file) => decodePng(file)),
  );
  const plain = blurRadius > 0 ? surfaceOver(example, blurredPositions(sharp.positions, blurRadius)) : sharp;
  const { normals } = plain;
  const vectorAt = (array: ArrayLike<number>, n: number): Vec3 => [array[3 * n]!, array[3 * n + 1]!, array[3 * n + 2]!];
  const positions = new Float32Array(plain.positions.length);
  const mappedNormals = new Float32Array(plain.positions.length);
  for (let n = 0; n < positions.length / 3; ++n) {
    const [point, normal] = map(vectorAt(plain.positions, n), vectorAt(normals!, n));
    positions.set(point, 3 * n);
    mappedNormals.set(
      normal.map((part) => part / Math.hypot(...normal)),
      3 * n,
    );
  }
  const triangles = plain.triangles.slice();
  if (isMirroring) for (let n = 0; n < triangles.length; n += 3) triangles.subarray(n + 1, n + 3).reverse();
  return { ...plain, positions, normals: mappedNormals, triangles };
}

function pageWith(attributes: string): string {
  return pageOf(site())
    .replace(/<link rel="preload"[^>]*>/g, "")
    .replace(/<Shape[\s\S]*<\/Shape>/i, () => shapeOf(example, attributes))
    .replace(/<Viewpoint[^>]*>/i, `<Viewpoint position="0.3 0.5 4.2" orientation="-1 0.1 0 0.1" fieldOfView="0.75">`);
}

async function hitAt(view: View, x: number, y: number): Promise<Vec3 | undefined> {
  return view.page.evaluate(
    (pixel) => {
      interface View {
        positionAndNormalFromPoint(x: number, y: number): { position: { x: number; y: number; z: number } } | null;
      }
      const position = (document.querySelector("imgeo-view") as unknown as View).positionAndNormalFromPoint(
        pixel.x,
        pixel.y,
      )?.position;
      return position && ([position.x, position.y, position.z] as const);
    },
    { x: x + 0.5, y: y + 0.5 },
  );
}

test("operators map the vertices of every pass", async () => {
  const pictures: Picture[][] = [];
  for (const decode of ["gpu", "cpu"]) {
    const html = pageWith(`decode="${decode}"`);
    const server = (server: View["server"]): void => {
      for (const [path, body] of example.files) server.put(path, body);
      server.when(/^\/$/, { replace: () => html });
    };
    await withPage(site(), { server }, async (view) => {
      await view.promise("complete");
      const plain = await view.picture();
      const requestCount = view.server.requests.length;
      const ofPage: Picture[] = [];
      for (const [operators, map, isMirroring, blurRadius = 0] of lists) {
        await view.page.evaluate((text) => {
          document.querySelector("imagegeometry")!.setAttribute("operators", text);
        }, operators);
        const picture = await view.picture();
        savePicture(`operators ${decode} ${operators}`, picture);
        assert.ok(difference(picture, plain).mean > 0.5, `${operators}: nothing has changed`);
        ofPage.push(picture);
        if (map === undefined) continue;
        const mesh = mappedMesh(map, isMirroring, blurRadius);
        if (decode === "gpu")
          assertSamePicture(operators, picture, await referencePicture(html, [mesh]), boundsOfQuantised);
        let hits = 0;
        for (const [x, y] of [
          [320, 240],
          [290, 200],
          [350, 270],
        ] as const) {
          const expected = firstHit(rayThrough(referenceSettingsOf(html).viewpoint, pictureSize, x, y), [mesh]);
          const found = await hitAt(view, x, y);
          if (expected === undefined || found === undefined) continue;
          assert.ok(Math.hypot(...minus(found, expected.position)) < 1e-4, `${operators}: hit at ${found.join(" ")}`);
          ++hits;
        }
        assert.ok(hits > 0, `${operators}: nothing was hit`);
      }
      await view.page.evaluate(() => {
        document.querySelector("imagegeometry")!.removeAttribute("operators");
      });
      assertSamePicture(`without operators again on the ${decode}`, await view.picture(), plain, { mean: 0 });
      assert.equal(view.server.requests.length, requestCount, "files were requested again");
      pictures.push(ofPage);
    });
  }
  for (const [n, [operators]] of lists.entries())
    assertSamePicture(`${operators} on the cpu`, pictures[1]![n]!, pictures[0]![n]!, boundsOfQuantised);
});
