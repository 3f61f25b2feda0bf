// Writes a glTF model with an animation: planets on arms that turn about a sun, one of them with a moon and one with
// rings. Arms are nodes that rotate, nested as they are in a real orrery.

interface Body {
  readonly name: string;
  readonly radius: number;
  /** From the axis of its arm, which turns once in `seconds`. */
  readonly distance: number;
  readonly seconds: number;
  /** Where the arm begins, in turns. */
  readonly phase: number;
  readonly color: readonly [number, number, number];
  readonly rings?: boolean;
  readonly moons?: readonly Body[];
}

const sun: Body = { name: "sun", radius: 1, distance: 0, seconds: 12, phase: 0, color: [1, 0.7, 0.15] };
const planets: readonly Body[] = [
  { name: "mercury", radius: 0.16, distance: 1.7, seconds: 4, phase: 0.1, color: [0.6, 0.55, 0.5] },
  { name: "venus", radius: 0.28, distance: 2.5, seconds: 6, phase: 0.45, color: [0.9, 0.75, 0.45] },
  {
    name: "earth",
    radius: 0.32,
    distance: 3.6,
    seconds: 12,
    phase: 0.8,
    color: [0.15, 0.4, 0.8],
    moons: [{ name: "moon", radius: 0.1, distance: 0.6, seconds: 3, phase: 0.3, color: [0.75, 0.75, 0.75] }],
  },
  { name: "mars", radius: 0.22, distance: 4.6, seconds: 24, phase: 0.62, color: [0.75, 0.25, 0.12] },
  { name: "saturn", radius: 0.55, distance: 6.2, seconds: 24, phase: 0.05, color: [0.85, 0.7, 0.5], rings: true },
];
/** All arms are back where they began. */
const period = 24;
const brass: readonly [number, number, number] = [0.8, 0.6, 0.25];

interface Mesh {
  readonly positions: number[];
  readonly normals: number[];
  readonly indices: number[];
}

/** A point of a profile. */
type Point = readonly [radius: number, height: number];

/** The surface that a profile, points of radius and height, sweeps about the y axis; smooth. */
function lathe(profile: readonly Point[], steps = 48): Mesh {
  const mesh: Mesh = { positions: [], normals: [], indices: [] };
  profile.forEach(([radius, height], row) => {
    const point: Point = [radius, height];
    const [before, after] = [profile[row - 1] ?? point, profile[row + 1] ?? point];
    const slope: [number, number] = [after[1] - before[1], before[0] - after[0]];
    const length = Math.hypot(...slope) || 1;
    for (let step = 0; step <= steps; ++step) {
      const angle = (2 * Math.PI * step) / steps;
      const [x, z] = [Math.cos(angle), -Math.sin(angle)];
      mesh.positions.push(radius * x, height, radius * z);
      mesh.normals.push((slope[0] / length) * x, slope[1] / length, (slope[0] / length) * z);
      if (row === 0 || step === 0) continue;
      const corner = row * (steps + 1) + step;
      const below = corner - steps - 1;
      mesh.indices.push(below - 1, below, corner, below - 1, corner, corner - 1);
    }
  });
  return mesh;
}

function sphere(radius: number): Mesh {
  const angles = Array.from({ length: 25 }, (_, i) => (Math.PI * i) / 24 - Math.PI / 2);
  return lathe(angles.map((angle) => [radius * Math.cos(angle), radius * Math.sin(angle)] as const));
}

/** A flat ring around a body, with two sides. */
function ring(radius: number): Mesh {
  const [inner, outer, half] = [1.3 * radius, 2 * radius, 0.02];
  return lathe([
    [outer, -half],
    [outer, half],
    [outer, half],
    [inner, half],
    [inner, half],
    [inner, -half],
    [inner, -half],
    [outer, -half],
  ]);
}

function rod(radius: number, height: number): Mesh {
  return lathe([
    [radius, 0],
    [radius, height],
  ]);
}

/** Collects the parts of a glTF document. */
class Document {
  readonly #bytes: Uint8Array[] = [];
  #length = 0;
  readonly #accessors: object[] = [];
  readonly #views: object[] = [];
  readonly #meshes: object[] = [];
  readonly #materials: object[] = [];
  readonly #nodes: { name: string; children?: number[]; [field: string]: unknown }[] = [];
  readonly #channels: object[] = [];
  readonly #samplers: object[] = [];

