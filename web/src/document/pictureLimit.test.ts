import assert from "node:assert/strict";
import { test } from "node:test";
import { elementsOf } from "./elements.testing.ts";
import { maxPictures } from "./pictureLimit.ts";
import { allTextures } from "./physicalMaterials.testing.ts";
import { readScene } from "./readScene.ts";

test("a material with more pictures than texture units leaves out the last, with one warning", () => {
  const read = (cubeMap: string) => {
    const { root, warnings } = readScene(
      elementsOf(`<X3D><Scene><Shape><Appearance>${allTextures}${cubeMap}</Appearance></Shape></Scene></X3D>`),
    );
    const [shape] = root.children;
    assert.ok(shape?.kind === "shape");
    return { roles: shape.appearance.textures.map(({ role }) => role), warnings };
  };
  const plain = read("");
  assert.equal(plain.roles.length, maxPictures);
  assert.deepEqual(
    plain.warnings.map(({ message }) => message),
    [
      "has more than 13 textures, which GPUs need not be able to draw at once; left out: specularStrength, specularColor, transmission, thickness",
    ],
  );
  const { roles, warnings } = read('<ImageCubeMapTexture url="cross.png"/>');
  assert.equal(roles.length, maxPictures - 1);
  assert.equal(warnings.length, 1);
});
