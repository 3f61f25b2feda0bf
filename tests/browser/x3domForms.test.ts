// Tests the forms of X3DOM's geometry nodes that imgeo does not write itself: each is drawn as the same vertices in
// nodes with their numbers in the document are.

import assert from "node:assert/strict";
import { test } from "node:test";
import { assertSamePicture, boundsOfQuantised, difference, savePicture } from "./compare.ts";
import { withPage, type View } from "./harness.ts";
import { encodePng, type Picture } from "./png.ts";
import { referencePicture } from "./reference.ts";
import { pageOf, siteOfGenerated } from "./sites.ts";
import { soakTest } from "./soak.ts";

const site = (): string => siteOfGenerated("trefoil", "--profile", "classic");

/** A square's corners, in units of 1/255 of the box -1 … 1. */
const corners = [
  [51, 51, 128],
  [204, 51, 128],
  [204, 204, 128],
  [51, 204, 128],
] as const;
const points = corners.map((corner) => corner.map((byte) => ((2 * byte) / 255 - 1).toFixed(6)).join(" ")).join(", ");
/** Tilted normals, as 16-bit numbers that differ from 8-bit ones. */
const normals = [
  [40000, 30000, 60000],
  [20000, 35000, 60000],
  [33000, 52345, 60000],
  [45000, 50000, 60000],
] as const;
const vectors = normals.map((normal) => normal.map((word) => ((2 * word) / 65535 - 1).toFixed(6)).join(" ")).join(", ");

function imageOf(texels: readonly (readonly number[])[]): Buffer {
  return encodePng({ width: texels.length, height: 1, channels: 3, data: Uint8Array.from(texels.flat()) });
}

const files = new Map<string, Buffer>([
  ["/form/coord.png", imageOf(corners)],
  ["/form/high.png", imageOf(normals.map((normal) => normal.map((word) => word >> 8)))],
  ["/form/low.png", imageOf(normals.map((normal) => normal.map((word) => word & 255)))],
  ["/form/color.png", imageOf(corners.map((corner) => [...corner]))],
  ["/form/coord.bin", Buffer.from(Float32Array.from(corners.flat().map((byte) => (2 * byte) / 255 - 1)).buffer)],
  ["/form/fan.bin", Buffer.from(Uint16Array.of(0, 1, 2, 0, 2, 3).buffer)],
  // Per face, not per vertex: their count does not fit the vertices.
  ["/form/faces.bin", Buffer.from(Float32Array.of(1, 0, 0, 1, 0, 0).buffer)],
]);

const coord = '<ImageTexture containerField="coord" url="form/coord.png"></ImageTexture>';
const normalImages = ["high", "low"]
  .map((name) => `<ImageTexture containerField="normal" url="form/${name}.png"></ImageTexture>`)
  .join("");
const image = (attributes: string, children: string) =>
  `<ImageGeometry position="0 0 0" size="2 2 2" implicitMeshSize="4 1" ${attributes}>${children}</ImageGeometry>`;
const arrays = (attributes: string) =>
  `<BinaryGeometry position="0 0 0" size="2 2 2" coord="form/coord.bin" ${attributes}></BinaryGeometry>`;
const fan = (attributes: string, children = "") =>
  `<TriangleFanSet fanCount="4" ${attributes}><Coordinate point="${points}"></Coordinate>${children}</TriangleFanSet>`;
const normal = `<Normal vector="${vectors}"></Normal>`;

