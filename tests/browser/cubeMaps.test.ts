// Tests cube maps and EnvironmentLight: spheres show the texel of each direction that OpenGL's cube maps have there,
// computed here from the view's rays alone.

import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { allTextures } from "../../web/src/document/physicalMaterials.testing.ts";
import { withPage, type View } from "./harness.ts";
import { encodePng, type Picture } from "./png.ts";
import { sceneOf } from "./scenes.ts";
import { startServer, type TestServer } from "./server.ts";
import { siteOfGenerated } from "./sites.ts";

type Vec3 = readonly [number, number, number];

const size = { width: 1080, height: 150 };
/** The eye's distance from the spheres, and half of the visible height there. */
const eye = 20,
  halfHeight = 1.25;
const fieldOfView = 2 * Math.atan(halfHeight / eye);
/** The scene is turned by this about y, so that the camera's axes are not the scene's. */
const turn = 0.6;

const sides = ["front", "back", "left", "right", "top", "bottom"] as const;
type Side = (typeof sides)[number];
const edge = 32;

/** The texel of a side at s and t, 0 … 1 from the upper left corner. */
function texelOf(side: Side, s: number, t: number): Vec3 {
  return [20 + 40 * sides.indexOf(side), s < 0.5 ? 30 : 230, t < 0.5 ? 30 : 230];
}

function pictureOf(columns: number, rows: number, cells: Partial<Record<Side, readonly [number, number]>>): Uint8Array {
  const [width, height] = [columns * edge, rows * edge];
  const data = new Uint8Array(width * height * 3);
  for (const [side, [column, row]] of Object.entries(cells) as [Side, [number, number]][])
    for (let y = 0; y < edge; ++y)
      for (let x = 0; x < edge; ++x)
        data.set(texelOf(side, x / edge, y / edge), ((row * edge + y) * width + column * edge + x) * 3);
  return encodePng({ width, height, channels: 3, data });
}

/** Axes of OpenGL's faces: the direction of the face, of growing s and of growing t (OpenGL ES 3.0, table 3.19). */
const axes: Readonly<Record<Side, readonly [face: Vec3, s: Vec3, t: Vec3]>> = {
  right: [
    [1, 0, 0],
    [0, 0, -1],
    [0, -1, 0],
  ],
  left: [
    [-1, 0, 0],
    [0, 0, 1],
    [0, -1, 0],
  ],
  top: [
    [0, 1, 0],
    [1, 0, 0],
    [0, 0, 1],
  ],
  bottom: [
    [0, -1, 0],
    [1, 0, 0],
    [0, 0, -1],
  ],
  front: [
    [0, 0, 1],
    [1, 0, 0],
    [0, -1, 0],
  ],
  back: [
    [0, 0, -1],
    [-1, 0, 0],
    [0, -1, 0],
  ],
};

const dot = (a: Vec3, b: Vec3): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** The texel in a direction; undefined near a border of colours. */
function cubeTexel(direction: Vec3): Vec3 | undefined {
  const side = sides.reduce((best, each) =>
    dot(axes[each][0], direction) > dot(axes[best][0], direction) ? each : best,
  );
  const depth = dot(axes[side][0], direction);
  const [s, t] = [dot(axes[side][1], direction) / depth, dot(axes[side][2], direction) / depth];
  const isClear = [s, t].every((value) => Math.abs(value) > 0.2 && Math.abs(value) < 0.8);
  return isClear ? texelOf(side, (s + 1) / 2, (t + 1) / 2) : undefined;
}

const turned = ([x, y, z]: Vec3): Vec3 => [
  Math.cos(turn) * x + Math.sin(turn) * z,
  y,
  Math.cos(turn) * z - Math.sin(turn) * x,
];

interface Sphere {
  readonly x: number;
  readonly markup: string;
  /** The direction that its cube map is read in, of the view's ray and the normal, in the camera's axes. */
  readonly read: (ray: Vec3, normal: Vec3) => Vec3;
}

