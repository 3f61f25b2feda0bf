// Runs in the browser: draws a glTF file with three.js' GLTFLoader, framed by a three-quarter view of its bounds.

import {
  AmbientLight,
  Box3,
  Color,
  DirectionalLight,
  Light,
  Mesh,
  MeshStandardMaterial,
  PerspectiveCamera,
  PMREMGenerator,
  Scene,
  Sphere,
  Vector3,
  WebGLRenderer,
} from "three";
import type { Object3D } from "three";
import { DRACOLoader } from "three/addons/loaders/DRACOLoader.js";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { MeshoptDecoder } from "three/addons/libs/meshopt_decoder.module.js";

/** The camera of a picture, in scene units and radians. */
export interface CameraView {
  readonly position: readonly number[];
  /** Axis and angle. */
  readonly orientation: readonly number[];
  readonly fieldOfView: number;
}

declare global {
  interface Window {
    drawModel: (url: string) => Promise<CameraView>;
  }
}

/** The lights that both runtimes add: a directional light from this direction, and ambient light. */
const direction = new Vector3(0.45, 0.8, 0.6);
const ambient = 0.2;
/** The radiance of the grey room that metals reflect in pages (lighting/physicalLighting.ts). */
const environmentRadiance = 0.3;

window.drawModel = async (url) => {
  const renderer = new WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
  renderer.setSize(window.innerWidth, window.innerHeight);
  document.body.append(renderer.domElement);
  const scene = new Scene();
  scene.background = new Color(0xededf2);
  const loader = new GLTFLoader().setDRACOLoader(new DRACOLoader().setDecoderPath("/draco/"));
  loader.setMeshoptDecoder(MeshoptDecoder);
  const model = (await loader.loadAsync(url)).scene;
  const lights: Object3D[] = [];
  model.traverse((object) => {
    if (object instanceof Light) lights.push(object);
  });
  for (const light of lights) light.removeFromParent();
  scene.add(model);
  addSurroundings(renderer, model);
  // X3D's light of intensity 1 makes a white, rough surface white.
  const sun = new DirectionalLight(0xffffff, Math.PI);
  sun.position.copy(direction);
  scene.add(sun, new AmbientLight(0xffffff, ambient * Math.PI));
  const bounds = new Box3().setFromObject(model, true).getBoundingSphere(new Sphere());
  const radius = Math.max(bounds.radius, 1e-6);
  const camera = new PerspectiveCamera(45, window.innerWidth / window.innerHeight, radius / 50, radius * 20);
  camera.position.copy(bounds.center).addScaledVector(new Vector3(0.35, 0.3, 1).normalize(), radius * 2.7);
  camera.lookAt(bounds.center);
  renderer.render(scene, camera);
  const { x, y, z, w } = camera.quaternion.clone().normalize();
  const sine = Math.sqrt(Math.max(1 - w * w, 0));
  return {
    position: camera.position.toArray(),
    orientation: sine < 1e-6 ? [0, 0, 1, 0] : [x / sine, y / sine, z / sine, 2 * Math.acos(w)],
    fieldOfView: Math.PI / 4,
  };
};

function addSurroundings(renderer: WebGLRenderer, model: Object3D): void {
  const room = new Scene();
  room.background = new Color().setRGB(environmentRadiance, environmentRadiance, environmentRadiance);
  const { texture } = new PMREMGenerator(renderer).fromScene(room);
  model.traverse((object) => {
    if (!(object instanceof Mesh)) return;
    for (const material of [object.material].flat())
      if (material instanceof MeshStandardMaterial && material.metalness === 1 && !material.metalnessMap)
        material.envMap = texture;
  });
}
