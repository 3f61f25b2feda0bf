// Runs in the browser: a three.js app that draws scenes of the loader, and moves their levels of detail by its cameras.
// Bundled by levelsLoader.test.ts.

import type { BufferGeometry } from "three";
import { AmbientLight, DirectionalLight, PerspectiveCamera, Scene, WebGLRenderer } from "three";
import { ImgeoLoader, type ImgeoScene } from "../../web/src/loader/index.ts";

/** Where a camera is, and what of the scenes it draws. */
export interface DrawRequest {
  readonly from: readonly [number, number, number];
  readonly to: readonly [number, number, number];
  readonly scene: number;
}

declare global {
  interface Window {
    levels: {
      /** Loads a document; returns the scene's number. `budget`: GPU memory in bytes. */
      load: (url: string, budget: number) => Promise<number>;
      /** Draws a scene alone, without telling it the camera. */
      draw: (request: DrawRequest) => void;
      /**
       * Draws a scene until nothing has been requested for half a second and 20 frames, of which the first can take
       * longer than that; tells it the camera before each frame.
       */
      converge: (request: DrawRequest) => Promise<void>;
      /** Bytes of vertex attributes and indices of a scene's present objects. */
      bytes: (scene: number) => number;
      dispose: (scene: number) => void;
    };
  }
}

const renderer = new WebGLRenderer({ antialias: true });
renderer.setPixelRatio(devicePixelRatio);
renderer.setSize(innerWidth, innerHeight);
document.body.append(renderer.domElement);
const camera = new PerspectiveCamera(45, innerWidth / innerHeight, 0.01, 100);
const scenes: ImgeoScene[] = [];

function draw({ from, to, scene: number }: DrawRequest): void {
  const light = new DirectionalLight(0xffffff, 4);
  light.position.set(from[0] - 1, from[1] + 1, from[2]);
  const scene = new Scene().add(new AmbientLight(0xffffff, 0.6), light);
  const object = scenes[number];
  if (object) scene.add(object);
  camera.position.set(...from);
  camera.lookAt(...to);
  renderer.render(scene, camera);
}

function isPending(scene: ImgeoScene): boolean {
  return !scene.transfers.every(({ state }) => state === "ready" || state === "failed");
}

window.levels = {
  async load(url, budget) {
    const loader = new ImgeoLoader().setWorkerUrl("/worker.js").setBudget(budget);
    const scene = await loader.loadAsync(url);
    await scene.complete;
    return scenes.push(scene) - 1;
  },

  draw,

  async converge(request) {
    const scene = scenes[request.scene];
    if (scene === undefined) throw new Error("no such scene");
    let changed = performance.now();
    let frames = 0;
    const onChange = (): void => {
      changed = performance.now();
      frames = 0;
    };
    scene.addEventListener("change", onChange);
    while (performance.now() - changed < 500 || frames < 20 || isPending(scene)) {
      frames += 1;
      draw(request);
      scene.update(camera, renderer);
      await new Promise(requestAnimationFrame);
    }
    scene.removeEventListener("change", onChange);
    draw(request);
  },

  bytes(number) {
    const arrays = new Set<ArrayBufferLike>();
    scenes[number]?.traverse((object) => {
      if (!("geometry" in object)) return;
      const { attributes, index } = object.geometry as BufferGeometry;
      for (const attribute of [...Object.values(attributes), ...(index ? [index] : [])])
        arrays.add(attribute.array.buffer);
    });
    return Array.from(arrays).reduce((sum, { byteLength }) => sum + byteLength, 0);
  },

  dispose(number) {
    scenes[number]?.dispose();
  },
};