const reflected = (ray: Vec3, normal: Vec3): Vec3 => {
  const twice = 2 * dot(ray, normal);
  return [ray[0] - twice * normal[0], ray[1] - twice * normal[1], ray[2] - twice * normal[2]];
};

const composed = sides
  .map((side) => `<ImageTexture containerField="${side}" url="${side}.png"></ImageTexture>`)
  .join("");
const mirror = `<PhysicalMaterial roughness="0"></PhysicalMaterial>`;
const ball = (appearance: string, generator = ""): string =>
  `<Shape><Appearance>${appearance}</Appearance>${generator}<Sphere></Sphere></Shape>`;
const generator = (mode: string): string => `<TextureCoordinateGenerator mode="${mode}"></TextureCoordinateGenerator>`;
const white = `<UnlitMaterial></UnlitMaterial>`;

/** A room of walls in the texels' colors, which are seen from within: 1.3 from its center, in the scene's axes. */
function room(): string {
  const points: number[] = [],
    colors: number[] = [];
  for (const side of sides) {
    const [face, right, down] = axes[side];
    for (const [s, t] of [
      [-1, -1],
      [0, -1],
      [-1, 0],
      [0, 0],
    ] as const) {
      for (const [i, j] of [
        [s, t],
        [s + 1, t],
        [s + 1, t + 1],
        [s, t + 1],
      ] as const)
        points.push(...[0, 1, 2].map((k) => 1.3 * (face[k]! + i * right[k]! + j * down[k]!)));
      colors.push(...texelOf(side, (s + 1) / 2, (t + 1) / 2).map((value) => value / 255));
    }
  }
  const indices = Array.from(
    { length: colors.length / 3 },
    (_, i) => `${4 * i} ${4 * i + 1} ${4 * i + 2} ${4 * i + 3} -1`,
  );
  return `<Transform id="room" rotation="0 1 0 ${-turn}"><Shape><Appearance>${white}</Appearance>
    <IndexedFaceSet colorPerVertex="false" coordIndex="${indices.join(" ")}"><Coordinate point="${points.join(" ")}"></Coordinate><Color color="${colors.join(" ")}"></Color></IndexedFaceSet></Shape></Transform>`;
}

const spheres: Readonly<Record<string, Sphere>> = {
  "composed, without a generator": {
    x: -4,
    markup: ball(`${white}<ComposedCubeMapTexture DEF="CUBE">${composed}</ComposedCubeMapTexture>`),
    read: (ray, normal) => turned(reflected(ray, normal)),
  },
  "a generated cube map": {
    x: -8,
    markup: `${ball(`${white}<GeneratedCubeMapTexture id="generated" update="NEXT_FRAME_ONLY"></GeneratedCubeMapTexture>`)}${room()}`,
    read: (ray, normal) => turned(reflected(ray, normal)),
  },
  "a cross of another URL than the first, which is lost, and the second, which its host refuses": {
    x: -2,
    markup: ball(
      `${white}<ImageCubeMapTexture url='"lost.png" "ORIGIN/refused.png" "cross.png"'></ImageCubeMapTexture>`,
      generator("CAMERASPACENORMAL"),
    ),
    read: (_, normal) => normal,
  },
  "a row of another host, in the camera's axes": {
    x: 0,
    markup: ball(
      `${white}<ImageCubeMapTexture url="ORIGIN/row.png"></ImageCubeMapTexture>`,
      generator("CAMERASPACEREFLECTIONVECTOR"),
    ),
    read: reflected,
  },
  "an EnvironmentLight": {
    x: 2,
    markup: `${ball(mirror)}<EnvironmentLight id="light" rotation="0 1 0 ${turn}"><ComposedCubeMapTexture USE="CUBE" containerField="specularTexture"></ComposedCubeMapTexture><ComposedCubeMapTexture USE="CUBE" containerField="diffuseTexture"></ComposedCubeMapTexture></EnvironmentLight>
      <Transform translation="4 0 0">${ball(allTextures)}</Transform><EnvironmentLight></EnvironmentLight>`,
    read: (ray, normal) => {
      const [x, y, z] = reflected(ray, normal); // both rotations cancel out
      return [-x, y, z];
    },
  },
};

