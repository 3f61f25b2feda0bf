// Writes a GLB whose shapes move: an arm that joints bend, with an armature of another scale as Blender's exports have
// one; a ball with two morph targets; and a finger that both moves. Its animation takes two seconds.

import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { GlbWriter } from "./glb.ts";
import { outputDirectory } from "./paths.ts";

const seconds = 2;

type Vec3 = readonly [number, number, number];

interface Vertices {
  readonly positions: Vec3[];
  readonly normals: Vec3[];
  readonly indices: number[];
}

/** A surface over a grid, whose columns are closed. */
function surfaceOf(rows: number, columns: number, at: (row: number, angle: number) => [Vec3, Vec3]): Vertices {
  const vertices: Vertices = { positions: [], normals: [], indices: [] };
  for (let row = 0; row <= rows; ++row)
    for (let column = 0; column < columns; ++column) {
      const [position, normal] = at(row / rows, (2 * Math.PI * column) / columns);
      vertices.positions.push(position);
      vertices.normals.push(normal);
    }
  for (let row = 0; row < rows; ++row)
    for (let column = 0; column < columns; ++column) {
      const [a, b] = [columns * row + column, columns * row + ((column + 1) % columns)];
      vertices.indices.push(a, b, a + columns, b, b + columns, a + columns);
    }
  return vertices;
}

/** A tapering tube along y, from 0 to `height`. */
function tubeOf(height: number, radius: number): Vertices {
  return surfaceOf(32, 24, (t, angle) => {
    const r = radius * (1 - 0.5 * t);
    const [x, z] = [Math.cos(angle), -Math.sin(angle)];
    const length = Math.hypot(1, (0.5 * radius) / height);
    return [
      [r * x, height * t, r * z],
      [x / length, (0.5 * radius) / height / length, z / length],
    ];
  });
}

function ballOf(radius: number): Vertices {
  return surfaceOf(24, 32, (t, angle) => {
    const polar = Math.PI * (0.02 + 0.96 * t);
    const normal: Vec3 = [Math.sin(polar) * Math.cos(angle), -Math.cos(polar), -Math.sin(polar) * Math.sin(angle)];
    return [[radius * normal[0], radius * normal[1], radius * normal[2]], normal];
  });
}

/** Two joints of each vertex of a tube and their weights, which sum to one. */
function rigOf({ positions }: Vertices, height: number, jointCount: number): { joints: number[]; weights: number[] } {
  const joints: number[] = [];
  const weights: number[] = [];
  for (const [, y] of positions) {
    const along = Math.min(jointCount - 1.001, Math.max(0, (y / height) * jointCount - 0.5));
    const first = Math.floor(along);
    joints.push(first, first + 1, 0, 0);
    weights.push(1 - (along - first), along - first, 0, 0);
  }
  return { joints, weights };
}

/** Row by row of the identity with a translation along y and a scale, column by column. */
function bindingOf(y: number, scale: number): number[] {
  return [scale, 0, 0, 0, 0, scale, 0, 0, 0, 0, scale, 0, 0, -y, 0, 1];
}

function quaternionAbout(axis: "x" | "z", angle: number): number[] {
  const [s, c] = [Math.sin(angle / 2), Math.cos(angle / 2)];
  return axis === "x" ? [s, 0, 0, c] : [0, 0, s, c];
}

/** A primitive; without `normals` its triangles are flat. */
function writtenPrimitive(glb: GlbWriter, { positions, normals, indices }: Vertices, more: object, targets?: object[]) {
  return {
    attributes: {
      POSITION: glb.attribute(positions.flat(), 3),
      ...(normals.length > 0 && { NORMAL: glb.attribute(normals.flat(), 3) }),
      ...more,
    },
    indices: glb.indices(indices),
    material: 0,
    ...(targets && { targets }),
  };
}

/** Displacements of a ball: squeezed along y, and with a nose. */
function targetsOf(glb: GlbWriter, { positions, normals }: Vertices): object[] {
  const squeezed = positions.map(([x, y, z]): Vec3 => [0.3 * x, -0.6 * y, 0.3 * z]);
  const squeezedNormals = positions.map(([x, y, z]): Vec3 => [-0.3 * x, 1.2 * y, -0.3 * z]);
  const nose = positions.map(([x, y, z]): Vec3 => [0, 0, 0.8 * Math.max(0, z) ** 4 * Math.exp(-8 * (x * x + y * y))]);
  const none = positions.map((): Vec3 => [0, 0, 0]);
  const target = (positions: Vec3[], itsNormals: Vec3[]) => ({
    POSITION: glb.attribute(positions.flat(), 3),
    ...(normals.length > 0 && { NORMAL: glb.attribute(itsNormals.flat(), 3) }),
  });
  return [target(squeezed, squeezedNormals), target(nose, none)];
}

/** Joints in a chain, nodes `first` …, each the only child of the one before. */
function chainOf(first: number, count: number, length: number, scale: number): object[] {
  return Array.from({ length: count }, (_, n) => ({
    name: `joint-${first + n}`,
    translation: [0, n === 0 ? 0 : length * scale, 0],
    ...(n < count - 1 && { children: [first + n + 1] }),
  }));
}

