// Tests transforms of shapes and their normals, and USE, for which everything is downloaded and stored once.

import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { Matrix4, Quaternion, Vector3 } from "three";
import { assertSamePicture, boundsOfQuantised, difference } from "./compare.ts";
import { finalPicture, withPage } from "./harness.ts";
import { transformedPatches } from "./transformedPatches.ts";
import { referencePicture } from "./reference.ts";
import { decodeSite, ranksOfFiles } from "./siteDecoder.ts";
import { pageOf, shapeIn, siteOfGenerated, variantOf, withShapes } from "./sites.ts";
import { soakTest } from "./soak.ts";

const turn = (x: number, y: number, z: number, angle: number): Matrix4 =>
  new Matrix4().makeRotationFromQuaternion(new Quaternion().setFromAxisAngle(new Vector3(x, y, z).normalize(), angle));
const move = (x: number, y: number, z: number): Matrix4 => new Matrix4().makeTranslation(x, y, z);
const stretch = (x: number, y: number, z: number): Matrix4 => new Matrix4().makeScale(x, y, z);
const product = (...matrices: Matrix4[]): Matrix4 => matrices.reduce((all, next) => all.multiply(next), new Matrix4());

const transforms: Record<string, { markup: (shape: string) => string; matrix: Matrix4 }> = {
  "scale that differs from axis to axis": {
    markup: (shape) => `<Transform scale="0.4 1 1.7">${shape}</Transform>`,
    matrix: stretch(0.4, 1, 1.7),
  },
  "every field at once, nested": {
    markup: (
      shape,
    ) => `<Transform translation="0.5 0.2 -1" rotation="1 0 0 0.3"><Transform translation="0.3 0 0" center="1 0.5 0"
      rotation="0 1 1 0.6" scale="0.5 1.2 0.8" scaleOrientation="0 0 1 0.7">${shape}</Transform></Transform>`,
    matrix: product(
      move(0.5, 0.2, -1),
      turn(1, 0, 0, 0.3),
      move(0.3, 0, 0),
      move(1, 0.5, 0),
      turn(0, 1, 1, 0.6),
      turn(0, 0, 1, 0.7),
      stretch(0.5, 1.2, 0.8),
      turn(0, 0, 1, -0.7),
      move(-1, -0.5, 0),
    ),
  },
  "a mirror": {
    markup: (shape) => `<Transform scale="-0.8 1 0.6">${shape}</Transform>`,
    matrix: stretch(-0.8, 1, 0.6),
  },
};

describe("a Transform applies to positions and normals", () => {
  for (const [name, { markup, matrix }] of Object.entries(transforms)) {
    for (const container of ["sig", "bg"]) {
      const sample =
        (container === "bg") === (name === "a mirror") && name !== "scale that differs from axis to axis"
          ? test
          : soakTest;
      sample(`${name}, ${container}`, async () => {
        const site = siteOfGenerated("trefoil-colors", "--profile", "classic", "--container", container);
        const page = withShapes(pageOf(site), markup);
        const seen = await finalPicture(variantOf(site, "transformed", () => page));
        const expected = await referencePicture(page, transformedPatches(decodeSite(site), matrix));
        assertSamePicture(`${name} ${container}`, seen, expected, boundsOfQuantised);
      });
    }
  }
});

for (const container of ["sig", "bg"]) {
  soakTest(
    `a decode box that is not a cube scales the shape and does not change its normals, ${container}`,
    async () => {
      const original = siteOfGenerated("trefoil", "--profile", "classic", "--container", container);
      const site = variantOf(original, "stretched", (page) =>
        page.replaceAll(/ bbox(Center|Size)="[^"]*"/g, "").replace(/ size="[^"]*"/, ' size="3 6 4"'),
      );
      assertSamePicture(
        `no cube ${container}`,
        await finalPicture(site),
        await referencePicture(pageOf(site), decodeSite(site)),
        boundsOfQuantised,
      );
    },
  );
}

