// Tests whether browser and GPU read vertices from images correctly. An image of four texels takes
// the usual path (browser decoder, upload, vertex chunk), and the result is compared with the input.
// Some browsers premultiply alpha or convert colours although told not to, and some drivers
// miscompile the texel fetch; without this test they would silently draw wrong shapes.

import {
  BufferGeometry,
  FrontSide,
  Matrix3,
  Matrix4,
  OrthographicCamera,
  Points,
  Scene,
  Vector4,
  type WebGLRenderer,
} from "three";
import { decodeWithBrowser } from "../../decode/image.ts";
import { byVertexRoleWith, texCoordRoles, vertexRoles } from "../../stage/attributeRows.ts";
import { textureRoles } from "../../document/description.ts";
import { makePickMaterial, pickTargetCount, pickedWordOffsets } from "./pickMaterial.ts";
import { makePickTarget } from "./picker.ts";
import { readPixelAsync } from "./pixelReadback.ts";
import type { TextureStore } from "../uploads/textureStore.ts";

/**
 * A PNG of 4 x 1 texels, RGBA, with alphas that would change colours if they were premultiplied: texel 0 is the high
 * bytes of a position, texel 1 its low bytes, texel 2 index 0, texel 3 a normal.
 */
export const testTexels = [1, 128, 255, 0, 254, 3, 64, 7, 0, 0, 0, 255, 255, 0, 51, 1] as const;
export const testPng =
  "iVBORw0KGgoAAAANSUhEUgAAAAQAAAABCAYAAAD5PA/NAAAAHElEQVR4AQERAO7/AAGA/wD+A0AHAAAA//8AMwEtuQT7j87v0AAAAABJRU5ErkJggg==";

/** Resolves to whether vertices can be read from textures. Never rejects. */
export async function testVertexTextures(renderer: WebGLRenderer, textures: TextureStore): Promise<boolean> {
  try {
    const words = await readTestVertex(renderer, textures);
    const floats = new Float32Array(words.buffer);
    const [hx, hy, hz, , lx, ly, lz] = testTexels;
    const expected = [256 * hx + lx, 256 * hy + ly, 256 * hz + lz];
    const stored = [1, -1, 51 / 127.5 - 1];
    const normal = stored.map((value) => value / Math.hypot(...stored)); // as the picking pass returns it
    const isPositionCorrect = expected.every((value, axis) => floats[pickedWordOffsets.position + axis] === value);
    const isNormalCorrect = normal.every(
      (value, axis) => Math.abs((floats[pickedWordOffsets.normal + axis] ?? NaN) - value) < 1e-6,
    );
    return words[pickedWordOffsets.pickId] === 1 && isPositionCorrect && isNormalCorrect;
  } catch {
    return false;
  }
}

async function readTestVertex(renderer: WebGLRenderer, textures: TextureStore): Promise<Uint32Array> {
  const bitmap = await decodeWithBrowser(Uint8Array.from(atob(testPng), (character) => character.charCodeAt(0)));
  const { image, steps } = textures.begin(bitmap, renderer);
  while (steps.next().done !== true);
  const texture = { value: textures.textureOf(image) };
  const material = makePickMaterial({
    primitive: "points",
    side: FrontSide,
    hasNormals: true,
    isFromImages: true,
    isInstanced: false,
    attributeDefines: {},
    wideLineStep: 0,
    alphaMask: undefined,
    gridDefines: {},
    normalDefines: {},
    uniforms: {
      pixelRatio: { value: 1 },
      pointSizes: { value: [1, 1, 1] },
      attenuation: { value: [1, 0, 0] },
      latticeStep: { value: [1, 1, 1] },
      lineWidth: { value: 1 },
      dashes: { value: [] },
      dashCount: { value: 0 },
      viewport: { value: new Vector4() },
      indexImage: texture,
      coordImage0: texture,
      coordImage1: texture,
      coordImage2: { value: null },
      coordImage3: { value: null },
      ...byVertexRoleWith("Image", (role) => (role === "normal" ? texture : { value: null })),
      texCoordFrames: { value: texCoordRoles.flatMap(() => [0, 0, 1, 1]) },
      textureTransforms: { value: textureRoles.map(() => new Matrix3()) },
      textureSets: { value: textureRoles.map(() => 0) },
      firstTexels: { value: [2, ...vertexRoles.map((role) => (role === "normal" ? 3 : 0))] },
      coordFirstTexels: { value: [0, 1, 0, 0] },
      coordPlaneCount: { value: 2 },
      missingBytesMidpoint: { value: 0 },
      hasIndex: { value: true },
      isIndexWide: { value: false },
      implicitWidth: { value: 4 },
      gridSize: { value: [0, 0] },
      gridPart: { value: [0, 0, 0, 0] },
      isGridClosed: { value: false },
      maxStoredValue: { value: 65535 },
      firstSequenceIndex: { value: 0 },
      isStrip: { value: false },
      areTexCoordsBytes: { value: false },
      colorHasAlpha: { value: false },
    },
  });
  material.uniforms.pickId.value = 1;
  const geometry = new BufferGeometry();
  geometry.setDrawRange(0, 1);
  const target = makePickTarget();
  try {
    renderer.setRenderTarget(target);
    renderer.render(sceneOf(new Points(geometry, material)), camera);
    const reading = readPixelAsync(renderer.getContext() as WebGL2RenderingContext, pickTargetCount);
    renderer.setRenderTarget(null);
    return await reading;
  } finally {
    image.close();
    material.dispose();
    geometry.dispose();
    target.dispose();
  }
}

/** A scene with the point, scaled so that it falls into the target's only pixel whatever its position. */
function sceneOf(point: Points): Scene {
  point.frustumCulled = false;
  point.matrixAutoUpdate = false;
  point.matrix.copy(new Matrix4().makeScale(1e-9, 1e-9, 1e-9));
  return new Scene().add(point);
}

const camera = new OrthographicCamera(-1, 1, 1, -1, -1, 1);
