// A room whose light was baked: every quad has coordinates of its own in an atlas (TEXCOORD_1), beside repeated ones
// for planks (TEXCOORD_0). Plaster and oak are unlit and show the baked light, planks have it as occlusion. No lights,
// no camera, walls with one side, as an exporter leaves them.

import { GlbWriter } from "../browser/glb.ts";
import { encodePng } from "../browser/png.ts";

type Vec = readonly [x: number, y: number, z: number];

/** A rectangle: a corner and two edges, whose cross product is the side that is seen. In metres. */
interface Quad {
  readonly corner: Vec;
  readonly u: Vec;
  readonly v: Vec;
  readonly material: "Plaster" | "Planks" | "Oak";
}

const [width, height, depth] = [6, 2.8, 4.5];
/** The window in the wall at x = 0: from z0 to z1, from y0 to y1. */
const opening = { z0: 1.1, z1: 3.4, y0: 0.9, y1: 2.3 };

const boxes: readonly (readonly [Vec, Vec])[] = [
  [
    [2.2, 0.72, 1.4],
    [4, 0.78, 2.5],
  ],
  ...([0, 1, 2, 3] as const).map((leg): readonly [Vec, Vec] => {
    const [x, z] = [2.25 + 1.62 * (leg & 1), 1.45 + 0.92 * (leg >> 1)];
    return [
      [x, 0, z],
      [x + 0.08, 0.72, z + 0.08],
    ];
  }),
  [
    [4.9, 0, 3.6],
    [5.9, 1.7, 4.4],
  ],
];

function quadsOfBox([[x0, y0, z0], [x1, y1, z1]]: readonly [Vec, Vec]): Quad[] {
  const [a, b, c] = [x1 - x0, y1 - y0, z1 - z0];
  const quad = (corner: Vec, u: Vec, v: Vec): Quad => ({ corner, u, v, material: "Oak" });
  return [
    quad([x0, y0, z1], [a, 0, 0], [0, b, 0]),
    quad([x1, y0, z0], [-a, 0, 0], [0, b, 0]),
    quad([x1, y0, z1], [0, 0, -c], [0, b, 0]),
    quad([x0, y0, z0], [0, 0, c], [0, b, 0]),
    quad([x0, y1, z1], [a, 0, 0], [0, 0, -c]),
    quad([x0, y0, z0], [a, 0, 0], [0, 0, c]),
  ];
}

const { z0, z1, y0, y1 } = opening;
const quads: readonly Quad[] = [
  { corner: [0, 0, depth], u: [width, 0, 0], v: [0, 0, -depth], material: "Planks" },
  { corner: [0, height, 0], u: [width, 0, 0], v: [0, 0, depth], material: "Plaster" },
  { corner: [0, 0, 0], u: [width, 0, 0], v: [0, height, 0], material: "Plaster" },
  { corner: [width, 0, depth], u: [-width, 0, 0], v: [0, height, 0], material: "Plaster" },
  { corner: [width, 0, 0], u: [0, 0, depth], v: [0, height, 0], material: "Plaster" },
  // The wall around the window.
  { corner: [0, 0, depth], u: [0, 0, -depth], v: [0, y0, 0], material: "Plaster" },
  { corner: [0, y1, depth], u: [0, 0, -depth], v: [0, height - y1, 0], material: "Plaster" },
  { corner: [0, y0, depth], u: [0, 0, z1 - depth], v: [0, y1 - y0, 0], material: "Plaster" },
  { corner: [0, y0, z0], u: [0, 0, -z0], v: [0, y1 - y0, 0], material: "Plaster" },
  ...boxes.flatMap(quadsOfBox),
];

const add = (a: Vec, b: Vec, times = 1): Vec => [a[0] + times * b[0], a[1] + times * b[1], a[2] + times * b[2]];
const dot = (a: Vec, b: Vec): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a: Vec, b: Vec): Vec => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
const length = (a: Vec): number => Math.hypot(...a);
const normalOf = ({ u, v }: Quad): Vec => {
  const n = cross(u, v);
  return add([0, 0, 0], n, 1 / length(n));
};

/** Whether furniture stands between two points. */
function isHidden(from: Vec, to: Vec): boolean {
  const way = add(to, from, -1);
  return boxes.some(([low, high]) => {
    let [enter, leave] = [1e-4, 1];
    for (const axis of [0, 1, 2] as const) {
      const slope = way[axis] === 0 ? 1e-12 : way[axis];
      const [a, b] = [(low[axis] - from[axis]) / slope, (high[axis] - from[axis]) / slope];
      enter = Math.max(enter, Math.min(a, b));
      leave = Math.min(leave, Math.max(a, b));
    }
    return enter < leave;
  });
}

/** Points on the window from which light comes, and on the ceiling from which it comes a second time. */
const lamps: readonly { point: Vec; facing: Vec; power: number }[] = Array.from({ length: 24 }, (_, i) => [
  {
    point: [0, y0 + ((Math.floor(i / 6) + 0.5) / 4) * (y1 - y0), z0 + (((i % 6) + 0.5) / 6) * (z1 - z0)] as Vec,
    facing: [1, 0, 0] as Vec,
    power: 0.32,
  },
  {
    point: [(((i % 6) + 0.5) / 6) * width, height - 0.02, ((Math.floor(i / 6) + 0.5) / 4) * depth] as Vec,
    facing: [0, -1, 0] as Vec,
    power: 0.1,
  },
]).flat();