/** Two instances of the shape beside each other, written in two ways: with USE, and in full. */
const twice: Record<string, { used: (shape: string) => string; full: (shape: string) => string }> = {
  "a Shape": {
    used: (shape) => `${shape}${aside('<Shape USE="trefoil"></Shape>')}`,
    full: (shape) => `${shape}${aside(shape)}`,
  },
  "a geometry": {
    used: (shape) => {
      const node = /<(ImageGeometry|BinaryGeometry)/.exec(shape)?.[1] ?? "";
      return (
        shape.replace(`<${node}`, `<${node} DEF="knot"`) +
        aside(
          `<Shape><Appearance><Material diffuseColor="0.8 0.1 0.1"></Material></Appearance><${node} USE="knot"></${node}></Shape>`,
        )
      );
    },
    full: (shape) => `${shape}${aside(shape.replace(/<Material[^>]*>/, '<Material diffuseColor="0.8 0.1 0.1">'))}`,
  },
  "an Appearance": {
    used: (shape) =>
      `${shape.replace("<Appearance", '<Appearance DEF="stone"')}${aside(shape.replace(/<Appearance[\s\S]*<\/Appearance>/, '<Appearance USE="stone"></Appearance>'))}`,
    full: (shape) => `${shape}${aside(shape)}`,
  },
  "a Material": {
    used: (shape) =>
      `${shape.replace("<Material", '<Material DEF="stone"')}${aside(shape.replace(/<Material[^>]*>/, '<Material USE="stone">'))}`,
    full: (shape) => `${shape}${aside(shape)}`,
  },
  "a Group": {
    used: (shape) =>
      `<Group DEF="all">${shape}<Group render="false"></Group></Group>${aside('<Group USE="all"></Group>')}`,
    full: (shape) => `${shape}${aside(shape)}`,
  },
  "a Transform": {
    used: (shape) =>
      `<Transform DEF="all" scale="0.7 0.7 0.7">${shape}</Transform>${aside('<Transform USE="all"></Transform>')}`,
    full: (shape) =>
      `<Transform scale="0.7 0.7 0.7">${shape}</Transform>${aside(`<Transform scale="0.7 0.7 0.7">${shape}</Transform>`)}`,
  },
};

function aside(markup: string): string {
  return `<Transform id="second" translation="2 1 -2" rotation="0 1 0 0.5">${markup}</Transform>`;
}

describe("USE of", () => {
  for (const [name, { used, full }] of Object.entries(twice)) {
    for (const container of ["sig", "bg"]) {
      const sample = container === "sig" && name === "a Group" ? test : soakTest;
      sample(`${name} displays it again without downloading or storing it again, ${container}`, async () => {
        const original = siteOfGenerated("trefoil", "--profile", "classic", "--container", container);
        const site = variantOf(original, "used", (page) => withShapes(page, used));
        const expected = await finalPicture(variantOf(original, "full", (page) => withShapes(page, full)));
        await withPage(site, {}, async (view) => {
          await view.promise("complete");
          assertSamePicture(`USE of ${name}`, await view.picture(), expected, { mean: 0.001 });
          const { live } = await view.observed();
          for (const url of ranksOfFiles(shapeIn(pageOf(original))).keys()) {
            assert.equal(view.server.requests.filter(({ path }) => path === `/${url}`).length, 1, url);
          }
          await view.page.evaluate(() => {
            document.querySelector("#second")!.remove();
          });
          assert.ok(difference(await view.picture(), expected).mean > 0.5, "the second instance is still visible");
          if (name === "an Appearance" || name === "a Material") return; // these cases have two geometries
          const { live: alone } = await view.observed();
          assert.deepEqual({ ...live, programs: 0 }, { ...alone, programs: 0 });
        });
      });
    }
  }

  soakTest("a Shape is removed with the Shape that defines it", async () => {
    const site = variantOf(siteOfGenerated("trefoil", "--profile", "classic"), "orphan", (page) =>
      withShapes(page, twice["a Shape"]!.used),
    );
    await withPage(site, {}, async (view) => {
      await view.promise("complete");
      await view.page.evaluate(() => {
        document.querySelector("shape")!.remove();
      });
      const { data, channels } = await view.picture();
      assert.ok(
        data.every((byte, at) => byte === data[at % channels]),
        "something is visible",
      );
      const { live } = await view.observed();
      assert.equal(live.textures, await emptySceneTextures());
    });
  });
});

async function emptySceneTextures(): Promise<number> {
  let count = -1;
  const site = variantOf(siteOfGenerated("trefoil", "--profile", "classic"), "empty", (page) =>
    withShapes(page, () => ""),
  );
  await withPage(site, {}, async (view) => {
    await view.promise("complete");
    await view.picture();
    count = (await view.observed()).live.textures;
  });
  return count;
}
