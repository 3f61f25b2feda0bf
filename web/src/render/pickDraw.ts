// A draw as the picking pass sees it, and what its buffers hold: of indexed
// buffers WebGL tells a shader too little, so the rest is looked up where the
// pointer is. JavaScript keeps no copy of vertex data; what is looked up comes
// back from the GPU, one patch at a time.

import type { BufferGeometry, Matrix4, Sphere } from "three";
import { Line, LineSegments, Mesh, Points } from "three";
import type { BufferStage, DrawRange, ElementArray, IndexArray, Stage } from "../decode/stage.ts";
import type { Buffers } from "./buffers.ts";
import type { PickMaterial, PickMaterialRequest } from "./pickMaterial.ts";
import { makePickMaterial } from "./pickMaterial.ts";

export type DrawnObject = Mesh | Points | Line;
export interface BufferContents {
  /** Of the draw alone. */
  readonly index: IndexArray | undefined;
  readonly coord: ElementArray;
  /** In elements: from one vertex to the next, and before the first. */
  readonly coordStride: number;
  readonly coordOffset: number;
}

export class PickDraw {
  readonly range: DrawRange;
  /** It stands in for what is to come, whose numbers it does not have. */
  readonly isStandIn: boolean;
  /** Triangles in the draws of the patch before this one. */
  readonly trianglesBefore: number;
  /** Undefined for vertices from images. */
  readonly #stage: BufferStage | undefined;
  readonly #buffers: Buffers;
  readonly #geometry: BufferGeometry;
  readonly #request: PickMaterialRequest;
  #material: PickMaterial | undefined;
  #contents: BufferContents | undefined;
  #isDisposed = false;

  constructor(stage: Stage, range: DrawRange, geometry: BufferGeometry, buffers: Buffers, request: Omit<PickMaterialRequest, "primitive">) {
    this.range = range;
    this.isStandIn = stage.name === "base";
    this.#geometry = geometry;
    this.#request = { ...request, primitive: range.primitive };
    this.#stage = stage.kind === "buffers" ? stage : undefined;
    this.#buffers = buffers;
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

  get bounds(): Sphere | null {
    return this.#geometry.boundingSphere;
  }

  /** To be drawn in the picking pass, under this number. */
  objectFor(drawNumber: number, worldFromStored: Matrix4): DrawnObject {
    const material = this.#material ??= makePickMaterial(this.#request);
    const object = objectOf(this.range, this.#geometry, material);
    object.frustumCulled = false; // whoever picks has done it
    object.matrixAutoUpdate = false;
    object.matrixWorldAutoUpdate = false;
    object.matrixWorld.copy(worldFromStored);
    object.onBeforeRender = () => {
      material.uniforms.drawNumber.value = drawNumber;
      material.uniformsNeedUpdate = true;
    };
    return object;
  }

  /** Reads the draw's index and the patch's coordinates back, once until `forget`; undefined for vertices from images. */
  contents(): BufferContents | undefined {
    if (this.#stage === undefined || this.#isDisposed) return undefined;
    const { index, coord } = this.#stage;
    const { first, count } = this.range;
    this.#contents ??= {
      index: index && this.#buffers.read(index.bytes, index.type, first, count) as IndexArray,
      coord: this.#buffers.read(coord.bytes, coord.type, 0),
      coordStride: coord.stride,
      coordOffset: coord.offset,
    };
    return this.#contents;
  }

  forget(): void {
    this.#contents = undefined;
  }

  dispose(): void {
    this.#isDisposed = true;
    this.#contents = undefined;
    this.#material?.dispose();
    this.#material = undefined;
  }
}

export function objectOf(draw: DrawRange, geometry: BufferGeometry, material: Mesh["material"]): DrawnObject {
  return draw.primitive === "points" ? new Points(geometry, material)
    : draw.primitive === "lines" ? new LineSegments(geometry, material)
    : draw.primitive === "lineStrip" ? new Line(geometry, material) : new Mesh(geometry, material);
}

export function cornersOf({ primitive }: DrawRange): 1 | 2 | 3 {
  return primitive === "points" ? 1 : primitive === "lines" || primitive === "lineStrip" ? 2 : 3;
}

function trianglesOf({ primitive, count }: DrawRange): number {
  return primitive === "triangles" ? Math.floor(count / 3) : primitive === "triangleStrip" ? Math.max(0, count - 2) : 0;
}