/** Each form, and the same in nodes of X3D; nothing where nothing is visible. */
const forms: readonly { readonly form: string; readonly reference: string }[] = [
  {
    form: image('primType="TRIANGLEFAN" vertexCount="4"', coord + normalImages),
    reference: fan("", normal),
  },
  // The corners run counterclockwise: with ccw="false" the back is visible, which is not drawn.
  { form: image('ccw="false" primType="TRIANGLEFAN" vertexCount="4"', coord + normalImages), reference: "" },
  {
    form: image('ccw="false" solid="false" primType="TRIANGLEFAN" vertexCount="4"', coord + normalImages),
    reference: fan('ccw="false" solid="false"', normal),
  },
  {
    form: image(
      'lit="false" primType="TRIANGLEFAN" vertexCount="4" implicitMeshMode="auto"',
      '<Texture DEF="A" containerField="coord"><img src="form/coord.png"></Texture><Texture USE="A" containerField="color"></Texture>',
    ),
    reference: "colors",
  },
  { form: arrays('primType="LINELOOP" vertexCount="4"'), reference: "loop" },
  {
    form: arrays('index="form/fan.bin" vertexCount="6" normal="form/faces.bin" normalPerVertex="false"'),
    reference: fan('normalPerVertex="false"'),
  },
  {
    form: image(
      'primType="TRIANGLEFAN" vertexCount="4"',
      '<Texture containerField="coord"><canvas width="4" height="1"></canvas></Texture>' + normalImages,
    ),
    reference: fan("", normal),
  },
  { form: '<PopGeometry size="2 2 2"></PopGeometry>', reference: "" },
];

const colors = corners.map((corner) => corner.map((byte) => (byte / 255).toFixed(6)).join(" ")).join(", ");
const special: Readonly<Record<string, string>> = {
  colors: fan("", `<Color color="${colors}"></Color>`),
  loop: `<IndexedLineSet coordIndex="0 1 2 3 0 -1"><Coordinate point="${points}"></Coordinate></IndexedLineSet>`,
};

function pageWith(geometryOf: (index: number) => string): string {
  const shapes = forms.map((_, index) => {
    const geometry = geometryOf(index);
    const isUnlit = forms[index]?.reference === "colors";
    const material =
      isUnlit && geometry.startsWith("<Triangle")
        ? ""
        : '<Material diffuseColor="0.35 0.3 0.25" emissiveColor="0.05 0.02 0"></Material>';
    const appearance = `<Appearance>${material}</Appearance>`;
    const at = `${2 * (index % 4) - 3} ${index < 4 ? 1 : -1} 0`;
    return geometry === ""
      ? ""
      : `<Transform translation="${at}"><Shape bboxSize="2 2 2">${appearance}${geometry}</Shape></Transform>`;
  });
  return pageOf(site())
    .replace(/<link rel="preload"[^>]*>/g, "")
    .replace(/<Shape[\s\S]*<\/Shape>/i, () => shapes.join("\n"))
    .replace(/<Viewpoint[^>]*>/i, '<Viewpoint position="0 0 9" orientation="0 0 1 0" fieldOfView="0.6">');
}

const serving = (html: string) => (server: View["server"]) => {
  for (const [path, body] of files) server.put(path, body);
  server.when(/^\/$/, { replace: () => html });
};

async function pictureOf(html: string): Promise<Picture> {
  let picture: Picture | undefined;
  await withPage(site(), { server: serving(html) }, async (view) => {
    await view.promise("complete");
    picture = await view.picture();
  });
  return picture ?? assert.fail("no picture");
}

test("X3DOM's forms are drawn as the same vertices in the document are, and a foreign node sends an error", async () => {
  const reference = pageWith((index) => {
    const name = forms[index]?.reference ?? "";
    return special[name] ?? name;
  });
  const expected = await pictureOf(reference);
  savePicture("X3DOM forms, reference", expected);
  const html = pageWith((index) => forms[index]?.form ?? "");
  await withPage(site(), { server: serving(html), expectedErrors: /PopGeometry/i }, async (view) => {
    await view.promise("complete");
    const before = await view.picture();
    assert.ok(difference(before, expected).mean > boundsOfQuantised.mean, "an empty canvas draws nothing");
    const errors = await view.page.evaluate(() =>
      (document.querySelector("x3d") as unknown as { errors: { type: string; message: string }[] }).errors.map(
        ({ type, message }) => `${type}: ${message}`,
      ),
    );
    assert.equal(errors.length, 1);
    assert.match(errors[0] ?? "", /^unsupported: <popgeometry> pages do not draw it; imgeo convert reads/);
    await view.page.evaluate((texels) => {
      const canvas = document.querySelector("canvas[width='4']");
      if (!(canvas instanceof HTMLCanvasElement)) throw new Error("no canvas");
      const context = canvas.getContext("2d");
      const pixels = new ImageData(Uint8ClampedArray.from(texels.flatMap((texel) => [...texel, 255])), 4, 1);
      context?.putImageData(pixels, 0, 0);
      canvas.setAttribute("data-frame", "1"); // lets the page be read again
    }, corners);
    await view.page.evaluate(() => new Promise((resolve) => setTimeout(resolve, 200)));
    const picture = await view.picture();
    savePicture("X3DOM forms", picture);
    assertSamePicture("X3DOM forms", picture, expected, boundsOfQuantised);
  });
});

