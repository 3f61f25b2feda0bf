// A scan as a structured-light scanner leaves it: a draped figure on a plinth, z up, millimetres, a colour at each
// vertex, rough surface, open below, nothing in the file that says which way is up.

/** Rows of vertices from the plinth's foot to the crown, and vertices around. */
const rows = 640;
const around = 320;

/** Height of the figure with its plinth, in mm. */
const height = 1620;

/** Values at heights, between which a cosine runs. */
type Profile = readonly (readonly [at: number, value: number])[];

const smooth = (profile: Profile, at: number): number => {
  let [below, value] = [0, 0];
  for (const [above, next] of profile) {
    if (above >= at) {
      const t = above > below ? 0.5 - 0.5 * Math.cos((Math.PI * (at - below)) / (above - below)) : 1;
      return value + t * (next - value);
    }
    [below, value] = [above, next];
  }
  return value;
};

/** Half widths of the plinth. */
const plinth: Profile = [
  [0, 300],
  [40, 300],
  [60, 270],
  [220, 270],
  [240, 295],
  [262, 295],
];

/** Half widths from side to side (x) and from front to back (y), and how far the axis leans; in mm. */
const width: Profile = [
  ...plinth,
  [268, 205],
  [620, 190],
  [900, 168],
  [1060, 142],
  [1230, 205],
  [1330, 196],
  [1375, 62],
  [1420, 58],
  [1470, 84],
  [1540, 92],
  [1600, 62],
  [1620, 2],
];
const depth: Profile = [
  ...plinth,
  [268, 180],
  [620, 160],
  [900, 140],
  [1060, 112],
  [1230, 128],
  [1330, 112],
  [1375, 60],
  [1420, 62],
  [1470, 92],
  [1540, 106],
  [1600, 70],
  [1620, 2],
];
const lean: Profile = [
  [0, 0],
  [262, 0],
  [700, 18],
  [1060, -14],
  [1330, 4],
  [1620, 16],
];

/** Numbers from -1 to 1 that depend on the vertex only. */
const noise = (a: number, b: number): number => {
  const value = Math.sin(a * 12.9898 + b * 78.233) * 43758.5453;
  return 2 * (value - Math.floor(value)) - 1;
};

/** A binary PLY. */
export function zUpScan(): Buffer {
  const vertices = rows * around;
  const triangles = 2 * (rows - 1) * around;
  const header = Buffer.from(
    `ply\nformat binary_little_endian 1.0\ncomment A scan with z up, in millimetres\nelement vertex ${vertices}\n` +
      "property float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty uchar green\n" +
      `property uchar blue\nelement face ${triangles}\nproperty list uchar int vertex_indices\nend_header\n`,
  );
  const points = Buffer.alloc(vertices * 15);
  for (let row = 0; row < rows; ++row)
    for (let column = 0; column < around; ++column) {
      const z = (row / (rows - 1)) * height;
      const angle = (column / around) * 2 * Math.PI;
      const robe = Math.min(Math.max((z - 268) / 60, 0), 1) * Math.min(Math.max((1340 - z) / 200, 0), 1);
      const fold = Math.sin(14 * angle + 0.006 * z + 2 * Math.sin(0.004 * z)) * (z < 1000 ? 1 : 0.5);
      // A plinth has corners: a superellipse of the fourth order.
      const corner = z < 264 ? (Math.abs(Math.cos(angle)) ** 8 + Math.abs(Math.sin(angle)) ** 8) ** (-1 / 8) : 1;
      const nose = z > 1478 && z < 1525 ? 26 * Math.exp(-(((angle - 1.5 * Math.PI) / 0.16) ** 2)) : 0;
      const radius = corner * (1 + 0.07 * robe * fold);
      const rough = 0.25 * noise(row, column);
      const x = smooth(lean, z) + Math.cos(angle) * (radius * smooth(width, z) + rough);
      const y = Math.sin(angle) * (radius * smooth(depth, z) + nose + rough);
      const stone = 178 + 22 * robe * fold + 9 * noise(column, row) + 10 * Math.sin(0.02 * z + 3 * angle);
      const at = (row * around + column) * 15;
      points.writeFloatLE(x, at);
      points.writeFloatLE(y, at + 4);
      points.writeFloatLE(z + 5000, at + 8); // a scanner's origin is anywhere
      [stone + 8, stone - 4, stone - 24].forEach((c, i) => points.writeUInt8(Math.round(c), at + 12 + i));
    }
  const faces = Buffer.alloc(triangles * 13);
  for (let row = 0, at = 0; row + 1 < rows; ++row)
    for (let column = 0; column < around; ++column) {
      const [a, b] = [row * around + column, row * around + ((column + 1) % around)];
      for (const triangle of [
        [a, b, b + around],
        [a, b + around, a + around],
      ]) {
        faces.writeUInt8(3, at);
        triangle.forEach((vertex, i) => faces.writeInt32LE(vertex, at + 1 + 4 * i));
        at += 13;
      }
    }
  return Buffer.concat([header, points, faces]);
}
