// Buffers that frames of one epoch fill, for shaders that read vertices from buffers.

import type { FrameArrays, NormalSource } from "../../decode/frame/frameArrays.ts";
import { frameImageSizeOf } from "../../decode/frame/frameImages.ts";
import type { GpuVertices, WritableArray } from "../../stage/stage.ts";
import { elementTypeOf } from "../../stage/elementType.ts";
import type { VertexArray } from "../../stage/vertexArray.ts";
import type { LiveArrays } from "../content.ts";
import type { DecodedFrame, FrameTarget, TargetTools } from "./frameTarget.ts";

const attributes = ["coord", "normal", "color", "value"] as const;
type Attribute = (typeof attributes)[number];

interface StoredAttribute {
  readonly writable: WritableArray;
  readonly vertices: GpuVertices;
}

export class ArrayTarget implements FrameTarget {
  readonly #tools: TargetTools;
  readonly #stored: Partial<Record<Attribute, StoredAttribute>> = {};
  readonly #aborter = new AbortController();
  #normalSource: NormalSource | undefined;
  /** The displayed frame. */
  #displayed: { readonly number: number; readonly bytes: Uint8Array<ArrayBuffer> } | undefined;
  vertices: LiveArrays | undefined;

  readonly #decodeAgain: () => Promise<void>;

  /**
   * `normalSource`: of frames without normals. `decodeAgain` decodes and displays the displayed frame when this has
   * changed; undefined: its bytes suffice.
   */
  constructor(tools: TargetTools, normalSource: NormalSource | undefined, decodeAgain?: () => Promise<void>) {
    this.#tools = tools;
    this.#normalSource = normalSource;
    this.#decodeAgain = decodeAgain ?? (() => this.#decodeDisplayed());
  }

  get form(): { readonly kind: "arrays"; readonly normalSource: NormalSource | undefined } {
    return { kind: "arrays", normalSource: this.#normalSource };
  }

  async decode(bytes: Uint8Array<ArrayBuffer>, signal: AbortSignal): Promise<DecodedFrame> {
    for (;;) {
      const normalSource = this.#normalSource;
      const frame = await this.#tools.runJob("frameArrays", { bytes, normalSource }, signal);
      if (normalSource !== this.#normalSource) continue; // the index has arrived meanwhile
      const display = (): void => {
        this.write(frame);
        this.#displayed = { number: frame.header.number, bytes };
      };
      return { header: frame.header, display };
    }
  }

  close(): void {
    this.#aborter.abort();
    for (const attribute of attributes) this.#stored[attribute]?.writable.bytes.close();
  }

  async #decodeDisplayed(): Promise<void> {
    const displayed = this.#displayed;
    if (displayed === undefined) return;
    const frame = await this.decode(displayed.bytes, this.#aborter.signal);
    // Frames that have been decoded since have normals already.
    if (this.#displayed?.number === displayed.number) frame.display();
  }

  /** Replaces all vertices. */
  write(frame: FrameArrays): void {
    for (const attribute of attributes) {
      const vertices = frame[attribute];
      if (vertices === undefined) continue;
      const stored = this.#stored[attribute];
      if (stored) stored.writable.write(vertices.array);
      else this.#stored[attribute] = this.#store(vertices);
    }
    this.vertices ??= this.#verticesOf(frame);
  }

  #store({ array, components, stride, offset }: VertexArray): StoredAttribute {
    const writable = this.#tools.makeWritableArray(array);
    return { writable, vertices: { bytes: writable.bytes, type: elementTypeOf(array), components, stride, offset } };
  }

  #verticesOf({ header, value }: FrameArrays): LiveArrays | undefined {
    const stored = this.#stored;
    const { coord } = stored;
    if (coord === undefined) return undefined;
    const maxStoredValue = 256 ** Math.ceil(header.valueBits / 8) - 1;
    return {
      kind: "arrays",
      ...frameImageSizeOf(header),
      vertexCount: header.vertices,
      coord: coord.vertices,
      /** Normals that follow from triangles come later. */
      get normal() {
        return stored.normal?.vertices;
      },
      normalFormat: header.normalBits > 0 ? { kind: "octahedral", bits: 16 } : { kind: "vector" },
      color: stored.color?.vertices,
      value: value && stored.value && { ...stored.value.vertices, maxStored: maxStoredValue },
      get byteLength() {
        return attributes.reduce((sum, attribute) => sum + (stored[attribute]?.vertices.bytes.byteLength ?? 0), 0);
      },
      deriveNormals: async (index) => {
        this.#normalSource = { kind: "triangles", index };
        await this.#decodeAgain();
      },
    };
  }
}
