// Draws Shape Resource Containers in X3DOM, and what convert makes of the same page in the runtime.

import assert from "node:assert/strict";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { assertSamePicture, boundsOfCompact, difference, savePicture } from "../browser/compare.ts";
import { pictureSize, withPage } from "../browser/harness.ts";
import { trefoil, withTexCoords } from "../browser/meshes.ts";
import { outputDirectory } from "../browser/paths.ts";
import { encodePng, type Picture } from "../browser/png.ts";
import { siteOf } from "../browser/sites.ts";
import { pictureOf } from "./releases.ts";

const mesh = withTexCoords(trefoil());

/** A picture of four smooth colours: which side is up shows. */
const texture = encodePng({
  width: 16,
  height: 16,
  channels: 3,
  data: Uint8Array.from(Array.from({ length: 256 }, (_, i) => [16 * (i % 16), i - (i % 16), 60]).flat()),
});

/** A container with the mesh three times: "plain", "textured" with texture coordinates, and "glowing", the scene. */
function container(): Buffer {
  const floats = [mesh.positions, mesh.normals ?? assert.fail(), mesh.texCoords ?? assert.fail()];
  const body = Buffer.concat([
    ...floats.map((array) => Buffer.from(Float32Array.from(array).buffer)),
    Buffer.from(Uint16Array.from(mesh.triangles).buffer),
  ]);
  const count = mesh.positions.length / 3;
  const vertexBytes = 12 * count;
  const accessor = (index: number, components: number) => ({
    bufferView: "vertices",
    byteOffset: index * vertexBytes,
    byteStride: 4 * components,
    componentType: 5126,
    count,
    type: `VEC${components}`,
  });
  const attributes = { POSITION: "positions", NORMAL: "normals" };
  const json = Buffer.from(
    JSON.stringify({
      asset: { version: "1.0" },
      extensionsUsed: ["KHR_binary_glTF", "WEB3D_SRC"],
      bufferViews: {
        vertices: { byteOffset: 0, byteLength: 32 * count, target: 34962 },
        indices: { byteOffset: 32 * count, byteLength: 2 * mesh.triangles.length, target: 34963 },
      },
      accessors: {
        positions: accessor(0, 3),
        normals: accessor(1, 3),
        texCoords: accessor(2, 2),
        triangles: {
          bufferView: "indices",
          byteOffset: 0,
          byteStride: 0,
          componentType: 5123,
          count: mesh.triangles.length,
          type: "SCALAR",
        },
      },
      // X3DOM lights every material, though glTF's CONSTANT is not lit, and all others also by a light of its own.
      // Light does not change colours of 0 and 1.
      materials: {
        glow: {
          extensions: {
            KHR_materials_common: { technique: "CONSTANT", values: { emission: [1, 0, 1, 1], specular: [0, 0, 0, 1] } },
          },
        },
      },
      scene: "all",
      scenes: { all: { nodes: ["root"] } },
      nodes: { root: { meshes: ["glowing"] } },
      meshes: {
        plain: { primitives: [{ attributes, indices: "triangles", mode: 4 }] },
        glowing: { primitives: [{ attributes, indices: "triangles", mode: 4, material: "glow" }] },
        textured: {
          primitives: [{ attributes: { ...attributes, TEXCOORD_0: "texCoords" }, indices: "triangles", mode: 4 }],
        },
      },
    }),
  );
  const header = Uint32Array.of(0x46546c67, 1, 20 + json.length + body.length, json.length, 0);
  return Buffer.concat([Buffer.from(header.buffer), json, body]);
}

test("a page with ExternalGeometry and ExternalShape is drawn by X3DOM as its conversion is by the runtime", async () => {
  const folder = join(outputDirectory, "containers");
  mkdirSync(folder, { recursive: true });
  const file = container();
  writeFileSync(join(folder, "knots.glb"), file);
  writeFileSync(join(folder, "colors.png"), texture);
  const box = [0, 1, 2].map((axis) => {
    const values = mesh.positions.filter((_, i) => i % 3 === axis);
    return values.reduce((a, b) => Math.max(a, b)) - values.reduce((a, b) => Math.min(a, b));
  });
  const width = box[0] ?? NaN;
  const shape = (x: number, name: string): string =>
    `<Transform translation="${x} 0 0"><Shape bboxCenter="0 0 0" bboxSize="${box.map((size) => 2 * size).join(" ")}">
    <Appearance><Material diffuseColor="${name === "textured" ? "1 1 1" : "0.2 0.8 0.3"}" ambientIntensity="0"></Material>
    ${name === "textured" ? '<ImageTexture url="colors.png"></ImageTexture>' : ""}</Appearance>
    <ExternalGeometry url="knots.glb#${name}"></ExternalGeometry></Shape></Transform>`;
  const scene = `<NavigationInfo headlight="true"></NavigationInfo>
    <Viewpoint position="0 0 ${4.6 * width}" fieldOfView="0.6"></Viewpoint><Background skyColor="1 1 1"></Background>
    ${shape(-1.1 * width, "plain")}${shape(0, "textured")}
    <Transform translation="${1.1 * width} 0 0"><ExternalShape url="knots.glb"></ExternalShape></Transform>`;
  const { width: pageWidth, height: pageHeight } = pictureSize;
  const page = `<!doctype html><html><head><meta charset="utf-8"><title>Old</title>
    <script src="x3dom/x3dom.js"></script><link rel="stylesheet" href="x3dom/x3dom.css">
    <style>html, body { margin: 0 } x3d { display: block; width: ${pageWidth}px; height: ${pageHeight}px; border: 0 }</style></head>
    <body><X3D width="${pageWidth}px" height="${pageHeight}px"><Scene>${scene}</Scene></X3D></body></html>`;
  writeFileSync(join(folder, "containers.html"), page);
  // Colours and light add up in X3DOM as in X3D's equations only without its gamma correction.
  const inX3dom = page.replace("<Scene>", '<Scene><Environment gammaCorrectionDefault="none"></Environment>');
  const expected = await pictureOf(folder, "sig", inX3dom, { "/knots.glb": file, "/colors.png": texture });
  savePicture("containers, X3DOM", expected);
  const site = siteOf(join(folder, "containers.html"), "--strict");
  assert.equal(readFileSync(join(site, "index.html"), "utf8").match(/<imagegeometry/gi)?.length, 3);
  let actual: Picture | undefined;
  await withPage(site, {}, async (view) => {
    await view.promise("complete");
    actual = await view.picture();
  });
  actual ??= assert.fail("no picture");
  savePicture("containers", actual);
  const blank = { ...actual, data: new Uint8Array(actual.data.length).fill(255) };
  assert.ok(difference(expected, blank).mean > 10, "X3DOM draws the container");
  const found = assertSamePicture("containers", actual, expected, boundsOfCompact);
  console.log(`containers: mean ${found.mean.toFixed(3)}, off ${(100 * found.offShare).toFixed(3)} %`);
});
