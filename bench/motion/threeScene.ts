// The scene of bench/motion in three.js: meshes of their own geometry that one AnimationMixer moves. `showFraction`
// sets its time and updates all matrices; the picture follows in the next frame.

import {
  AnimationClip,
  AnimationMixer,
  BoxGeometry,
  DirectionalLight,
  Mesh,
  MeshPhongMaterial,
  PerspectiveCamera,
  QuaternionKeyframeTrack,
  Quaternion,
  Scene,
  Vector3,
  VectorKeyframeTrack,
  WebGLRenderer,
} from "three";

declare global {
  var showFraction: (fraction: number) => void;
}

const { count, field } = document.body.dataset as { count: string; field: "position" | "quaternion" };
const renderer = new WebGLRenderer({ canvas: document.querySelector("canvas")!, antialias: true });
const camera = new PerspectiveCamera(45, 64 / 48, 0.1, 1000);
camera.position.set(40, 25, 90);
const scene = new Scene();
const light = new DirectionalLight();
light.position.set(40, 25, 90);
scene.add(light);
const material = new MeshPhongMaterial({ color: 0x808080 });
const times = [0, 0.5, 1];
const tracks = Array.from({ length: Number(count) }, (_, n) => {
  const mesh = new Mesh(new BoxGeometry(1, 1, 1 + n / 10_000), material);
  const [x, y, z] = [2 * (n % 40), 2 * Math.floor(n / 40), 1 + (n % 3)];
  mesh.position.set(x, y, 0);
  scene.add(mesh);
  if (field === "position") return new VectorKeyframeTrack(`${mesh.uuid}.position`, times, [x, y, 0, x, y, z, x, y, 0]);
  const turns = [0, z, 0].map((angle) => new Quaternion().setFromAxisAngle(new Vector3(0, 1, 0), angle).toArray());
  return new QuaternionKeyframeTrack(`${mesh.uuid}.quaternion`, times, turns.flat());
});
const mixer = new AnimationMixer(scene);
mixer.clipAction(new AnimationClip("motion", 1, tracks)).play();

let isRequested = false;
globalThis.showFraction = (fraction) => {
  mixer.setTime(fraction);
  scene.updateMatrixWorld();
  if (isRequested) return;
  isRequested = true;
  requestAnimationFrame(() => {
    isRequested = false;
    renderer.render(scene, camera);
  });
};
