import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { PatchDescription } from "./description.ts";
import { shapesOf } from "./description.ts";
import type { SceneElement } from "./element.ts";
import { elementsOf } from "./elements.testing.ts";
import { readScene } from "./readScene.ts";

function read(x3d: SceneElement): { patch: PatchDescription | undefined; warnings: string[] } {
  const scene = readScene(x3d);
  return {
    patch: shapesOf(scene.root)[0]?.geometry?.patches[0],
    warnings: scene.warnings.map(({ message }) => message),
  };
}

function readImages(children: string): ReturnType<typeof read> {
  return read(
    elementsOf(`<X3D><Scene><Shape><ImageGeometry vertexCount="3">${children}</ImageGeometry></Shape></Scene></X3D>`),
  );
}

const texel = (url: string) => ({ url, firstTexel: 0 });

describe("images that are children of an ImageGeometry", () => {
  test("may be an ImageTexture, a Texture, an img in one of them, or an img alone", () => {
    const { patch, warnings } = readImages(`
      <ImageTexture containerField="index" url="i.png"/>
      <Texture containerField="coord" url="a.png"/>
      <Texture containerField="coord"><img src="b.png"/></Texture>
      <img containerField="normal" src="n.png"/>`);
    assert.deepEqual(warnings, []);
    assert.deepEqual(
      [patch?.index, patch?.coord, patch?.normal],
      [texel("i.png"), [texel("a.png"), texel("b.png")], texel("n.png")],
    );
  });

  test("may be USEd, in another role", () => {
    const { patch, warnings } = readImages(`
      <ImageTexture DEF="A" containerField="coord" url="a.png"/>
      <ImageTexture USE="A" containerField="normal"/>
      <ImageTexture USE="A" containerField="coord"/>
      <ImageTexture USE="NONE" containerField="color"/>`);
    assert.deepEqual([patch?.coord.length, patch?.normal], [2, texel("a.png")]);
    assert.deepEqual(warnings, ['USE="NONE" names no DEF of this scene']);
  });

  test("may be several of a field: low bytes of normals and colors, and sets of texture coordinates", () => {
    const images = (field: string, count: number) =>
      Array.from({ length: count }, (_, n) => `<ImageTexture containerField="${field}" url="${field}${n}"/>`).join("");
    const { patch, warnings } = readImages(
      images("coord", 1) + images("normal", 2) + images("color", 4) + images("texCoord", 5),
    );
    assert.deepEqual(patch?.lowBytes, {
      normal: [texel("normal1")],
      color: [texel("color1"), texel("color2")],
    });
    assert.deepEqual([patch.texCoord1, patch.texCoord3], [texel("texCoord1"), texel("texCoord3")]);
    assert.deepEqual(warnings, [
      "only the first 4 of 5 texCoord images are used",
      "only the first 3 of 4 color images are used",
    ]);
  });

  test("may have several URLs, which are tried in order; those with another fragment than the first are left out", () => {
    const { patch, warnings } = readImages(`
      <ImageTexture containerField="coord" url='"a.png#3" "b.png#3" "c.png"'/>
      <ImageTexture containerField="index" url='"i.png" "j.png"'/>`);
    assert.deepEqual(patch?.coord, [{ url: "a.png", firstTexel: 3, furtherUrls: ["b.png"] }]);
    assert.deepEqual(patch.index, { url: "i.png", firstTexel: 0, furtherUrls: ["j.png"] });
    assert.deepEqual(warnings, ["the URLs of a file have different fragments; only those like the first are used"]);
  });

  test("that cannot be read leave the geometry out where they are images of coordinates or indices", () => {
    const video = (field: string) => `<MovieTexture containerField="${field}" url="a.mp4"/>`;
    const coord = '<ImageTexture containerField="coord" url="a.png"/>';
    for (const field of ["coord", "index"])
      assert.deepEqual(readImages(video(field) + coord), {
        patch: undefined,
        warnings: ["a movie with coordinates names a lossless video and the index of its frames"],
      });
    const { patch, warnings } = readImages(video("normal") + coord);
    assert.deepEqual([patch?.coord, patch?.normal, warnings.length], [[texel("a.png")], undefined, 1]);
  });

  test("are left out with a warning where they are movies, empty, or without a field", () => {
    const { patch, warnings } = readImages(`
      <ImageTexture containerField="coord" url="a.png"/>
      <MovieTexture containerField="normal" url="a.mp4"/>
      <Texture containerField="normal"><video src="a.mp4"/></Texture>
      <PixelTexture containerField="normal"/>
      <Texture containerField="normal"/>
      <img containerField="normal"/>
      <canvas containerField="normal"/>
      <ImageTexture url="a.png"/>`);
    assert.deepEqual([patch?.coord.length, patch?.normal], [1, undefined]);
    assert.equal(warnings.filter((message) => message.startsWith("movies are not drawn")).length, 1);
    assert.equal(warnings.filter((message) => message.startsWith("a movie with coordinates names")).length, 1);
    assert.equal(warnings.length, 7);
  });

  test("may be a live stream, as a texture or a movie", () => {
    for (const element of ["ImageTexture", "MovieTexture"]) {
      const { patch, warnings } = readImages(
        `<${element} containerField="coord" url="https://a.example/live/cloth-1"/>`,
      );
      assert.deepEqual([patch?.coord[0]?.url, warnings], ["https://a.example/live/cloth-1", []]);
    }
  });

  test("may be a movie with a lossless video and the index of its frames, which replace the geometry's own", () => {
    const read = (movie: string) =>
      readScene(
        elementsOf(`<X3D><Scene><Shape><ImageGeometry coord="a.png" vertexCount="3">
          <MovieTexture ${movie}/></ImageGeometry></Shape></Scene></X3D>`),
      );
    const scene = read(`containerField="coord" url='"g/a.webm" "g/b.json?v=2"' loop="true"`);
    const [shape] = shapesOf(scene.root);
    assert.equal(shape?.geometry?.sequence?.url, "g/b.json?v=2");
    assert.equal(shape.geometry.sequence.video, "g/a.webm");
    assert.deepEqual(shape.geometry.patches[0]?.coord, [texel("a.png")]);
    assert.deepEqual(scene.warnings, []);
    assert.equal(read(`containerField="coord" url="g/a.webm"`).warnings.length, 1);
    assert.equal(read(`containerField="normal" url='"g/a.webm" "g/b.json"'`).warnings.length, 1);
  });

  test("may be a canvas, whose pixels are read; one with another site's image is left out with a warning", () => {
    const x3d = elementsOf(`<X3D><Scene><Shape><ImageGeometry vertexCount="3">
      <Texture containerField="coord"><canvas/></Texture></ImageGeometry></Shape></Scene></X3D>`);
    const canvas = x3d.children[0]?.children[0]?.children[0]?.children[0]?.children[0];
    assert.ok(canvas);
    const withPixels = (toDataURL: () => string) => {
      Object.assign(canvas, { toDataURL });
      return read(x3d);
    };
    assert.deepEqual(withPixels(() => "data:image/png,1").patch?.coord, [texel("data:image/png,1")]);
    const { patch, warnings } = withPixels(() => {
      throw new Error("SecurityError");
    });
    assert.deepEqual([patch, warnings.length], [undefined, 1]);
  });
});

test("a Texture in an Appearance is an ImageTexture, whose image may be an img in it", () => {
  const texture = (content: string) => `<Shape><Appearance>${content}</Appearance><Box/></Shape>`;
  const scene = readScene(
    elementsOf(`<X3D><Scene>${texture('<Texture url="a.png"/>')}
      ${texture('<Material><Texture containerField="diffuseTexture"><img src="b.png"/></Texture></Material>')}
      ${texture('<Texture><video src="c.mp4"/></Texture>')}</Scene></X3D>`),
  );
  assert.deepEqual(
    shapesOf(scene.root).map(({ appearance }) => appearance.textures.map(({ urls }) => urls)),
    [[["a.png"]], [["b.png"]], []],
  );
  assert.deepEqual(
    scene.warnings.map(({ message }) => message),
    ["movies are not drawn; images and live streams are"],
  );
});
