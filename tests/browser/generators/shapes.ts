// Generates many small and different shapes as objects of an OBJ file.

import { closeSync, openSync, writeSync } from "node:fs";
import { sphere } from "../meshes.ts";

/**
 * Spheres of 32, 72 and 128 triangles on a square grid, each with different bumps.
 * `node tests/browser/generators/shapes.ts COUNT FILE` writes them to a file.
 */
export function writeShapes(count: number, file: string): void {
  const spheres = [2, 3, 4].map((splits) => sphere(splits));
  const side = Math.ceil(Math.sqrt(count));
  const out = openSync(file, "w");
  let first = 1;
  for (let n = 0; n < count; ++n) {
    const { positions, triangles } = spheres[n % spheres.length]!;
    const [x, y] = [3 * (n % side), 3 * Math.floor(n / side)];
    const lines = [`o shape${n}`];
    for (let i = 0; i < positions.length; i += 3) {
      const radius = 1 + 0.2 * Math.sin(n + i * (1 + n / count));
      const at = [x + radius * positions[i]!, y + radius * positions[i + 1]!, radius * positions[i + 2]!];
      lines.push(`v ${at.map((coordinate) => coordinate.toFixed(4)).join(" ")}`);
    }
    for (let i = 0; i < triangles.length; i += 3)
      lines.push(`f ${[0, 1, 2].map((corner) => first + triangles[i + corner]!).join(" ")}`);
    first += positions.length / 3;
    writeSync(out, `${lines.join("\n")}\n`);
  }
  closeSync(out);
}

if (import.meta.main) writeShapes(Number(process.argv[2]), process.argv[3]!);
