// Typed arrays as buffers. Like images they go to the GPU in pieces, so that no
// single step holds up a frame, and nothing of them is kept here when they are
// there. Small ones wait here until a draw wants them as buffers: many of them never
// are, but become a part of a larger mesh. three.js would keep its arrays, and
// delete buffers with whatever geometry is first disposed of; so these are ours, and
// three.js is only told of them.

import type { BufferAttribute, BufferGeometry, InterleavedBuffer } from "three";
import { GLBufferAttribute } from "three";
import type { ElementArray } from "../../stage/vertexArray.ts";
import type { ElementType } from "../../stage/elementType.ts";
import { arrayTypeOf, byteSizeOf } from "../../stage/elementType.ts";
import type { ArrayUse, StoredBytes } from "../../stage/stage.ts";
import type { BufferProvider, BufferUpload } from "./bufferProvider.ts";

const bytesPerStep = 2 ** 18;

/** Arrays up to this one are small: a step would bring them to the GPU. */
const maxBytesKept = bytesPerStep;

interface Kept {
  readonly array: ElementArray;
  readonly use: ArrayUse;
}

/** WebGL's constants. */
const glTypes: Readonly<Record<ElementType, number>> = {
  Int8: 0x1400,
  Uint8: 0x1401,
  Int16: 0x1402,
  Uint16: 0x1403,
  Int32: 0x1404,
  Uint32: 0x1405,
  Float32: 0x1406,
};

export class BufferStore implements BufferProvider {
  readonly #gl: WebGL2RenderingContext;
  readonly #buffers = new WeakMap<StoredBytes, WebGLBuffer | Kept>();
  #bytes = 0;

  constructor(gl: WebGL2RenderingContext) {
    this.#gl = gl;
  }

  /** Of all arrays that are open. */
  get bytes(): number {
    return this.#bytes;
  }

  begin(array: ElementArray, use: ArrayUse): BufferUpload {
    const gl = this.#gl;
    const { byteLength } = array;
    this.#bytes += byteLength;
    const bytes = {
      byteLength,
      close: () => {
        const held = this.#buffers.get(bytes);
        if (!this.#buffers.delete(bytes)) return;
        this.#bytes -= byteLength;
        if (held instanceof WebGLBuffer) gl.deleteBuffer(held);
      },
    };
    if (byteLength <= maxBytesKept) {
      this.#buffers.set(bytes, { array, use });
      return { bytes, steps: keeping(byteLength) };
    }
    const buffer = gl.createBuffer();
    this.#buffers.set(bytes, buffer);
    return { bytes, steps: pieces(gl, buffer, array, use) };
  }

  recordsOf(bytes: StoredBytes, type: ElementType, stride: number): InterleavedBuffer {
    const attribute = new GLBufferAttribute(
      this.#bufferOf(bytes),
      glTypes[type],
      stride,
      byteSizeOf(type) as 1 | 2 | 4,
      Math.floor(bytes.byteLength / byteSizeOf(type) / stride),
    );
    // What three.js looks at of interleaved buffers: the step from one record to the next, and the type of elements.
    return Object.assign(attribute, {
      isInterleavedBuffer: true,
      stride,
      array: new (arrayTypeOf(type))(0),
    }) as unknown as InterleavedBuffer;
  }

  indexOf(bytes: StoredBytes, type: ElementType): BufferAttribute {
    return new GLBufferAttribute(
      this.#bufferOf(bytes),
      glTypes[type],
      1,
      byteSizeOf(type) as 1 | 2 | 4,
      bytes.byteLength / byteSizeOf(type),
    ) as unknown as BufferAttribute;
  }

  read(bytes: StoredBytes, type: ElementType, first: number, count = Infinity): ElementArray {
    const gl = this.#gl;
    const held = this.#heldOf(bytes);
    if (!(held instanceof WebGLBuffer)) {
      const { buffer, byteOffset, byteLength } = held.array;
      return new (arrayTypeOf(type))(buffer, byteOffset, Math.floor(byteLength / byteSizeOf(type))).subarray(
        first,
        first + count,
      );
    }
    const length = Math.max(0, Math.floor(bytes.byteLength / byteSizeOf(type)) - first);
    const elements = new (arrayTypeOf(type))(Math.min(length, count));
    gl.bindBuffer(gl.COPY_READ_BUFFER, held);
    gl.getBufferSubData(gl.COPY_READ_BUFFER, first * byteSizeOf(type), elements);
    gl.bindBuffer(gl.COPY_READ_BUFFER, null);
    return elements;
  }

  /** three.js deletes the buffers of what a geometry has when it is disposed of. */
  dispose(geometry: BufferGeometry): void {
    geometry.setIndex(null);
    for (const name of Object.keys(geometry.attributes)) geometry.deleteAttribute(name);
    geometry.dispose();
  }

  #bufferOf(bytes: StoredBytes): WebGLBuffer {
    const held = this.#heldOf(bytes);
    if (held instanceof WebGLBuffer) return held;
    const buffer = this.#gl.createBuffer();
    for (const steps = pieces(this.#gl, buffer, held.array, held.use); steps.next().done !== true;);
    this.#buffers.set(bytes, buffer);
    return buffer;
  }

  #heldOf(bytes: StoredBytes): WebGLBuffer | Kept {
    const held = this.#buffers.get(bytes);
    if (held === undefined) throw new RangeError("the array is closed");
    return held;
  }
}

/** Counts as the step that will be taken when a draw wants it. */
function* keeping(byteLength: number): Generator<number, void, void> {
  yield byteLength;
}

/** Through a target that no vertex array notes, but for the first step. */
function* pieces(
  gl: WebGL2RenderingContext,
  buffer: WebGLBuffer,
  array: ElementArray,
  use: ArrayUse,
): Generator<number, void, void> {
  const all = new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
  for (let first = 0; first < all.length || first === 0; first += bytesPerStep) {
    const piece = all.subarray(first, first + bytesPerStep);
    if (first === 0) allocate(gl, buffer, all.length, use);
    gl.bindBuffer(gl.COPY_WRITE_BUFFER, buffer);
    gl.bufferSubData(gl.COPY_WRITE_BUFFER, first, piece);
    gl.bindBuffer(gl.COPY_WRITE_BUFFER, null);
    yield piece.length;
  }
}

/** What a buffer is for is what it is bound to first; an index is noted by the vertex array that is bound, which is three.js'. */
function allocate(gl: WebGL2RenderingContext, buffer: WebGLBuffer, byteLength: number, use: ArrayUse): void {
  const target = use === "index" ? gl.ELEMENT_ARRAY_BUFFER : gl.ARRAY_BUFFER;
  const vertexArray = gl.getParameter(gl.VERTEX_ARRAY_BINDING) as WebGLVertexArrayObject | null;
  gl.bindVertexArray(null);
  gl.bindBuffer(target, buffer);
  gl.bufferData(target, byteLength, gl.STATIC_DRAW);
  gl.bindBuffer(target, null);
  gl.bindVertexArray(vertexArray);
}
