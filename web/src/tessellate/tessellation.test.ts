// Compares tessellation with the inputs and outputs in vectors/tessellation, which C++ and TypeScript share:
// src/import/x3d/tessellation_vectors_test.cpp reads the same files. With IMGEO_REWRITE_GOLDEN=1 the outputs are
// rewritten from the inputs.

import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { CreasedNormals, maxComparedFaces } from "./creasedNormals.ts";
import { triangulate } from "./earClipping.ts";
import type { ElevationGridFields } from "./elevationGrid.ts";
import { elevationGrid } from "./elevationGrid.ts";
import type { ExtrusionFields } from "./extrusion.ts";
import { extrusion } from "./extrusion.ts";
import type { Surface } from "./faces.ts";
import { withCreasedNormals } from "./faces.ts";
import type { Vec3 } from "./vectors.ts";

const folder = join(import.meta.dirname, "../../../vectors/tessellation");
const isRewriting = process.env.IMGEO_REWRITE_GOLDEN !== undefined;

/** Checks every vector of a file; numbers agree within 1e-5. */
function checkVectors(file: string, outputOf: (input: never) => object): void {
  const path = join(folder, file);
  const vectors = JSON.parse(readFileSync(path, "utf8")) as { name: string }[];
  assert.ok(vectors.length > 0);
  if (isRewriting) {
    const rows = vectors.map((vector) => JSON.stringify({ ...vector, ...withShortNumbers(outputOf(vector as never)) }));
    writeFileSync(path, `[\n${rows.join(",\n")}\n]\n`);
    return;
  }
  for (const vector of vectors) {
    for (const [key, actual] of Object.entries(outputOf(vector as never)))
      assertNear(actual, (vector as Record<string, unknown>)[key], `${vector.name}: ${key}`);
  }
}

/** Eight digits: single precision has no more. */
function withShortNumbers(output: object): object {
  const shortened = (_: string, value: unknown) => (typeof value === "number" ? Number(value.toPrecision(8)) : value);
  return JSON.parse(JSON.stringify(output, shortened)) as object;
}

function assertNear(actual: unknown, expected: unknown, name: string): void {
  if (typeof actual === "number" && typeof expected === "number") {
    assert.ok(Math.abs(actual - expected) < 1e-5, `${name} is ${actual}, not ${expected}`);
    return;
  }
  assert.ok(Array.isArray(actual) && Array.isArray(expected), name);
  assert.equal(actual.length, expected.length, name);
  for (const [i, value] of actual.entries()) assertNear(value, expected[i], `${name}[${i}]`);
}

function indicesOf(surface: Surface | undefined, index: "position" | "texCoord"): number[][] {
  return surface?.faces.map((face) => face.map((corner) => corner[index])) ?? [];
}

test("ear clipping gives the triangles of vectors/tessellation", () => {
  checkVectors("earClipping.json", ({ ring }: { ring: number[] }) => {
    const corners = Array.from({ length: ring.length / 3 }, (_, i) => ring.slice(3 * i, 3 * i + 3) as unknown as Vec3);
    return { triangles: triangulate(corners) };
  });
});

test("crease normals are those of vectors/tessellation", () => {
  checkVectors(
    "creaseNormals.json",
    ({ positions, faces, creaseAngle }: { positions: number[]; faces: number[][]; creaseAngle: number }) => {
      const data = { positions, normals: [], texCoords: [], colors: [], colorComponents: 3 as const };
      const corners = faces.map((face) => face.map((position) => ({ position, normal: -1, texCoord: -1, color: -1 })));
      const creased = withCreasedNormals(data, corners, creaseAngle);
      return {
        normals: creased.faces.flatMap((face) =>
          face.flatMap(({ normal }) => creased.data.normals.slice(3 * normal, 3 * normal + 3)),
        ),
      };
    },
  );
});

test("crease normals are those of faces where more meet than are compared", () => {
  const sides = maxComparedFaces + 1;
  const positions = [0, 0, 1];
  const cone = Array.from({ length: sides }, (_, i) => {
    const angle = (2 * Math.PI * i) / sides;
    positions.push(Math.cos(angle), Math.sin(angle), 0);
    return [0, 1 + i, 1 + ((i + 1) % sides)];
  });
  const apexOf = (creaseAngle: number) => new CreasedNormals(cone, creaseAngle).compute(positions).slice(0, 3);
  assertNear(Array.from(apexOf(Math.PI)), [0, 0, 1], "smooth");
  const [x = NaN, , z = NaN] = apexOf(3);
  assert.ok(Math.abs(x - Math.SQRT1_2) < 1e-4 && Math.abs(z - Math.SQRT1_2) < 1e-4, `${x} ${z}`);
});

test("extrusions have the vertices and faces of vectors/tessellation", () => {
  checkVectors("extrusion.json", (fields: ExtrusionFields) => {
    const surface = extrusion(fields);
    return {
      positions: surface?.data.positions ?? [],
      texCoords: surface?.data.texCoords ?? [],
      faces: indicesOf(surface, "position"),
      texCoordFaces: indicesOf(surface, "texCoord"),
    };
  });
});

test("elevation grids have the vertices and faces of vectors/tessellation", () => {
  const fields = { normalPerVertex: true, colorPerVertex: true };
  const childData = { positions: [], normals: [], texCoords: [], colors: [], colorComponents: 3 as const };
  checkVectors("elevationGrid.json", (input: ElevationGridFields) => {
    const surface = elevationGrid({ ...input, ...fields }, childData);
    return {
      positions: surface?.data.positions ?? [],
      texCoords: surface?.data.texCoords ?? [],
      faces: indicesOf(surface, "position"),
    };
  });
});
