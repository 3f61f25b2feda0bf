// Displays a tileset by 3d-tiles-renderer, to an error of a pixel and with the memory that pages of imgeo take at most.
// The page states the camera, and what is loaded beside what is displayed.

import { TilesRenderer } from "3d-tiles-renderer";
import {
  Color,
  DirectionalLight,
  Mesh,
  MeshPhongMaterial,
  PerspectiveCamera,
  Scene,
  SRGBColorSpace,
  Vector3,
  WebGLRenderer,
  type Object3D,
} from "three";
import { MeshoptDecoder } from "three/examples/jsm/libs/meshopt_decoder.module.js";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";

/** What the page that the benchmark writes states. */
declare global {
  interface Window {
    settings: {
      position: [number, number, number];
      orientation: [number, number, number, number];
      /** Siblings out of the view, and tiles above those that are displayed, are loaded: the default of the library. */
      loadsAll: boolean;
    };
  }
}

const maxBytes = 256 * 2 ** 20;

const { position, orientation, loadsAll } = window.settings;
const [axisX, axisY, axisZ, angle] = orientation;
const renderer = new WebGLRenderer({ antialias: true });
renderer.setPixelRatio(devicePixelRatio);
renderer.setSize(innerWidth, innerHeight);
document.body.append(renderer.domElement);
const camera = new PerspectiveCamera(45, innerWidth / innerHeight, 0.01, 10);
camera.position.fromArray(position);
camera.quaternion.setFromAxisAngle(new Vector3(axisX, axisY, axisZ), angle);
camera.updateMatrixWorld();
const light = new DirectionalLight(0xffffff, 3);
light.position.copy(camera.position);
const scene = new Scene();
scene.background = new Color().setRGB(0.93, 0.94, 0.95, SRGBColorSpace);
scene.add(light);

// meshoptimizer's author recommends workers for large files.
MeshoptDecoder.useWorkers(1);
const material = new MeshPhongMaterial({ color: 0x858278 });
const tiles = new TilesRenderer("tiles/tileset.json");
tiles.manager.addHandler(/\.glb$/, new GLTFLoader(tiles.manager).setMeshoptDecoder(MeshoptDecoder));
tiles.errorTarget = 1;
tiles.loadSiblings = tiles.loadAncestors = loadsAll;
tiles.lruCache.minBytesSize = tiles.lruCache.maxBytesSize = maxBytes;
tiles.setCamera(camera);
tiles.setResolutionFromRenderer(camera, renderer);
scene.add(tiles.group);

let isDue = false;
let hasDrawn = false;
/** Frames in a row that had nothing to load and nothing to draw. */
let idleFrames = 0;
tiles.addEventListener("load-model", ({ scene: model }: { scene: Object3D }) => {
  model.traverse((object) => {
    if (object instanceof Mesh) object.material = material;
  });
});
// Draws where something has changed, as pages do that spare the battery.
tiles.addEventListener("tile-visibility-change", () => (isDue = true));

function frame(): void {
  tiles.update();
  const isIdle = hasDrawn && !isDue && tiles.loadProgress === 1;
  idleFrames = isIdle ? idleFrames + 1 : 0;
  if (isDue) {
    isDue = false;
    hasDrawn = true;
    renderer.render(scene, camera);
  }
  if (idleFrames < 10) requestAnimationFrame(frame);
  else document.dispatchEvent(new Event("model-complete"));
}
requestAnimationFrame(frame);
