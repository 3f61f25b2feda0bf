// A recorded sequence for tests: a sphere that breathes and leans, with a number a vertex that changes.

import { areaWeightedNormals, sphere, withoutNormals, type PlainMesh } from "./meshes.ts";
import type { PlainPatch } from "./siteDecoder.ts";
import { siteOfFrames } from "./sites.ts";

export const rate = 10;
/** Three files of 10, 10 and 5 frames. */
export const frameCount = 25;

function frameOf(number: number): PlainMesh {
  const mesh = withoutNormals(sphere(24));
  const [swell, lean] = [1 + 0.25 * Math.sin(0.4 * number), 0.3 * Math.sin(0.25 * number)];
  const positions = mesh.positions.slice();
  const heat = new Float32Array(positions.length / 3);
  for (let i = 0; i < positions.length; i += 3) {
    const [x, y, z] = [positions[i]!, positions[i + 1]!, positions[i + 2]!];
    positions.set([x * swell + lean * y, y / swell, z * swell], i);
    heat[i / 3] = 300 + 40 * Math.sin(2 * y + 0.5 * number);
  }
  return { ...mesh, positions, numbers: { heat } };
}

export const breath: readonly PlainMesh[] = Array.from({ length: frameCount }, (_, number) => frameOf(number));

/** The least and the greatest heat of all frames. */
export const heatRange: readonly [number, number] = [
  Math.min(...breath.map(({ numbers }) => Math.min(...numbers!.heat!))),
  Math.max(...breath.map(({ numbers }) => Math.max(...numbers!.heat!))),
];

export const breathSite = (): string =>
  siteOfFrames("breath", breath, "--rate", String(rate), "--keep-attributes", "heat");

/** A frame as plain buffers, with the normals of its triangles. */
export function patchOfFrame(number: number): PlainPatch & { normals: Float32Array } {
  const { positions, triangles } = breath[number]!;
  const normals = areaWeightedNormals({ positions, triangles });
  return { positions, normals, triangles, lines: new Uint32Array(), points: new Uint32Array() };
}