function lightAt(point: Vec, normal: Vec): number {
  const from = add(point, normal, 2e-3);
  let sum = 0.16;
  for (const lamp of lamps) {
    const way = add(lamp.point, from, -1);
    const distance = Math.max(length(way), 0.35);
    const [cosine, emitted] = [dot(way, normal) / distance, -dot(way, lamp.facing) / distance];
    if (cosine <= 0 || emitted <= 0 || isHidden(from, lamp.point)) continue;
    sum += (lamp.power * cosine * emitted) / distance ** 2;
  }
  return sum / (0.6 + sum);
}

/** Charts lie in cells of a grid; each has a border, so that filtering does not reach its neighbour. */
const columns = Math.ceil(Math.sqrt(quads.length));
const cell = 80;
const edge = columns * cell;
const margin = 3;

function bakedAtlas(): Buffer {
  const data = new Uint8Array(3 * edge * edge);
  quads.forEach((quad, n) => {
    const [left, top] = [(n % columns) * cell, Math.floor(n / columns) * cell];
    const normal = normalOf(quad);
    for (let y = 0; y < cell; ++y)
      for (let x = 0; x < cell; ++x) {
        const inside = (at: number) => Math.min(Math.max((at + 0.5 - margin) / (cell - 2 * margin), 0.004), 0.996);
        const point = add(add(quad.corner, quad.u, inside(x)), quad.v, inside(y));
        const light = 255 * lightAt(point, normal) ** (1 / 2.2);
        data.set([light, 0.985 * light, 0.95 * light].map(Math.round), 3 * ((top + y) * edge + left + x));
      }
  });
  return encodePng({ width: edge, height: edge, channels: 3, data });
}

function planks(): Buffer {
  const side = 128;
  const data = new Uint8Array(3 * side * side);
  for (let y = 0; y < side; ++y)
    for (let x = 0; x < side; ++x) {
      const board = Math.floor(x / 32);
      const joint = x % 32 === 0 || (y + 47 * board) % 128 === 0;
      const grain = 12 * Math.sin(0.9 * x + 2.5 * Math.sin(0.05 * y + board)) + 9 * ((board * 7) % 4);
      const tone = joint ? 70 : 150 + grain;
      data.set([tone, 0.74 * tone, 0.5 * tone].map(Math.round), 3 * (y * side + x));
    }
  return encodePng({ width: side, height: side, channels: 3, data });
}

const names = ["Plaster", "Planks", "Oak"] as const;
const matte = { metallicFactor: 0, roughnessFactor: 1 };
const materials = [
  {
    name: "Plaster",
    extensions: { KHR_materials_unlit: {} },
    pbrMetallicRoughness: { ...matte, baseColorTexture: { index: 0, texCoord: 1 } },
  },
  {
    name: "Planks",
    pbrMetallicRoughness: { ...matte, baseColorTexture: { index: 1 } },
    occlusionTexture: { index: 0, texCoord: 1 },
  },
  {
    name: "Oak",
    extensions: { KHR_materials_unlit: {} },
    pbrMetallicRoughness: {
      ...matte,
      baseColorFactor: [0.5, 0.3, 0.14, 1],
      baseColorTexture: { index: 0, texCoord: 1 },
    },
  },
];

/** A GLB. */
export function bakedInterior(): Buffer {
  const writer = new GlbWriter();
  const meshes = names.map((name, material) => {
    const own = quads.map((quad, n) => ({ quad, n })).filter(({ quad }) => quad.material === name);
    const corners = own.flatMap(({ quad, n }) =>
      ([0, 1, 2, 3] as const).map((i) => {
        const [s, t] = [Number(i === 1 || i === 2), i >> 1];
        const chart = (origin: number, at: number) => (origin * cell + margin + at * (cell - 2 * margin)) / edge;
        return {
          position: add(add(quad.corner, quad.u, s), quad.v, t),
          normal: normalOf(quad),
          repeated: [s * length(quad.u), t * length(quad.v)],
          baked: [chart(n % columns, s), chart(Math.floor(n / columns), t)],
        };
      }),
    );
    const attributes = {
      POSITION: writer.attribute(
        corners.flatMap(({ position }) => position),
        3,
      ),
      NORMAL: writer.attribute(
        corners.flatMap(({ normal }) => normal),
        3,
      ),
      TEXCOORD_0: writer.attribute(
        corners.flatMap(({ repeated }) => repeated),
        2,
      ),
      TEXCOORD_1: writer.attribute(
        corners.flatMap(({ baked }) => baked),
        2,
      ),
    };
    const indices = writer.indices(own.flatMap((_, i) => [0, 1, 2, 0, 2, 3].map((corner) => 4 * i + corner)));
    return { name, primitives: [{ attributes, indices, material }] };
  });
  const images = [bakedAtlas(), planks()].map((png) => ({ bufferView: writer.bufferView(png), mimeType: "image/png" }));
  return writer.file({
    asset: { version: "2.0", generator: "a baker of light maps" },
    extensionsUsed: ["KHR_materials_unlit"],
    scene: 0,
    scenes: [{ name: "Room", nodes: meshes.map((_, i) => i) }],
    nodes: meshes.map(({ name }, mesh) => ({ name, mesh })),
    meshes,
    materials,
    textures: [{ source: 0 }, { source: 1 }],
    images,
  });
}
