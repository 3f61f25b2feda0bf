// Writes binary glTF files (GLB 2.0) with Float32 attributes and Uint16 indices.

export class GlbWriter {
  readonly #chunks: Buffer[] = [];
  readonly #bufferViews: object[] = [];
  readonly #accessors: object[] = [];
  #size = 0;

  /** Adds bytes; returns the index of their buffer view. */
  bufferView(bytes: Buffer): number {
    const padding = Buffer.alloc(-bytes.length & 3);
    this.#chunks.push(bytes, padding);
    this.#bufferViews.push({ buffer: 0, byteOffset: this.#size, byteLength: bytes.length });
    this.#size += bytes.length + padding.length;
    return this.#bufferViews.length - 1;
  }

  /** Adds vectors of a vertex attribute; returns the index of their accessor. */
  attribute(numbers: readonly number[], components: 2 | 3): number {
    const extreme = (of: (...values: number[]) => number) =>
      Array.from({ length: components }, (_, i) => of(...numbers.filter((_, n) => n % components === i)));
    this.#accessors.push({
      bufferView: this.bufferView(Buffer.from(Float32Array.from(numbers).buffer)),
      componentType: 5126,
      count: numbers.length / components,
      type: `VEC${components}`,
      min: extreme(Math.min),
      max: extreme(Math.max),
    });
    return this.#accessors.length - 1;
  }

  /** Adds numbers as floats, such as keys, weights and matrices; returns the index of their accessor. */
  floats(numbers: readonly number[], type: "SCALAR" | "VEC3" | "VEC4" | "MAT4"): number {
    const components = { SCALAR: 1, VEC3: 3, VEC4: 4, MAT4: 16 }[type];
    this.#accessors.push({
      bufferView: this.bufferView(Buffer.from(Float32Array.from(numbers).buffer)),
      componentType: 5126,
      count: numbers.length / components,
      type,
      ...(type === "SCALAR" && { min: [Math.min(...numbers)], max: [Math.max(...numbers)] }),
    });
    return this.#accessors.length - 1;
  }

  /** Adds four joints of each vertex; returns the index of their accessor. */
  joints(numbers: readonly number[]): number {
    const bufferView = this.bufferView(Buffer.from(Uint8Array.from(numbers)));
    this.#accessors.push({ bufferView, componentType: 5121, count: numbers.length / 4, type: "VEC4" });
    return this.#accessors.length - 1;
  }

  /** Adds indices of vertices; returns the index of their accessor. */
  indices(numbers: readonly number[]): number {
    const bufferView = this.bufferView(Buffer.from(Uint16Array.from(numbers).buffer));
    this.#accessors.push({ bufferView, componentType: 5123, count: numbers.length, type: "SCALAR" });
    return this.#accessors.length - 1;
  }

  /** The file of a glTF document, which lacks accessors and buffers. */
  file(document: object): Buffer {
    const json = Buffer.from(
      JSON.stringify({
        ...document,
        accessors: this.#accessors,
        bufferViews: this.#bufferViews,
        buffers: [{ byteLength: this.#size }],
      }),
    );
    const text = Buffer.concat([json, Buffer.alloc(-json.length & 3, " ")]);
    const words = (...numbers: number[]) => Buffer.from(Uint32Array.from(numbers).buffer);
    const [magic, jsonType, binaryType] = [0x46546c67, 0x4e4f534a, 0x004e4942];
    return Buffer.concat([
      words(magic, 2, 28 + text.length + this.#size),
      words(text.length, jsonType),
      text,
      words(this.#size, binaryType),
      ...this.#chunks,
    ]);
  }
}
