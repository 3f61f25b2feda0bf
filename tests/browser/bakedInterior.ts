// Writes a GLB of a baked interior: three walls whose textures use two sets of texture coordinates. Set 0 repeats an
// albedo; set 1 places each half of a wall in a chart of its own, as bakers of light maps do.

import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { GlbWriter } from "./glb.ts";
import { outputDirectory } from "./paths.ts";
import { encodePng, type Picture } from "./png.ts";

/** Cells along each side of a wall. */
const cells = 8;
const textureEdge = 64;

type Texel = (s: number, t: number) => [number, number, number];

/** A texture without edges, so that filtering and rounding of coordinates hardly matter. */
function smoothPicture(texel: Texel): Buffer {
  const data = new Uint8Array(3 * textureEdge * textureEdge);
  for (let y = 0; y < textureEdge; ++y)
    for (let x = 0; x < textureEdge; ++x)
      data.set(texel((x + 0.5) / textureEdge, (y + 0.5) / textureEdge), 3 * (y * textureEdge + x));
  const picture: Picture = { width: textureEdge, height: textureEdge, channels: 3, data };
  return encodePng(picture);
}

const wave = (phase: number) => Math.round(128 + 100 * Math.sin(2 * Math.PI * phase));
const images = {
  "baked-albedo.png": smoothPicture((s, t) => [wave(s), wave(t), wave(s + t)]),
  "baked-light.png": smoothPicture((s, t) => [Math.round(20 + 220 * s), Math.round(20 + 220 * t), 90]),
};

/** The model with the files that it names. */
export const interiorFiles = ["baked-interior.glb", ...Object.keys(images)];

/** Float32 attributes of a wall one unit wide whose left side is at x. Two columns of vertices meet in the middle. */
function wallAt(x: number): { positions: number[]; normals: number[]; sets: [number[], number[]]; indices: number[] } {
  const positions: number[] = [];
  const normals: number[] = [];
  const sets: [number[], number[]] = [[], []];
  const indices: number[] = [];
  for (const half of [0, 1]) {
    const first = positions.length / 3;
    const columns = cells / 2;
    for (let j = 0; j <= cells; ++j)
      for (let i = 0; i <= columns; ++i) {
        const [u, v] = [(half * columns + i) / cells, j / cells];
        positions.push(x + 0.95 * u, v - 0.5, 0);
        normals.push(0, 0, 1);
        sets[0].push(3 * u, 3 * v);
        // Charts: the left half upright in the lower half of the texture, the right half turned in the upper one.
        if (half === 0) sets[1].push(0.1 + 1.6 * u, 0.05 + 0.4 * v);
        else sets[1].push(0.9 - 0.8 * v, 0.55 + 0.8 * (u - 0.5));
      }
    for (let j = 0; j < cells; ++j)
      for (let i = 0; i < columns; ++i) {
        const a = first + j * (columns + 1) + i;
        const b = a + columns + 1;
        indices.push(a, a + 1, b + 1, a, b + 1, b);
      }
  }
  return { positions, normals, sets, indices };
}

const materials = [
  {
    // KHR_texture_transform names another set than the texture does.
    extensions: { KHR_materials_unlit: {} },
    pbrMetallicRoughness: {
      baseColorTexture: {
        index: 1,
        texCoord: 0,
        extensions: { KHR_texture_transform: { texCoord: 1, scale: [0.8, 0.6], offset: [0.15, 0.25], rotation: 0 } },
      },
    },
  },
  {
    pbrMetallicRoughness: {
      baseColorFactor: [0, 0, 0, 1],
      baseColorTexture: { index: 0 },
      metallicFactor: 0,
      roughnessFactor: 1,
    },
    emissiveFactor: [1, 1, 1],
    emissiveTexture: { index: 1, texCoord: 1 },
  },
  {
    pbrMetallicRoughness: { baseColorTexture: { index: 0 }, metallicFactor: 0, roughnessFactor: 1 },
    occlusionTexture: { index: 1, texCoord: 1 },
  },
];

/**
 * Writes the model and returns its path. The walls, from the left, show: a transformed texture on set 1; a light map on
 * set 1; albedo times occlusion.
 */
export function writeBakedInterior(): string {
  const writer = new GlbWriter();
  const meshes = materials.map((_, material) => {
    const { positions, normals, sets, indices } = wallAt(material - 1.5);
    const attributes = {
      POSITION: writer.attribute(positions, 3),
      NORMAL: writer.attribute(normals, 3),
      TEXCOORD_0: writer.attribute(sets[0], 2),
      TEXCOORD_1: writer.attribute(sets[1], 2),
    };
    return { name: `wall${material}`, primitives: [{ attributes, indices: writer.indices(indices), material }] };
  });
  const glb = writer.file({
    asset: { version: "2.0" },
    extensionsUsed: ["KHR_materials_unlit", "KHR_texture_transform"],
    scene: 0,
    scenes: [{ nodes: meshes.map((_, node) => node) }],
    nodes: meshes.map(({ name }, mesh) => ({ name, mesh })),
    meshes,
    materials,
    samplers: [{ magFilter: 9729, minFilter: 9729 }],
    textures: Object.keys(images).map((_, source) => ({ source, sampler: 0 })),
    images: Object.keys(images).map((uri) => ({ uri })),
  });
  mkdirSync(outputDirectory, { recursive: true });
  const path = join(outputDirectory, "baked-interior.glb");
  writeFileSync(path, glb);
  for (const [name, png] of Object.entries(images)) writeFileSync(join(outputDirectory, name), png);
  return path;
}
