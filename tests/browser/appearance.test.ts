// Tests the fields of Appearance other than the material: textures on surfaces of every container, and points with a
// size. Pixels are compared with the texels and sizes that the document specifies; a quad that faces the headlight has
// the colours of its texture.

import assert from "node:assert/strict";
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { describe, test } from "node:test";
import { savePicture } from "./compare.ts";
import { pictureSize, until, withPage, type View } from "./harness.ts";
import { outputDirectory } from "./paths.ts";
import { encodePng, type Picture } from "./png.ts";
import { sceneOf, shapeInFolder } from "./scenes.ts";
import { gate } from "./server.ts";
import { siteOf } from "./sites.ts";
import { soakTest } from "./soak.ts";

/** A text PLY. */
function plyOf(name: string, properties: string, rows: string[], faces: string[] = []): string {
  mkdirSync(outputDirectory, { recursive: true });
  const path = join(outputDirectory, `${name}.ply`);
  const listed = properties
    .split(" ")
    .map((property) => `property ${property.replace(":", " ")}\n`)
    .join("");
  const ends = faces.length > 0 ? `element face ${faces.length}\nproperty list uchar int vertex_indices\n` : "";
  writeFileSync(
    path,
    `ply\nformat ascii 1.0\nelement vertex ${rows.length}\n${listed}${ends}end_header\n${[...rows, ...faces].join("\n")}\n`,
  );
  return path;
}

/** A square from -1 to 1 with texture coordinates from 0 to `maxTexCoord`. */
const quad = (maxTexCoord: number): string =>
  plyOf(
    `quad${maxTexCoord}`,
    "float:x float:y float:z float:nx float:ny float:nz float:s float:t",
    [
      [-1, -1],
      [1, -1],
      [1, 1],
      [-1, 1],
    ].map(([x, y]) => `${x} ${y} 0 0 0 1 ${((x! + 1) / 2) * maxTexCoord} ${((y! + 1) / 2) * maxTexCoord}`),
    ["3 0 1 2", "3 0 2 3"],
  );

/** White, with an alpha of 0 on its left side and of 1 on its right. */
const fadingQuad = (): string =>
  plyOf(
    "quad-fading",
    "float:x float:y float:z float:nx float:ny float:nz uchar:red uchar:green uchar:blue uchar:alpha",
    [
      [-1, -1],
      [1, -1],
      [1, 1],
      [-1, 1],
    ].map(([x, y]) => `${x} ${y} 0 0 0 1 255 255 255 ${x! < 0 ? 0 : 255}`),
    ["3 0 1 2", "3 0 2 3"],
  );

const [columns, rows] = [4, 2];
/** By column and row from the top. */
const texel = (column: number, row: number): [number, number, number] => [
  40 + 60 * column,
  200 - 90 * row,
  30 + 17 * column + 100 * row,
];
const picture: Picture = {
  width: columns,
  height: rows,
  channels: 3,
  data: Uint8Array.from(
    Array.from({ length: rows }, (_, row) => Array.from({ length: columns }, (_, column) => texel(column, row))).flat(
      2,
    ),
  ),
};

/** The same picture as an SFImage: rows from the lowest up. */
const numbers = [
  columns,
  rows,
  3,
  ...Array.from({ length: columns * rows }, (_, n) => texel(n % columns, rows - 1 - Math.floor(n / columns))).map(
    ([r, g, b]) => `0x${((r << 16) | (g << 8) | b).toString(16)}`,
  ),
].join(" ");

/** The texel that texture coordinates name, the first row being the highest. */
const texelAt = (s: number, t: number): [number, number, number] =>
  texel(Math.min(columns - 1, Math.floor(s * columns)), rows - 1 - Math.min(rows - 1, Math.floor(t * rows)));

interface Case {
  what: string;
  site: string;
  maxTexCoord: number;
  appearance: string;
  /** From the quad's texture coordinates to the picture's. */
  expected: (s: number, t: number) => [number, number, number];
  change?: (shape: string) => string;
  alphaMode?: string;
  /** 0..255 */
  tolerance?: number;
}

const nearest =
  '<TextureProperties magnificationFilter="NEAREST_PIXEL" minificationFilter="NEAREST_PIXEL"></TextureProperties>';
const white = '<Material diffuseColor="1 1 1" ambientIntensity="0"></Material>';
const image = (attributes = "", inside = nearest): string =>
  `<ImageTexture url="texels.png" ${attributes}>${inside}</ImageTexture>`;
