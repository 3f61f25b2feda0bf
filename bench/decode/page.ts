// The page of bench/decode: three decoders, each from bytes in memory to arrays in the page, as a viewer uses it.

import type { BufferGeometry, Object3D } from "three";
import { Mesh } from "three";
import { MeshoptDecoder } from "three/examples/jsm/libs/meshopt_decoder.module.js";
import { DRACOLoader } from "three/examples/jsm/loaders/DRACOLoader.js";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import { pageWorkers } from "../../web/src/workers/pageWorkers.ts";

export interface Decoded {
  vertices: number;
  triangles: number;
}

export type Decode = (files: readonly Uint8Array<ArrayBuffer>[]) => Promise<Decoded>;

declare global {
  interface Window {
    decoders: Record<string, Decode>;
    files: Record<string, Uint8Array<ArrayBuffer>[]>;
  }
}

const workers = pageWorkers();
const draco = new DRACOLoader().setDecoderPath("draco/").preload();
// meshoptimizer's author recommends a worker for large files.
MeshoptDecoder.useWorkers(1);
const gltf = new GLTFLoader().setMeshoptDecoder(MeshoptDecoder);
const { signal } = new AbortController();

window.files = {};
window.decoders = {
  async imgeo(files) {
    const patches = await Promise.all(files.map((file) => workers.run("compactPatches", file, signal)));
    return sumOf(
      patches.flat().map(({ vertexCount, index }) => ({ vertices: vertexCount, triangles: (index?.length ?? 0) / 3 })),
    );
  },
  async draco(files) {
    const geometries = await Promise.all(
      files.map(
        (file) =>
          new Promise<BufferGeometry>((resolve, reject) => {
            // The loader transfers its bytes to its worker, so it gets a copy.
            draco.parse(file.slice().buffer, resolve, reject);
          }),
      ),
    );
    return sumOf(geometries.map(countsOf));
  },
  async meshopt(files) {
    const scenes = await Promise.all(files.map(async (file) => (await gltf.parseAsync(file.slice().buffer, "")).scene));
    return sumOf(scenes.flatMap((scene) => meshesIn(scene).map((mesh) => countsOf(mesh.geometry))));
  },
};

function countsOf(geometry: BufferGeometry): Decoded {
  return { vertices: geometry.getAttribute("position").count, triangles: (geometry.getIndex()?.count ?? 0) / 3 };
}

function meshesIn(root: Object3D): Mesh[] {
  const meshes: Mesh[] = [];
  root.traverse((object) => {
    if (object instanceof Mesh) meshes.push(object as Mesh);
  });
  return meshes;
}

function sumOf(parts: readonly Decoded[]): Decoded {
  return parts.reduce(
    (sum, part) => ({ vertices: sum.vertices + part.vertices, triangles: sum.triangles + part.triangles }),
    { vertices: 0, triangles: 0 },
  );
}
