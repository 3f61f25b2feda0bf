// Shapes in the layouts that X3DOM's own tools (aopt, the POP converter) and authors wrote, one in each.

import { extents, levels, middle, mixed, mixedCounts, rowsOf, soup, stripCounts, vertexCount } from "./foreignFiles.ts";
import type { Container } from "./releases.ts";

/** A shape in one layout of files. */
export interface Layout {
  readonly name: string;
  /** The releases that draw it. */
  readonly releases: readonly Container[];
  /** The runtime does not draw the node, and its sentence names `imgeo convert`. */
  readonly isRefused?: boolean;
  /** The shape, in its box around the origin. */
  readonly markup: string;
}

const box = `position="0 0 0" size="${extents.join(" ")}"`;

const mixedDraws = `primType='"TRIANGLES" "LINES" "POINTS"' vertexCount="${mixedCounts.join(" ")}"`;
const texture = (role: string, url: string): string =>
  `<ImageTexture containerField="${role}" url="${url}">
<TextureProperties boundaryModeS="CLAMP_TO_EDGE" boundaryModeT="CLAMP_TO_EDGE"
    magnificationFilter="NEAREST" minificationFilter="NEAREST"></TextureProperties></ImageTexture>`;
const images = (indices: readonly number[], attributes: string, ...textures: readonly string[]): string =>
  `<ImageGeometry ${box} implicitMeshSize="256 ${rowsOf(indices)}" useGeoCache="false"
    ${attributes}>${textures.join("")}</ImageGeometry>`;
const arrays = (attributes: string): string => `<BinaryGeometry ${box} ${attributes}></BinaryGeometry>`;
const triangles = `primType='"TRIANGLES"' vertexCount="${soup.length}"`;
const material = '<Material diffuseColor="0.7 0.5 0.3" specularColor="0.2 0.2 0.2"></Material>';
const shape = (geometry: string, appearance = material): string =>
  `<Shape><Appearance>${appearance}</Appearance>${geometry}</Shape>`;

const pop = `<Transform translation="${extents.map((extent) => -extent / 2).join(" ")}">${shape(
  `<PopGeometry size="${extents.join(" ")}" tightSize="${extents.join(" ")}" maxBBSize="${extents.join(" ")}"
    position="${extents.map((extent) => extent / 2).join(" ")}" bbMin="0 0 0" bbMinModF="0 0 0" bbMaxModF="1 1 1"
    attributeStride="12" normalOffset="8" normalPrecision="1" precisionFactor="0.001" ` +
    `primType='"TRIANGLES"' vertexCount="${soup.length}" vertexBufferSize="${vertexCount}">` +
    levels
      .map(
        (indices, level) =>
          `<PopGeometryLevel src="level${level}.bin" numIndices="${indices.length}"
    vertexDataBufferOffset="${level * middle}"></PopGeometryLevel>`,
      )
      .join("") +
    "</PopGeometry>",
)}</Transform>`;

const both: readonly Container[] = ["sig", "bg"];