const wrapped = (value: number): number => value - Math.floor(value);
const clamped = (value: number): number => Math.min(0.999, Math.max(0, value));
const mirrored = (value: number): number => (Math.floor(value) % 2 === 0 ? wrapped(value) : 0.999999 - wrapped(value));
const properties = (s: string, t: string): string =>
  nearest.replace("<TextureProperties", `<TextureProperties boundaryModeS="${s}" boundaryModeT="${t}"`);

const cases = (): Case[] => [
  ...[
    ["--profile", "classic"],
    ["--container", "bg"],
    ["--container", "bg", "--coord-type", "float32"],
    ["--profile", "compact"],
  ].map((options): Case => ({
    what: options.join(" "),
    site: siteOf(quad(1), ...options),
    maxTexCoord: 1,
    appearance: white + image(),
    expected: texelAt,
  })),
  {
    what: "on the CPU",
    site: siteOf(quad(1), "--profile", "classic"),
    maxTexCoord: 1,
    appearance: white + image(),
    expected: texelAt,
    change: (shape) => shape.replace(/<ImageGeometry/i, '$& decode="cpu"'),
  },
  {
    what: "repeated",
    site: siteOf(quad(3), "--profile", "classic"),
    maxTexCoord: 3,
    appearance: white + image(),
    expected: (s, t) => texelAt(wrapped(s), wrapped(t)),
  },
  {
    what: "clamped",
    site: siteOf(quad(3), "--profile", "classic"),
    maxTexCoord: 3,
    appearance: white + image("", properties("CLAMP_TO_EDGE", "REPEAT")),
    expected: (s, t) => texelAt(clamped(s), wrapped(t)),
  },
  {
    what: "mirrored",
    site: siteOf(quad(3), "--profile", "classic"),
    maxTexCoord: 3,
    appearance: white + image("", properties("REPEAT", "MIRRORED_REPEAT")),
    expected: (s, t) => texelAt(wrapped(s), mirrored(t)),
  },
  {
    what: "translated, rotated and scaled",
    site: siteOf(quad(1), "--profile", "classic"),
    maxTexCoord: 1,
    appearance: `${white}${image()}<TextureTransform translation="0.25 0.5" rotation="1.5707963" scale="2 0.5" center="0.5 0.25"></TextureTransform>`,
    expected: (s, t) => {
      const [x, y] = [s + 0.25 + 0.5, t + 0.5 + 0.25]; // T, C
      return texelAt(wrapped(-y * 2 - 0.5), wrapped(x * 0.5 - 0.25)); // R, S, -C
    },
  },
  {
    what: "of a physical material",
    site: siteOf(quad(1), "--profile", "classic"),
    maxTexCoord: 1,
    appearance: `<PhysicalMaterial metallic="0" roughness="1">${image('containerField="baseTexture"')}</PhysicalMaterial>`,
    expected: texelAt,
    tolerance: 12,
  }, // 4 % of the light is reflected specularly instead

  {
    what: "unlit",
    site: siteOf(quad(1), "--profile", "classic"),
    maxTexCoord: 1,
    appearance: `<UnlitMaterial>${image('containerField="emissiveTexture"')}</UnlitMaterial>`,
    expected: texelAt,
  },
  {
    what: "of a PixelTexture, multiplied by the material",
    site: siteOf(quad(1), "--profile", "classic"),
    maxTexCoord: 1,
    appearance: `<Material diffuseColor="0.5 1 0" ambientIntensity="0"><PixelTexture image="${numbers}" containerField="diffuseTexture">${nearest}</PixelTexture></Material>`,
    expected: (s, t) => {
      const [r, g] = texelAt(s, t);
      return [r / 2, g, 0];
    },
  },
  {
    what: "of emissive colour",
    site: siteOf(quad(1), "--profile", "classic"),
    maxTexCoord: 1,
    appearance: `<Material diffuseColor="0 0 0" emissiveColor="1 0.5 1">${image('containerField="emissiveTexture"')}</Material>`,
    expected: (s, t) => {
      const [r, g, b] = texelAt(s, t);
      return [r, g / 2, b];
    },
  },
  {
    what: "of normals, lit by the headlight and from the upper right",
    site: siteOf(quad(1), "--container", "bg"),
    maxTexCoord: 1,
    appearance: `<Material diffuseColor="0.5 0.5 0.5" ambientIntensity="0">${dataImage("normal.png", "normalTexture")}</Material>`,
    expected: () => {
      const grey = 127.5 * (tilted[2] + sideLight * (tilted[0] + tilted[1]) * Math.SQRT1_2);
      return [grey, grey, grey];
    },
    tolerance: 4,
  },
  {
    what: "of metallic and roughness",
    site: siteOf(quad(1), "--profile", "compact"),
    maxTexCoord: 1,
    appearance: `<PhysicalMaterial metallic="1" roughness="1">${image('containerField="baseTexture"')}${dataImage("plain.png", "metallicRoughnessTexture")}</PhysicalMaterial>`,
    expected: texelAt,
    tolerance: 12,
  },
  {
    what: "with holes",
    site: siteOf(quad(1), "--profile", "classic"),
    maxTexCoord: 1,
    appearance: white + dataImage("holes.png", "texture"),
    alphaMode: "MASK",
    expected: (s) => (s < 0.5 ? [0, 0, 0] : [200, 100, 50]),
  },
  ...["classic", "compact"].map((profile): Case => ({
    what: `whose vertices hide half of it, in ${profile}`,
    site: siteOf(fadingQuad(), "--profile", profile),
    maxTexCoord: 1,
    appearance: white,
    alphaMode: "MASK",
    expected: (s) => (s < 0.5 ? [0, 0, 0] : [255, 255, 255]),
  })),
];

