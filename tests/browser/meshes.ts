// Generates small meshes for tests (creases, colours, closed surfaces of many patches), writes them as PLY, and reads
// the PLY and OBJ files from which reference pictures of the float input are drawn.

import { cross, minus, unit, type Vec3 } from "./vectors.ts";

/** Per vertex arrays; triangles as vertex triples, lines as pairs; a point cloud has neither. */
export interface PlainMesh {
  positions: Float32Array;
  normals?: Float32Array;
  /** Bytes, three a vertex. */
  colors?: Uint8Array;
  /** Two a vertex. */
  texCoords?: Float32Array;
  triangles: Uint32Array;
  lines?: Uint32Array;
  /** Further numbers, one a vertex, by PLY property name. */
  numbers?: Readonly<Record<string, Float32Array>>;
}

/** A trefoil knot of a bumpy tube: closed, with overhangs and occlusion. 2·along·around triangles. */
export function trefoil(along = 160, around = 16): PlainMesh {
  return closedGrid(along, around, (u, v) => {
    const spine = (t: number): Vec3 => [
      Math.sin(t) + 2 * Math.sin(2 * t),
      Math.cos(t) - 2 * Math.cos(2 * t),
      -Math.sin(3 * t),
    ];
    const radius = 0.5 + 0.06 * Math.sin(12 * u) * Math.cos(3 * v);
    const [ahead, behind, center] = [spine(u + 0.01), spine(u - 0.01), spine(u)];
    const tangent = unit(minus(ahead, behind));
    const side = unit(cross(tangent, [0, 0, 1]));
    const up = cross(side, tangent);
    const onTube = (axis: 0 | 1 | 2): number =>
      center[axis] + radius * (Math.cos(v) * side[axis] + Math.sin(v) * up[axis]);
    return [onTube(0), onTube(1), onTube(2)];
  });
}

/** The same with a colour that changes along the tube. */
export function withColors(mesh: PlainMesh): PlainMesh {
  const colors = new Uint8Array(mesh.positions.length);
  for (let i = 0; i < colors.length; ++i) {
    colors[i] = Math.round(127.5 + 127.5 * Math.sin(1.7 * mesh.positions[i]! + 2.1 * (i % 3)));
  }
  return { ...mesh, colors };
}

/** The mesh with texture coordinates projected along z, from `start` to `start + times` over its extent. */
export function withTexCoords(mesh: PlainMesh, times = 1, start = 0): PlainMesh {
  const across = [0, 1].map((axis) => mesh.positions.filter((_, i) => i % 3 === axis));
  const [min, max] = [Math.min, Math.max].map((pick) => across.map((values) => values.reduce((a, b) => pick(a, b))));
  const texCoords = Float32Array.from({ length: (mesh.positions.length / 3) * 2 }, (_, i) => {
    const [low, high] = [min![i % 2]!, max![i % 2]!];
    return start + (times * (across[i % 2]![Math.floor(i / 2)]! - low)) / (high - low);
  });
  return { ...mesh, texCoords };
}

/** OBJ of triangles with normals and texture coordinates, whose material `material` is in `library`. */
export function writeObj(
  { positions, normals = new Float32Array(0), texCoords = new Float32Array(0), triangles }: PlainMesh,
  library: string,
  material: string,
): string {
  const rows = (word: string, values: Float32Array, each: number): string[] =>
    Array.from(
      { length: values.length / each },
      (_, i) => `${word} ${values.subarray(each * i, each * (i + 1)).join(" ")}`,
    );
  const faces = Array.from(
    { length: triangles.length / 3 },
    (_, t) =>
      `f ${Array.from(triangles.subarray(3 * t, 3 * t + 3), (vertex) =>
        Array(3)
          .fill(vertex + 1)
          .join("/"),
      ).join(" ")}`,
  );
  return [
    `mtllib ${library}`,
    `usemtl ${material}`,
    ...rows("v", positions, 3),
    ...rows("vt", texCoords, 2),
    ...rows("vn", normals, 3),
    ...faces,
    "",
  ].join("\n");
}

export function withoutNormals({ positions, triangles }: PlainMesh): PlainMesh {
  return { positions, triangles };
}

/** A unit sphere: an octahedron whose edges are split into `splits`; closed, 8·splits² triangles. */
export function sphere(splits = 50): PlainMesh {
  const vertices: Vec3[] = [];
  const numbers = new Map<string, number>();
  const triangles: number[] = [];
  const vertex = (corner: Vec3): number => {
    const key = corner.join();
    const known = numbers.get(key);
    if (known !== undefined) return known;
    numbers.set(key, vertices.length);
    return vertices.push(unit(corner)) - 1;
  };
  for (let octant = 0; octant < 8; ++octant) {
    const [sx, sy, sz] = [octant & 1 ? -1 : 1, octant & 2 ? -1 : 1, octant & 4 ? -1 : 1];
    const at = (i: number, j: number): number => vertex([sx * i + 0, sy * j + 0, sz * (splits - i - j) + 0]);
    const add = (a: number, b: number, c: number): number =>
      sx * sy * sz > 0 ? triangles.push(a, b, c) : triangles.push(a, c, b);
    for (let i = 0; i < splits; ++i) {
      for (let j = 0; j < splits - i; ++j) {
        add(at(i, j), at(i + 1, j), at(i, j + 1));
        if (i + j < splits - 1) add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
      }
    }
  }
  const positions = Float32Array.from(vertices.flat());
  return { positions, normals: Float32Array.from(positions), triangles: Uint32Array.from(triangles) };
}

