import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, test } from "node:test";
import type { VertexArray } from "../../stage/vertexArray.ts";
import { pngWithTexels } from "../png.testing.ts";
import { classicColors, classicNormals, classicTexCoords, classicWords } from "./classicArrays.ts";

/** Values, and the texels in which the converter stores them (src/containers/classic/attribute_vectors_test.cpp). */
interface Vector {
  readonly role: "normal" | "texCoord" | "color";
  readonly normals: "rgb" | "octahedral" | "spherical";
  readonly bits: 8 | 16 | 24;
  readonly colorComponents: 3 | 4;
  readonly values: readonly (readonly number[])[];
  readonly images: readonly { readonly channels: 1 | 3 | 4; readonly texels: readonly number[] }[];
}

const path = join(import.meta.dirname, "../../../../vectors/classic-1/attributes.json");
const vectors = JSON.parse(readFileSync(path, "utf8")) as Vector[];

/** The box of the texture coordinates. */
const [texCoordMin, texCoordSize] = [-1, 4];

async function decode({ role, normals, bits, colorComponents, values, images }: Vector): Promise<VertexArray> {
  const planes = images.map(({ channels, texels }) => ({
    bytes: pngWithTexels(values.length, 1, channels, (n, channel) => texels[channels * n + channel] ?? assert.fail()),
    firstTexel: 0,
  }));
  const layout = { count: values.length, rowLength: 0 };
  const [file] = planes;
  assert.ok(file);
  if (role === "texCoord") return classicTexCoords({ planes, firstBits: bits === 8 ? 8 : 16, ...layout });
  if (planes.length > 1) {
    const isSigned = role === "normal";
    return classicWords({ planes, components: isSigned ? 3 : colorComponents, isSigned, ...layout });
  }
  if (role === "color") return classicColors({ file, components: colorComponents, ...layout });
  const format =
    normals === "rgb" ? ({ kind: "byteVector" } as const) : ({ kind: normals, bits: bits === 8 ? 8 : 16 } as const);
  return classicNormals({ file, format, ...layout });
}

/** A record as fractions of the range of its type: 0 … 1, or -1 … 1. */
function fractionsOf({ array, stride, components }: VertexArray, record: number): number[] {
  const max = { Uint8Array: 255, Uint16Array: 65535, Int16Array: 32767 }[array.constructor.name] ?? 1;
  return Array.from(array.subarray(record * stride, record * stride + components), (stored) => stored / max);
}

/** The unit vector of two numbers 0 … 1 (docs/formats/nodes.md, "Stored values"). */
function unitOf(normals: Vector["normals"], [first = 0, second = 0]: number[]): number[] {
  if (normals === "spherical") {
    const [phi, theta] = [Math.PI * (2 * first - 1), Math.PI * second];
    return [Math.sin(theta) * Math.cos(phi), Math.sin(theta) * Math.sin(phi), Math.cos(theta)];
  }
  const [x, y] = [first, second].map((fraction) => (2 * fraction * 65535) / 65534 - 1) as [number, number];
  const z = 1 - Math.abs(x) - Math.abs(y);
  const folded = z < 0 ? [(1 - Math.abs(y)) * Math.sign(x), (1 - Math.abs(x)) * Math.sign(y), z] : [x, y, z];
  const length = Math.hypot(...folded);
  return folded.map((component) => component / length);
}

function decodedValue({ role, normals, bits }: Vector, vertices: VertexArray, record: number): number[] {
  const fractions = fractionsOf(vertices, record);
  if (role === "texCoord") return fractions.map((fraction) => texCoordMin + texCoordSize * fraction);
  if (role === "color") return fractions.slice(0, 3);
  if (normals !== "rgb") return unitOf(normals, fractions);
  return bits === 8 ? fractions.map((fraction) => 2 * fraction - 1) : fractions;
}

describe("attributes that the converter stores in images", () => {
  for (const vector of vectors) {
    const { role, normals, bits, colorComponents, values } = vector;
    const kind = role === "normal" ? normals : role === "color" ? `${colorComponents} components` : "";
    test(`are decoded within their rounding: ${role} ${kind} ${bits} bits`, async () => {
      const vertices = await decode(vector);
      const step = 1 / (2 ** bits - 1);
      // Normals: the diagonal of a cell, and the rounding of words to Int16. Texture coordinates: a step of their box.
      const bound = { normal: 4 * step + 2 ** -15, texCoord: (texCoordSize * step) / 2, color: step / 2 }[role] + 1e-6;
      values.forEach((value, record) => {
        decodedValue(vector, vertices, record).forEach((decoded, component) => {
          const difference = Math.abs(decoded - (value[component] ?? NaN));
          assert.ok(difference <= bound, `record ${record}: ${decoded} for ${value[component]}`);
        });
      });
    });
  }
});