const dataImage = (url: string, field: string): string =>
  `<ImageTexture url="${url}" containerField="${field}">${nearest}</ImageTexture>`;
/** The normal in every texel of the normal map, and the light that shows its direction. */
const tilted = [0.48, 0.36, 0.8] as const;
const sideLight = 0.4;
const withSideLight = `<DirectionalLight direction="-1 -1 0" intensity="${sideLight}"></DirectionalLight>`;

/** One row of texels. */
const rowOf = (channels: 3 | 4, ...data: number[]): Buffer =>
  encodePng({ width: data.length / channels, height: 1, channels, data: Uint8Array.from(data) });
const dataFiles = {
  "normal.png": rowOf(3, ...tilted.map((value) => Math.round(127.5 * (value + 1)))),
  "plain.png": rowOf(3, 0, 255, 0), // rough, and no metal
  "holes.png": rowOf(4, 200, 100, 50, 0, 200, 100, 50, 255),
};

const perRow = 6;
const positionOf = (n: number): [number, number] => [2.5 * (n % perRow) - 6.25, 2.5 - 2.5 * Math.floor(n / perRow)];
const distance = 14;

/** The pixel of a point of the plane z = 0. */
function pixelAt(x: number, y: number): [number, number] {
  const scale = pictureSize.height / 2 / Math.tan(0.7854 / 2) / distance;
  return [Math.floor(pictureSize.width / 2 + x * scale), Math.floor(pictureSize.height / 2 - y * scale)];
}

const colorAt = ({ data, channels, width }: Picture, [x, y]: [number, number]): number[] => [
  ...data.subarray((y * width + x) * channels, (y * width + x) * channels + 3),
];

const viewpoint = (z: number): string =>
  `<NavigationInfo type='"EXAMINE" "ANY"'></NavigationInfo><Background skyColor="0 0 0"></Background><Viewpoint position="0 0 ${z}" fieldOfView="0.7854"></Viewpoint>`;

/** Whether the pointer hits something there. */
const hitAt = (view: View, pixel: readonly [number, number]): Promise<boolean> =>
  view.page.evaluate(
    ([x, y]) =>
      (
        document.querySelector("x3d") as unknown as { positionAndNormalFromPoint: (x: number, y: number) => unknown }
      ).positionAndNormalFromPoint(x, y) !== null,
    pixel,
  );

