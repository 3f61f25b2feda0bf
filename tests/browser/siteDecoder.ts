// The tests' own decoder: reads a site's document and container files into plain float buffers of the quantised mesh.
// It is written from docs/formats/nodes.md alone and shares no code with the product, so that errors of either do not
// cancel out.

import { readFileSync } from "node:fs";
import { join } from "node:path";
import { decodePng } from "./png.ts";

/** An element's name and its attributes by name; names are in lower case. */
export interface Tag {
  name: string;
  attributes: Record<string, string>;
}

/** Every start tag of a document that imgeo wrote, in order. */
export function tagsOf(text: string): Tag[] {
  return [...text.matchAll(/<([A-Za-z][\w-]*)((?:\s+[\w:-]+(?:=(?:"[^"]*"|'[^']*'))?)*)\s*\/?>/g)].map((tag) => ({
    name: tag[1]!.toLowerCase(),
    attributes: Object.fromEntries(
      [...tag[2]!.matchAll(/([\w:-]+)=(?:"([^"]*)"|'([^']*)')/g)].map((a) => [
        a[1]!.toLowerCase(),
        (a[2] ?? a[3] ?? "").replaceAll("&quot;", '"').replaceAll("&apos;", "'").replaceAll("&#39;", "'"),
      ]),
    ),
  }));
}

export function numbersOf(text: string | undefined, fallback: number[]): number[] {
  const numbers = text
    ?.trim()
    .split(/[\s,]+/)
    .map(Number);
  return numbers ?? fallback;
}

function stringsOf(text: string | undefined): string[] {
  if (text === undefined || text.trim() === "") return [];
  const quoted = [...text.matchAll(/"([^"]*)"/g)].map((match) => match[1]!);
  return quoted.length ? quoted : text.trim().split(/\s+/);
}

/** The content of one patch as plain buffers. */
export interface PlainPatch {
  positions: Float32Array;
  normals?: Float32Array;
  /** 0..1, three a vertex. */
  colors?: Float32Array;
  /** Triangles in their drawn orientation; strips are converted to triangles. */
  triangles: Uint32Array;
  /** Pairs of vertices; strips are converted to pairs. */
  lines: Uint32Array;
  /** Index of each triangle in the patch; degenerate triangles that join strips count too. */
  triangleIndices?: Uint32Array;
  /** Vertices drawn as points. */
  points: Uint32Array;
}

type Attributes = Record<string, string>;
interface Records {
  /** Component of a record, as stored. */
  at(record: number, component: number): number;
}

/** All patches of the only geometry of the site; of SIG only the first `planes` byte planes are read. */
export function decodeSite(directory: string, planes = Infinity): PlainPatch[] {
  const tags = tagsOf(readFileSync(join(directory, "index.html"), "utf8"));
  const node = tags.find(({ name }) => name === "imagegeometry" || name === "binarygeometry");
  if (!node) throw new Error(`${directory} has no geometry node`);
  const patches = tags.filter(({ name }) => name === "geometrypatch");
  return (patches.length ? patches : [node]).map((patch) =>
    node.name === "imagegeometry"
      ? decodeSig(node.attributes, patch.attributes, directory, planes)
      : decodeBg(node.attributes, patch.attributes, directory),
  );
}

/** The URLs, without fragments, of every container file of a document, each with its rank in the order of
 *  delivery: 0 first coordinate byte, 1 index, 2 normals, 3 colours and texture coordinates, 4 and up further bytes. */
export function ranksOfFiles(html: string): Map<string, number> {
  const ranks = new Map<string, number>();
  for (const { name, attributes } of tagsOf(html)) {
    if (!/^(geometrypatch|imagegeometry|binarygeometry)$/.test(name)) continue;
    const setRank = (text: string | undefined, rank: (index: number) => number): void => {
      stringsOf(text).forEach((reference, index) => {
        const url = reference.split("#")[0]!;
        ranks.set(url, Math.min(rank(index), ranks.get(url) ?? Infinity));
      });
    };
    setRank(attributes.coord, (index) => (index === 0 ? 0 : 3 + index));
    setRank(attributes.index, () => 1);
    setRank(attributes.normal, () => 2);
    setRank(attributes.color, () => 3);
    setRank(attributes.texcoord, () => 3);
  }
  return ranks;
}

interface DataImage extends Records {
  width: number;
  height: number;
}

function normalsOfImages(node: Attributes, images: DataImage[], records: number): Float32Array {
  const encoding = node.normalencoding ?? "rgb";
  const image = images[0]!;
  if (encoding === "rgb" || encoding === "palette")
    return table(records, (r, axis) => 2 * fractionOf(images, r, axis) - 1);
  if (node.normalbits === "16") {
    const word = (r: number, part: number): number => 256 * image.at(r, part) + image.at(r, part + 2);
    return normalsOfPairs(encoding, 65535, records, word);
  }
  const half = (image.width * image.height) / 2;
  return normalsOfPairs(encoding, 255, records, (r, part) => image.at(part * half + r, 0));
}

/** A number whose bytes are in several images, most significant first, as a fraction of its range. */
function fractionOf(images: DataImage[], record: number, component: number): number {
  return images.reduce((sum, image) => 256 * sum + image.at(record, component), 0) / (256 ** images.length - 1);
}

/** Unit vectors of octahedral (x, y) or spherical (phi, theta), integers 0..largest. */
function normalsOfPairs(
  encoding: string,
  largest: number,
  records: number,
  pairAt: (r: number, part: number) => number,
): Float32Array {
  const normals = Array.from({ length: records }, (_, r): number[] => {
    const [first, second] = [pairAt(r, 0), pairAt(r, 1)];
    if (encoding === "spherical") {
      const phi = Math.PI * ((2 * first) / largest - 1);
      const theta = (Math.PI * second) / largest;
      return [Math.sin(theta) * Math.cos(phi), Math.sin(theta) * Math.sin(phi), Math.cos(theta)];
    }
    const [u, v] = [first, second].map((number) => (2 * number) / (largest - 1) - 1) as [number, number];
    const z = 1 - Math.abs(u) - Math.abs(v);
    const [x, y] = z >= 0 ? [u, v] : [(1 - Math.abs(v)) * (u < 0 ? -1 : 1), (1 - Math.abs(u)) * (v < 0 ? -1 : 1)];
    const length = Math.hypot(x, y, z);
    return [x / length, y / length, z / length];
  });
  return Float32Array.from(normals.flat());
}

function decodeSig(node: Attributes, patch: Attributes, directory: string, planeCount: number): PlainPatch {
  const image = (url: string): DataImage => {
    const [path, first] = url.split("#");
    const { data, channels, width, height } = decodePng(readFileSync(join(directory, path!)));
    return { width, height, at: (record, component) => data[(record + Number(first ?? 0)) * channels + component]! };
  };
  const planes = stringsOf(patch.coord).map(image);
  const height = planes[0]!.height;
  const recordCount = Number(patch.recordcount);
  const index = patch.index ? image(patch.index) : undefined;
  // The midpoint of the possible values replaces missing bytes.
  const byteOf = (plane: Records, index: number, r: number, axis: number): number =>
    index < planeCount ? plane.at(r, axis) : 127.5;
  const coordinate: Records = {
    at: (r, axis) => planes.reduce((value, plane, index) => 256 * value + byteOf(plane, index, r, axis), 0),
  };
  const normals = stringsOf(patch.normal).map(image);
  const colors = stringsOf(patch.color).map(image);
  const indexWidth = numbersOf(patch.implicitmeshsize ?? node.implicitmeshsize, [256])[0]!;
  const recordIndexOf = (n: number): number => {
    if (!index) return n;
    const texel = (n % indexWidth) + Math.floor(n / indexWidth) * index.width;
    if (node.indextype === "Uint32") return index.at(texel, 0) + 256 * index.at(texel, 1) + 65536 * index.at(texel, 2);
    return index.at(texel, 0) + 256 * ((index.at(texel, 1) * height) / 256);
  };
  return {
    positions: spread(node, coordinate, recordCount, 256 ** planes.length - 1),
    ...(normals.length > 0 && { normals: normalsOfImages(node, normals, recordCount) }),
    ...(colors.length > 0 && { colors: table(recordCount, (r, axis) => fractionOf(colors, r, axis)) }),
    ...elementsOf(patch, recordIndexOf),
  };
}

const readers: Record<string, [bytes: number, largest: number, read: (bytes: Buffer, at: number) => number]> = {
  Int8: [1, 127, (bytes, at) => bytes.readInt8(at)],
  Uint8: [1, 255, (bytes, at) => bytes.readUInt8(at)],
  Int16: [2, 32767, (bytes, at) => bytes.readInt16LE(at)],
  Uint16: [2, 65535, (bytes, at) => bytes.readUInt16LE(at)],
  Uint32: [4, 4294967295, (bytes, at) => bytes.readUInt32LE(at)],
  Float32: [4, 1, (bytes, at) => bytes.readFloatLE(at)],
};

function decodeBg(node: Attributes, patch: Attributes, directory: string): PlainPatch {
  const array = (url: string, type: string, components: number): Records => {
    const [path, fragment] = url.split("#");
    const bytes = readFileSync(join(directory, path!));
    const [size, , read] = readers[type]!;
    const [offset, stride] = (fragment ?? "0+0").split("+").map(Number);
    const step = stride === 0 ? size * components : stride!;
    return { at: (record, component) => read(bytes, offset! + record * step + component * size) };
  };
  const attribute = (name: string, fallback: string): (Records & { largest: number }) | undefined => {
    const type = node[`${name}type`] ?? fallback;
    const url = patch[name];
    return url ? { ...array(url, type, 3), largest: readers[type]![1] } : undefined;
  };
  const recordCount = Number(patch.recordcount);
  const coordinate = attribute("coord", "Float32")!;
  const normals = normalsOfArrays(node, patch, array, recordCount);
  const color = attribute("color", "Float32");
  const index = patch.index ? array(patch.index, node.indextype ?? "Uint16", 1) : undefined;
  const asFloats = (records: Records & { largest: number }): Float32Array =>
    table(recordCount, (r, axis) => records.at(r, axis) / records.largest);
  return {
    positions:
      coordinate.largest === 1
        ? asFloats(coordinate)
        : spread(node, coordinate, recordCount, coordinate.largest, node.coordtype!.startsWith("Int") ? 0 : 0.5),
    ...(normals && { normals }),
    ...(color && { colors: asFloats(color) }),
    ...elementsOf(patch, (n) => (index ? index.at(n, 0) : n)),
  };
}

type OpenArray = (url: string, type: string, components: number) => Records;

function normalsOfArrays(
  node: Attributes,
  patch: Attributes,
  open: OpenArray,
  records: number,
): Float32Array | undefined {
  if (node.normalassphericalcoordinates === "true") {
    const words = open(patch.coord!, "Uint16", 4);
    return normalsOfPairs("spherical", 255, records, (r, part) => (words.at(r, 3) >> (8 * part)) & 255);
  }
  if (!patch.normal) return undefined;
  const type = node.normaltype ?? "Float32";
  const largest = readers[type]![1];
  if (node.normalencoding === "octahedral") {
    const pairs = open(patch.normal, type, 2);
    return normalsOfPairs("octahedral", largest, records, (r, part) => pairs.at(r, part));
  }
  const vectors = open(patch.normal, type, 3);
  return table(records, (r, axis) => vectors.at(r, axis) / largest);
}

function table(records: number, value: (record: number, axis: number) => number): Float32Array {
  return Float32Array.from({ length: 3 * records }, (_, i) => value(Math.floor(i / 3), i % 3));
}

/** Maps stored integers 0..largest to the decode box; signed ones (`middle` 0) to both sides of its center. */
function spread(node: Attributes, stored: Records, records: number, largest: number, middle = 0.5): Float32Array {
  const center = numbersOf(node.position, [0, 0, 0]);
  const size = numbersOf(node.size, [1, 1, 1]);
  return table(records, (r, axis) => center[axis]! + size[axis]! * (stored.at(r, axis) / largest - middle));
}

function elementsOf(
  patch: Attributes,
  recordIndexOf: (n: number) => number,
): Required<Pick<PlainPatch, "triangles" | "triangleIndices" | "lines" | "points">> {
  const triangles: number[] = [];
  const triangleIndices: number[] = [];
  let triangleCount = 0;
  const lines: number[] = [];
  const points: number[] = [];
  const counts = numbersOf(patch.vertexcount, []);
  let first = 0;
  stringsOf(patch.primtype).forEach((primitive, draw) => {
    const vertices = Array.from({ length: counts[draw]! }, (_, i) => recordIndexOf(first + i));
    first += counts[draw]!;
    if (primitive === "POINTS") points.push(...vertices);
    else if (primitive === "LINES") lines.push(...vertices);
    else if (primitive === "LINESTRIP") vertices.slice(1).forEach((vertex, i) => lines.push(vertices[i]!, vertex));
    else if (primitive === "TRIANGLES") {
      for (const vertex of vertices) triangles.push(vertex);
      for (let i = 2; i < vertices.length; i += 3) triangleIndices.push(triangleCount++);
    } else if (primitive === "TRIANGLESTRIP") {
      for (let i = 2; i < vertices.length; ++i, ++triangleCount) {
        const [a, b, c] = [vertices[i - 2]!, vertices[i - 1]!, vertices[i]!];
        if (a === b || b === c || c === a) continue;
        triangles.push(...(i % 2 === 0 ? [a, b, c] : [b, a, c]));
        triangleIndices.push(triangleCount);
      }
    } else throw new Error(`the test decoder does not know ${primitive}`);
  });
  return {
    triangles: Uint32Array.from(triangles),
    triangleIndices: Uint32Array.from(triangleIndices),
    lines: Uint32Array.from(lines),
    points: Uint32Array.from(points),
  };
}
