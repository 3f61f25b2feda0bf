// Runs in the browser: one three.js app that plays the animation of a GLB with GLTFLoader, or of a site with ImgeoLoader,
// and draws a moment of it with lights and shadows. Bundled by skins.test.ts.

import {
  AmbientLight,
  AnimationMixer,
  Box3,
  BoxGeometry,
  DirectionalLight,
  Group,
  Mesh,
  MeshStandardMaterial,
  type Object3D,
  PCFShadowMap,
  PerspectiveCamera,
  Scene,
  Vector3,
  WebGLRenderer,
} from "three";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import { ImgeoLoader, type ImgeoScene } from "../../web/src/loader/index.ts";

declare global {
  interface Window {
    /** Loads a GLB, or the document of a site, with a camera at a distance from a point, by default the origin. */
    loadModel: (url: string, workerUrl: string, distance: number, center?: [number, number, number]) => Promise<void>;
    /** The box around the vertices of a GLB as GLTFLoader poses them at rest. */
    boundsOf: (url: string) => Promise<{ center: [number, number, number]; size: number }>;
    /** Adds a floor that receives shadows. */
    addFloor: (y: number) => void;
    /** Displays a frame of the model's sequences. */
    showSequence: (seconds: number) => Promise<void>;
    /** Draws the model at a time of its first animation, in seconds; undefined: as it is. */
    drawMoment: (seconds: number | undefined) => Promise<void>;
    /** The name of the shape at a pixel of the canvas, by ImgeoScene.pick. */
    pickedShape: (x: number, y: number) => string | undefined;
  }
}

const scene = new Scene();
let renderer: WebGLRenderer;
let camera: PerspectiveCamera;
let mixer: AnimationMixer | undefined;
let sequences: ImgeoScene | undefined;
/** Whether the model has been drawn at a moment. */
let isUploaded = false;
let pick: Window["pickedShape"] = () => undefined;

async function modelOf(url: string, workerUrl: string): Promise<Object3D> {
  if (url.endsWith(".x3d")) {
    const loader = new ImgeoLoader();
    loader.setWorkerUrl(workerUrl);
    const model = await loader.loadAsync(url);
    await model.complete;
    sequences = model;
    pick = (x, y) => model.pick(renderer, camera, x, y)?.object.name;
    return model;
  }
  const { scene: model, animations } = await new GLTFLoader().loadAsync(url);
  model.animations = animations;
  model.traverse((object) => {
    object.frustumCulled = false;
    if (object instanceof Mesh) object.castShadow = object.receiveShadow = true;
  });
  return model;
}

window.boundsOf = async (url) => {
  const box = new Box3().setFromObject(await modelOf(url, ""), true);
  return { center: box.getCenter(new Vector3()).toArray(), size: box.getSize(new Vector3()).length() };
};

window.loadModel = async (url, workerUrl, distance, center = [0, 0, 0]) => {
  renderer = new WebGLRenderer({ antialias: true });
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.type = PCFShadowMap;
  renderer.setSize(window.innerWidth, window.innerHeight);
  document.body.replaceChildren(renderer.domElement);
  camera = new PerspectiveCamera(45, window.innerWidth / window.innerHeight, distance / 100, 10 * distance);
  camera.position.set(0, 0.1 * distance, distance);
  camera.lookAt(0, 0, 0);
  const sun = new DirectionalLight(0xffffff, 2);
  sun.position.set(0.6, 1.6, 0.8).multiplyScalar(distance / 2);
  sun.castShadow = true;
  const { camera: shadow } = sun.shadow;
  [shadow.left, shadow.right, shadow.top, shadow.bottom] = [-1, 1, 1, -1].map((side) => side * 0.6 * distance) as [
    number,
    number,
    number,
    number,
  ];
  [shadow.near, shadow.far] = [0.1 * distance, 3 * distance];
  sun.shadow.bias = -0.002;
  const model = await modelOf(url, workerUrl);
  model.castShadow = model.receiveShadow = true;
  model.position.set(0.1, 0.05, 0);
  model.rotation.y = 0.2;
  const moved = new Group().add(model);
  moved.position.set(...center).negate();
  scene.add(new AmbientLight(0xffffff, 1), sun, moved);
  const [clip] = model.animations;
  mixer = new AnimationMixer(model);
  if (clip) mixer.clipAction(clip).play();
};

window.addFloor = (y) => {
  const floor = new Mesh(new BoxGeometry(12, 0.1, 12), new MeshStandardMaterial());
  floor.position.y = y;
  floor.receiveShadow = true;
  scene.add(floor);
};

window.showSequence = async (seconds) => {
  let lastChange = performance.now();
  sequences?.addEventListener("change", () => {
    lastChange = performance.now();
  });
  sequences?.setSequenceTime(seconds);
  const quietTime = 500;
  while (performance.now() < lastChange + quietTime) await window.drawMoment(undefined);
};

window.drawMoment = async (seconds) => {
  if (seconds !== undefined) mixer?.setTime(seconds);
  // ImgeoLoader draws what it has uploaded in the frames that follow.
  for (let frame = 0; frame < (isUploaded ? 1 : 8); ++frame) {
    renderer.render(scene, camera);
    await new Promise(requestAnimationFrame);
  }
  isUploaded = true;
  renderer.render(scene, camera);
};

window.pickedShape = (x, y) => pick(x, y);