function texturedScene(): { directory: string; all: Case[] } {
  const all = cases();
  const shapes = all.map(({ site, appearance, alphaMode = "AUTO", change = (shape) => shape }, n) => {
    const [x, y] = positionOf(n);
    const shape = change(shapeInFolder(site, `q${n}`)).replace(
      /<Appearance[\s\S]*<\/Appearance>/i,
      `<Appearance alphaMode="${alphaMode}">${appearance}</Appearance>`,
    );
    const inFolder = shape.replaceAll(/(["'])geometry\//g, `$1q${n}/geometry/`); // compact's too
    return `<Transform translation="${x} ${y} 0">${inFolder}</Transform>`;
  });
  const directory = sceneOf(
    "textures",
    Object.fromEntries(all.map(({ site }, n) => [`q${n}`, site])),
    viewpoint(distance) + withSideLight + shapes.join("\n"),
  );
  for (const [name, bytes] of Object.entries({ ...dataFiles, "texels.png": encodePng(picture) }))
    writeFileSync(join(directory, name), bytes);
  return { directory, all };
}

describe("a texture", () => {
  soakTest(
    "is applied to surfaces of every container as X3D specifies, and requested once, after all other files",
    async () => {
      const { directory, all } = texturedScene();
      const { closed, open } = gate();
      await withPage(
        directory,
        { server: (server) => server.when(/\/(texels|normal|plain|holes)\.png$/, { hold: closed }) },
        async (view) => {
          await until(
            "everything but the texture is displayed",
            async () => (await view.events("first-image", "shape")).length === all.length,
          );
          await until("the texture is requested", () => view.server.requestsOf(/texels\.png$/).length > 0);
          const [textured, others] = [
            all.filter(({ appearance }) => appearance.includes("url=")).length,
            (await view.events("load", "shape")).length,
          ];
          assert.ok(
            textured + others <= all.length,
            `${others} of ${all.length} shapes are loaded, but ${textured} wait for their texture`,
          );
          assert.deepEqual(await view.events("load", "x3d"), []); // the scene waits for the textures
          open();
          await view.promise("complete");
          const shown = await view.picture();
          savePicture("textures", shown);
          for (const [n, { what, maxTexCoord, expected, tolerance = 2 }] of all.entries()) {
            const [x, y] = positionOf(n);
            let compared = 0;
            for (let step = 0; step < 121; ++step) {
              const [u, v] = [((step % 11) + 0.52) / 11, (Math.floor(step / 11) + 0.52) / 11];
              const found = colorAt(shown, pixelAt(x + 2 * u - 1, y + 2 * v - 1));
              const expectedColor = expected(u * maxTexCoord, v * maxTexCoord);
              // A pixel on the border between two texels may have either colour.
              const isInside = [-0.02, 0.02].every((away) =>
                [
                  [away, away],
                  [away, -away],
                ].every(
                  ([a, b]) => expected((u + a!) * maxTexCoord, (v + b!) * maxTexCoord).join() === expectedColor.join(),
                ),
              );
              if (!isInside) continue;
              compared += 1;
              assert.ok(
                expectedColor.every((channel, i) => Math.abs(channel - found[i]!) <= tolerance),
                `${what}, at ${u.toFixed(2)} ${v.toFixed(2)}: ${found.join()} instead of ${expectedColor.join()}`,
              );
            }
            assert.ok(compared >= 20, `${what}: ${compared} points`);
          }
          for (const [n, { what, alphaMode }] of all.entries()) {
            if (alphaMode !== "MASK") continue;
            const [x, y] = positionOf(n);
            assert.deepEqual(
              [await hitAt(view, pixelAt(x - 0.5, y)), await hitAt(view, pixelAt(x + 0.5, y))],
              [false, true],
              what,
            );
          }
          assert.equal(view.server.requestsOf(/texels\.png$/).length, 3); // once for each wrap mode
        },
      );
    },
  );

  test("is the first of its URLs that decodes, without an error event", async () => {
    const site = siteOf(quad(1), "--profile", "classic");
    const names = ["absent.png", "cut.png", "page.png", "texels.png", "other.png"];
    const urls = names.map((name) => `"${name}"`).join(" ");
    const shape = shapeInFolder(site, "q").replace(
      /<Appearance[\s\S]*<\/Appearance>/i,
      `<Appearance>${white}<ImageTexture url='${urls}'>${nearest}</ImageTexture></Appearance>`,
    );
    const directory = sceneOf("texture-urls", { q: site }, viewpoint(distance) + shape);
    const png = encodePng(picture);
    const files = { "cut.png": png.subarray(0, png.length / 2), "page.png": "<!DOCTYPE html>", "texels.png": png };
    for (const [name, bytes] of Object.entries(files)) writeFileSync(join(directory, name), bytes);
    await withPage(directory, { expectedErrors: /404/ }, async (view) => {
      await view.promise("complete");
      for (const [u, v] of [
        [0.12, 0.2],
        [0.4, 0.8],
        [0.9, 0.3],
      ] as const)
        assert.deepEqual(colorAt(await view.picture(), pixelAt(2 * u - 1, 2 * v - 1)), texelAt(u, v));
      assert.deepEqual(await view.events("error", "x3d"), []);
      assert.deepEqual(
        names.map((name) => view.server.requestsOf(new RegExp(name)).length),
        [1, 1, 1, 1, 0],
      );
    });
  });

  test("that fails is missing from its shape only; without a texture its coordinates are not fetched", async () => {
    const site = siteOf(quad(1), "--profile", "classic");
    const plain = sceneOf("untextured", { q: site }, viewpoint(distance) + shapeInFolder(site, "q"));
    let without = 0;
    await withPage(plain, {}, async (view) => {
      await view.promise("complete");
      without = view.server.requestsOf(/geometry/).length;
    });
    const shape = shapeInFolder(site, "q").replace(
      /<Appearance[\s\S]*<\/Appearance>/i,
      `<Appearance>${white}${image()}</Appearance>`,
    );
    const directory = sceneOf("texture-missing", { q: site }, viewpoint(distance) + shape);
    await withPage(directory, { expectedErrors: /404|imgeo/ }, async (view) => {
      await view.promise("complete");
      assert.equal(view.server.requestsOf(/geometry/).length, without + 1);
      const [error] = await view.events("error", "shape");
      assert.deepEqual([error?.detail.type, error?.detail.url], ["http", "texels.png"]);
      assert.deepEqual(colorAt(await view.picture(), pixelAt(0.3, 0.3)), [255, 255, 255]);
    });
  });
});

describe("points", () => {
  /** Two points, the second farther away and with a normal that faces away. */
  const cloud = (): string =>
    siteOf(
      plyOf("two-points", "float:x float:y float:z float:nx float:ny float:nz", ["-1 0 0 0 0 1", "2 0 -10 0 0 -1"]),
    );

  async function withPoints(properties: string, check: (view: View, picture: Picture) => Promise<void>): Promise<void> {
    const site = cloud();
    const shape = shapeInFolder(site, "cloud").replace(
      /<Appearance[\s\S]*<\/Appearance>/i,
      `<Appearance><Material diffuseColor="1 1 1" ambientIntensity="0"></Material>${properties}</Appearance>`,
    );
    await withPage(sceneOf("points-sized", { cloud: site }, viewpoint(10) + shape), {}, async (view) => {
      await view.promise("complete");
      await check(view, await view.picture());
    });
  }

  const scale = pictureSize.height / 2 / Math.tan(0.7854 / 2);
  const near: [number, number] = [pictureSize.width / 2 - scale / 10, pictureSize.height / 2];
  const far: [number, number] = [pictureSize.width / 2 + (2 * scale) / 20, pictureSize.height / 2];
  const isLit = (picture: Picture, [x, y]: [number, number], right: number, down: number): boolean =>
    colorAt(picture, [Math.floor(x + right), Math.floor(y + down)])[0]! > 100;
  async function assertDisc(view: View, picture: Picture, at: [number, number], diameter: number): Promise<void> {
    const inside = diameter / 2 - 1.5;
    const outside = diameter / 2 + 1.5;
    const diagonal = Math.SQRT1_2;
    for (const [right, down] of [
      [0, 0],
      [1, 0],
      [0, 1],
      [-1, 0],
      [0, -1],
      [diagonal, diagonal],
      [-diagonal, diagonal],
    ] as const) {
      assert.ok(
        isLit(picture, at, right * inside, down * inside),
        `dark at ${right} ${down} of a point of ${diameter}`,
      );
      assert.ok(
        await hitAt(view, [at[0] + right * inside, at[1] + down * inside]),
        `not hit at ${right} ${down} of a point of ${diameter}`,
      );
      if (right === 0 && down === 0) continue;
      assert.ok(
        !isLit(picture, at, right * outside, down * outside),
        `lit beyond ${right} ${down} of a point of ${diameter}`,
      );
      assert.ok(
        !(await hitAt(view, [at[0] + right * outside, at[1] + down * outside])),
        `hit beyond ${right} ${down} of a point of ${diameter}`,
      );
    }
  }

  test("are round, have the size in pixels of PointProperties, are hit where they are drawn, and are lit from both sides", async () => {
    await withPoints('<PointProperties pointSizeScaleFactor="24"></PointProperties>', async (view, picture) => {
      savePicture("points-24", picture);
      await assertDisc(view, picture, near, 24);
      await assertDisc(view, picture, far, 24);
    });
  });

  soakTest("become smaller with distance, within limits", async () => {
    // At distances of about 10 and 20.
    await withPoints(
      '<PointProperties pointSizeScaleFactor="40" attenuation="0 0.1 0"></PointProperties>',
      async (view, picture) => {
        savePicture("points-far", picture);
        await assertDisc(view, picture, near, 40 / (0.1 * Math.hypot(10, 1)));
        await assertDisc(view, picture, far, 40 / (0.1 * Math.hypot(20, 2)));
      },
    );
    await withPoints(
      '<PointProperties pointSizeScaleFactor="40" attenuation="0 0.1 0" pointSizeMinValue="28" pointSizeMaxValue="30"></PointProperties>',
      async (view, picture) => {
        await assertDisc(view, picture, near, 30);
        await assertDisc(view, picture, far, 28);
      },
    );
  });
});
