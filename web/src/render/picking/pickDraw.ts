// A draw as the picking pass sees it, and what its buffers hold: of indexed
// buffers WebGL tells a shader too little, so the rest is looked up where the
// pointer is. JavaScript keeps no copy of vertex data but of small meshes; what is
// looked up comes back from the GPU, one patch at a time.

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
  /** Of the draw alone. */
  readonly index: IndexArray | undefined;
  readonly coord: ElementArray;
  /** In elements: from one vertex to the next, and before the first. */
  readonly coordStride: number;
  readonly coordOffset: number;
}

/** What a picking pass draws with: made when the pointer is near for the first time. */
export interface PickResources {
  readonly geometry: BufferGeometry;
  readonly request: Omit<PickMaterialRequest, "primitive">;
  /** Gives back what was made. */
  release(): void;
}

export interface PickDrawOptions {
  readonly buffers: BufferProvider;
  /** Around the stored vertices. */
  readonly bounds: Sphere;
  /** Places what is stored in the shape. */
  readonly shapeFromStored: Matrix4;
  acquireResources(): PickResources;
}

export class PickDraw {
  readonly range: DrawRange;
  /** It stands in for what is to come, whose numbers it does not have. */
  readonly isStandIn: boolean;
  /** Triangles in the draws of the patch before this one. */
  readonly trianglesBefore: number;
  readonly bounds: Sphere;
  readonly shapeFromStored: Matrix4;
  /** Undefined for vertices from images. */
  readonly #stage: BufferStage | undefined;
  readonly #context: PickDrawOptions;
  #made: { readonly parts: PickResources; readonly material: PickMaterial } | undefined;
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

  /** The vertices come from buffers, of which the pass itself knows little. */
  get hasContents(): boolean {
    return this.#stage !== undefined;
  }

  get isDisposed(): boolean {
    return this.#isDisposed;
  }

  /** To be drawn in the picking pass, under this number. */
  objectFor(pickId: number, worldFromStored: Matrix4): DrawnObject {
    const { parts, material } = (this.#made ??= this.#make());
    const object = makeDrawnObject(this.range, parts.geometry, material);
    object.frustumCulled = false; // whoever picks has done it
    object.matrixAutoUpdate = false;
    object.matrixWorldAutoUpdate = false;
    object.matrixWorld.copy(worldFromStored);
    object.onBeforeRender = () => {
      material.uniforms.pickId.value = pickId;
      material.uniformsNeedUpdate = true;
    };
    return object;
  }

  /** Reads the draw's index and the patch's coordinates back, once until `forget`; undefined for vertices from images. */
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

  /** What it draws with is made anew when it is wanted again. */
  releaseResources(): void {
    this.#made?.material.dispose();
    this.#made?.parts.release();
    this.#made = undefined;
  }

  dispose(): void {
    this.#isDisposed = true;
    this.#contents = undefined;
    this.releaseResources();
  }

  #make(): { parts: PickResources; material: PickMaterial } {
    const parts = this.#context.acquireResources();
    return { parts, material: makePickMaterial({ ...parts.request, primitive: this.range.primitive }) };
  }
}
