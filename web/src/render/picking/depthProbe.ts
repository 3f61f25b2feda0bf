// Samples the surroundings of a walking avatar: one depth image straight down from the eye, and four
// rows of depths around it at eye level, all in one small render target. The picking materials draw
// them, with the same vertices as on the screen. JavaScript has no copy of the vertices, so the depths
// are read back when the GPU has drawn them.

import type { WebGLRenderer, WebGLRenderTarget } from "three";
import { Camera, Matrix4, Quaternion, Scene, Vector3 } from "three";
import type { DepthCamera, GroundSamples } from "../../navigation/groundSamples.ts";
import { cornersOf } from "../primitives/primitives.ts";
import type { PickCandidate } from "./picker.ts";
import { candidatesInView, makePickTarget } from "./picker.ts";
import { pickedWordOffsets } from "./pickMaterial.ts";
import { readBlocksAsync } from "./pixelReadback.ts";

/** Samples along each edge of the height map. */
const floorCells = 48;
/** Depth samples in each of the four directions. */
const wallRays = 128;
const directions = 4;
const wordsPerPixel = 4;

/** A block of the render target, and the camera that fills it. */
interface DepthView {
  readonly camera: Camera;
  readonly x: number;
  readonly y: number;
  readonly width: number;
  readonly height: number;
}

export class DepthProbe {
  readonly #renderer: WebGLRenderer;
  readonly #scene = new Scene();
  #target: WebGLRenderTarget | undefined;
  #isBusy = false;

  constructor(renderer: WebGLRenderer) {
    this.#renderer = renderer;
    this.#scene.matrixWorldAutoUpdate = false;
  }

  /** Whether a probe is in progress; there may be only one at a time. */
  get isBusy(): boolean {
    return this.#isBusy;
  }

  /**
   * Draws the surfaces of the candidates and reads their depths. Ground is searched down to `searchDepth` below the
   * eye. Resolves to undefined if the context is lost meanwhile.
   */
  async probe(
    depthCamera: DepthCamera,
    searchDepth: number,
    candidates: readonly PickCandidate[],
  ): Promise<GroundSamples | undefined> {
    this.#isBusy = true;
    try {
      const near = depthCamera.range * 1e-3;
      const far = depthCamera.range * 2;
      const down = downwards(depthCamera, searchDepth);
      const around = Array.from({ length: directions }, (_, turn) => sideways(depthCamera, turn, near, far));
      const surfaces = candidates.filter(({ pick }) => cornersOf(pick.range) === 3);
      for (const view of [down, ...around]) this.#draw(view, surfaces);
      const gl = this.#renderer.getContext() as WebGL2RenderingContext;
      const reading = readBlocksAsync(
        gl,
        [down, ...around].map((view) => ({ ...view, attachment: 0 })),
      );
      this.#renderer.setRenderTarget(null);
      const words = await reading;
      if (gl.isContextLost()) return undefined;
      const depths = depthsIn(words);
      return {
        floor: { cellsPerSide: floorCells, heights: heightsOf(depths.subarray(0, floorCells ** 2), searchDepth) },
        walls: wallsOf(depths.subarray(floorCells ** 2), near, far),
      };
    } finally {
      this.#isBusy = false;
    }
  }

  dispose(): void {
    this.#target?.dispose();
    this.#target = undefined;
  }

  /** Draws one block of the render target, and leaves the target bound. */
  #draw({ camera, x, y, width, height }: DepthView, surfaces: readonly PickCandidate[]): void {
    const target = (this.#target ??= makePickTarget(wallRays, floorCells + directions));
    target.viewport.set(x, y, width, height);
    target.scissor.copy(target.viewport);
    target.scissorTest = true;
    this.#scene.children = candidatesInView(camera, surfaces).map(({ pick, worldFromStored, clipPlanes }) =>
      pick.objectFor(1, worldFromStored, clipPlanes),
    );
    this.#renderer.setRenderTarget(target);
    this.#renderer.render(this.#scene, camera);
    this.#scene.children = [];
  }
}

function downwards({ eye, orientation, range }: DepthCamera, searchDepth: number): DepthView {
  const projection = new Matrix4().makeOrthographic(-range, range, range, -range, 0, searchDepth);
  const downwardRotation = new Quaternion().setFromAxisAngle(new Vector3(1, 0, 0), -Math.PI / 2);
  return {
    camera: cameraAt(eye, orientation.clone().multiply(downwardRotation), projection),
    x: 0,
    y: 0,
    width: floorCells,
    height: floorCells,
  };
}

/** A quarter of the horizon, one pixel high; quarter 0 looks along -z, the following ones turn to the left. */
function sideways({ eye, orientation }: DepthCamera, turn: number, near: number, far: number): DepthView {
  const half = near / wallRays;
  const projection = new Matrix4().makePerspective(-near, near, half, -half, near, far);
  return {
    camera: cameraAt(eye, orientation.clone().multiply(quarterTurns(turn)), projection),
    x: 0,
    y: floorCells + turn,
    width: wallRays,
    height: 1,
  };
}

function quarterTurns(turn: number): Quaternion {
  return new Quaternion().setFromAxisAngle(new Vector3(0, 1, 0), (turn * Math.PI) / 2);
}

function cameraAt(eye: Vector3, orientation: Quaternion, projection: Matrix4): Camera {
  const camera = new Camera();
  camera.position.copy(eye);
  camera.quaternion.copy(orientation);
  camera.projectionMatrix.copy(projection);
  camera.projectionMatrixInverse.copy(projection).invert();
  camera.updateMatrixWorld();
  return camera;
}

/** Depths 0 … 1; Infinity for pixels in which nothing is hit. */
function depthsIn(words: Uint32Array): Float32Array {
  const floats = new Float32Array(words.buffer);
  return Float32Array.from({ length: words.length / wordsPerPixel }, (_, pixel) => {
    const first = pixel * wordsPerPixel;
    return words[first + pickedWordOffsets.pickId] === 0
      ? Infinity
      : (floats[first + pickedWordOffsets.depth] ?? Infinity);
  });
}

/**
 * Heights relative to the eye. The last row of the image, its top, is towards -z, and becomes the first row of the map.
 */
function heightsOf(depths: Float32Array, searchDepth: number): Float32Array {
  const heights = new Float32Array(depths.length);
  for (let row = 0; row < floorCells; ++row) {
    const line = depths.subarray((floorCells - 1 - row) * floorCells, (floorCells - row) * floorCells);
    line.forEach((depth, column) => {
      heights[row * floorCells + column] = -depth * searchDepth;
    });
  }
  return heights;
}

/** The points (x, z) that are hit at eye level, in the depth camera's coordinate system. */
function wallsOf(depths: Float32Array, near: number, far: number): Float32Array {
  const points: number[] = [];
  const point = new Vector3();
  depths.forEach((depth, pixel) => {
    if (depth === Infinity) return;
    const distance = (near * far) / (far - depth * (far - near));
    const tangent = (2 * (pixel % wallRays) + 1) / wallRays - 1;
    point.set(tangent * distance, 0, -distance).applyQuaternion(quarterTurns(Math.floor(pixel / wallRays)));
    points.push(point.x, point.z);
  });
  return Float32Array.from(points);
}
