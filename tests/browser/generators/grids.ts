// Generates images that define surfaces (a terrain, a sheet of points, a sculpted vase) as files of an ImageGeometry
// and as the plain meshes that they must look like.

import type { PlainPatch } from "../siteDecoder.ts";
import { decodePng, encodePng } from "../png.ts";

type Point = [number, number, number];

export interface GridExample {
  mode: "heightMap" | "geometryImage" | "sculpt";
  columns: number;
  rows: number;
  position: Point;
  size: Point;
  /** Byte planes, most significant first, by file name. */
  files: Map<string, Buffer>;
}

/** Position of a point on the grid, 0..1 in each axis of its box; u runs along columns, v along rows. */
type Shape = (u: number, v: number) => Point;

/** Hills 4 wide and at most 1 high; heights in 16 bits. */
export function terrain(columns = 80, rows = 60): GridExample {
  const height: Shape = (u, v) => {
    const hills =
      Math.sin(7 * u) * Math.cos(5 * v) + 0.4 * Math.sin(17 * u + 3) * Math.sin(13 * v) + 0.15 * Math.cos(41 * u * v);
    return [(hills + 1.6) / 3.2, 0, 0];
  };
  return exampleOf("heightMap", columns, rows, [0.5, 0.25, 0], [4, 1, 3], 2, 1, height);
}

/** A sheet of waves, rolled up by a third; 16 bits. */
export function sheet(columns = 50, rows = 40): GridExample {
  return exampleOf("geometryImage", columns, rows, [0, 0, 0], [2, 2, 2], 2, 3, (u, v) => {
    const angle = 2 * (u - 0.5);
    const radius = 0.45 + 0.04 * Math.sin(20 * v);
    return [0.5 + radius * Math.sin(angle), 1 - v, 0.1 + radius * Math.cos(angle)];
  });
}

/** A vase with a seam at its back and a pole at either end; 8 bits. */
export function vase(columns = 64, rows = 48): GridExample {
  return exampleOf("sculpt", columns, rows, [0, 0, 0], [2, 3, 2], 1, 3, (u, v) => {
    const radius = v === 0 || v === 1 ? 0 : 0.5 * Math.sin(Math.PI * v) * (0.6 + 0.4 * Math.cos(9 * v));
    // Columns run to the right seen from outside, so counterclockwise around the vase.
    const angle = (2 * Math.PI * u * (columns - 1)) / columns;
    return [0.5 + radius * Math.sin(angle), 1 - v, 0.5 + radius * Math.cos(angle)];
  });
}

export function exampleOf(
  mode: GridExample["mode"],
  columns: number,
  rows: number,
  position: Point,
  size: Point,
  planes: number,
  channels: number,
  shape: Shape,
): GridExample {
  const largest = 256 ** planes - 1;
  const files = new Map<string, Buffer>();
  for (let plane = 0; plane < planes; ++plane) {
    const data = new Uint8Array(columns * rows * channels);
    for (let texel = 0; texel < columns * rows; ++texel) {
      const point = shape((texel % columns) / (columns - 1), Math.floor(texel / columns) / (rows - 1));
      for (let channel = 0; channel < channels; ++channel) {
        const stored = Math.round(point[channel]! * largest);
        data[texel * channels + channel] = Math.floor(stored / 256 ** (planes - 1 - plane)) % 256;
      }
    }
    files.set(`/grid/${mode}-${plane}.png`, encodePng({ width: columns, height: rows, channels, data }));
  }
  return { mode, columns, rows, position, size, files };
}

/**
 * The Shape of a height map whose images are those of `example` cut at the columns and rows, with normals, since those
 * of a part's slope would differ along its border; the files; and the mesh with the normals as they are stored.
 */
export function shapeOfParts(
  example: GridExample,
  cuts: { readonly columns: readonly number[]; readonly rows: readonly number[] },
): { shape: string; files: Map<string, Buffer>; mesh: PlainPatch } {
  const planes = [...example.files.values()].map((file) => decodePng(file));
  const mesh = meshOf(example, planes);
  const bytes = Uint8Array.from(mesh.normals!, (value) => Math.round(((value + 1) / 2) * 255));
  const images = [...planes, { channels: 3, data: bytes }];
  const files = new Map<string, Buffer>();
  const rangesOf = (cuts: readonly number[], count: number) =>
    [0, ...cuts].map((first, i) => ({ first, count: (cuts[i] ?? count - 1) - first + 1 }));
  const patches = rangesOf(cuts.rows, example.rows).flatMap((rows) =>
    rangesOf(cuts.columns, example.columns).map((columns) => {
      const paths = images.map(({ channels, data }, image) => {
        const part = new Uint8Array(columns.count * rows.count * channels);
        for (let row = 0; row < rows.count; ++row) {
          const begin = channels * ((rows.first + row) * example.columns + columns.first);
          part.set(data.subarray(begin, begin + channels * columns.count), channels * row * columns.count);
        }
        const path = `/grid/part-${columns.first}-${rows.first}-${image}.png`;
        files.set(path, encodePng({ width: columns.count, height: rows.count, channels, data: part }));
        return `"${path}"`;
      });
      return `<GeometryPatch gridOrigin="${columns.first} ${rows.first}" implicitMeshSize="${columns.count} ${rows.count}"
        coord='${paths.slice(0, -1).join(" ")}' normal='${paths.at(-1)!}'></GeometryPatch>`;
    }),
  );
  const shape = shapeOf(example)
    .replace(/ coord='[^']*'/, "")
    .replace("></ImageGeometry>", () => `>${patches.join("\n")}</ImageGeometry>`);
  return { shape, files, mesh: { ...mesh, normals: Float32Array.from(bytes, (byte) => (2 * byte) / 255 - 1) } };
}