const scene = `<NavigationInfo headlight="false"></NavigationInfo>
  <Transform rotation="0 1 0 ${turn}"><Viewpoint position="0 0 ${eye}" fieldOfView="${fieldOfView}"></Viewpoint>
  ${Object.values(spheres)
    .map(
      ({ x, markup }) =>
        `<Transform translation="${x} 0 0"><Group>${markup.replace(/(?<="light" )rotation="0 1 0 [\d.]+"/, "")}</Group></Transform>`,
    )
    .join("")}
  <Transform translation="4 0 0">${ball(`${mirror}<ImageCubeMapTexture id="none" url="front.png"></ImageCubeMapTexture>`)}</Transform></Transform>`;

function assertSphere({ data, width, height, channels }: Picture, name: string, { x, read }: Sphere): void {
  let count = 0,
    wrong = 0;
  let example = "";
  for (let row = 0; row < height; row += 3) {
    for (let column = 0; column < width; column += 3) {
      const unit = height / 2 / halfHeight;
      const [dx, dy] = [(column + 0.5 - width / 2) / unit, (height / 2 - row - 0.5) / unit];
      const length = Math.hypot(dx, dy, eye);
      const ray: Vec3 = [dx / length, dy / length, -eye / length];
      // The nearer intersection with the sphere around (x, 0, 0).
      const [fromX, fromZ] = [-x, eye];
      const b = ray[0] * fromX + ray[2] * fromZ;
      const root = b * b - (fromX * fromX + fromZ * fromZ - 1);
      if (root < 0.25) continue; // sides of a sphere of triangles are too steep to compare
      const distance = -b - Math.sqrt(root);
      const normal: Vec3 = [fromX + distance * ray[0], distance * ray[1], fromZ + distance * ray[2]];
      const expected = cubeTexel(read(ray, normal));
      if (expected === undefined) continue;
      const at = (row * width + column) * channels;
      const off = Math.max(...expected.map((value, i) => Math.abs(value - data[at + i]!)));
      count += 1;
      if (off <= 3) continue;
      wrong += 1;
      example = `${expected.join(" ")} at ${column} ${row}, seen ${data.subarray(at, at + 3).join(" ")}`;
    }
  }
  assert.ok(count > 50, `${name}: ${count} pixels are compared`);
  assert.ok(wrong <= count / 50, `${name}: ${wrong} of ${count} pixels differ: ${example}`);
}

/** Runs in the page: notes the largest number of textures that the fragment shader of a program reads. */
function countSamplers(): void {
  const { prototype } = WebGL2RenderingContext;
  // eslint-disable-next-line @typescript-eslint/unbound-method -- called with `this`
  const { useProgram } = prototype;
  const counted = window as unknown as { maxSamplers: number };
  counted.maxSamplers = 0;
  prototype.useProgram = function (this: WebGL2RenderingContext, program: WebGLProgram | null) {
    useProgram.call(this, program);
    if (program === null) return;
    const count = this.getProgramParameter(program, this.ACTIVE_UNIFORMS) as number;
    const types = Array.from({ length: count }, (_, i) => this.getActiveUniform(program, i)?.type);
    const samplers = types.filter((type) => type === this.SAMPLER_2D || type === this.SAMPLER_CUBE);
    counted.maxSamplers = Math.max(counted.maxSamplers, samplers.length);
  };
}

/** A change of the room is seen in the generated cube map when its update is ALWAYS. */
async function assertGeneratedAgain(view: View): Promise<void> {
  const generated = { x: -8, markup: "" };
  const before = (ray: Vec3, normal: Vec3) => turned(reflected(ray, normal));
  await view.page.evaluate((turn) => {
    document.querySelector("#room")!.setAttribute("rotation", `0 1 0 ${Math.PI / 2 - turn}`);
  }, turn);
  assertSphere(await view.picture(), "NEXT_FRAME_ONLY, the room turned", { ...generated, read: before });
  await view.page.evaluate(() => {
    document.querySelector("#generated")!.setAttribute("update", "ALWAYS");
  });
  const after = (ray: Vec3, normal: Vec3): Vec3 => {
    const [x, y, z] = before(ray, normal); // turned back by a quarter
    return [-z, y, x];
  };
  assertSphere(await view.picture(), "ALWAYS, the room turned", { ...generated, read: after });
}

