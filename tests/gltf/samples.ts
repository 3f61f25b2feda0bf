// glTF documents for the extensions of materials: a row of spheres, each with other numbers.

/** A material of glTF. */
type Material = Record<string, unknown>;

const dielectric = { baseColorFactor: [0.8, 0.1, 0.1, 1], metallicFactor: 0, roughnessFactor: 0.5 };
const glass = { baseColorFactor: [0.9, 0.97, 1, 1], metallicFactor: 0, roughnessFactor: 0 };

function extended(pbrMetallicRoughness: Material, extensions: Record<string, Material>): Material {
  return { pbrMetallicRoughness, extensions };
}

/** Rows of materials by the name of their document. */
export const materialSamples: Readonly<Record<string, readonly Material[]>> = {
  clearcoat: [0, 0.2, 0.6].map((roughness) =>
    extended(dielectric, {
      KHR_materials_clearcoat: { clearcoatFactor: 1, clearcoatRoughnessFactor: roughness },
    }),
  ),
  sheen: [0.2, 0.5, 1].map((roughness) =>
    extended(
      { ...dielectric, roughnessFactor: 1 },
      { KHR_materials_sheen: { sheenColorFactor: [0.2, 0.4, 1], sheenRoughnessFactor: roughness } },
    ),
  ),
  specularAndIor: [
    extended({ ...dielectric, roughnessFactor: 0.3 }, { KHR_materials_specular: { specularFactor: 0 } }),
    extended(
      { ...dielectric, roughnessFactor: 0.3 },
      { KHR_materials_specular: { specularColorFactor: [0, 1, 0] }, KHR_materials_ior: { ior: 2 } },
    ),
    extended({ ...dielectric, roughnessFactor: 0.3 }, { KHR_materials_ior: { ior: 2.4 } }),
  ],
  anisotropy: [0, 0.6, 1].map((strength) =>
    extended(
      { baseColorFactor: [0.9, 0.8, 0.6, 1], metallicFactor: 1, roughnessFactor: 0.35 },
      { KHR_materials_anisotropy: { anisotropyStrength: strength, anisotropyRotation: 0.6 } },
    ),
  ),
  iridescence: [250, 400, 700].map((thickness) =>
    extended(
      { baseColorFactor: [0.1, 0.1, 0.1, 1], metallicFactor: 0, roughnessFactor: 0.4 },
      { KHR_materials_iridescence: { iridescenceFactor: 1, iridescenceThicknessMaximum: thickness } },
    ),
  ),
  transmission: [0, 0.3, 0.6].map((roughnessFactor) =>
    extended({ ...glass, roughnessFactor }, { KHR_materials_transmission: { transmissionFactor: 1 } }),
  ),
  volume: [
    extended(glass, {
      KHR_materials_transmission: { transmissionFactor: 1 },
      KHR_materials_volume: { thicknessFactor: 1, attenuationDistance: 0.5, attenuationColor: [0.2, 0.8, 0.4] },
    }),
    extended(glass, {
      KHR_materials_transmission: { transmissionFactor: 1 },
      KHR_materials_volume: { thicknessFactor: 1 },
      KHR_materials_ior: { ior: 1.2 },
    }),
    extended(glass, {
      KHR_materials_transmission: { transmissionFactor: 1 },
      KHR_materials_volume: { thicknessFactor: 1 },
      KHR_materials_dispersion: { dispersion: 5 },
    }),
  ],
  emission: [1, 2, 4].map((emissiveStrength) => ({
    pbrMetallicRoughness: { ...dielectric, baseColorFactor: [0, 0, 0, 1] },
    emissiveFactor: [0.2, 0.1, 0],
    extensions: { KHR_materials_emissive_strength: { emissiveStrength } },
  })),
};

const slices = 48;

/**
 * Positions (which are normals, too), tangents, texture coordinates and indices of a unit sphere. Without tangents
 * three.js turns anisotropic surfaces the other way: it derives bitangents that point down the texture.
 */
function sphereArrays(): { positions: number[]; tangents: number[]; texCoords: number[]; indices: number[] } {
  const positions: number[] = [];
  const tangents: number[] = [];
  const texCoords: number[] = [];
  const indices: number[] = [];
  for (let row = 0; row <= slices; row++)
    for (let column = 0; column <= slices; column++) {
      const [polar, around] = [(row / slices) * Math.PI, (column / slices) * 2 * Math.PI];
      positions.push(Math.sin(polar) * Math.sin(around), Math.cos(polar), Math.sin(polar) * Math.cos(around));
      tangents.push(Math.cos(around), 0, -Math.sin(around), 1);
      texCoords.push(column / slices, row / slices);
      if (row === slices || column === slices) continue;
      const at = row * (slices + 1) + column;
      indices.push(at, at + slices + 1, at + 1, at + 1, at + slices + 1, at + slices + 2);
    }
  return { positions, tangents, texCoords, indices };
}

/** The text of a glTF document with a sphere for each material, and a striped wall behind them. */
export function sampleDocument(materials: readonly Material[]): string {
  const { positions, tangents, texCoords, indices } = sphereArrays();
  const bytes = Buffer.concat([
    Buffer.from(new Float32Array(positions).buffer),
    Buffer.from(new Float32Array(texCoords).buffer),
    Buffer.from(new Float32Array(tangents).buffer),
    Buffer.from(new Uint16Array(indices).buffer),
  ]);
  const count = positions.length / 3;
  const view = (byteOffset: number, byteLength: number) => ({ buffer: 0, byteOffset, byteLength });
  const stripes = Array.from({ length: 6 }, (_, i) => ({
    mesh: materials.length + (i % 2),
    translation: [2.4 * (materials.length / 2 - 0.5), -1.25 + i * 0.5, -2],
    scale: [1.2 * materials.length, 0.25, 0.05],
  }));
  const mesh = (material: number) => ({
    primitives: [{ attributes: { POSITION: 0, NORMAL: 0, TEXCOORD_0: 1, TANGENT: 3 }, indices: 2, material }],
  });
  const colored = (baseColorFactor: number[]) => ({
    pbrMetallicRoughness: { baseColorFactor, metallicFactor: 0, roughnessFactor: 1 },
  });
  return JSON.stringify({
    asset: { version: "2.0" },
    scene: 0,
    scenes: [{ nodes: Array.from({ length: materials.length + stripes.length }, (_, i) => i) }],
    nodes: [...materials.map((_, i) => ({ mesh: i, translation: [2.4 * i, 0, 0] })), ...stripes],
    materials: [...materials, colored([0.9, 0.6, 0.1, 1]), colored([0.1, 0.2, 0.6, 1])],
    meshes: Array.from({ length: materials.length + 2 }, (_, i) => mesh(i)),
    accessors: [
      { bufferView: 0, componentType: 5126, count, type: "VEC3", min: [-1, -1, -1], max: [1, 1, 1] },
      { bufferView: 1, componentType: 5126, count, type: "VEC2" },
      { bufferView: 3, componentType: 5123, count: indices.length, type: "SCALAR" },
      { bufferView: 2, componentType: 5126, count, type: "VEC4" },
    ],
    bufferViews: [
      view(0, count * 12),
      view(count * 12, count * 8),
      view(count * 20, count * 16),
      view(count * 36, indices.length * 2),
    ],
    buffers: [{ byteLength: bytes.length, uri: `data:application/octet-stream;base64,${bytes.toString("base64")}` }],
  });
}
