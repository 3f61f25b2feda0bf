// The pictures of X3D's Background and TextureBackground (ISO/IEC 19775-1, 24.2.1): the inner sides of a cube around
// the viewer, in front of sky and ground.

import type { Texture } from "three";
import {
  AddEquation,
  BufferAttribute,
  BufferGeometry,
  CustomBlending,
  DoubleSide,
  Mesh,
  OneFactor,
  OneMinusSrcAlphaFactor,
  ShaderMaterial,
  SrcAlphaFactor,
  Vector3,
} from "three";
import type { PanoramaSide, Vec3 } from "../../document/description.ts";
import type { BackgroundMesh } from "../environment/lateEnvironment.ts";

/** By side, the direction from the viewer to the middle of its picture, and the picture's up direction. */
const directions: Readonly<Record<PanoramaSide, { readonly forward: Vec3; readonly up: Vec3 }>> = {
  front: { forward: [0, 0, -1], up: [0, 1, 0] },
  back: { forward: [0, 0, 1], up: [0, 1, 0] },
  left: { forward: [-1, 0, 0], up: [0, 1, 0] },
  right: { forward: [1, 0, 0], up: [0, 1, 0] },
  top: { forward: [0, 1, 0], up: [0, 0, 1] },
  bottom: { forward: [0, -1, 0], up: [0, 0, -1] },
};

/** The corners of a side in the order lower left, lower right, upper left, upper right. */
export function cornersOf(side: PanoramaSide): readonly Vec3[] {
  const forward = new Vector3(...directions[side].forward),
    up = new Vector3(...directions[side].up);
  const right = forward.clone().cross(up);
  return [
    [-1, -1],
    [1, -1],
    [-1, 1],
    [1, 1],
  ].map(([x = 0, y = 0]) => forward.clone().addScaledVector(right, x).addScaledVector(up, y).toArray());
}

// Depth is neither tested nor written, so that z only has to lie between the planes of the view.
const vertexShader = /* glsl */ `
varying vec2 vUv;
void main() {
  vUv = uv;
  gl_Position = projectionMatrix * vec4(mat3(modelViewMatrix) * position, 1.0);
  gl_Position.z = 0.0;
}
`;

const fragmentShader = /* glsl */ `
uniform sampler2D picture;
varying vec2 vUv;
void main() {
  gl_FragColor = texture2D(picture, vUv);
}
`;

/** A side with its picture. The mesh is drawn before everything else but sky and ground. */
export function makePicture(side: PanoramaSide, picture: Texture): BackgroundMesh {
  const geometry = new BufferGeometry()
    .setAttribute("position", new BufferAttribute(new Float32Array(cornersOf(side).flat()), 3))
    .setAttribute("uv", new BufferAttribute(new Float32Array([0, 0, 1, 0, 0, 1, 1, 1]), 2))
    .setIndex([0, 1, 2, 2, 1, 3]);
  const mesh = new Mesh(
    geometry,
    new ShaderMaterial({
      vertexShader,
      fragmentShader,
      depthTest: false,
      depthWrite: false,
      side: DoubleSide,
      // Blends like a transparent material; `transparent` would draw it after all opaque shapes.
      blending: CustomBlending,
      blendEquation: AddEquation,
      blendSrc: SrcAlphaFactor,
      blendDst: OneMinusSrcAlphaFactor,
      blendSrcAlpha: OneFactor,
      blendDstAlpha: OneMinusSrcAlphaFactor,
      uniforms: { picture: { value: picture } },
    }),
  );
  mesh.frustumCulled = false;
  mesh.renderOrder = -Number.MAX_VALUE;
  return mesh;
}
