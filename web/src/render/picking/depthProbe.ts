// Samples the surroundings of a walking viewer: one depth image straight down from the eye, and
// four rows of depths around it at eye level, all in one small render target. The picking pass
// draws them, so its vertices are those on the screen; they are read back when the GPU is done,
// because JavaScript has no copy of the vertices.

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
interface Shot {
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

  /** A probe is under way; only one may be at a time. */
  get isBusy(): boolean {
    return this.#isBusy;
  }

  /** `depth`: the distance below the eye that is searched for ground. Undefined where the context is lost meanwhile. */
  async probe(
    depthCamera: DepthCamera,
    depth: number,
    candidates: readonly PickCandidate[],
  ): Promise<GroundSamples | undefined> {
    this.#isBusy = true;
    try {
      const nearest = depthCamera.range * 1e-3;
      const farthest = depthCamera.range * 2;
      const down = downwards(depthCamera, depth);
      const around = Array.from({ length: directions }, (_, turn) => sideways(depthCamera, turn, nearest, farthest));
      const surfaces = candidates.filter(({ pick }) => cornersOf(pick.range) === 3);
      for (const shot of [down, ...around]) this.#take(shot, surfaces);
      const gl = this.#renderer.getContext() as WebGL2RenderingContext;
      const reading = readBlocksAsync(
        gl,
        [down, ...around].map((shot) => ({ ...shot, attachment: 0 })),
      );
      this.#renderer.setRenderTarget(null);
      const words = await reading;
      if (gl.isContextLost()) return undefined;
      const depths = depthsIn(words);
      return {
        floor: { cells: floorCells, heights: heightsOf(depths.subarray(0, floorCells ** 2), depth) },
        walls: wallsOf(depths.subarray(floorCells ** 2), nearest, farthest),
      };
    } finally {
      this.#isBusy = false;
    }
  }

  dispose(): void {
    this.#target?.dispose();
    this.#target = undefined;
  }

  /** Leaves the render target bound. */
  #take({ camera, x, y, width, height }: Shot, surfaces: readonly PickCandidate[]): void {
    const target = (this.#target ??= makePickTarget(wallRays, floorCells + directions));
    target.viewport.set(x, y, width, height);
    target.scissor.copy(target.viewport);
    target.scissorTest = true;
    this.#scene.children = candidatesInView(camera, surfaces).map(({ pick, worldFromStored }) =>
      pick.objectFor(1, worldFromStored),
    );
    this.#renderer.setRenderTarget(target);
    this.#renderer.render(this.#scene, camera);
    this.#scene.children = [];
  }
}

function downwards({ eye, orientation, range }: DepthCamera, depth: number): Shot {
  const projection = new Matrix4().makeOrthographic(-range, range, range, -range, 0, depth);
  const towardsFeet = new Quaternion().setFromAxisAngle(new Vector3(1, 0, 0), -Math.PI / 2);
  return {
    camera: cameraAt(eye, orientation.clone().multiply(towardsFeet), projection),
    x: 0,
    y: 0,
    width: floorCells,
    height: floorCells,
  };
}

/** A quarter of the horizon, one pixel high; quarter 0 looks along -z, the following ones turn to the left. */
function sideways({ eye, orientation }: DepthCamera, turn: number, nearest: number, farthest: number): Shot {
  const half = nearest / wallRays;
  const projection = new Matrix4().makePerspective(-nearest, nearest, half, -half, nearest, farthest);
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

/** Depths 0 … 1; Infinity where nothing is hit. */
function depthsIn(words: Uint32Array): Float32Array {
  const floats = new Float32Array(words.buffer);
  return Float32Array.from({ length: words.length / wordsPerPixel }, (_, pixel) => {
    const first = pixel * wordsPerPixel;
    return words[first + pickedWordOffsets.pickId] === 0
      ? Infinity
      : (floats[first + pickedWordOffsets.depth] ?? Infinity);
  });
}

/** The last row of the image, its top, looks towards -z; it becomes the first row of the map. */
function heightsOf(depths: Float32Array, depth: number): Float32Array {
  const heights = new Float32Array(depths.length);
  for (let row = 0; row < floorCells; ++row) {
    const line = depths.subarray((floorCells - 1 - row) * floorCells, (floorCells - row) * floorCells);
    line.forEach((share, column) => {
      heights[row * floorCells + column] = -share * depth;
    });
  }
  return heights;
}

/** Hit points (x, z) in the depth camera's coordinate system. */
function wallsOf(depths: Float32Array, nearest: number, farthest: number): Float32Array {
  const points: number[] = [];
  const point = new Vector3();
  depths.forEach((share, pixel) => {
    if (share === Infinity) return;
    const ahead = (nearest * farthest) / (farthest - share * (farthest - nearest));
    const aside = (2 * (pixel % wallRays) + 1) / wallRays - 1;
    point.set(aside * ahead, 0, -ahead).applyQuaternion(quarterTurns(Math.floor(pixel / wallRays)));
    points.push(point.x, point.z);
  });
  return Float32Array.from(points);
}
