// Runs in the browser: draws plain buffers with plain three.js and without any module of the runtime. Bundled by
// reference.ts. The shader implements X3D's lighting (ISO/IEC 19775-1, 17.2.2) independently.

import {
  BufferAttribute,
  BufferGeometry,
  Color,
  FrontSide,
  LinearSRGBColorSpace,
  LineSegments,
  MathUtils,
  Mesh,
  PerspectiveCamera,
  Points,
  Scene,
  ShaderMaterial,
  Vector3,
  WebGLRenderer,
  type Object3D,
} from "three";
import type { ReferenceScene } from "./reference.ts";

declare global {
  interface Window {
    drawReference: (sceneUrl: string) => Promise<void>;
  }
}

type Patch = ReferenceScene["patches"][number];

/** Size of points in CSS pixels. */
const pointSize = 2;

let lastRenderer: WebGLRenderer | undefined;

window.drawReference = async (sceneUrl) => {
  const description = (await (await fetch(sceneUrl, { cache: "no-store" })).json()) as ReferenceScene;
  // A new context for each picture, so that no state remains from the last one.
  lastRenderer?.forceContextLoss();
  lastRenderer?.dispose();
  const canvas = document.createElement("canvas");
  document.body.replaceChildren(canvas);
  const renderer = new WebGLRenderer({ canvas, antialias: true });
  lastRenderer = renderer;
  renderer.outputColorSpace = LinearSRGBColorSpace;
  renderer.setPixelRatio(window.devicePixelRatio);
  renderer.setSize(window.innerWidth, window.innerHeight);
  const camera = cameraOf(description, window.innerWidth / window.innerHeight);
  const scene = new Scene();
  const [red, green, blue] = description.skyColor;
  scene.background = new Color().setRGB(red, green, blue, LinearSRGBColorSpace);
  for (const patch of description.patches) scene.add(objectOf(patch, materialOf(patch, description, camera)));
  renderer.render(scene, camera);
};

function cameraOf({ viewpoint, patches }: ReferenceScene, aspect: number): PerspectiveCamera {
  const half = Math.tan(viewpoint.fieldOfView / 2);
  const camera = new PerspectiveCamera(MathUtils.radToDeg(2 * Math.atan(aspect >= 1 ? half : half / aspect)), aspect);
  camera.position.set(...viewpoint.position);
  const [x, y, z, angle] = viewpoint.orientation;
  camera.quaternion.setFromAxisAngle(new Vector3(x, y, z).normalize(), angle);
  const farthest = Math.max(...patches.map(({ positions }) => farthestFrom(camera.position, positions)));
  camera.near = farthest * 0.01;
  camera.far = farthest * 1.01;
  camera.updateMatrixWorld();
  camera.updateProjectionMatrix();
  return camera;
}

function farthestFrom(point: Vector3, positions: number[]): number {
  let farthest = 0;
  for (let i = 0; i < positions.length; i += 3)
    farthest = Math.max(farthest, point.distanceTo(new Vector3().fromArray(positions, i)));
  return farthest;
}

function objectOf(patch: Patch, material: ShaderMaterial): Object3D {
  const vertices = new BufferGeometry();
  const set = (name: string, values: number[] | undefined): void => {
    if (values) vertices.setAttribute(name, new BufferAttribute(Float32Array.from(values), 3));
  };
  set("position", patch.positions);
  set("normal", patch.normals);
  set("color", patch.colors);
  const { points, lines, triangles } = patch;
  vertices.setIndex(points.length ? points : lines.length ? lines : triangles);
  if (points.length) return new Points(vertices, material);
  return lines.length ? new LineSegments(vertices, material) : new Mesh(vertices, material);
}

const vertexShader = /* glsl */ `
uniform float pointSize;
varying vec3 vNormal;
varying vec3 vEyePosition;
varying vec3 vColor;
#ifdef HAS_COLORS
attribute vec3 color;
#endif
uniform vec3 diffuseColor;
void main() {
  vec4 eyePosition = modelViewMatrix * vec4(position, 1.0);
  vEyePosition = eyePosition.xyz;
  vNormal = normalize(normalMatrix * normal);
  vColor = diffuseColor;
  #ifdef HAS_COLORS
  vColor = color;
  #endif
  gl_PointSize = pointSize;
  gl_Position = projectionMatrix * eyePosition;
}`;

const fragmentShader = /* glsl */ `
varying vec3 vNormal;
varying vec3 vEyePosition;
varying vec3 vColor;
uniform vec3 specularColor, emissiveColor, ambient;
uniform float shininess;
uniform vec3 towardsLight[LIGHTS];
uniform vec3 lightColor[LIGHTS];
void main() {
  #ifdef HAS_NORMALS
  vec3 normal = normalize(vNormal);
  vec3 towardsEye = normalize(-vEyePosition);
  #ifdef HAS_NO_BACK
  if (dot(normal, towardsEye) < 0.0) normal = -normal;
  #endif
  vec3 light = emissiveColor + ambient * vColor;
  for (int i = 0; i < LIGHTS; ++i) {
    float facing = dot(normal, towardsLight[i]);
    if (facing <= 0.0) continue;
    vec3 halfway = normalize(towardsLight[i] + towardsEye);
    light += lightColor[i] * (vColor * facing + specularColor * pow(max(dot(normal, halfway), 1e-6), shininess * 128.0));
  }
  gl_FragColor = vec4(light, 1.0);
  #else
  gl_FragColor = vec4(vColor, 1.0);
  #endif
}`;

function materialOf(
  patch: Patch,
  { material, lights, headlight }: ReferenceScene,
  camera: PerspectiveCamera,
): ShaderMaterial {
  const towards = (direction: [number, number, number]): Vector3 =>
    new Vector3(...direction).negate().normalize().transformDirection(camera.matrixWorldInverse);
  const activeLights = [
    ...(headlight ? [{ towards: new Vector3(0, 0, 1), color: new Vector3(1, 1, 1) }] : []),
    ...lights.map(({ direction, color, intensity }) => ({
      towards: towards(direction),
      color: new Vector3(...color).multiplyScalar(intensity),
    })),
  ];
  const ambient = new Vector3();
  for (const { color, ambientIntensity } of lights)
    ambient.addScaledVector(new Vector3(...color), ambientIntensity * material.ambientIntensity);
  const value = <Value>(value: Value): { value: Value } => ({ value });
  return new ShaderMaterial({
    vertexShader,
    fragmentShader,
    side: FrontSide,
    defines: {
      LIGHTS: activeLights.length,
      ...(patch.normals && { HAS_NORMALS: "" }),
      ...(patch.colors && { HAS_COLORS: "" }),
      ...(patch.points.length && { HAS_NO_BACK: "" }),
    },
    uniforms: {
      diffuseColor: value(new Vector3(...material.diffuseColor)),
      specularColor: value(new Vector3(...material.specularColor)),
      emissiveColor: value(new Vector3(...material.emissiveColor)),
      shininess: value(material.shininess),
      ambient: value(ambient),
      towardsLight: value(activeLights.map((light) => light.towards)),
      lightColor: value(activeLights.map((light) => light.color)),
      pointSize: value(pointSize * window.devicePixelRatio),
    },
  });
}
