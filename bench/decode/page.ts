// The page of bench/decode: a decoder, from bytes in memory to arrays in the page, as a viewer uses it. The query names
// it (`?decoder=`) and the number of its workers (`&workers=`), which are started with the page.

import type { BufferGeometry, Object3D } from "three";
import { Mesh } from "three";
import { MeshoptDecoder } from "three/examples/jsm/libs/meshopt_decoder.module.js";
import { DRACOLoader } from "three/examples/jsm/loaders/DRACOLoader.js";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import type { DecoderName } from "./inputs.ts";
import { WorkerPool } from "../../web/src/workers/workerPool.ts";

export interface Decoded {
  vertices: number;
  triangles: number;
}

export type Decode = (files: readonly Uint8Array<ArrayBuffer>[]) => Promise<Decoded>;

declare global {
  interface Window {
    decode: Decode;
    files: Uint8Array<ArrayBuffer>[];
    /** Resolves when the workers have had time to start. */
    ready: Promise<unknown>;
  }
}

/** No decoder says when its worker has started, but all have within this time. */
const startMs = Number(new URL(location.href).searchParams.get("start"));
const { signal } = new AbortController();

function imgeoWith(isWasm: boolean, size: number): Decode {
  const workers = new WorkerPool({
    size,
    idleMs: 1e9,
    start: () => new Worker("imgeo-worker.js", { type: "module" }),
    decoderUrl: () => (isWasm ? new URL("imgeo-decoder.wasm", location.href).href : undefined),
    runOnMainThread: () => Promise.reject(new Error("there are no workers")),
    prepareMainThread: () => undefined,
  });
  workers.prepare(size);
  workers.requestDecoder();
  return async (files) => {
    const patches = await Promise.all(files.map((file) => workers.run("compactPatches", file, signal)));
    return sumOf(
      patches.flat().map(({ vertexCount, index }) => ({ vertices: vertexCount, triangles: (index?.length ?? 0) / 3 })),
    );
  };
}

function dracoWith(size: number): Decode {
  const draco = new DRACOLoader().setDecoderPath("draco/").setWorkerLimit(size);
  // Starts a worker as the first file would; the loader has no public way to do so.
  void (draco as unknown as { _getWorker(taskId: number, cost: number): Promise<Worker> })._getWorker(0, 0);
  return async (files) => {
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
  };
}

function meshoptWith(size: number): Decode {
  MeshoptDecoder.useWorkers(size); // its author recommends workers for large files
  const gltf = new GLTFLoader().setMeshoptDecoder(MeshoptDecoder);
  return async (files) => {
    const scenes = await Promise.all(files.map(async (file) => (await gltf.parseAsync(file.slice().buffer, "")).scene));
    return sumOf(scenes.flatMap((scene) => meshesIn(scene).map((mesh) => countsOf(mesh.geometry))));
  };
}

const query = new URL(location.href).searchParams;
const workerCount = Number(query.get("workers"));
const decoders: Readonly<Record<DecoderName, () => Decode>> = {
  typescript: () => imgeoWith(false, workerCount),
  wasm: () => imgeoWith(true, workerCount),
  draco: () => dracoWith(workerCount),
  meshopt: () => meshoptWith(workerCount),
};
window.decode = decoders[query.get("decoder") as DecoderName]();
window.ready = new Promise((resolve) => setTimeout(resolve, startMs));

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
