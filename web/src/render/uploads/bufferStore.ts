// Stores vertex and index arrays on the GPU. Large ones are uploaded in steps, so that no single step
// delays a frame, and JavaScript keeps no copy. Small ones stay in JavaScript until a draw uses
// them as buffers: many never are, because they are copied into a merged mesh. three.js' own
// attributes would keep their arrays and delete buffers with the first geometry that is disposed
// of, so the buffers are created here, and three.js sees GLBufferAttributes.

import type { BufferAttribute, BufferGeometry, InterleavedBuffer } from "three";
import { GLBufferAttribute } from "three";
import type { ElementArray } from "../../stage/vertexArray.ts";
import type { ElementType } from "../../stage/elementType.ts";
import { arrayTypeOf, byteSizeOf, glTypeOf } from "../../stage/elementType.ts";
import type { ArrayUse, GpuArray, WritableArray } from "../../stage/stage.ts";
import { maxWaitingBytes, SpareMemory } from "./spareMemory.ts";
import type { BufferProvider, BufferUpload } from "./bufferProvider.ts";

const bytesPerStep = 2 ** 18;

/** Arrays of at most this size stay in JavaScript until they are needed: one step uploads them. */
const maxBytesKept = bytesPerStep;

/** An array that is not on the GPU yet. */
interface KeptArray {
  readonly array: ElementArray;
  readonly use: ArrayUse;
  /** Whether its bytes count as waiting. */
  readonly isCounted: boolean;
}

