// Finds what is visible at a pixel: renders the candidates into a target of one pixel, with the
// matrices and the viewport of the canvas, so that they cover the pixel as on the screen.

import type { Camera, Group, Vector4, WebGLRenderer } from "three";
import {
  Matrix3,
  Matrix4,
  NearestFilter,
  PerspectiveCamera,
  Ray,
  RGBAIntegerFormat,
  Scene,
  Sphere,
  UnsignedIntType,
  Vector3,
  WebGLRenderTarget,
} from "three";
import type { SceneElement } from "../../document/element.ts";
import type { PickDraw } from "./pickDraw.ts";
import { cornersOf } from "../primitives/primitives.ts";
import type { Face } from "./pickedPrimitive.ts";
import { faceOf, nearestVertex, primitiveAt, primitiveEndingAt, primitiveIn } from "./pickedPrimitive.ts";
import { pickTargetCount, pickedWordOffsets } from "./pickMaterial.ts";
import { readPixel, readPixelAsync } from "./pixelReadback.ts";
import { frustumOf } from "../frames/viewFrustum.ts";

/** A hit, in scene coordinates. */
export interface Hit {
  /** The page's element of the shape. */
  readonly element: SceneElement;
  /** The element of the shape itself, which may be in an inlined document. */
  readonly shape: SceneElement;
  /** The group of the shape instance that was hit. */
  readonly group: Group;
  /** Index of the patch in its geometry. */
  readonly patch: number;
  /**
   * Index among the patch's triangles in draw order; each further element of a strip is a triangle. Undefined for
   * points, lines, bases and coarse forms of levels of detail.
   */
  readonly triangle: number | undefined;
  /** Record index in the patch of the primitive's vertex nearest to the hit point; -1 in a base. */
  readonly vertex: number;
  readonly position: Vector3;
  /** How far the mesh may be from the hit point, in world units; undefined where that is not known. */
  readonly accuracy: number | undefined;
  /** The shading normal, of length 1, on the visible side; undefined for points and lines without normals. */
  readonly normal: Vector3 | undefined;
}

export interface PickCandidate {
  readonly element: SceneElement;
  readonly shape: SceneElement;
  readonly patch: number;
  /** The group of one of the shape's instances. */
  readonly group: Group;
  readonly pick: PickDraw;
  /** Planes that clip the draw, in scene coordinates; at most `maxClipPlanes`. */
  readonly clipPlanes?: readonly Vector4[];
}

/** A candidate with its model matrix. */
export interface CandidateInView extends PickCandidate {
  readonly worldFromStored: Matrix4;
}

/** A pixel (x, y) from the top left of a canvas of this size, all in device pixels. */
export interface PixelPosition {
  readonly x: number;
  readonly y: number;
  readonly width: number;
  readonly height: number;
}

export class Picker {
  readonly #renderer: WebGLRenderer;
  readonly #scene = new Scene();
  #target: WebGLRenderTarget | undefined;
  /** The last draw that was hit and whose buffer contents have been read; they are kept for the next hit. */
  #lastHit: PickDraw | undefined;

  constructor(renderer: WebGLRenderer) {
    this.#renderer = renderer;
    this.#scene.matrixWorldAutoUpdate = false;
  }