/** The cube from -1 to 1: two triangles a face, whose corners have its normal. */
export function cube(): PlainMesh {
  const [positions, normals, triangles]: number[][] = [[], [], []];
  for (const axis of [0, 1, 2])
    for (const side of [-1, 1]) {
      const first = positions!.length / 3;
      const turned = (vector: Vec3): Vec3 => [
        vector[(3 - axis) % 3]!,
        vector[(4 - axis) % 3]!,
        vector[(5 - axis) % 3]!,
      ];
      for (const [u, v] of [
        [-1, -1],
        [1, -1],
        [1, 1],
        [-1, 1],
      ] as const) {
        positions!.push(...turned([side, side * u, v]));
        normals!.push(...turned([side, 0, 0]));
      }
      triangles!.push(...[0, 1, 2, 0, 2, 3].map((corner) => first + corner));
    }
  return {
    positions: Float32Array.from(positions!),
    normals: Float32Array.from(normals!),
    triangles: Uint32Array.from(triangles!),
  };
}

/** Coloured points on a spiral around a unit sphere. */
export function pointSpiral(count = 4000): PlainMesh {
  const positions = new Float32Array(3 * count);
  for (let i = 0; i < count; ++i) {
    const z = 1 - (2 * i + 1) / count;
    const r = Math.sqrt(1 - z * z);
    positions.set([r * Math.cos(2.399963 * i), r * Math.sin(2.399963 * i), z], 3 * i);
  }
  return withColors({ positions, triangles: new Uint32Array(0) });
}

/** Coloured lines: a long coil around a torus, and a net of short ones across its hole. */
export function coil(turns = 40, steps = 24, spokes = 60): PlainMesh {
  const vertices: Vec3[] = [];
  const lines: number[] = [];
  for (let i = 0; i < turns * steps; ++i) {
    const [u, v] = [(2 * Math.PI * i) / (turns * steps), (2 * Math.PI * i) / steps];
    const radius = 1 + 0.35 * Math.cos(v);
    vertices.push([radius * Math.cos(u), radius * Math.sin(u), 0.35 * Math.sin(v)]);
    lines.push(i, (i + 1) % (turns * steps));
  }
  for (let i = 0; i < spokes; ++i) {
    const angle = (2 * Math.PI * i) / spokes;
    const first = vertices.push([0.5 * Math.cos(angle), 0.5 * Math.sin(angle), 0]) - 1;
    vertices.push([0.1 * Math.cos(angle + 1), 0.1 * Math.sin(angle + 1), 0.4]);
    lines.push(first, first + 1);
  }
  const positions = Float32Array.from(vertices.flat());
  return withColors({ positions, triangles: new Uint32Array(0), lines: Uint32Array.from(lines) });
}

/** A surface over u, v in 0..2π that closes in both; normals by central differences. */
function closedGrid(along: number, around: number, at: (u: number, v: number) => Vec3): PlainMesh {
  const positions = new Float32Array(3 * along * around);
  const normals = new Float32Array(3 * along * around);
  const triangles: number[] = [];
  const angle = (i: number, count: number): number => (2 * Math.PI * i) / count;
  const step = 1e-4;
  for (let i = 0; i < along; ++i) {
    for (let j = 0; j < around; ++j) {
      const [u, v] = [angle(i, along), angle(j, around)];
      const vertex = i * around + j;
      positions.set(at(u, v), 3 * vertex);
      const du = minus(at(u + step, v), at(u - step, v));
      const dv = minus(at(u, v + step), at(u, v - step));
      normals.set(unit(cross(du, dv)), 3 * vertex);
      const right = ((i + 1) % along) * around + j;
      const [above, aboveRight] = [i * around + ((j + 1) % around), ((i + 1) % along) * around + ((j + 1) % around)];
      triangles.push(vertex, right, aboveRight, vertex, aboveRight, above);
    }
  }
  return { positions, normals, triangles: Uint32Array.from(triangles) };
}

/** Area-weighted vertex normals, as convert computes them for a mesh without normals. */
export function areaWeightedNormals({ positions, triangles }: PlainMesh): Float32Array {
  const sums = new Float64Array(positions.length);
  const at = (vertex: number): Vec3 => [positions[3 * vertex]!, positions[3 * vertex + 1]!, positions[3 * vertex + 2]!];
  for (let t = 0; t < triangles.length; t += 3) {
    const corners = [triangles[t]!, triangles[t + 1]!, triangles[t + 2]!];
    const [a, b, c] = [at(corners[0]!), at(corners[1]!), at(corners[2]!)];
    const weighted = cross(minus(b, a), minus(c, a));
    for (const corner of corners) weighted.forEach((value, axis) => (sums[3 * corner + axis]! += value));
  }
  for (let i = 0; i < sums.length; i += 3) sums.set(unit([sums[i]!, sums[i + 1]!, sums[i + 2]!]), i);
  return Float32Array.from(sums);
}

