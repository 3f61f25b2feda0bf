// Runs in the browser: one three.js app that draws a GLB with GLTFLoader, or a site with ImgeoLoader. Bundled by
// texCoordSets.test.ts.

import { AmbientLight, Color, PerspectiveCamera, Scene, WebGLRenderer, type Object3D } from "three";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import { ImgeoLoader } from "../../web/src/loader/index.ts";

declare global {
  interface Window {
    /** Draws a GLB, or the document of a site. */
    drawInterior: (url: string, workerUrl: string) => Promise<void>;
  }
}

async function sceneOf(url: string, workerUrl: string): Promise<Object3D> {
  if (url.endsWith(".glb")) return (await new GLTFLoader().loadAsync(url)).scene;
  const loader = new ImgeoLoader();
  loader.setWorkerUrl(workerUrl);
  const scene = await loader.loadAsync(url);
  await scene.complete;
  return scene;
}

window.drawInterior = async (url, workerUrl) => {
  const renderer = new WebGLRenderer({ antialias: true });
  renderer.setSize(window.innerWidth, window.innerHeight);
  document.body.replaceChildren(renderer.domElement);
  const camera = new PerspectiveCamera(45, window.innerWidth / window.innerHeight);
  camera.position.set(0, 0, 3);
  const scene = new Scene();
  scene.background = new Color(0);
  // With intensity pi, a white surface without occlusion is white, as with an ambientIntensity of 1 in X3D.
  scene.add(new AmbientLight(0xffffff, Math.PI), await sceneOf(url, workerUrl));
  renderer.render(scene, camera);
  // ImgeoLoader draws what it has uploaded in the frames that follow.
  await new Promise<void>((resolve) => {
    let frames = 30;
    const draw = () => {
      renderer.render(scene, camera);
      if (--frames > 0) requestAnimationFrame(draw);
      else resolve();
    };
    draw();
  });
};