  addMesh({ positions, normals, indices }: Mesh, color: readonly number[], isMetal = false): number {
    this.#materials.push({
      pbrMetallicRoughness: {
        baseColorFactor: [...color, 1],
        metallicFactor: isMetal ? 1 : 0,
        roughnessFactor: isMetal ? 0.35 : 0.6,
      },
    });
    const attributes = {
      POSITION: this.#add(Float32Array.from(positions), "VEC3", true),
      NORMAL: this.#add(Float32Array.from(normals), "VEC3"),
    };
    const primitive = { attributes, indices: this.#add(Uint16Array.from(indices), "SCALAR") };
    this.#meshes.push({ primitives: [{ ...primitive, material: this.#materials.length - 1 }] });
    return this.#meshes.length - 1;
  }

  addNode(name: string, fields: object): number {
    this.#nodes.push({ name, ...fields });
    return this.#nodes.length - 1;
  }

  /** Turns a node about the y axis, once in `seconds`, from `phase` turns on. */
  turn(node: number, seconds: number, phase: number): void {
    const count = (4 * period) / seconds + 1; // a quarter from key to key
    const times = Array.from({ length: count }, (_, key) => (key * seconds) / 4);
    const rotations = times.flatMap((time) => {
      const half = Math.PI * (time / seconds + phase);
      return [0, Math.sin(half), 0, Math.cos(half)];
    });
    const input = this.#add(Float32Array.from(times), "SCALAR", true);
    this.#samplers.push({ input, output: this.#add(Float32Array.from(rotations), "VEC4") });
    this.#channels.push({ sampler: this.#samplers.length - 1, target: { node, path: "rotation" } });
  }

  /** The document of glTF 2.0, whose buffer is in it. */
  toJson(root: number): string {
    const bytes = Buffer.concat(this.#bytes);
    return JSON.stringify({
      asset: { version: "2.0", generator: "imgeo examples/motion" },
      scene: 0,
      scenes: [{ nodes: [root] }],
      nodes: this.#nodes,
      meshes: this.#meshes,
      materials: this.#materials,
      animations: [{ name: "orbits", channels: this.#channels, samplers: this.#samplers }],
      accessors: this.#accessors,
      bufferViews: this.#views,
      buffers: [{ byteLength: bytes.length, uri: `data:application/octet-stream;base64,${bytes.toString("base64")}` }],
    });
  }

  #add(array: Float32Array | Uint16Array, type: "SCALAR" | "VEC3" | "VEC4", hasRange = false): number {
    const size = { SCALAR: 1, VEC3: 3, VEC4: 4 }[type];
    const range = (choose: (...values: number[]) => number): number[] =>
      Array.from({ length: size }, (_, c) => choose(...array.filter((__, i) => i % size === c)));
    this.#views.push({ buffer: 0, byteOffset: this.#length, byteLength: array.byteLength });
    this.#accessors.push({
      bufferView: this.#views.length - 1,
      componentType: array instanceof Float32Array ? 5126 : 5123,
      count: array.length / size,
      type,
      ...(hasRange && { min: range(Math.min), max: range(Math.max) }),
    });
    const padded = new Uint8Array(Math.ceil(array.byteLength / 4) * 4);
    padded.set(new Uint8Array(array.buffer));
    this.#bytes.push(padded);
    this.#length += padded.length;
    return this.#accessors.length - 1;
  }
}

/** A body at the end of an arm that turns; the node of the arm. */
function addBody(document: Document, body: Body): number {
  const { name, radius, distance, seconds, phase, color, rings, moons = [] } = body;
  const children = moons.map((moon) => addBody(document, moon));
  if (rings) {
    const tilt = [Math.sin(0.22), 0, 0, Math.cos(0.22)];
    children.push(document.addNode(`${name}-rings`, { mesh: document.addMesh(ring(radius), color), rotation: tilt }));
  }
  const planet = document.addNode(name, {
    mesh: document.addMesh(sphere(radius), color),
    translation: [distance, 0, 0],
    ...(children.length > 0 && { children }),
  });
  const lying = [0, 0, -Math.SQRT1_2, Math.SQRT1_2]; // along x
  const rodNode = document.addNode(`${name}-rod`, {
    mesh: document.addMesh(rod(0.03, distance), brass, true),
    rotation: lying,
  });
  const rotation = [0, Math.sin(Math.PI * phase), 0, Math.cos(Math.PI * phase)];
  const arm = document.addNode(`${name}-arm`, { children: [planet, rodNode], rotation });
  document.turn(arm, seconds, phase);
  return arm;
}

/** The orrery as a document of glTF 2.0 with one animation, in which every node that moves turns about y. */
export function orrery(): string {
  const document = new Document();
  const children = planets.map((planet) => addBody(document, planet));
  const center = document.addNode(sun.name, { mesh: document.addMesh(sphere(sun.radius), sun.color) });
  const foot = document.addNode("foot", {
    mesh: document.addMesh(
      lathe([
        [0, -3],
        [1.6, -3],
        [1.6, -3],
        [1.5, -2.8],
        [0.2, -2.6],
        [0.12, -2.4],
        [0.12, -0.9],
      ]),
      brass,
      true,
    ),
  });
  return document.toJson(document.addNode("orrery", { children: [...children, center, foot] }));
}