/** Binary little-endian PLY. */
export function writePly({
  positions,
  normals,
  colors,
  triangles,
  lines = new Uint32Array(0),
  numbers = {},
}: PlainMesh): Buffer {
  const count = positions.length / 3;
  const properties = [
    ...["x", "y", "z"].map((name) => `float ${name}`),
    ...(normals ? ["nx", "ny", "nz"].map((name) => `float ${name}`) : []),
    ...(colors ? ["red", "green", "blue"].map((name) => `uchar ${name}`) : []),
    ...Object.keys(numbers).map((name) => `float ${name}`),
  ].map((property) => `property ${property}\n`);
  const faces = triangles.length
    ? `element face ${triangles.length / 3}\nproperty list uchar int vertex_indices\n`
    : "";
  const edges = lines.length ? `element edge ${lines.length / 2}\nproperty int vertex1\nproperty int vertex2\n` : "";
  const header = `ply\nformat binary_little_endian 1.0\nelement vertex ${count}\n${properties.join("")}${faces}${edges}end_header\n`;
  const recordBytes = 12 + (normals ? 12 : 0) + (colors ? 3 : 0) + 4 * Object.keys(numbers).length;
  const body = Buffer.alloc(count * recordBytes + (triangles.length / 3) * 13 + lines.length * 4);
  let at = 0;
  for (let i = 0; i < count; ++i) {
    for (const floats of [positions, normals]) {
      floats?.subarray(3 * i, 3 * i + 3).forEach((value) => (at = body.writeFloatLE(value, at)));
    }
    colors?.subarray(3 * i, 3 * i + 3).forEach((value) => (at = body.writeUInt8(value, at)));
    for (const values of Object.values(numbers)) at = body.writeFloatLE(values[i]!, at);
  }
  for (let t = 0; t < triangles.length; t += 3) {
    at = body.writeUInt8(3, at);
    triangles.subarray(t, t + 3).forEach((corner) => (at = body.writeInt32LE(corner, at)));
  }
  lines.forEach((corner) => (at = body.writeInt32LE(corner, at)));
  return Buffer.concat([Buffer.from(header), body]);
}

/** The mesh with a number for each vertex (its y coordinate) and a vector (its position). */
export function withNumbers(mesh: PlainMesh): PlainMesh {
  const axis = (n: number): Float32Array => mesh.positions.filter((_, i) => i % 3 === n);
  return { ...mesh, numbers: { height: axis(1), away_0: axis(0), away_1: axis(1), away_2: axis(2) } };
}

/** Reads files of writePly, without further numbers. */
export function readPly(bytes: Buffer): PlainMesh {
  const headerBytes = bytes.indexOf("end_header\n") + "end_header\n".length;
  const header = bytes.toString("latin1", 0, headerBytes);
  const count = Number(/element vertex (\d+)/.exec(header)?.[1]);
  const faceCount = Number(/element face (\d+)/.exec(header)?.[1] ?? 0);
  const edgeCount = Number(/element edge (\d+)/.exec(header)?.[1] ?? 0);
  const normals = header.includes("float nx") ? new Float32Array(3 * count) : undefined;
  const colors = header.includes("uchar red") ? new Uint8Array(3 * count) : undefined;
  const positions = new Float32Array(3 * count);
  const triangles = new Uint32Array(3 * faceCount);
  let at = headerBytes;
  for (let i = 0; i < count; ++i) {
    for (const floats of normals ? [positions, normals] : [positions]) {
      for (let axis = 0; axis < 3; ++axis, at += 4) floats[3 * i + axis] = bytes.readFloatLE(at);
    }
    if (colors) for (let axis = 0; axis < 3; ++axis, ++at) colors[3 * i + axis] = bytes.readUInt8(at);
  }
  for (let t = 0; t < faceCount; ++t, at += 13) {
    for (let corner = 0; corner < 3; ++corner) triangles[3 * t + corner] = bytes.readInt32LE(at + 1 + 4 * corner);
  }
  const lines = Uint32Array.from({ length: 2 * edgeCount }, (_, corner) => bytes.readInt32LE(at + 4 * corner));
  return {
    positions,
    triangles,
    ...(edgeCount > 0 && { lines }),
    ...(normals && { normals }),
    ...(colors && { colors }),
  };
}

/** Positions and triangles of an OBJ file; ignores everything else. */
export function readObj(text: string): PlainMesh {
  const positions: number[] = [];
  const triangles: number[] = [];
  for (const line of text.split("\n")) {
    const [keyword, ...words] = line.trim().split(/\s+/);
    if (keyword === "v") positions.push(...words.slice(0, 3).map(Number));
    if (keyword === "f") {
      const corners = words.map((word) => parseInt(word) - 1);
      for (let i = 2; i < corners.length; ++i) triangles.push(corners[0]!, corners[i - 1]!, corners[i]!);
    }
  }
  return { positions: Float32Array.from(positions), triangles: Uint32Array.from(triangles) };
}
