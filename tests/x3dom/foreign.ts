// Pages in the layouts that X3DOM's own tools (aopt, the POP converter) and authors wrote: one shape in each layout,
// side by side. The tests write all bytes themselves.

import { mkdirSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { trefoil, type PlainMesh } from "../browser/meshes.ts";
import { outputDirectory } from "../browser/paths.ts";
import { encodePng, type Picture } from "../browser/png.ts";
import type { Container } from "./releases.ts";

/** A shape in one layout of files. */
export interface Layout {
  readonly name: string;
  /** The releases that draw it. */
  readonly releases: readonly Container[];
  /** The runtime does not draw the node, and its sentence names `imgeo convert`. */
  readonly isRefused?: boolean;
  /** The shape, in a box of `half`. */
  readonly markup: string;
}

/** Columns and rows of the shapes on the picture. */
const columns = 4;
const rows = 4;
const cell = 1.8;
const distance = 20;
/** Size of the picture in pixels, at which no byte of a coordinate is too fine to be visible. */
export const foreignSize = { width: 640, height: 640 };

const half = { x: 0.85, y: 0.8, z: 0.6 };

/** A knot that fills the box of half extents `half`, small enough for any index. */
function knot(): PlainMesh & { readonly normals: Float32Array } {
  const mesh = trefoil(90, 10);
  const axes = [half.x, half.y, half.z];
  const ranges = axes.map((_, axis) => {
    const values = mesh.positions.filter((_, i) => i % 3 === axis);
    return { min: Math.min(...values), max: Math.max(...values) };
  });
  const positions = mesh.positions.map((value, i) => {
    const { min, max } = ranges[i % 3] ?? { min: 0, max: 1 };
    return (axes[i % 3] ?? 1) * ((2 * (value - min)) / (max - min) - 1);
  });
  const scales = axes.map((extent, axis) => (2 * extent) / ((ranges[axis]?.max ?? 1) - (ranges[axis]?.min ?? 0)));
  if (!mesh.normals) throw new Error("the knot has no normals");
  const normals = new Float32Array(mesh.normals.length);
  for (let vertex = 0; vertex < normals.length; vertex += 3) {
    const scaled = scales.map((scale, axis) => (mesh.normals?.[vertex + axis] ?? 0) / scale);
    normals.set(
      scaled.map((value) => value / Math.hypot(...scaled)),
      vertex,
    );
  }
  return { ...mesh, positions, normals };
}

const mesh = knot();
const vertexCount = mesh.positions.length / 3;
const extents = [2 * half.x, 2 * half.y, 2 * half.z] as const;
const box = `position="0 0 0" size="${extents.join(" ")}"`;

/** A vertex: its position relative to the box, -0.5 … 0.5, its normal, and a colour. */
interface Vertex {
  readonly relative: readonly number[];
  readonly normal: readonly number[];
  readonly color: readonly number[];
}

const vertices: readonly Vertex[] = Array.from({ length: vertexCount }, (_, index) => {
  const relative = extents.map((extent, axis) => (mesh.positions[3 * index + axis] ?? 0) / extent);
  const normal = Array.from(mesh.normals.slice(3 * index, 3 * index + 3));
  return { relative, normal, color: relative.map((value) => Math.round(255 * (value + 0.5))) };
});

function bytesOf(write: (vertex: Vertex, view: DataView, at: number) => void, stride: number): Buffer {
  const bytes = Buffer.alloc(stride * vertexCount);
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
  vertices.forEach((vertex, index) => {
    write(vertex, view, stride * index);
  });
  return bytes;
}

const typedArray = (array: Float32Array | Uint16Array): Buffer =>
  Buffer.from(array.buffer, array.byteOffset, array.byteLength);

/** X3DOM's signed coordinates: half of the range, around the center. */
const signed = (value: number): number => Math.round(32767 * value);

const writeSigned = (values: readonly number[], view: DataView, at: number): void => {
  values.forEach((value, axis) => {
    view.setInt16(at + 2 * axis, signed(value), true);
  });
};

/** 256 times the angle from the z axis, plus the angle around it, each 0 … 255. */
function sphericalOf([x = 0, y = 0, z = 0]: readonly number[]): number {
  const theta = Math.round((Math.acos(Math.max(-1, Math.min(1, z))) / Math.PI) * 255);
  const phi = Math.round((Math.atan2(y, x) / (2 * Math.PI) + 0.5) * 255);
  return 256 * theta + phi;
}

const files = new Map<string, Buffer>();
files.set("index.bin", typedArray(Uint16Array.from(mesh.triangles)));
files.set("position.bin", typedArray(Float32Array.from(mesh.positions)));
files.set("normal.bin", typedArray(Float32Array.from(mesh.normals)));
files.set(
  "position.bin+8",
  bytesOf(({ relative }, view, at) => {
    writeSigned(relative, view, at);
  }, 8),
);
files.set(
  "normal.bin+4",
  bytesOf(({ normal }, view, at) => {
    normal.forEach((value, axis) => {
      view.setInt8(at + axis, Math.round(127 * value));
    });
  }, 4),
);
files.set(
  "color.bin+4",
  bytesOf(({ color }, view, at) => {
    color.forEach((value, axis) => {
      view.setUint8(at + axis, value);
    });
  }, 4),
);
files.set(
  "records.bin",
  bytesOf(({ relative, normal }, view, at) => {
    writeSigned(relative, view, at);
    writeSigned(normal, view, at + 8);
  }, 24),
);
files.set(
  "spherical.bin+8",
  bytesOf(({ relative, normal }, view, at) => {
    relative.forEach((value, axis) => {
      view.setUint16(at + 2 * axis, Math.round(65535 * (value + 0.5)), true);
    });
    view.setUint16(at + 6, sphericalOf(normal), true);
  }, 8),
);
// Two draws: the first triangles as one strip, joined by degenerate triangles, then the others.
const stripTriangles = 60;
const strip = Array.from({ length: stripTriangles }, (_, triangle) => {
  const [a = 0, b = 0, c = 0, next = 0] = mesh.triangles.slice(3 * triangle, 3 * triangle + 4);
  return [a, b, c, c, next, next];
}).flat();
files.set("draws.bin", typedArray(Uint16Array.from([...strip, ...mesh.triangles.slice(3 * stripTriangles)])));
const soup = Array.from(mesh.triangles);
// Three draws: a third of the mesh as triangles, the edges of the second third as lines, and vertices of the last.
const third = 3 * Math.floor(soup.length / 9);
const edges = Array.from({ length: third / 3 }, (_, triangle) => {
  const [a = 0, b = 0, c = 0] = soup.slice(third + 3 * triangle, third + 3 * triangle + 3);
  return [a, b, b, c, c, a];
}).flat();
const mixed = [...soup.slice(0, third), ...edges, ...soup.slice(2 * third)];
const mixedDraws = `primType='"TRIANGLES" "LINES" "POINTS"' vertexCount="${third} ${edges.length} ${soup.length - 2 * third}"`;
files.set("mixed.bin", typedArray(Uint16Array.from(mixed)));
const corners = (values: Float32Array): Float32Array =>
  Float32Array.from(soup.flatMap((vertex) => Array.from(values.slice(3 * vertex, 3 * vertex + 3))));
files.set("soup.bin", typedArray(corners(Float32Array.from(mesh.positions))));
files.set("soupNormal.bin", typedArray(corners(mesh.normals)));

/** Images of 256 columns, whose heights are powers of two, with a texel for each record. */
function image(texels: readonly (readonly number[])[], height: number): Buffer {
  const data = new Uint8Array(256 * height * 3);
  texels.forEach((texel, index) => {
    data.set(texel, 3 * index);
  });
  return encodePng({ width: 256, height, channels: 3, data });
}

const recordRows = 2 ** Math.ceil(Math.log2(vertexCount / 256));
const rowsOf = (indices: readonly number[]): number => 2 ** Math.ceil(Math.log2(indices.length / 256));
const stored = ({ relative }: Vertex): number[] => relative.map((value) => Math.round(65535 * (value + 0.5)));
const indexImage = (indices: readonly number[]): Buffer =>
  image(
    indices.map((record) => [record % 256, Math.floor(record / 256) * (256 / recordRows), 0]),
    rowsOf(indices),
  );
files.set("index.png", indexImage(soup));
files.set("mixed.png", indexImage(mixed));
files.set(
  "coord0.png",
  image(
    vertices.map((vertex) => stored(vertex).map((value) => value >> 8)),
    recordRows,
  ),
);
files.set(
  "coord1.png",
  image(
    vertices.map((vertex) => stored(vertex).map((value) => value & 255)),
    recordRows,
  ),
);
files.set(
  "normal.png",
  image(
    vertices.map(({ normal }) => normal.map((value) => Math.round((value + 1) * 127.5))),
    recordRows,
  ),
);
files.set(
  "color.png",
  image(
    vertices.map(({ color }) => color),
    recordRows,
  ),
);

const texture = (role: string, url: string): string =>
  `<ImageTexture containerField="${role}" url="${url}"><TextureProperties boundaryModeS="CLAMP_TO_EDGE" boundaryModeT="CLAMP_TO_EDGE" magnificationFilter="NEAREST" minificationFilter="NEAREST"></TextureProperties></ImageTexture>`;
const images = (attributes: string, ...textures: readonly string[]): string =>
  `<ImageGeometry ${box} implicitMeshSize="256 ${rowsOf(attributes.includes("LINES") ? mixed : soup)}" useGeoCache="false" ${attributes}>${textures.join("")}</ImageGeometry>`;
const arrays = (attributes: string): string => `<BinaryGeometry ${box} ${attributes}></BinaryGeometry>`;
const triangles = `primType='"TRIANGLES"' vertexCount="${soup.length}"`;
const material = '<Material diffuseColor="0.7 0.5 0.3" specularColor="0.2 0.2 0.2"></Material>';
const shape = (geometry: string, appearance = material): string =>
  `<Shape><Appearance>${appearance}</Appearance>${geometry}</Shape>`;

/** A PopGeometry's file: indices, then records of a position of 16 bits an axis, a normal of 8, a byte of padding. */
function popLevel(indices: readonly number[], [from, to]: readonly [number, number]): Buffer {
  const records = bytesOf(({ relative, normal }, view, at) => {
    relative.forEach((value, axis) => {
      view.setUint16(at + 2 * axis, Math.round(65535 * (value + 0.5)), true);
    });
    normal.forEach((value, axis) => {
      view.setUint8(at + 8 + axis, Math.round((value + 1) * 127.5));
    });
  }, 12).subarray(12 * from, 12 * to);
  return Buffer.concat([typedArray(Uint16Array.from(indices)), records]);
}

// The first level has the triangles of the first half of the vertices.
const coarse = Array.from({ length: soup.length / 3 }, (_, triangle) => soup.slice(3 * triangle, 3 * triangle + 3));
const middle = vertexCount / 2;
const levels = [
  coarse.filter((triangle) => triangle.every((vertex) => vertex < middle)).flat(),
  coarse.filter((triangle) => triangle.some((vertex) => vertex >= middle)).flat(),
] as const;
files.set("level0.bin", popLevel(levels[0], [0, middle]));
files.set("level1.bin", popLevel(levels[1], [middle, vertexCount]));
const pop = `<Transform translation="${extents.map((extent) => -extent / 2).join(" ")}">${shape(
  `<PopGeometry size="${extents.join(" ")}" tightSize="${extents.join(" ")}" maxBBSize="${extents.join(" ")}" position="${extents.map((extent) => extent / 2).join(" ")}" ` +
    `bbMin="0 0 0" bbMinModF="0 0 0" bbMaxModF="1 1 1" attributeStride="12" normalOffset="8" normalPrecision="1" precisionFactor="0.001" ` +
    `primType='"TRIANGLES"' vertexCount="${soup.length}" vertexBufferSize="${vertexCount}">` +
    levels
      .map(
        (indices, level) =>
          `<PopGeometryLevel src="level${level}.bin" numIndices="${indices.length}" vertexDataBufferOffset="${level * middle}"></PopGeometryLevel>`,
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
        `${triangles} index="index.bin" coord="position.bin+8" normal="normal.bin+4" coordType="Int16" normalType="Int8"`,
      ),
    ),
  },
  {
    name: "aopt: interleaved records of Int16",
    releases: both,
    markup: shape(
      arrays(
        `vertexCount="0" index="index.bin" coord="records.bin#0+24" normal="records.bin#8+24" coordType="Int16" normalType="Int16"`,
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
        `primType='"TRIANGLESTRIP" "TRIANGLES"' vertexCount="${strip.length} ${soup.length - 3 * stripTriangles}" index="draws.bin" coord="position.bin" normal="normal.bin"`,
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
        `${triangles} ccw="false" solid="true" index="index.bin" coord="position.bin" normal="normal.bin" color="color.bin+4" colorType="Uint8"`,
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
        `primType='"TRIANGLES"' vertexCount="${soup.length}" coord="soup.bin" normal="soupNormal.bin" normalPerVertex="false"`,
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
        `${mixedDraws} lit="false"`,
        texture("index", "mixed.png"),
        texture("coord", "coord0.png"),
        texture("coord", "coord1.png"),
        texture("color", "color.png"),
      ),
    ),
  },
];

/** The X3D element that shows the layouts for which `isShown` is true. */
export function sceneOf(isShown: (layout: Layout) => boolean): string {
  const shapes = layouts.map((layout, index) => {
    const x = cell * ((index % columns) - (columns - 1) / 2);
    const y = cell * ((rows - 1) / 2 - Math.floor(index / columns));
    return isShown(layout) ? `<Transform translation="${x} ${y} 0">${layout.markup}</Transform>` : "";
  });
  const angle = 2 * Math.atan((rows * cell) / 2 / distance);
  return (
    `<X3D width="${foreignSize.width}px" height="${foreignSize.height}px" showStat="false" showLog="false"><Scene>` +
    `<Background skyColor="0.1 0.1 0.15"></Background><NavigationInfo></NavigationInfo>` +
    `<Viewpoint position="0 0 ${distance}" fieldOfView="${angle}"></Viewpoint>${shapes.join("\n")}</Scene></X3D>`
  );
}

/** Writes the page and its files, and returns their folder. */
export function writeForeignSite(): string {
  const folder = join(outputDirectory, "foreign");
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(folder, { recursive: true });
  for (const [name, bytes] of files) writeFileSync(join(folder, name), bytes);
  const head = `<title>Old</title><meta charset="utf-8"><script src="https://www.x3dom.org/download/x3dom.js"></script>`;
  writeFileSync(
    join(folder, "index.html"),
    `<!doctype html><html><head>${head}</head><body>${sceneOf(() => true)}</body></html>`,
  );
  return folder;
}

/** The part of a picture that shows a layout. */
export function cellOf(picture: Picture, index: number): Picture {
  const width = Math.floor(picture.width / columns);
  const height = Math.floor(picture.height / rows);
  const left = width * (index % columns);
  const top = height * Math.floor(index / columns);
  const lines = Array.from({ length: height }, (_, line) => {
    const from = picture.channels * ((top + line) * picture.width + left);
    return picture.data.slice(from, from + picture.channels * width);
  });
  return { ...picture, width, height, data: Uint8Array.from(lines.flatMap((line) => Array.from(line))) };
}

/** A part of the picture's size that shows nothing but the background of its first pixel. */
export function emptyCell(picture: Picture): Picture {
  const cell = cellOf(picture, 0);
  return { ...cell, data: cell.data.map((_, index) => picture.data[index % picture.channels] ?? 0) };
}
