// A draw as the picking pass sees it, and what its buffers hold: of indexed
// buffers WebGL tells a shader too little, so the rest is looked up where the
// pointer is. JavaScript keeps no copy of vertex data; what is looked up comes
// back from the GPU, one patch at a time.

import type { BufferGeometry, Matrix4, Sphere } from "three";
import { Line, LineSegments, Mesh, Points } from "three";
import type { DrawRange, ElementArray, IndexArray, Stage } from "../decode/stage.ts";
import type { PickMaterial, PickMaterialRequest } from "./pickMaterial.ts";
import { makePickMaterial } from "./pickMaterial.ts";

export type DrawnObject = Mesh | Points | Line;
type ArrayType<Elements> = new (length: number) => Elements;

/** How the buffers of a draw are laid out. */
export interface BufferLayout {
  /** Undefined: vertices are drawn in order. */
  readonly indexArray: ArrayType<IndexArray> | undefined;
  readonly coordArray: ArrayType<ElementArray>;
  /** In elements: from one vertex to the next, and before the first. */
  readonly coordStride: number;
  readonly coordOffset: number;
}

export interface BufferContents {
  /** Of the draw alone. */
  readonly index: IndexArray | undefined;
  readonly coord: ElementArray;
}

export class PickDraw {
  readonly range: DrawRange;
  /** Triangles in the draws of the patch before this one. */
  readonly trianglesBefore: number;
  /** Undefined for vertices from images. */
  readonly layout: BufferLayout | undefined;
  readonly #geometry: BufferGeometry;
  readonly #request: PickMaterialRequest;
  #material: PickMaterial | undefined;
  #buffers: { index: WebGLBuffer | null; coord: WebGLBuffer } | undefined;
  #contents: BufferContents | undefined;
  #isDisposed = false;

  constructor(stage: Stage, range: DrawRange, geometry: BufferGeometry, request: Omit<PickMaterialRequest, "primitive">) {
    this.range = range;
    this.#geometry = geometry;
    this.#request = { ...request, primitive: range.primitive };
    this.layout = stage.kind === "textures" ? undefined : {
      indexArray: stage.index?.constructor as ArrayType<IndexArray> | undefined,
      coordArray: stage.coord.array.constructor as ArrayType<ElementArray>,
      coordStride: stage.coord.stride,
      coordOffset: stage.coord.offset,
    };
    const before = stage.draws.slice(0, stage.draws.indexOf(range));
    this.trianglesBefore = before.reduce((sum, draw) => sum + trianglesOf(draw), 0);
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
    if (this.layout !== undefined && this.#buffers === undefined) {
      object.onAfterRender = (renderer) => { this.#noteBuffers(renderer.getContext() as WebGL2RenderingContext); };
    }
    return object;
  }

  /** Reads the draw's index and the patch's coordinates back, once until `forget`; undefined before its first picking pass. */
  contents(gl: WebGL2RenderingContext): BufferContents | undefined {
    if (this.#contents === undefined && this.#buffers !== undefined && this.layout !== undefined && !this.#isDisposed) {
      const { index, coord } = this.#buffers;
      const { indexArray, coordArray } = this.layout;
      this.#contents = {
        index: index && indexArray ? readBuffer(gl, index, indexArray, this.range.first, this.range.count) : undefined,
        coord: readBuffer(gl, coord, coordArray, 0),
      };
    }
    return this.#contents;
  }

  forget(): void {
    this.#contents = undefined;
  }

  dispose(): void {
    this.#isDisposed = true;
    this.#buffers = undefined;
    this.#contents = undefined;
    this.#material?.dispose();
    this.#material = undefined;
  }

  /** The buffers that three.js made are known while they are bound. */
  #noteBuffers(gl: WebGL2RenderingContext): void {
    const program = gl.getParameter(gl.CURRENT_PROGRAM) as WebGLProgram | null;
    if (program === null) return;
    const place = gl.getAttribLocation(program, "position");
    const coord = gl.getVertexAttrib(place, gl.VERTEX_ATTRIB_ARRAY_BUFFER_BINDING) as WebGLBuffer | null;
    const index = gl.getParameter(gl.ELEMENT_ARRAY_BUFFER_BINDING) as WebGLBuffer | null;
    if (coord !== null) this.#buffers = { coord, index };
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

/** `count` elements from number `first` on; all that follow where `count` is undefined. */
function readBuffer<Elements extends ElementArray>(gl: WebGL2RenderingContext, buffer: WebGLBuffer, arrayType: ArrayType<Elements>,
                                                   first: number, count?: number): Elements {
  gl.bindBuffer(gl.COPY_READ_BUFFER, buffer);
  const { BYTES_PER_ELEMENT } = arrayType as unknown as { BYTES_PER_ELEMENT: number };
  const byteLength = gl.getBufferParameter(gl.COPY_READ_BUFFER, gl.BUFFER_SIZE) as number;
  const held = Math.max(0, Math.floor(byteLength / BYTES_PER_ELEMENT) - first);
  const elements = new arrayType(Math.min(held, count ?? held));
  gl.getBufferSubData(gl.COPY_READ_BUFFER, first * BYTES_PER_ELEMENT, elements);
  gl.bindBuffer(gl.COPY_READ_BUFFER, null);
  return elements;
}
