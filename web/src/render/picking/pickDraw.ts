// One draw in the picking pass, and access to its buffers. For indexed buffers WebGL tells the
// shader only the last vertex of a primitive, so index and coordinates are read back for the draw
// under the pointer. JavaScript keeps vertex data of small meshes only.

import type { BufferGeometry, Matrix4, Sphere } from "three";
import type { ElementArray, IndexArray } from "../../stage/vertexArray.ts";
import type { BufferStage, DrawRange, Stage } from "../../stage/stage.ts";
import type { BufferProvider } from "../uploads/bufferProvider.ts";
import type { DrawnObject } from "../primitives/drawnObject.ts";
import { makeDrawnObject } from "../primitives/drawnObject.ts";
import type { PickMaterial, PickMaterialRequest } from "./pickMaterial.ts";
import { makePickMaterial } from "./pickMaterial.ts";
import { trianglesOf } from "../primitives/primitives.ts";

export interface BufferContents {
  /** The index of this draw only. */
  readonly index: IndexArray | undefined;
  readonly coord: ElementArray;
  /** In elements: the distance from one vertex to the next, and the offset of the first. */
  readonly coordStride: number;
  readonly coordOffset: number;
}

/** What the picking pass draws with; created when the pointer comes near for the first time. */
export interface PickResources {
  readonly geometry: BufferGeometry;
  readonly request: Omit<PickMaterialRequest, "primitive">;
  /** Releases the geometry. */
  release(): void;
}

export interface PickDrawOptions {
  readonly buffers: BufferProvider;
  /** Bounds of the vertices, in stored coordinates. */
  readonly bounds: Sphere;
  /** Transforms stored coordinates into the shape's. */
  readonly shapeFromStored: Matrix4;
  acquireResources(): PickResources;
}

export class PickDraw {
  readonly range: DrawRange;
  /** The stage is a base: its triangle and vertex indices are not those of the patch. */
  readonly isStandIn: boolean;
  /** The number of triangles in the patch's earlier draws. */
  readonly trianglesBefore: number;
  readonly bounds: Sphere;
  readonly shapeFromStored: Matrix4;
  /** Undefined for vertices from images. */
  readonly #stage: BufferStage | undefined;
  readonly #context: PickDrawOptions;
  #made: { readonly resources: PickResources; readonly material: PickMaterial } | undefined;
  #contents: BufferContents | undefined;
  #isDisposed = false;

  constructor(stage: Stage, range: DrawRange, context: PickDrawOptions) {
    this.range = range;
    this.isStandIn = stage.name === "base";
    this.bounds = context.bounds;
    this.shapeFromStored = context.shapeFromStored;
    this.#context = context;
    this.#stage = stage.kind === "buffers" ? stage : undefined;
    const before = stage.draws.slice(0, stage.draws.indexOf(range));
    this.trianglesBefore = before.reduce((sum, draw) => sum + trianglesOf(draw), 0);
  }

  /** The vertices come from buffers, so the primitive must be looked up in `contents`. */
  get hasContents(): boolean {
    return this.#stage !== undefined;
  }

  get isDisposed(): boolean {
    return this.#isDisposed;
  }

  /** The object to draw in the picking pass; its pixels get this id. */
  objectFor(pickId: number, worldFromStored: Matrix4): DrawnObject {
    const { resources, material } = (this.#made ??= this.#make());
    const object = makeDrawnObject(this.range, resources.geometry, material);
    object.frustumCulled = false; // candidatesInView has already culled
    object.matrixAutoUpdate = false;
    object.matrixWorldAutoUpdate = false;
    object.matrixWorld.copy(worldFromStored);
    object.onBeforeRender = () => {
      material.uniforms.pickId.value = pickId;
      material.uniformsNeedUpdate = true;
    };
    return object;
  }

  /** Index and coordinates of the draw, read back once until `forgetContents`; undefined for vertices from images. */
  contents(): BufferContents | undefined {
    if (this.#stage === undefined || this.#isDisposed) return undefined;
    const { index, coord } = this.#stage;
    const { first, count } = this.range;
    const { buffers } = this.#context;
    this.#contents ??= {
      index: index && (buffers.read(index.bytes, index.type, first, count) as IndexArray),
      coord: buffers.read(coord.bytes, coord.type, 0),
      coordStride: coord.stride,
      coordOffset: coord.offset,
    };
    return this.#contents;
  }

  forgetContents(): void {
    this.#contents = undefined;
  }

  /** Releases what it draws with, until it is drawn again. */
  releaseResources(): void {
    this.#made?.material.dispose();
    this.#made?.resources.release();
    this.#made = undefined;
  }

  dispose(): void {
    this.#isDisposed = true;
    this.#contents = undefined;
    this.releaseResources();
  }

  #make(): { resources: PickResources; material: PickMaterial } {
    const resources = this.#context.acquireResources();
    return { resources, material: makePickMaterial({ ...resources.request, primitive: this.range.primitive }) };
  }
}
