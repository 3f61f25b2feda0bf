// Loads the glTF files of gltfpack, with the material that the other pages use.

import { Mesh, MeshPhongMaterial, type Object3D } from "three";
import { MeshoptDecoder } from "three/examples/jsm/libs/meshopt_decoder.module.js";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";

// meshoptimizer's author recommends workers for large files.
MeshoptDecoder.useWorkers(1);
const loader = new GLTFLoader().setMeshoptDecoder(MeshoptDecoder);

export async function load(url: string): Promise<Object3D> {
  const { scene } = await loader.loadAsync(url);
  scene.traverse((object) => {
    if (object instanceof Mesh) object.material = new MeshPhongMaterial();
  });
  return scene;
}
