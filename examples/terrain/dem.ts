// The elevation model of the Jacksboro fault in Tennessee (SRTM, three seconds of arc), which Debian's package
// python-matplotlib-data installs as arrays of NumPy, as a GeoTIFF file.

import { readFileSync } from "node:fs";
import { inflateRawSync } from "node:zlib";

export const jacksboroFile = "/usr/share/matplotlib/mpl-data/sample_data/jacksboro_fault_dem.npz";

/** Heights row by row, the northern one first, and the outer corner of the first cell in degrees. */
export interface ElevationModel {
  readonly columns: number;
  readonly rows: number;
  /** Metres. */
  readonly heights: Int16Array;
  readonly west: number;
  readonly north: number;
  /** Degrees, to the east and to the south. */
  readonly cell: readonly [number, number];
}

/** The files of a ZIP archive by name; stored or deflated. */
function unzip(archive: Buffer): Map<string, Buffer> {
  const end = archive.lastIndexOf(Buffer.from([0x50, 0x4b, 5, 6]));
  const files = new Map<string, Buffer>();
  let entry = archive.readUInt32LE(end + 16);
  for (let left = archive.readUInt16LE(end + 10); left > 0; --left) {
    const [method, size] = [archive.readUInt16LE(entry + 10), archive.readUInt32LE(entry + 20)];
    const [nameLength, extraLength, commentLength] = [
      archive.readUInt16LE(entry + 28),
      archive.readUInt16LE(entry + 30),
      archive.readUInt16LE(entry + 32),
    ];
    const header = archive.readUInt32LE(entry + 42);
    const begin = header + 30 + archive.readUInt16LE(header + 26) + archive.readUInt16LE(header + 28);
    const packed = archive.subarray(begin, begin + size);
    const name = archive.toString("latin1", entry + 46, entry + 46 + nameLength);
    files.set(name, method === 0 ? packed : inflateRawSync(packed));
    entry += 46 + nameLength + extraLength + commentLength;
  }
  return files;
}

/** Shape and data of an array in NumPy's format. */
function npyOf(file: Buffer): { shape: number[]; data: Buffer } {
  const headerLength = file.readUInt16LE(8);
  const shape = /'shape': \(([^)]*)\)/.exec(file.toString("latin1", 10, 10 + headerLength))?.[1] ?? "";
  return { shape: shape.split(",").filter(Boolean).map(Number), data: file.subarray(10 + headerLength) };
}

export function readElevationModel(path = jacksboroFile): ElevationModel {
  const files = unzip(readFileSync(path));
  const arrayOf = (name: string) => {
    const file = files.get(`${name}.npy`);
    if (file === undefined) throw new Error(`${path} has no array ${name}`);
    return npyOf(file);
  };
  const numberOf = (name: string) => arrayOf(name).data.readDoubleLE(0);
  const { shape, data } = arrayOf("elevation");
  const [rows = 0, columns = 0] = shape;
  return {
    columns,
    rows,
    heights: Int16Array.from({ length: rows * columns }, (_, n) => data.readInt16LE(2 * n)),
    west: numberOf("xmin"),
    north: Math.max(numberOf("ymin"), numberOf("ymax")),
    cell: [numberOf("dx"), numberOf("dy")],
  };
}

/** A GeoTIFF file (OGC 19-008) of heights in WGS 84. */
export function geoTiffOf({ columns, rows, heights, west, north, cell }: ElevationModel): Buffer {
  type Tag = [tag: number, type: 3 | 4 | 12, values: number[]];
  const bytesOf = { 3: 2, 4: 4, 12: 8 } as const;
  const heightsAt = [0];
  const tags: Tag[] = [
    [256, 4, [columns]],
    [257, 4, [rows]],
    [258, 3, [16]], // bits of a sample
    [259, 3, [1]], // not compressed
    [262, 3, [1]], // black is zero
    [273, 4, heightsAt],
    [277, 3, [1]], // samples of a cell
    [278, 4, [rows]],
    [279, 4, [2 * columns * rows]],
    [339, 3, [2]], // signed
    [33550, 12, [cell[0], cell[1], 0]],
    [33922, 12, [0, 0, 0, west, north, 0]],
    // Version 1.1.0, three keys: a geographic system, cells are areas, EPSG:4326
    [34735, 3, [1, 1, 0, 3, 1024, 0, 1, 2, 1025, 0, 1, 1, 2048, 0, 1, 4326]],
  ];
  const directory = Buffer.alloc(2 + 12 * tags.length + 4);
  const further: Buffer[] = [];
  let end = 8 + directory.length;
  for (const [, type, values] of tags) if (values.length * bytesOf[type] > 4) end += values.length * bytesOf[type];
  heightsAt[0] = end;
  directory.writeUInt16LE(tags.length, 0);
  let offset = 8 + directory.length;
  for (const [n, [tag, type, values]] of tags.entries()) {
    const bytes = Buffer.alloc(Math.max(4, values.length * bytesOf[type]));
    for (const [i, value] of values.entries()) {
      if (type === 3) bytes.writeUInt16LE(value, 2 * i);
      if (type === 4) bytes.writeUInt32LE(value, 4 * i);
      if (type === 12) bytes.writeDoubleLE(value, 8 * i);
    }
    const at = 2 + 12 * n;
    directory.writeUInt16LE(tag, at);
    directory.writeUInt16LE(type, at + 2);
    directory.writeUInt32LE(values.length, at + 4);
    if (bytes.length === 4) bytes.copy(directory, at + 8);
    else {
      directory.writeUInt32LE(offset, at + 8);
      further.push(bytes);
      offset += bytes.length;
    }
  }
  const header = Buffer.from([0x49, 0x49, 42, 0, 8, 0, 0, 0]);
  const samples = Buffer.alloc(2 * columns * rows);
  for (const [n, height] of heights.entries()) samples.writeInt16LE(height, 2 * n);
  return Buffer.concat([header, directory, ...further, samples]);
}
