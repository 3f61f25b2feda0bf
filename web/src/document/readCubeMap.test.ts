import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { elementsOf } from "./elements.testing.ts";
import { readScene } from "./readScene.ts";

const sides = ["front", "back", "left", "right", "top", "bottom"];
const picture = (side: string) => `<ImageTexture containerField="${side}" url="${side}.png"/>`;
const whole = '<ImageCubeMapTexture url="cross.png"/>';

/** The cube map of a shape, and warnings. */
function shapeWith(appearance: string, generator = "") {
  const { root, warnings } = readScene(
    elementsOf(
      `<X3D><Scene><Shape><Appearance>${appearance}</Appearance><IndexedFaceSet>${generator}</IndexedFaceSet></Shape></Scene></X3D>`,
    ),
  );
  const [shape] = root.children;
  const cubeMap = shape?.kind === "shape" ? shape.appearance.cubeMap : undefined;
  return {
    pictures: cubeMap?.pictures.map(({ role, urls }) => `${role} ${urls.join(" ")}`),
    direction: cubeMap?.direction,
    warnings: warnings.map(({ message }) => message),
  };
}

describe("a cube map", () => {
  test("has a picture for each side", () => {
    const { pictures, warnings } = shapeWith(
      `<ComposedCubeMapTexture>${sides.map(picture).join("")}</ComposedCubeMapTexture>`,
    );
    assert.deepEqual(
      pictures,
      sides.map((side) => `${side} ${side}.png`),
    );
    assert.deepEqual(warnings, []);
  });

  test("without pictures for some sides has the others, and one warning", () => {
    const { pictures, warnings } = shapeWith(
      `<ComposedCubeMapTexture>${picture("left")}<ImageTexture containerField="top"/></ComposedCubeMapTexture>`,
    );
    assert.deepEqual(pictures, ["left left.png"]);
    assert.deepEqual(warnings, ["has no picture for front, back, right, top, bottom, which stays black"]);
  });

  test("is read in the direction that the geometry's generator names", () => {
    const generator = (mode: string) => `<TextureCoordinateGenerator mode="${mode}"/>`;
    assert.equal(shapeWith(whole).direction, "reflection");
    assert.equal(shapeWith(whole, generator("CAMERASPACEREFLECTIONVECTOR")).direction, "cameraReflection");
    assert.equal(shapeWith(whole, generator("CAMERASPACENORMAL")).direction, "cameraNormal");
    assert.equal(shapeWith(whole, generator("NOISE")).direction, "reflection");
  });

  test("is drawn beside a texture of a MultiTexture, and in the field of the main color only", () => {
    const multi = shapeWith(`<MultiTexture><ImageTexture url="t.png"/>${whole}</MultiTexture>`);
    assert.deepEqual([multi.pictures, multi.warnings], [["whole cross.png"], []]);
    const { pictures, warnings } = shapeWith(
      '<PhysicalMaterial><ImageCubeMapTexture containerField="normalTexture" url="cross.png"/></PhysicalMaterial>',
    );
    assert.equal(pictures, undefined);
    assert.equal(warnings.length, 1);
  });
});

test("an EnvironmentLight with too few coefficients has none, and one warning", () => {
  const { root, warnings } = readScene(
    elementsOf('<X3D><Scene><EnvironmentLight diffuseCoefficients="1 2 3"/></Scene></X3D>'),
  );
  const [light] = root.children;
  assert.ok(light?.kind === "environmentLight");
  assert.deepEqual(light.diffuseCoefficients, []);
  assert.equal(warnings.length, 1);
});

describe("a GeneratedCubeMapTexture", () => {
  const read = (fields: string) => {
    const { root } = readScene(
      elementsOf(
        `<X3D><Scene><Shape><Appearance><GeneratedCubeMapTexture ${fields}/></Appearance></Shape></Scene></X3D>`,
      ),
    );
    const [shape] = root.children;
    return shape?.kind === "shape" ? shape.appearance.cubeMap?.generated : undefined;
  };

  test("is drawn when its update says so", () => {
    assert.equal(read(""), undefined);
    assert.deepEqual(read('update="NEXT_FRAME_ONLY"'), { size: 128, isUpdatedAlways: false });
    assert.deepEqual(read('update="ALWAYS"'), { size: 128, isUpdatedAlways: true });
  });

  test("has faces of a power of two of at most 1024 texels", () => {
    for (const [written, size] of [
      [-5, 1],
      [100, 128],
      [1e9, 1024],
    ] as const)
      assert.equal(read(`update="ALWAYS" size="${written}"`)?.size, size);
  });
});

test("an EnvironmentLight leaves out a GeneratedCubeMapTexture, with one warning", () => {
  const { root, warnings } = readScene(
    elementsOf(
      '<X3D><Scene><EnvironmentLight><GeneratedCubeMapTexture containerField="specularTexture" update="ALWAYS"/></EnvironmentLight></Scene></X3D>',
    ),
  );
  const [light] = root.children;
  assert.ok(light?.kind === "environmentLight");
  assert.deepEqual([light.specular, warnings.length], [undefined, 1]);
});
