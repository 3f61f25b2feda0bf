import { Mesh, MeshPhongMaterial } from "three";
import { MeshoptDecoder } from "three/examples/jsm/libs/meshopt_decoder.module.js";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import { show } from "./stage.ts";

// Where the decoder runs in workers, as its author advises for large files.
MeshoptDecoder.useWorkers(1);
const { scene } = await new GLTFLoader().setMeshoptDecoder(MeshoptDecoder).loadAsync("mesh.glb");
scene.traverse((object) => { if (object instanceof Mesh) object.material = new MeshPhongMaterial(); });
show(scene);
