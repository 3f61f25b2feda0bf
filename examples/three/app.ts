// A plain three.js app that displays a site of `imgeo convert` on a floor of its own, under its own lights, with
// shadows. A click on the model marks the point.

import {
  CircleGeometry,
  Color,
  DirectionalLight,
  HemisphereLight,
  Mesh,
  MeshBasicMaterial,
  MeshStandardMaterial,
  PerspectiveCamera,
  Scene,
  Sphere,
  SphereGeometry,
  Vector3,
  WebGLRenderer,
  type Box3,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { ImgeoLoader } from "imgeo/loader";

const status = document.querySelector("#status") ?? document.body;

const renderer = new WebGLRenderer({ antialias: true });
renderer.setPixelRatio(devicePixelRatio);
renderer.shadowMap.enabled = true;
document.body.append(renderer.domElement);

const scene = new Scene();
scene.background = new Color(0xdfe5ea);
const camera = new PerspectiveCamera(40);
const controls = new OrbitControls(camera, renderer.domElement);

// Draws when something has changed: the camera, the window's size, or the model.
let isFrameDue = false;
function draw(): void {
  if (isFrameDue) return;
  isFrameDue = true;
  requestAnimationFrame(() => {
    isFrameDue = false;
    renderer.render(scene, camera);
  });
}

function fitWindow(): void {
  renderer.setSize(innerWidth, innerHeight);
  camera.aspect = innerWidth / innerHeight;
  camera.updateProjectionMatrix();
  draw();
}

controls.addEventListener("change", draw);
addEventListener("resize", fitWindow);

const model = await new ImgeoLoader().setPath("model/").loadAsync("scene.x3d", ({ loaded, total }) => {
  status.textContent = `${Math.round(loaded / 1000)} of ${Math.round(total / 1000)} kB`;
});
model.castShadow = true;
model.receiveShadow = true;
scene.add(model);
model.addEventListener("change", draw);
addSurroundings(model.box);
fitWindow();

await model.complete;
status.textContent = "Complete. Drag to turn, click to mark a point.";

/** Places the camera, and adds lights, a floor and the marker in sizes that fit the model. */
function addSurroundings(box: Box3): void {
  const { center, radius } = box.getBoundingSphere(new Sphere());
  camera.near = radius / 50;
  camera.far = radius * 50;
  camera.position.copy(center).add(new Vector3(0.6, 0.5, 1).setLength(3.2 * radius));
  controls.target.copy(center);
  controls.update();

  const sun = new DirectionalLight(0xfff2dd, 2.5);
  sun.position.copy(center).add(new Vector3(0.5, 1.5, 0.7).setLength(3 * radius));
  sun.target.position.copy(center);
  sun.castShadow = true;
  sun.shadow.mapSize.set(2048, 2048);
  Object.assign(sun.shadow.camera, {
    left: -radius,
    right: radius,
    top: radius,
    bottom: -radius,
    near: radius,
    far: 6 * radius,
  });
  sun.shadow.normalBias = radius / 100;
  scene.add(sun, sun.target, new HemisphereLight(0xeaf4ff, 0x8a8177, 1.2));

  const floor = new Mesh(
    new CircleGeometry(4 * radius, 64),
    new MeshStandardMaterial({ color: 0xc9c4bb, roughness: 1 }),
  );
  floor.rotation.x = -Math.PI / 2;
  floor.position.set(center.x, box.min.y, center.z);
  floor.receiveShadow = true;
  scene.add(floor);

  const marker = new Mesh(new SphereGeometry(radius / 60), new MeshBasicMaterial({ color: 0xd0342c }));
  marker.visible = false;
  scene.add(marker);
  renderer.domElement.addEventListener("click", ({ offsetX, offsetY }) => {
    const hit = model.pick(renderer, camera, offsetX, offsetY);
    marker.visible = hit !== undefined;
    if (hit) marker.position.copy(hit.point);
    draw();
  });
}