export const layouts: readonly Layout[] = [
  {
    name: "aopt: files of Int16 and Int8 named by their strides",
    releases: both,
    markup: shape(
      arrays(
        `${triangles} index="index.bin" coord="position.bin+8" normal="normal.bin+4"
    coordType="Int16" normalType="Int8"`,
      ),
    ),
  },
  {
    name: "aopt: interleaved records of Int16",
    releases: both,
    markup: shape(
      arrays(
        `vertexCount="0" index="index.bin" coord="records.bin#0+24" normal="records.bin#8+24"
    coordType="Int16" normalType="Int16"`,
      ),
    ),
  },
  {
    name: "aopt: normals as spherical coordinates",
    releases: both,
    markup: shape(
      arrays(
        `${triangles} index="index.bin" coord="spherical.bin+8" coordType="Uint16" normalAsSphericalCoordinates="true"`,
      ),
    ),
  },
  {
    name: "BinaryGeometry of plain floats",
    releases: both,
    markup: shape(arrays(`${triangles} index="index.bin" coord="position.bin" normal="normal.bin"`)),
  },
  {
    name: "BinaryGeometry with two draws, a strip and triangles",
    releases: both,
    markup: shape(
      arrays(
        `primType='"TRIANGLESTRIP" "TRIANGLES"' vertexCount="${stripCounts.join(" ")}" index="draws.bin"
    coord="position.bin" normal="normal.bin"`,
      ),
    ),
  },
  {
    name: "BinaryGeometry without an index",
    releases: both,
    markup: shape(
      arrays(`primType='"TRIANGLES"' vertexCount="${soup.length}" coord="soup.bin" normal="soupNormal.bin"`),
    ),
  },
  {
    name: "BinaryGeometry with colours and ccw false",
    releases: both,
    markup: shape(
      arrays(
        `${triangles} ccw="false" solid="true" index="index.bin" coord="position.bin" normal="normal.bin"
    color="color.bin+4" colorType="Uint8"`,
      ),
    ),
  },
  {
    name: "ClipPlane of a group with a BinaryGeometry",
    releases: both,
    markup: `<Group><ClipPlane plane="1 0.5 0 0.1"></ClipPlane>${shape(
      arrays(`${triangles} solid="false" index="index.bin" coord="position.bin" normal="normal.bin"`),
    )}</Group>`,
  },
  { name: "PopGeometry of two levels", releases: both, isRefused: true, markup: pop },
  {
    name: "aopt: ImageGeometry with an index, two coordinate images and normals",
    releases: ["sig"],
    markup: shape(
      images(
        soup,
        triangles,
        texture("index", "index.png"),
        texture("coord", "coord0.png"),
        texture("coord", "coord1.png"),
        texture("normal", "normal.png"),
      ),
    ),
  },
  {
    name: "ImageGeometry of 8-bit coordinates and colours, not lit",
    releases: ["sig"],
    markup: shape(
      images(
        soup,
        `${triangles} lit="false"`,
        texture("index", "index.png"),
        texture("coord", "coord0.png"),
        texture("color", "color.png"),
      ),
    ),
  },
  {
    name: "ImageGeometry without an index, as points",
    releases: ["sig"],
    markup: shape(
      images(
        soup,
        `primType='"POINTS"' vertexCount="${vertexCount}"`,
        texture("coord", "coord0.png"),
        texture("coord", "coord1.png"),
        texture("color", "color.png"),
      ),
      '<Material emissiveColor="1 1 1"></Material>',
    ),
  },
  {
    name: "BinaryGeometry with normalPerVertex false",
    releases: both,
    markup: shape(
      arrays(
        `primType='"TRIANGLES"' vertexCount="${soup.length}" coord="soup.bin" normal="soupNormal.bin"
    normalPerVertex="false"`,
      ),
    ),
  },
  {
    name: "BinaryGeometry with normals, not lit",
    releases: both,
    markup: shape(
      arrays(`${triangles} index="index.bin" coord="position.bin" normal="normal.bin" lit="false"`),
      '<Material diffuseColor="1 0 0" emissiveColor="0.2 0.5 0.9"></Material>',
    ),
  },
  // Not lit: X3DOM lights lines and points from one side, imgeo from both.
  {
    name: "BinaryGeometry of triangles, lines and points, not lit",
    releases: both,
    markup: shape(
      arrays(`${mixedDraws} lit="false" index="mixed.bin" coord="position.bin" color="color.bin+4" colorType="Uint8"`),
    ),
  },
  {
    name: "ImageGeometry of triangles, lines and points, not lit",
    releases: ["sig"],
    markup: shape(
      images(
        mixed,
        `${mixedDraws} lit="false"`,
        texture("index", "mixed.png"),
        texture("coord", "coord0.png"),
        texture("coord", "coord1.png"),
        texture("color", "color.png"),
      ),
    ),
  },
];