/** A plate of two triangles, a zigzag of lines and four points, in units of 1/255 of the box -1 … 1. */
const mixedRecords = [
  ...[20, 110].flatMap((x) => [20, 110].map((y) => [x, y, x])),
  ...[0, 1, 2, 3].map((n) => [140 + 30 * n, n % 2 === 0 ? 30 : 120, 90]),
  ...[0, 1, 2, 3].map((n) => [30 + 65 * n, 170 + 20 * (n % 2), 200]),
];
const mixedNormals = mixedRecords.map((_, n) => [100 + 10 * n, 230 - 15 * n, 220]);
const mixedIndices = { triangles: [0, 2, 1, 1, 2, 3], lines: [4, 5, 5, 6, 6, 7], points: [8, 9, 10, 11] };
const mixedIndex = [...mixedIndices.triangles, ...mixedIndices.lines, ...mixedIndices.points];
const inBox = (records: readonly (readonly number[])[]): number[] => records.flat().map((byte) => (2 * byte) / 255 - 1);

files.set("/form/mixed.png", imageOf(mixedRecords));
files.set("/form/mixedNormal.png", imageOf(mixedNormals));
// X3DOM's index: the share of the image's width at which the record is.
files.set("/form/mixedIndex.png", imageOf(mixedIndex.map((n) => [Math.round((256 * n) / mixedRecords.length), 0, 0])));
files.set("/form/mixed.bin", Buffer.from(Float32Array.from(inBox(mixedRecords)).buffer));
files.set("/form/mixedNormal.bin", Buffer.from(Float32Array.from(inBox(mixedNormals)).buffer));
files.set("/form/mixedIndex.bin", Buffer.from(Uint16Array.from(mixedIndex).buffer));

soakTest(
  "triangles, lines and points of one node, in arrays and in images, are drawn as three.js draws them",
  async () => {
    const attributes = `position="0 0 0" size="2 2 2" primType='"TRIANGLES" "LINES" "POINTS"' vertexCount="6 6 4"`;
    const texture = (field: string, name: string): string =>
      `<ImageTexture containerField="${field}" url="form/${name}.png"></ImageTexture>`;
    const nodes = [
      `<BinaryGeometry ${attributes} index="form/mixedIndex.bin" coord="form/mixed.bin" normal="form/mixedNormal.bin"></BinaryGeometry>`,
      `<ImageGeometry ${attributes} implicitMeshSize="${mixedIndex.length} 1">${texture("index", "mixedIndex")}${texture("coord", "mixed")}${texture("normal", "mixedNormal")}</ImageGeometry>`,
    ];
    const offsets = [-1.2, 1.2];
    const material = '<Appearance><Material diffuseColor="0.8 0.6 0.3"></Material></Appearance>';
    const shapes = nodes.map(
      (node, n) =>
        `<Transform translation="${offsets[n]} 0 0"><Shape bboxSize="2 2 2">${material}${node}</Shape></Transform>`,
    );
    const html = pageWith(() => "").replace("</Scene>", `${shapes.join("\n")}</Scene>`);
    const picture = await pictureOf(html);
    savePicture("mixed primitives", picture);
    const none = new Uint32Array(0);
    const patches = offsets.flatMap((offset) =>
      Object.entries(mixedIndices).map(([kind, indices]) => ({
        positions: Float32Array.from(inBox(mixedRecords), (value, n) => (n % 3 === 0 ? value + offset : value)),
        normals: Float32Array.from(inBox(mixedNormals)),
        ...{ triangles: none, lines: none, points: none, [kind]: Uint32Array.from(indices) },
      })),
    );
    const expected = await referencePicture(html, patches);
    assertSamePicture("mixed primitives", picture, expected, boundsOfQuantised);
  },
);
