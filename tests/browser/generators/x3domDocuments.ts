// Shapes with the geometry nodes of X3DOM's families, one for each thing that authors write, right or wrong: a square
// whose vertices are in images and in arrays that this program writes.

import { encodePng } from "../png.ts";

const image = (channels: 3 | 4, texels: readonly number[]): Buffer =>
  encodePng({ width: texels.length / channels, height: 1, channels, data: Uint8Array.from(texels) });
const floats = (values: readonly number[]): Buffer => Buffer.from(Float32Array.from(values).buffer);

/** The files that the documents name, and some that are damaged. */
export const x3domFiles: ReadonlyMap<string, Buffer> = new Map([
  ["hi.png", image(3, [51, 51, 128, 204, 51, 128, 204, 204, 128, 51, 204, 128])],
  ["lo.png", image(3, [10, 20, 30, 40, 50, 60, 70, 80, 90, 100, 110, 120])],
  ["normal.png", image(3, [128, 128, 255, 140, 128, 250, 128, 140, 250, 120, 120, 250])],
  ["angles.png", image(4, [10, 0, 30, 0, 20, 0, 60, 0, 30, 0, 90, 0, 40, 0, 120, 0])],
  ["texCoord.png", image(4, [0, 0, 0, 0, 255, 0, 255, 0, 255, 255, 255, 255, 0, 255, 0, 255])],
  ["color.png", image(3, [255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 0])],
  ["index.png", image(3, [0, 0, 0, 64, 0, 0, 128, 0, 0, 0, 0, 0, 128, 0, 0, 192, 0, 0])], // in 1/256 of the width
  ["damaged.png", image(3, [51, 51, 128]).subarray(0, 40)],
  ["coord.bin", floats([-0.6, -0.6, 0, 0.6, -0.6, 0, 0.6, 0.6, 0, -0.6, 0.6, 0])],
  ["strip.bin", floats([-0.6, -0.6, 0, 0.6, -0.6, 0, 0.6, 0.6, 0])],
  ["normal.bin", floats([0, 0, 1, 0.1, 0, 1, 0, 0.1, 1, 0.1, 0.1, 1])],
  ["color.bin", floats([1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 0])],
  ["index.bin", Buffer.from(Uint16Array.of(0, 1, 2, 0, 2, 3).buffer)],
]);

const texture = (field: string, url: string): string =>
  `<ImageTexture containerField="${field}" url='${url}'></ImageTexture>`;
const planes = texture("coord", "hi.png") + texture("coord", "lo.png");
const indexed = planes + texture("index", "index.png");

/** An ImageGeometry of four indexed vertices; the attributes replace those of the same name. */
const images = (attributes: string, children = indexed + texture("normal", "normal.png")): string =>
  element(
    "ImageGeometry",
    'position="0 0 0" size="2 2 2" implicitMeshSize="6 1" vertexCount="6"',
    attributes,
    children,
  );
const sequence = (attributes: string, children = planes): string =>
  images(`implicitMeshSize="4 1" vertexCount="4" ${attributes}`, children);
const arrays = (attributes: string): string =>
  element(
    "BinaryGeometry",
    'position="0 0 0" size="2 2 2" coord="coord.bin" normal="normal.bin" index="index.bin" vertexCount="6"',
    attributes,
    "",
  );

