// An assembly as a CAD program exports it to OBJ: a roller conveyor of 3,000 parts, z up, millimetres, one object a
// part, long names, a material library beside it, flat normals left out.

/** Parts: 2 rails, 12 legs, 12 feet, and 18 for each of 165 rollers, and 4 guards. */
const rollers = 165;
const pitch = 60;
const width = 620;
const level = 750;

export const assemblyParts = 18 * rollers + 30;

/** Parts that are another part, moved: those of all rollers but one. Of the others there are too few of a kind. */
export const assemblyInstances = 18 * (rollers - 1);

const materials = {
  Aluminium_6063: [0.77, 0.78, 0.8],
  Steel_galvanised: [0.55, 0.57, 0.6],
  Steel_black_oxide: [0.12, 0.12, 0.13],
  RAL_5015_sky_blue: [0.13, 0.44, 0.7],
  POM_white: [0.93, 0.93, 0.9],
  RAL_1003_signal_yellow: [0.96, 0.72, 0.05],
} as const;

type Material = keyof typeof materials;
type Point = readonly [x: number, y: number, z: number];

class ObjWriter {
  readonly #lines: string[] = [];
  #first = 1;
  parts = 0;

  #part(name: string, material: Material, points: readonly Point[], faces: readonly (readonly number[])[]): void {
    this.#lines.push(`o ${name}`, `usemtl ${material}`);
    for (const point of points) this.#lines.push(`v ${point.map((value) => value.toFixed(3)).join(" ")}`);
    for (const face of faces) this.#lines.push(`f ${face.map((index) => this.#first + index).join(" ")}`);
    this.#first += points.length;
    this.parts += 1;
  }

  box(name: string, material: Material, [x0, y0, z0]: Point, [x1, y1, z1]: Point): void {
    const points = [0, 1, 2, 3, 4, 5, 6, 7].map((i): Point => [i & 1 ? x1 : x0, i & 2 ? y1 : y0, i & 4 ? z1 : z0]);
    this.#part(name, material, points, [
      [0, 2, 3, 1],
      [4, 5, 7, 6],
      [0, 1, 5, 4],
      [2, 6, 7, 3],
      [0, 4, 6, 2],
      [1, 3, 7, 5],
    ]);
  }

  /** A prism along y from y0 to y1 with a hole: rollers, bearings, washers and, with six sides, nuts. */
  ring(
    name: string,
    material: Material,
    [x, y0, z]: Point,
    y1: number,
    outer: number,
    inner: number,
    sides: number,
  ): void {
    const points: Point[] = [];
    for (let side = 0; side < sides; ++side) {
      const angle = (2 * Math.PI * side) / sides;
      for (const [radius, y] of [
        [outer, y0],
        [outer, y1],
        [inner, y1],
        [inner, y0],
      ] as const)
        points.push([x + radius * Math.cos(angle), y, z + radius * Math.sin(angle)]);
    }
    const faces: number[][] = [];
    for (let side = 0; side < sides; ++side)
      for (let edge = 0; edge < 4; ++edge) {
        const [a, b] = [4 * side, 4 * ((side + 1) % sides)];
        faces.push([a + edge, a + ((edge + 1) % 4), b + ((edge + 1) % 4), b + edge]);
      }
    this.#part(name, material, points, faces);
  }

  get text(): string {
    return `# Roller conveyor RC-620, exported in millimetres\nmtllib conveyor.mtl\n${this.#lines.join("\n")}\n`;
  }
}

function addRoller(obj: ObjWriter, n: number): void {
  const x = pitch * (n + 0.5);
  const id = String(n + 1).padStart(3, "0");
  const name = (part: string) => `RC-620-${part}:${id}`;
  obj.ring(name("0410_Roller_tube_D50"), "Steel_galvanised", [x, 14, level], width - 14, 25, 23.5, 24);
  obj.ring(name("0411_Axle_D10"), "Steel_black_oxide", [x, -14, level], width + 14, 5, 0.5, 12);
  for (const [side, at, out] of [
    ["L", 0, -1],
    ["R", width, 1],
  ] as const) {
    const ring = (
      part: string,
      material: Material,
      from: number,
      to: number,
      r1: number,
      r0: number,
      sides: number,
    ) => {
      obj.ring(name(`${part}_${side}`), material, [x, at + out * from, level], at + out * to, r1, r0, sides);
    };
    ring("0420_Bearing_6000_outer", "Steel_galvanised", -16, -24, 13, 10, 20);
    ring("0421_Bearing_6000_inner", "Steel_galvanised", -16, -24, 7, 5, 20);
    ring("0422_Bearing_seal", "Steel_black_oxide", -17, -23, 10, 7, 20);
    ring("0423_End_cap", "POM_white", -13, -16, 24, 6, 24);
    ring("0430_Washer_DIN125", "Steel_galvanised", 4, 5.5, 10, 5.2, 16);
    ring("0431_Nut_M10_DIN934", "Steel_galvanised", 5.5, 13, 8.5, 5, 6);
    ring("0432_Spring_washer", "Steel_black_oxide", 2, 4, 9, 5.2, 16);
    ring("0433_Bush", "POM_white", -4, 2, 7, 5.1, 16);
  }
}

/** The texts of the OBJ file and of its material library, conveyor.mtl. */
export function conveyor(): { obj: string; mtl: string } {
  const obj = new ObjWriter();
  const length = rollers * pitch;
  for (let n = 0; n < rollers; ++n) addRoller(obj, n);
  for (const [side, y] of [
    ["L", 0],
    ["R", width],
  ] as const) {
    obj.box(`RC-620-0100_Rail_${side}`, "Aluminium_6063", [0, y - 3, level - 70], [length, y + 3, level + 40]);
    for (let leg = 0; leg < 6; ++leg) {
      const x = 120 + (leg * (length - 280)) / 5;
      obj.box(`RC-620-0200_Leg_${side}:${leg + 1}`, "RAL_5015_sky_blue", [x, y - 20, 20], [x + 40, y + 20, level - 70]);
      obj.box(`RC-620-0210_Foot_${side}:${leg + 1}`, "Steel_black_oxide", [x - 30, y - 50, 0], [x + 70, y + 50, 20]);
    }
    for (const [end, x] of [
      ["in", 0],
      ["out", length - 400],
    ] as const)
      obj.box(
        `RC-620-0300_Guard_${side}_${end}`,
        "RAL_1003_signal_yellow",
        [x, y - 5, level + 40],
        [x + 400, y + 5, level + 90],
      );
  }
  const mtl = Object.entries(materials)
    .map(([name, color]) => `newmtl ${name}\nKd ${color.join(" ")}\nKs 0.2 0.2 0.2\nNs 40\n`)
    .join("\n");
  return { obj: obj.text, mtl };
}