  /** Blocks until the GPU is done. `slack`: see ScreenPicker.pick. */
  pick(
    camera: PerspectiveCamera,
    pixel: PixelPosition,
    slack: number,
    candidates: Iterable<PickCandidate>,
  ): Hit | undefined {
    const nearby = candidatesNearPixel(camera, pixel, slack, candidates);
    if (nearby.length === 0) return undefined;
    this.#draw(camera, pixel, nearby);
    const words = readPixel(this.#gl, pickTargetCount);
    this.#renderer.setRenderTarget(null);
    return this.#hitOf(words, camera, pixel, nearby);
  }

  /**
   * Does not block: the result is read when the GPU is done. It is "stale" if the draw that was hit has been disposed
   * of meanwhile.
   */
  async pickAsync(
    camera: PerspectiveCamera,
    pixel: PixelPosition,
    slack: number,
    candidates: Iterable<PickCandidate>,
  ): Promise<Hit | "stale" | undefined> {
    const nearby = candidatesNearPixel(camera, pixel, slack, candidates);
    if (nearby.length === 0) return undefined;
    this.#draw(camera, pixel, nearby);
    const reading = readPixelAsync(this.#gl, pickTargetCount);
    this.#renderer.setRenderTarget(null);
    const pickCamera = new PerspectiveCamera().copy(camera, false); // the original may move meanwhile
    const words = await reading;
    const hit = nearby[(words[pickedWordOffsets.pickId] ?? 0) - 1];
    return hit?.pick.isDisposed === true ? "stale" : this.#hitOf(words, pickCamera, pixel, nearby);
  }

  dispose(): void {
    this.#target?.dispose();
    this.#target = undefined;
  }

  get #gl(): WebGL2RenderingContext {
    return this.#renderer.getContext() as WebGL2RenderingContext;
  }

  /** Draws the candidates, and leaves the render target bound. */
  #draw(
    camera: PerspectiveCamera,
    { x, y, width, height }: PixelPosition,
    candidates: readonly CandidateInView[],
  ): void {
    this.#target ??= makePickTarget();
    // The canvas's viewport, shifted so that the requested pixel is the target's only one.
    this.#target.viewport.set(-x, y - height + 1, width, height);
    this.#scene.children = candidates.map(({ pick, worldFromStored, clipPlanes }, index) =>
      pick.objectFor(index + 1, worldFromStored, clipPlanes),
    );
    this.#renderer.setRenderTarget(this.#target);
    this.#renderer.render(this.#scene, camera);
    this.#scene.children = [];
  }

  #hitOf(
    words: Uint32Array,
    camera: PerspectiveCamera,
    pixel: PixelPosition,
    candidates: readonly CandidateInView[],
  ): Hit | undefined {
    const candidate = candidates[(words[pickedWordOffsets.pickId] ?? 0) - 1];
    if (candidate === undefined) return undefined;
    const { element, shape, group, patch, pick, worldFromStored } = candidate;
    const hasTriangles = cornersOf(pick.range) === 3 && !pick.isBase && pick.range.error === undefined;
    const accuracy = pick.error && pick.error * worldFromStored.getMaxScaleOnAxis();
    const floats = new Float32Array(words.buffer);
    const stored = new Vector3().fromArray(floats, pickedWordOffsets.position);
    const { number, vertex, face } = this.#primitiveOf(words, pick, stored);
    const faceNormal = worldNormalOf(face.normal, worldFromStored);
    const ray = rayThrough(camera, pixel);
    // The normal points to the viewer's side of the face.
    if (faceNormal !== undefined && faceNormal.dot(ray.direction) > 0) faceNormal.negate();
    const onFace = faceNormal && intersection(ray, face.point.clone().applyMatrix4(worldFromStored), faceNormal);
    return {
      element,
      shape,
      group,
      patch,
      vertex: pick.isBase ? -1 : vertex,
      triangle: hasTriangles ? pick.trianglesBefore + number : undefined,
      accuracy,
      position: onFace ?? stored.applyMatrix4(worldFromStored),
      normal: worldNormalOf(new Vector3().fromArray(floats, pickedWordOffsets.normal), worldFromStored) ?? faceNormal,
    };
  }

  #primitiveOf(words: Uint32Array, pick: PickDraw, point: Vector3): { number: number; vertex: number; face: Face } {
    const number = words[pickedWordOffsets.element] ?? 0;
    const vertex = words[pickedWordOffsets.vertex] ?? 0;
    const floats = new Float32Array(words.buffer);
    const face = {
      point: new Vector3(...pickedWordOffsets.facePoint.map((offset) => floats[offset] ?? 0)),
      normal: new Vector3().fromArray(floats, pickedWordOffsets.faceNormal),
    };
    if (!pick.hasContents || pick.range.primitive === "points") return { number, vertex, face };
    if (this.#lastHit !== pick) this.#lastHit?.forgetContents();
    this.#lastHit = pick;
    const contents = pick.contents();
    if (contents === undefined) return { number: 0, vertex, face };
    const { coord, index, coordStride, coordOffset } = contents;
    const positionOf = (n: number) => pick.pointOf(new Vector3().fromArray(coord, coordOffset + n * coordStride), n);
    const found =
      pick.range.isWide === true
        ? primitiveAt(number, pick.range, index)
        : index
          ? primitiveIn(index, pick.range.primitive, vertex, point, positionOf)
          : primitiveEndingAt(vertex - pick.range.first, pick.range);
    if (found === undefined) return { number: 0, vertex, face };
    return {
      number: found.number,
      vertex: nearestVertex(found.vertices, point, positionOf),
      face: faceOf(found.vertices, positionOf),
    };
  }
}

