// The common start of a three.js page: a canvas over the whole window, a light at the camera, and a camera that frames
// the first object.

import {
  Box3,
  Color,
  DirectionalLight,
  PerspectiveCamera,
  Scene,
  Sphere,
  Vector3,
  WebGLRenderer,
  type Object3D,
} from "three";

const renderer = new WebGLRenderer({ antialias: true });
const camera = new PerspectiveCamera(45, innerWidth / innerHeight);
const light = new DirectionalLight(0xffffff, 3);
let displayed: Object3D | undefined;

/** Displays `object` instead of the one before; `isAll`: no finer object follows. */
export function show(object: Object3D, isAll = true): void {
  if (displayed === undefined) setUp(object);
  displayed = object;
  const scene = new Scene();
  scene.background = new Color(0.93, 0.94, 0.95);
  scene.add(object, light);
  requestAnimationFrame(() => {
    renderer.render(scene, camera);
    if (isAll)
      queueMicrotask(() => {
        document.dispatchEvent(new Event("model-complete"));
      });
  });
}

function setUp(object: Object3D): void {
  renderer.setPixelRatio(devicePixelRatio);
  renderer.setSize(innerWidth, innerHeight);
  document.body.append(renderer.domElement);
  const sphere = new Box3().setFromObject(object).getBoundingSphere(new Sphere());
  camera.near = sphere.radius / 100;
  camera.far = sphere.radius * 10;
  camera.position.copy(sphere.center).add(new Vector3(0.3, 0.3, 1).setLength(2.5 * sphere.radius));
  camera.lookAt(sphere.center);
  camera.updateProjectionMatrix();
  light.position.copy(camera.position);
}