function writtenScene(hasNormals: boolean): Buffer {
  const glb = new GlbWriter();
  const [arm, ball, finger, floor] = [tubeOf(2, 0.3), ballOf(0.6), tubeOf(1.2, 0.25), plane].map((vertices) =>
    hasNormals ? vertices : { ...vertices, normals: [] },
  ) as [Vertices, Vertices, Vertices, Vertices];
  const [armRig, fingerRig] = [rigOf(arm, 2, 4), rigOf(finger, 1.2, 2)];
  const rigged = ({ joints, weights }: typeof armRig) => ({
    JOINTS_0: glb.joints(joints),
    WEIGHTS_0: glb.floats(weights, "VEC4"),
  });
  const bend = finger.positions.map(([x, y]): Vec3 => [0.2 * Math.sin(4 * y), 0, 0.1 * x]);
  const nodes = [
    { name: "arm", mesh: 0, skin: 0, translation: [9, 9, 9] }, // which glTF ignores
    { name: "armature", children: [2], translation: [-1.4, -1, 0], scale: [0.01, 0.01, 0.01] },
    ...chainOf(2, 4, 0.5, 100),
    { name: "ball", mesh: 1, weights: [0, 0.5], translation: [0.1, 0, 0] },
    { name: "finger", mesh: 2, skin: 1, children: [8], translation: [1.4, -1, 0] },
    ...chainOf(8, 2, 0.6, 1),
  ];
  const keys = [0, 0.5, 1, 1.5, seconds];
  const times = glb.floats(keys, "SCALAR");
  const samplers: object[] = [];
  const channels: object[] = [];
  const animate = (node: number, path: string, output: number, interpolation = "LINEAR") => {
    samplers.push({ input: times, output, interpolation });
    channels.push({ sampler: samplers.length - 1, target: { node, path } });
  };
  const turns = (axis: "x" | "z", angle: number) =>
    glb.floats(
      [0, 1, 0, -1, 0].flatMap((part) => quaternionAbout(axis, part * angle)),
      "VEC4",
    );
  animate(3, "rotation", turns("z", 0.9));
  animate(4, "rotation", turns("x", 1.1));
  animate(5, "scale", glb.floats([1, 1, 1, 1.5, 0.8, 1.5, 1, 1, 1, 0.7, 1.3, 0.7, 1, 1, 1], "VEC3"));
  animate(9, "rotation", turns("x", 1.2));
  animate(6, "weights", glb.floats([0, 0.5, 1, 0, 0, 1, 0.5, 0.5, 0, 0.5], "SCALAR"));
  animate(7, "weights", glb.floats([0, 1, 0.3, -0.5, 0], "SCALAR"), "STEP");
  const chain = (first: number, count: number) => Array.from({ length: count }, (_, n) => first + n);
  return glb.file({
    asset: { version: "2.0" },
    scene: 0,
    scenes: [{ nodes: [0, 1, 6, 7, 10] }],
    nodes: [...nodes, { name: "floor", mesh: 3, translation: [0, -1.2, 0] }],
    skins: [
      {
        name: "arm-skin",
        joints: chain(2, 4),
        inverseBindMatrices: glb.floats(
          chain(0, 4).flatMap((n) => bindingOf(50 * n, 100)),
          "MAT4",
        ),
      },
      {
        joints: chain(8, 2),
        inverseBindMatrices: glb.floats(
          chain(0, 2).flatMap((n) => bindingOf(0.6 * n, 1)),
          "MAT4",
        ),
      },
    ],
    meshes: [
      { name: "arm", primitives: [writtenPrimitive(glb, arm, rigged(armRig))] },
      {
        name: "ball",
        primitives: [writtenPrimitive(glb, ball, {}, targetsOf(glb, ball))],
        weights: [0, 0],
        extras: { targetNames: ["squeeze", "nose"] },
      },
      {
        name: "finger",
        primitives: [writtenPrimitive(glb, finger, rigged(fingerRig), [{ POSITION: glb.attribute(bend.flat(), 3) }])],
        weights: [0],
      },
      { name: "floor", primitives: [writtenPrimitive(glb, floor, {})] },
    ],
    materials: [
      { pbrMetallicRoughness: { baseColorFactor: [0.8, 0.6, 0.4, 1], metallicFactor: 0, roughnessFactor: 0.7 } },
    ],
    animations: [{ name: "wave", samplers, channels }],
  });
}

const plane: Vertices = {
  positions: [
    [-3, 0, 3],
    [3, 0, 3],
    [3, 0, -3],
    [-3, 0, -3],
  ],
  normals: [
    [0, 1, 0],
    [0, 1, 0],
    [0, 1, 0],
    [0, 1, 0],
  ],
  indices: [0, 1, 2, 0, 2, 3],
};

/** Returns the path of the file, which has no normals if it is `flat`. */
export function writeRiggedScene(shading: "smooth" | "flat" = "smooth"): string {
  mkdirSync(outputDirectory, { recursive: true });
  const path = join(outputDirectory, `rigged-${shading}.glb`);
  writeFileSync(path, writtenScene(shading === "smooth"));
  return path;
}
