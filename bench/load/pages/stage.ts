// A three.js page's usual beginning: a canvas over the whole window, a light at
// the camera, and a camera that frames what is added.

import { Box3, Color, DirectionalLight, PerspectiveCamera, Scene, Sphere, Vector3, WebGLRenderer, type Object3D } from "three";

export function show(object: Object3D): void {
  const renderer = new WebGLRenderer({ antialias: true });
  renderer.setPixelRatio(devicePixelRatio);
  renderer.setSize(innerWidth, innerHeight);
  document.body.append(renderer.domElement);
  const sphere = new Box3().setFromObject(object).getBoundingSphere(new Sphere());
  const camera = new PerspectiveCamera(45, innerWidth / innerHeight, sphere.radius / 100, sphere.radius * 10);
  camera.position.copy(sphere.center).add(new Vector3(0.3, 0.3, 1).setLength(2.5 * sphere.radius));
  camera.lookAt(sphere.center);
  const scene = new Scene();
  scene.background = new Color(0.93, 0.94, 0.95);
  const light = new DirectionalLight(0xffffff, 3);
  light.position.copy(camera.position);
  scene.add(object, light);
  requestAnimationFrame(() => { renderer.render(scene, camera); });
}