function element(name: string, defaults: string, attributes: string, children: string): string {
  const fields = new Map<string, string>();
  for (const text of [defaults, attributes])
    for (const [, field = "", value = ""] of text.matchAll(/(\w+)=("[^"]*"|'[^']*')/g)) fields.set(field, value);
  const stated = Array.from(fields, ([field, value]) => `${field}=${value}`).join(" ");
  return `<${name} ${stated}>${children}</${name}>`;
}

/** What each document is about, and the geometry of its Shape. */
export const x3domGeometries: Readonly<Record<string, string>> = {
  images: images(""),
  arrays: arrays(""),
  "ccw of images": images('ccw="false" solid="false"'),
  "ccw of arrays": arrays('ccw="false"'),
  "unlit images": images('lit="false"', indexed + texture("color", "color.png")),
  "unlit arrays": arrays('lit="false" color="color.bin"'),
  "flat arrays": arrays('normalPerVertex="false"'),
  "compressed arrays": arrays('compressed="true"'),
  "a loop of lines in arrays": arrays('index="" primType="LINELOOP" vertexCount="4"'),
  "a fan in arrays": arrays('index="" primType="TRIANGLEFAN" vertexCount="4"'),
  "a strip of lines in images": sequence('primType="LINESTRIP"'),
  "a fan in images": sequence('primType="TRIANGLEFAN"', planes + texture("normal", "normal.png")),
  "a strip in images": sequence('primType="TRIANGLESTRIP"', planes + texture("normal", "normal.png")),
  "points in images": sequence('primType="POINTS"'),
  "triangles, lines and points": arrays(`primType='"TRIANGLES" "LINES" "POINTS"' vertexCount="3 2 1"`),
  "all records of a file": arrays('index="" normal="" coord="strip.bin" vertexCount="0"'),
  "all indices of a file": arrays('vertexCount="0"'),
  "no count of images": images('vertexCount="0"'),
  "a USE of no image": images("", '<ImageTexture USE="none" containerField="coord"></ImageTexture>'),
  "a USE of no normal": images("", `${indexed}<ImageTexture USE="none" containerField="normal"></ImageTexture>`),
  "a USE of no geometry": '<ImageGeometry USE="none"></ImageGeometry>',
  "a Texture": images("", `<Texture containerField="coord" url="hi.png"></Texture>${texture("index", "index.png")}`),
  "an img in a Texture": images(
    "",
    `<Texture containerField="coord"><img src="hi.png"></Texture>${texture("index", "index.png")}`,
  ),
  "a movie": images("", '<MovieTexture containerField="coord" url="m.mp4"></MovieTexture>'),
  "normals in a movie": images("", `${indexed}<MovieTexture containerField="normal" url="m.mp4"></MovieTexture>`),
  "a PixelTexture": images("", '<PixelTexture containerField="coord" image="1 1 3 0xff0000"></PixelTexture>'),
  "an unknown field": images("", indexed + texture("colour", "color.png")),
  "two images of normals": images("", indexed + texture("normal", "normal.png") + texture("normal", "lo.png")),
  "five images of coordinates": sequence('primType="TRIANGLEFAN"', texture("coord", "hi.png").repeat(5)),
  "no images of coordinates": images("", texture("index", "index.png")),
  "an unknown mode": images('implicitMeshMode="torus"'),
  "the paper's mode": images('implicitMeshMode="auto"'),
  "a height map of one row": images('implicitMeshMode="heightMap" implicitMeshSize="4 1"', planes),
  "too few primitives": arrays('primType="TRIANGLES" vertexCount="3 3"'),
  "too many primitives": arrays(`primType='"TRIANGLES" "LINES"'`),
  "an unknown primitive": arrays('primType="QUADS"'),
  "a negative count": arrays('vertexCount="-3"'),
  "a count that is a word": arrays('vertexCount="six"'),
  "more indices than there are": arrays('vertexCount="60"'),
  "spherical normals": images('normalEncoding="spherical" normalBits="16"', indexed + texture("normal", "angles.png")),
  "bits of normals that none have": images('normalBits="12"'),
  "texture coordinates of 8 bits": images('texCoordBits="8"', indexed + texture("texCoord", "texCoord.png")),
  "an unknown encoding": images('normalEncoding="cube"'),
  "an unknown profile": images('profile="zip"'),
  "an unknown type of indices": arrays('indexType="Float64"'),
  "two components of colours": images('numColorComponents="2"', indexed + texture("color", "color.png")),
  "three texture coordinates": images('numTexCoordComponents="3"'),
  tangents: arrays('tangent="normal.bin"'),
  "a box without extent": images('size="0 0 0"'),
  "a negative box": images('size="-2 2 2"'),
  "a box of no numbers": images('size="big"'),
  "no columns": images('implicitMeshSize="0 0"'),
  "half a column": images('implicitMeshSize="6.5 1"'),
  "bits of coordinates": images('positionBits="40"'),
  "a fragment that is none": arrays('coord="coord.bin#x"'),
  "a stride": arrays('coord="coord.bin#0+12"'),
  "an offset": arrays('coord="coord.bin#0"'),
  "a missing file": images("", texture("coord", "none.png") + texture("index", "index.png")),
  "a damaged image before a whole one": images(
    "",
    texture("coord", '"damaged.png" "hi.png"') + texture("index", "index.png"),
  ),
  PopGeometry: "<PopGeometry></PopGeometry>",
  ExternalGeometry: '<ExternalGeometry url="x.src"></ExternalGeometry>',
  BufferGeometry: '<BufferGeometry buffer="coord.bin"></BufferGeometry>',
  "an unknown node": "<SurprisingGeometry></SurprisingGeometry>",
  "two geometries": `${arrays("")}<Box></Box>`,
  "two geometries, a box first": `<Box size="1 1 1"></Box>${arrays("")}`,
};

/** The Shape of a geometry. */
export function x3domShape(geometry: string): string {
  return `<Shape><Appearance><Material diffuseColor="0.8 0.5 0.2"></Material></Appearance>${geometry}</Shape>`;
}