test("cube maps and environment lights show the texels of OpenGL's cube maps", async () => {
  const site = sceneOf("cube-maps", { trefoil: siteOfGenerated("trefoil", "--profile", "classic") }, scene);
  for (const side of sides) writeFileSync(join(site, `${side}.png`), pictureOf(1, 1, { [side]: [0, 0] }));
  const cross = { top: [1, 0], left: [0, 1], front: [1, 1], right: [2, 1], back: [3, 1], bottom: [1, 2] } as const;
  const row = { right: [0, 0], left: [1, 0], top: [2, 0], bottom: [3, 0], front: [4, 0], back: [5, 0] } as const;
  writeFileSync(join(site, "cross.png"), pictureOf(4, 3, cross));
  for (const name of ["row.png", "refused.png"]) writeFileSync(join(site, name), pictureOf(6, 1, row));
  writeFileSync(
    join(site, "texel.png"),
    encodePng({ width: 1, height: 1, channels: 3, data: Buffer.from([99, 99, 99]) }),
  );
  const other = await startServer(site);
  other.when(/row/, { headers: { "Access-Control-Allow-Origin": "*" } });
  const page = join(site, "index.html");
  writeFileSync(page, readFileSync(page, "utf8").replaceAll("ORIGIN/", other.origin));
  const options = {
    size,
    before: countSamplers,
    isCrossOrigin: true,
    server: (server: TestServer): void => void (server.contentPolicy = "default-src 'self'; connect-src *"),
    expectedErrors: /404|no cube map|Access-Control-Allow-Origin|ERR_FAILED/,
  };
  const warnings: string[] = [];
  await withPage(site, options, async (view) => {
    view.page.on("console", (message) => {
      if (message.type() === "warning" && message.text().startsWith("imgeo")) warnings.push(message.text());
    });
    await view.page.waitForFunction(
      () => (document.querySelector("x3d") as { complete?: unknown }).complete !== undefined,
    );
    const errors = await view.page.evaluate(async () => {
      const x3d = document.querySelector("x3d") as unknown as {
        complete: Promise<unknown>;
        errors: { type: string; url: string }[];
      };
      await x3d.complete.catch(() => undefined);
      return x3d.errors.map(({ type, url }) => [type, url.replace(/.*\//, "")]);
    });
    assert.deepEqual(errors, [["unsupported", "front.png"]]);
    const picture = await view.picture();
    for (const [name, sphere] of Object.entries(spheres)) assertSphere(picture, name, sphere);
    await assertGeneratedAgain(view);
    // Out of the light's scope, and with a picture that is no cube map: the grey surroundings.
    const { data, width, channels } = picture;
    const unit = size.height / 2 / halfHeight;
    const center = (75 * width + Math.round(size.width / 2 + 4 * unit)) * channels;
    for (const channel of data.subarray(center, center + 3)) assert.ok(Math.abs(channel - 149) <= 2, `${channel}`);
    // All textures of a PhysicalMaterial and the light's are more than the 16 that every GPU can read.
    const samplers = await view.page.evaluate(() => (window as unknown as { maxSamplers: number }).maxSamplers);
    assert.equal(samplers, 16);
    const crowded = (75 * width + Math.round(size.width / 2 + 6 * unit)) * channels;
    assert.ok(Math.max(...data.subarray(crowded, crowded + 3)) > 10, "the shape with too many textures is drawn");
  });
  await other.close();
  for (const expected of [/has several EnvironmentLights/, /left out: specularStrength, .*thickness$/])
    assert.equal(warnings.filter((warning) => expected.test(warning)).length, 1, warnings.join("\n"));
  assert.equal(warnings.length, 2, warnings.join("\n"));
});