/** A render target for pick materials. */
export function makePickTarget(width = 1, height = 1): WebGLRenderTarget {
  return new WebGLRenderTarget(width, height, {
    count: pickTargetCount,
    format: RGBAIntegerFormat,
    type: UnsignedIntType,
    magFilter: NearestFilter,
    minFilter: NearestFilter,
  });
}

/** Candidates whose bounds come within `slack` device pixels of the pixel. */
function candidatesNearPixel(
  camera: PerspectiveCamera,
  { x, y, width, height }: PixelPosition,
  slack: number,
  candidates: Iterable<PickCandidate>,
): CandidateInView[] {
  const narrow = new PerspectiveCamera().copy(camera, false);
  narrow.setViewOffset(width, height, x - slack, y - slack, 2 * slack + 1, 2 * slack + 1);
  return candidatesInView(narrow, candidates);
}

/** Candidates whose bounds intersect the camera's view frustum. */
export function candidatesInView(
  { projectionMatrix, matrixWorldInverse }: Camera,
  candidates: Iterable<PickCandidate>,
): CandidateInView[] {
  const frustum = frustumOf(projectionMatrix, matrixWorldInverse);
  const sphere = new Sphere();
  const nearby: CandidateInView[] = [];
  const worldFromStored = new Matrix4();
  for (const candidate of candidates) {
    const { group, pick } = candidate;
    worldFromStored.multiplyMatrices(group.matrixWorld, pick.shapeFromStored);
    if (!frustum.intersectsSphere(sphere.copy(pick.bounds).applyMatrix4(worldFromStored))) continue;
    nearby.push({ ...candidate, worldFromStored: worldFromStored.clone() });
  }
  return nearby;
}

/** The normal in scene coordinates, of length 1; undefined for a zero normal. */
function worldNormalOf(normal: Vector3, worldFromStored: Matrix4): Vector3 | undefined {
  if (normal.lengthSq() === 0) return undefined;
  return normal.clone().applyMatrix3(new Matrix3().getNormalMatrix(worldFromStored)).normalize();
}

/** The ray through the pixel's centre, in scene coordinates. */
function rayThrough(camera: PerspectiveCamera, { x, y, width, height }: PixelPosition): Ray {
  const origin = new Vector3().setFromMatrixPosition(camera.matrixWorld);
  const through = new Vector3((2 * x + 1) / width - 1, 1 - (2 * y + 1) / height, 0.5).unproject(camera);
  return new Ray(origin, through.sub(origin).normalize());
}

/**
 * The intersection of the ray with a plane; undefined if they are parallel. GPUs snap vertices to fractions of a
 * pixel, so the interpolated point is slightly off the ray, and far off it on a face seen at a grazing angle.
 */
function intersection(ray: Ray, point: Vector3, normal: Vector3): Vector3 | undefined {
  const cosine = normal.dot(ray.direction);
  if (Math.abs(cosine) < 1e-6) return undefined;
  return ray.at(normal.dot(point.clone().sub(ray.origin)) / cosine, new Vector3());
}
