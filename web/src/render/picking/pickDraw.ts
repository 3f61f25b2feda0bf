// One draw in the picking pass, and access to its buffers. If vertices have an index buffer, the
// shader gets only the last vertex of a primitive, so index and coordinates of the draw that is hit
// are read back. JavaScript keeps vertex data of small meshes only.

import type { BufferGeometry, Matrix4, Vector3, Vector4 } from "three";
import { Sphere } from "three";
import type { ElementArray, IndexArray } from "../../stage/vertexArray.ts";
import type { BufferStage, DrawRange, Stage } from "../../stage/stage.ts";
import type { BufferProvider } from "../uploads/bufferProvider.ts";
import type { DrawnObject } from "../primitives/drawnObject.ts";
import { makeDrawnObject } from "../primitives/drawnObject.ts";
import { planeIn } from "../environment/clipPlanes.ts";
import type { PickMaterial, PickMaterialRequest } from "./pickMaterial.ts";
import { makePickMaterial } from "./pickMaterial.ts";
import { triangleCountOf } from "../primitives/primitives.ts";

export interface BufferContents {
  /** The index of this draw only. */
  readonly index: IndexArray | undefined;
  readonly coord: ElementArray;
  /** Elements from one vertex to the next. */
  readonly coordStride: number;
  /** Index of the first vertex's first element. */
  readonly coordOffset: number;
}

/** The resources of a draw in the picking pass; acquired when the pointer comes near for the first time. */
export interface PickResources {
  readonly geometry: BufferGeometry;
  readonly request: Omit<PickMaterialRequest, "primitive">;
  /** Releases the geometry. */
  release(): void;
}

/** What operators map the vertices to, in stored coordinates. */
interface MappedVertices {
  readonly bounds: Sphere;
  /** What is drawn instead of the coordinates in the buffers, x, y and z of each vertex. */
  readonly blurred?: { readonly points: Float32Array<ArrayBuffer> } | undefined;
  pointOf(stored: Vector3): Vector3;
}

export interface PickDrawOptions {
  readonly buffers: BufferProvider;
  /** Bounds of the vertices, in stored coordinates. */
  readonly bounds: Sphere;
  /** Undefined where there are no operators. */
  readonly operation?: MappedVertices | undefined;
  /** Where joints and displacers move a vertex, in stored coordinates; undefined where nothing moves. */
  readonly deformation?: { move(stored: Vector3, vertex: number): Vector3 } | undefined;
  /** Transforms stored coordinates into those of the shape. */
  readonly shapeFromStored: Matrix4;
  acquireResources(): PickResources;
}

export class PickDraw {
  readonly range: DrawRange;
  /** Whether the stage is a base, whose triangle and vertex indices are not those of the patch. */
  readonly isBase: boolean;
  /** How far the mesh may be from what is drawn, in stored units; undefined where that is not known. */
  readonly error: number | undefined;
  /** The number of triangles in the patch's earlier draws. */
  readonly trianglesBefore: number;
  readonly shapeFromStored: Matrix4;
  /** Undefined for vertices from images. */
  readonly #stage: BufferStage | undefined;
  readonly #options: PickDrawOptions;
  #acquired: { readonly resources: PickResources; readonly material: PickMaterial } | undefined;
  #contents: (BufferContents & { readonly version: number | undefined }) | undefined;
  #isDisposed = false;

  constructor(stage: Stage, range: DrawRange, options: PickDrawOptions) {
    this.range = range;
    this.isBase = stage.name === "base";
    this.error = range.error ?? (stage.name === "full" ? 0 : undefined);
    this.shapeFromStored = options.shapeFromStored;
    this.#options = options;
    this.#stage = stage.kind === "buffers" ? stage : undefined;
    const before = stage.draws.slice(0, stage.draws.indexOf(range));
    this.trianglesBefore = before.reduce((sum, draw) => sum + triangleCountOf(draw), 0);
  }

  /** Whether the vertices come from buffers, so that the primitive must be looked up in `contents`. */
  get hasContents(): boolean {
    return this.#stage !== undefined;
  }

  /** Bounds of the drawn vertices, in stored coordinates, with the spacing of points around them. */
  get bounds(): Sphere {
    const { bounds } = this.#options.operation ?? this.#options;
    const { spacing } = this.range;
    return spacing === undefined ? bounds : new Sphere(bounds.center, bounds.radius + spacing / 2);
  }

  /** The point that is drawn for the coordinates of a vertex with this index, in stored coordinates. */
  pointOf(stored: Vector3, vertex: number): Vector3 {
    const { operation, deformation } = this.#options;
    const moved = deformation ? deformation.move(stored, vertex) : stored;
    return operation ? operation.pointOf(moved) : moved;
  }

  get isDisposed(): boolean {
    return this.#isDisposed;
  }

  /** The object to draw in the picking pass; its pixels get this id. `clipPlanes`: in world coordinates. */
  objectFor(pickId: number, worldFromStored: Matrix4, clipPlanes: readonly Vector4[] = []): DrawnObject {
    const { resources, material } = (this.#acquired ??= this.#make());
    const object = makeDrawnObject(this.range, resources.geometry, material);
    object.frustumCulled = false; // candidatesInView has already culled
    object.matrixAutoUpdate = false;
    object.matrixWorldAutoUpdate = false;
    object.matrixWorld.copy(worldFromStored);
    object.onBeforeRender = () => {
      material.uniforms.pickId.value = pickId;
      material.uniforms.clipPlaneCount.value = clipPlanes.length;
      clipPlanes.forEach((plane, i) => material.uniforms.clipPlanes.value[i]?.copy(planeIn(plane, worldFromStored)));
      material.uniformsNeedUpdate = true;
    };
    return object;
  }

  /**
   * Index and coordinates of the draw, read back once until `forgetContents` or a change; undefined for vertices from
   * images.
   */
  contents(): BufferContents | undefined {
    if (this.#stage === undefined || this.#isDisposed) return undefined;
    const { index, coord } = this.#stage;
    const { first, count } = this.range;
    const { buffers, operation } = this.#options;
    if (this.#contents?.version !== coord.bytes.version) this.#contents = undefined;
    const blurred = operation?.blurred;
    this.#contents ??= {
      version: coord.bytes.version,
      index: index && (buffers.read(index.bytes, index.type, first, count) as IndexArray),
      coord: blurred ? blurred.points : buffers.read(coord.bytes, coord.type, 0),
      coordStride: blurred ? 3 : coord.stride,
      coordOffset: blurred ? 0 : coord.offset,
    };
    return this.#contents;
  }

  /** Frees the memory of `contents`. */
  forgetContents(): void {
    this.#contents = undefined;
  }

  /** Releases the resources, which are acquired again when it is drawn. */
  releaseResources(): void {
    this.#acquired?.material.dispose();
    this.#acquired?.resources.release();
    this.#acquired = undefined;
  }

  dispose(): void {
    this.#isDisposed = true;
    this.#contents = undefined;
    this.releaseResources();
  }

  #make(): { resources: PickResources; material: PickMaterial } {
    const resources = this.#options.acquireResources();
    return { resources, material: makePickMaterial({ ...resources.request, primitive: this.range.primitive }) };
  }
}