export class BufferStore implements BufferProvider {
  readonly ownsBuffers = true;
  readonly #gl: WebGL2RenderingContext;
  readonly #buffers = new WeakMap<GpuArray, WebGLBuffer | KeptArray>();
  readonly #spare = new SpareMemory<WebGLBuffer>((buffer) => {
    this.#gl.deleteBuffer(buffer);
  });
  #bytes = 0;
  /**
   * While geometries are being replaced, larger arrays wait, too, until a draw needs them: they then take the buffers
   * of those before. Only as many as may be uploaded in one frame.
   */
  isReplacing = false;
  #waitingBytes = 0;

  constructor(gl: WebGL2RenderingContext) {
    this.#gl = gl;
  }

  /** Total size of all open arrays. */
  get bytes(): number {
    return this.#bytes;
  }

  /** Arrays are being replaced: their memory is kept for a while for others of the same size. */
  expectReplacements(): void {
    this.#spare.expectReplacements();
  }

  /** Frees memory that is kept for others. */
  freeSpares(): void {
    this.#spare.clear();
  }

  begin(array: ElementArray, use: ArrayUse): BufferUpload {
    const { byteLength } = array;
    const waits = byteLength > maxBytesKept && this.isReplacing && this.#waitingBytes + byteLength <= maxWaitingBytes;
    if (waits) this.#waitingBytes += byteLength;
    if (waits || byteLength <= maxBytesKept)
      return { bytes: this.#add(byteLength, use, { array, use, isCounted: waits }), steps: deferredUpload(byteLength) };
    const buffer = this.#allocate(byteLength, use);
    return { bytes: this.#add(byteLength, use, buffer), steps: uploadPieces(this.#gl, buffer, array) };
  }

  /**
   * Stores vertices that can be replaced, all at once, before a frame is drawn. Their buffer is allocated when a draw
   * needs it: it may then take that of an array that it replaces.
   */
  makeWritable(array: ElementArray): WritableArray {
    const { byteLength } = array;
    const kept = (elements: ElementArray): KeptArray => ({ array: elements, use: "vertices", isCounted: false });
    const bytes = Object.assign(this.#add(byteLength, "vertices", kept(array)), { version: 0 });
    const write = (elements: ElementArray): void => {
      if (elements.byteLength !== byteLength) throw new RangeError("another number of elements");
      const held = this.#buffers.get(bytes);
      if (held === undefined) return;
      if (held instanceof WebGLBuffer) uploadPiece(this.#gl, held, 0, elements);
      else this.#buffers.set(bytes, kept(elements));
      bytes.version += 1;
    };
    return { bytes, write };
  }

  recordsOf(bytes: GpuArray, type: ElementType, stride: number): InterleavedBuffer {
    const attribute = new GLBufferAttribute(
      this.#bufferOf(bytes),
      glTypeOf(type),
      stride,
      byteSizeOf(type) as 1 | 2 | 4,
      Math.floor(bytes.byteLength / byteSizeOf(type) / stride),
    );
    // The properties of InterleavedBuffer that three.js reads: stride, and the element type by the
    // type of `array`.
    return Object.assign(attribute, {
      isInterleavedBuffer: true,
      stride,
      array: new (arrayTypeOf(type))(0),
    }) as unknown as InterleavedBuffer;
  }

  indexAttributeOf(bytes: GpuArray, type: ElementType): BufferAttribute {
    return new GLBufferAttribute(
      this.#bufferOf(bytes),
      glTypeOf(type),
      1,
      byteSizeOf(type) as 1 | 2 | 4,
      bytes.byteLength / byteSizeOf(type),
    ) as unknown as BufferAttribute;
  }

  read(bytes: GpuArray, type: ElementType, first: number, count = Infinity): ElementArray {
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

  /**
   * three.js deletes the buffers of a geometry's attributes when the geometry is disposed of; so the attributes are
   * removed first.
   */
  dispose(geometry: BufferGeometry): void {
    geometry.setIndex(null);
    for (const name of Object.keys(geometry.attributes)) geometry.deleteAttribute(name);
    geometry.dispose();
  }

  /** A buffer of this size, whose contents are undefined. */
  #allocate(byteLength: number, use: ArrayUse): WebGLBuffer {
    const spare = this.#spare.take(spareKeyOf(byteLength, use));
    if (spare !== undefined) return spare;
    const buffer = this.#gl.createBuffer();
    allocate(this.#gl, buffer, byteLength, use);
    return buffer;
  }

  #add(byteLength: number, use: ArrayUse, held: WebGLBuffer | KeptArray): GpuArray {
    this.#bytes += byteLength;
    const bytes = {
      byteLength,
      close: () => {
        const held = this.#buffers.get(bytes);
        if (held === undefined) return;
        this.#buffers.delete(bytes);
        this.#bytes -= byteLength;
        if (held instanceof WebGLBuffer) this.#spare.release(spareKeyOf(byteLength, use), held);
        else this.#endWait(held);
      },
    };
    this.#buffers.set(bytes, held);
    return bytes;
  }

  #bufferOf(bytes: GpuArray): WebGLBuffer {
    const held = this.#heldOf(bytes);
    if (held instanceof WebGLBuffer) return held;
    const { array, use } = held;
    const buffer = this.#allocate(array.byteLength, use);
    uploadPiece(this.#gl, buffer, 0, array);
    this.#buffers.set(bytes, buffer);
    this.#endWait(held);
    return buffer;
  }

  /** An array that was kept is on the GPU, or closed. */
  #endWait({ array, isCounted }: KeptArray): void {
    if (isCounted) this.#waitingBytes -= array.byteLength;
  }

  #heldOf(bytes: GpuArray): WebGLBuffer | KeptArray {
    const held = this.#buffers.get(bytes);
    if (held === undefined) throw new RangeError("the array is closed");
    return held;
  }
}

function spareKeyOf(byteLength: number, use: ArrayUse): string {
  return `${use} ${byteLength}`;
}

/** Accounts for the step that is taken later, when a draw needs the buffer. */
function* deferredUpload(byteLength: number): Generator<number, void, void> {
  yield byteLength;
}

/** Uploads through COPY_WRITE_BUFFER, which no vertex array object records. */
function* uploadPieces(
  gl: WebGL2RenderingContext,
  buffer: WebGLBuffer,
  array: ElementArray,
): Generator<number, void, void> {
  const all = new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
  for (let first = 0; first < all.length || first === 0; first += bytesPerStep) {
    const piece = all.subarray(first, first + bytesPerStep);
    uploadPiece(gl, buffer, first, piece);
    yield piece.length;
  }
}

function uploadPiece(gl: WebGL2RenderingContext, buffer: WebGLBuffer, first: number, piece: ElementArray): void {
  gl.bindBuffer(gl.COPY_WRITE_BUFFER, buffer);
  gl.bufferSubData(gl.COPY_WRITE_BUFFER, first, piece);
  gl.bindBuffer(gl.COPY_WRITE_BUFFER, null);
}

/**
 * The first target that a buffer is bound to fixes its use. A bound vertex array object records index buffers, so
 * three.js' own is unbound meanwhile.
 */
function allocate(gl: WebGL2RenderingContext, buffer: WebGLBuffer, byteLength: number, use: ArrayUse): void {
  const target = use === "index" ? gl.ELEMENT_ARRAY_BUFFER : gl.ARRAY_BUFFER;
  const vertexArray = gl.getParameter(gl.VERTEX_ARRAY_BINDING) as WebGLVertexArrayObject | null;
  gl.bindVertexArray(null);
  gl.bindBuffer(target, buffer);
  gl.bufferData(target, byteLength, gl.STATIC_DRAW);
  gl.bindBuffer(target, null);
  gl.bindVertexArray(vertexArray);
}
