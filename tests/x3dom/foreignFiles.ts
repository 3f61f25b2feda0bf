// The files of a knot in the layouts that X3DOM's own tools (aopt, the POP converter) and authors wrote. The tests
// write all bytes themselves.

import { trefoil, type PlainMesh } from "../browser/meshes.ts";
import { encodePng } from "../browser/png.ts";

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
export const vertexCount = mesh.positions.length / 3;
/** The size of the box around the knot. */
export const extents = [2 * half.x, 2 * half.y, 2 * half.z] as const;

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

/** By name. */
export const files = new Map<string, Buffer>();
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
/** The numbers of indices of the two draws. */
export const stripCounts = [strip.length, mesh.triangles.length - 3 * stripTriangles] as const;
files.set("draws.bin", typedArray(Uint16Array.from([...strip, ...mesh.triangles.slice(3 * stripTriangles)])));
/** The triangles, as indices of vertices. */
export const soup = Array.from(mesh.triangles);
// Three draws: a third of the mesh as triangles, the edges of the second third as lines, and vertices of the last.
const third = 3 * Math.floor(soup.length / 9);
const edges = Array.from({ length: third / 3 }, (_, triangle) => {
  const [a = 0, b = 0, c = 0] = soup.slice(third + 3 * triangle, third + 3 * triangle + 3);
  return [a, b, b, c, c, a];
}).flat();
export const mixed = [...soup.slice(0, third), ...edges, ...soup.slice(2 * third)];
/** The numbers of indices of the three draws. */
export const mixedCounts = [third, edges.length, soup.length - 2 * third] as const;
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
/** The rows of an image of these indices. */
export const rowsOf = (indices: readonly number[]): number => 2 ** Math.ceil(Math.log2(indices.length / 256));
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
/** The number of vertices of the first level. */
export const middle = vertexCount / 2;
/** The indices of each level. */
export const levels = [
  coarse.filter((triangle) => triangle.every((vertex) => vertex < middle)).flat(),
  coarse.filter((triangle) => triangle.some((vertex) => vertex >= middle)).flat(),
] as const;
files.set("level0.bin", popLevel(levels[0], [0, middle]));
files.set("level1.bin", popLevel(levels[1], [middle, vertexCount]));