/** The Shape element of the example. */
export function shapeOf({ mode, columns, rows, position, size, files }: GridExample, attributes = ""): string {
  const coord = [...files.keys()].map((path) => `"${path}"`).join(" ");
  return `<Shape><Appearance><Material diffuseColor="0.7 0.6 0.4" specularColor="0.2 0.2 0.2"></Material></Appearance>
    <ImageGeometry implicitMeshMode="${mode}" implicitMeshSize="${columns} ${rows}" position="${position.join(" ")}" size="${size.join(" ")}"
      coord='${coord}' ${attributes}></ImageGeometry></Shape>`;
}

/** The surface as plain buffers, computed from the bytes of the files. */
export function meshOf(
  { mode, columns, rows, position, size }: GridExample,
  planes: { data: Uint8Array; channels: number }[],
): PlainPatch {
  const largest = 256 ** planes.length - 1;
  const stored = (texel: number, channel: number): number =>
    planes.reduce((value, { data, channels }) => 256 * value + data[texel * channels + channel]!, 0) / largest;
  const count = columns * rows;
  const positions = new Float32Array(3 * count);
  for (let n = 0; n < count; ++n) {
    const [column, row] = [n % columns, Math.floor(n / columns)];
    const share =
      mode === "heightMap"
        ? [column / (columns - 1), stored(n, 0), row / (rows - 1)]
        : [0, 1, 2].map((axis) => stored(n, axis));
    positions.set(
      share.map((part, axis) => position[axis]! + size[axis]! * (part - 0.5)),
      3 * n,
    );
  }
  return surfaceOver({ mode, columns, rows }, positions);
}

/** The surface of a grid whose vertices are at other positions, with its normals. */
export function surfaceOver(
  { mode, columns, rows }: Pick<GridExample, "mode" | "columns" | "rows">,
  positions: Float32Array,
): PlainPatch {
  const triangles: number[] = [];
  const across = mode === "sculpt" ? columns : columns - 1;
  for (let row = 0; row < rows - 1; ++row) {
    for (let column = 0; column < across; ++column) {
      const next = (column + 1) % columns;
      const [a, b, c, d] = [
        row * columns + column,
        row * columns + next,
        (row + 1) * columns + column,
        (row + 1) * columns + next,
      ];
      triangles.push(a, c, b, c, d, b);
    }
  }
  return {
    positions,
    normals: slopes(positions, columns, rows, mode === "sculpt"),
    triangles: Uint32Array.from(triangles),
    lines: new Uint32Array(0),
    points: new Uint32Array(0),
  };
}

/** Normals by central differences; a row that is a single point takes those of the next row. */
function slopes(positions: Float32Array, columns: number, rows: number, isClosed: boolean): Float32Array {
  const at = (row: number, column: number): Point => {
    const n = row * columns + column;
    return [positions[3 * n]!, positions[3 * n + 1]!, positions[3 * n + 2]!];
  };
  const difference = (a: Point, b: Point): Point => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
  const slope = (row: number, column: number): Point => {
    const right = isClosed ? (column + 1) % columns : Math.min(column + 1, columns - 1);
    const left = isClosed ? (column - 1 + columns) % columns : Math.max(column - 1, 0);
    const [x, y, z] = difference(at(row, right), at(row, left));
    const [a, b, c] = difference(at(Math.min(row + 1, rows - 1), column), at(Math.max(row - 1, 0), column));
    return [b * z - c * y, c * x - a * z, a * y - b * x];
  };
  const normals = new Float32Array(positions.length);
  for (let row = 0; row < rows; ++row) {
    for (let column = 0; column < columns; ++column) {
      let normal = slope(row, column);
      if (Math.hypot(...normal) < 1e-12) normal = slope(row === 0 ? 1 : row - 1, column);
      const length = Math.hypot(...normal);
      normals.set(
        normal.map((part) => part / length),
        3 * (row * columns + column),
      );
    }
  }
  return normals;
}
