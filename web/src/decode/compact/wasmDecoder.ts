// The decoder of compact as WebAssembly, compiled from C++ (src/wasm/main.cpp).

import type { ElementArray, IndexArray, VertexArray } from "../../stage/vertexArray.ts";
import type { DecodeError } from "../decodeError.ts";
import type { DecodedPatch } from "./decodedFile.ts";
import { attributeKinds, topologies } from "./header.ts";
import type { AttributeBuffer } from "./patchBuffers.ts";
import { withRoles } from "./patchBuffers.ts";

interface DecoderExports {
  readonly memory: WebAssembly.Memory;
  /** Discards all memory, and returns the address of this many free bytes. */
  reserve(byteLength: number): number;
  /**
   * Decodes the payload at an address; returns the address of the table of its arrays. A module whose tables are laid
   * out differently has another number in this name.
   */
  decodeToTable1(payload: number, byteLength: number): number;
}

/** Thrown where the module refuses a payload. It has no message: the decoder in TypeScript words the refusal. */
export class WasmRefusal extends Error {
  readonly kind: DecodeError["kind"];

  constructor(kind: DecodeError["kind"]) {
    super(kind);
    this.kind = kind;
  }
}

/** By the number of an ErrorKind (include/imgeo/error.h). */
const kinds: readonly (DecodeError["kind"] | undefined)[] = [
  undefined,
  "truncated",
  "malformed",
  "unsupported",
  "limit",
];

/** By the number of an ElementType (src/wasm/patch_buffers.h). */
const arrayTypes = [Int8Array, Uint8Array, Int16Array, Uint16Array, Uint32Array, Float32Array] as const;

/**
 * An instance with more memory is dropped after a file, since memory never shrinks. A file of 65,535 vertices takes
 * 13 MB.
 */
export const maxKeptBytes = 64 * 2 ** 20;

export class WasmDecoder {
  readonly #module: WebAssembly.Module;
  #instance: DecoderExports | undefined;

  constructor(module: WebAssembly.Module) {
    this.#module = module;
  }

  /** The size of its memory in bytes. */
  get memoryBytes(): number {
    return this.#instance?.memory.buffer.byteLength ?? 0;
  }

  /**
   * Decodes all patches or base meshes of a payload. Throws WasmRefusal for an invalid payload,
   * WebAssembly.RuntimeError where memory does not suffice, and TypeError where the module belongs to another runtime.
   * Safe for untrusted bytes.
   */
  decode(payload: Uint8Array): DecodedPatch[] {
    const instance = (this.#instance ??= instantiate(this.#module));
    this.#instance = undefined; // nothing unwinds in an instance that throws
    const address = instance.reserve(payload.length);
    new Uint8Array(instance.memory.buffer).set(payload, address);
    const table = instance.decodeToTable1(address, payload.length);
    const patches = new TableReader(instance.memory.buffer, table).patches();
    if (instance.memory.buffer.byteLength <= maxKeptBytes) this.#instance = instance;
    return patches;
  }
}

function instantiate(module: WebAssembly.Module): DecoderExports {
  const refuse = (kind: number): never => {
    throw new WasmRefusal(kinds[kind] ?? "malformed");
  };
  return new WebAssembly.Instance(module, { imgeo: { refuse } }).exports as unknown as DecoderExports;
}

/**
 * Reads the table that the module's `decodeToTable1` returns (`Table` in src/wasm/main.cpp), layout 1. Copies the
 * arrays.
 */
class TableReader {
  readonly #memory: ArrayBuffer;
  readonly #words: Uint32Array;
  #at = 0;

  constructor(memory: ArrayBuffer, address: number) {
    this.#memory = memory;
    this.#words = new Uint32Array(memory, address);
  }

  patches(): DecodedPatch[] {
    return Array.from({ length: this.#next() }, () => this.#patch());
  }

  #next(): number {
    return this.#words[this.#at++]!;
  }

  #patch(): DecodedPatch {
    const topology = topologies[this.#next()]!;
    const positionBits = this.#next();
    const vertexCount = this.#next();
    const index = this.#array() as IndexArray;
    const coord = this.#vertices();
    const attributes = Array.from({ length: this.#next() }, () => this.#attribute());
    const buffers = {
      topology,
      positionBits,
      vertexCount,
      index: topology === "points" ? undefined : index,
      coord,
      ...withRoles(attributes),
    };
    const segmentCount = this.#next();
    const address = this.#next();
    const segment = new Int32Array(this.#memory.slice(address, address + 4 * this.#next()));
    return { buffers, segments: segmentCount > 0 ? { segment, segmentCount } : undefined };
  }

  #attribute(): AttributeBuffer {
    const kind = attributeKinds[this.#next()]!;
    return { kind, bits: this.#next(), vertices: this.#vertices() };
  }

  #vertices(): VertexArray {
    const array = this.#array();
    const components = this.#next() as VertexArray["components"];
    return { array, components, stride: this.#next(), offset: 0 };
  }

  #array(): ElementArray {
    const type = arrayTypes[this.#next()]!;
    const address = this.#next();
    return new type(this.#memory.slice(address, address + type.BYTES_PER_ELEMENT * this.#next()));
  }
}
