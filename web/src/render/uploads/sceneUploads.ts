// The images and vertex arrays of a scene on the GPU.

import type { WebGLRenderer } from "three";
import type { TexelArray } from "../../decode/textureImage.ts";
import type { SamplingDescription } from "../../document/description.ts";
import type { WritableImage } from "../../stage/decodedImage.ts";
import type { ArrayUse, WritableArray } from "../../stage/stage.ts";
import type { ElementArray } from "../../stage/vertexArray.ts";
import { lateImageVertices } from "../shaders/lateImageVertices.ts";
import { minVertexTextureUnits } from "../shaders/vertexFormat.ts";
import type { BufferUpload } from "./bufferProvider.ts";
import { BufferStore } from "./bufferStore.ts";
import type { TextureUpload } from "./textureStore.ts";
import { TextureStore } from "./textureStore.ts";

export class SceneUploads {
  readonly textures = new TextureStore();
  readonly buffers: BufferStore;
  readonly #renderer: WebGLRenderer;
  readonly #requestFrame: () => void;
  #readsTextures: Promise<boolean> | undefined;

  constructor(renderer: WebGLRenderer, context: WebGL2RenderingContext, requestFrame: () => void) {
    this.#renderer = renderer;
    this.#requestFrame = requestFrame;
    this.buffers = new BufferStore(context);
  }

  /** Maximum width and height of textures, in texels. */
  get maxTextureSize(): number {
    return this.#renderer.capabilities.maxTextureSize;
  }

  /** Whether vertex shaders have enough texture units. */
  get hasVertexTextureUnits(): boolean {
    return this.#renderer.capabilities.maxVertexTextures >= minVertexTextureUnits;
  }

  /** Whether vertices can be read from textures; tested once, when a scene has such vertices. */
  readsTextures(): Promise<boolean> {
    this.#readsTextures ??= lateImageVertices.required.testTextures(this.#renderer, this.textures);
    return this.#readsTextures;
  }

  /** Begins the upload of an image; stages may use it after the last step. */
  beginTexture(bitmap: ImageBitmap | TexelArray, sampling?: SamplingDescription): TextureUpload {
    return this.textures.begin(bitmap, this.#renderer, sampling);
  }

  /** Begins the upload of a vertex array. */
  beginBuffer(array: ElementArray, use: ArrayUse): BufferUpload {
    return this.buffers.begin(array, use);
  }

  /** An image of vertex data; writing its texels draws a frame. */
  makeWritableImage(width: number, height: number): WritableImage {
    const writable = this.textures.makeWritable(width, height);
    return {
      image: writable.image,
      write: (texels) => {
        writable.write(texels);
        this.#requestFrame();
      },
    };
  }

  /** Vertices that change; writing them draws a frame. */
  makeWritableArray(array: ElementArray): WritableArray {
    const writable = this.buffers.makeWritable(array);
    return {
      bytes: writable.bytes,
      write: (elements) => {
        writable.write(elements);
        this.#requestFrame();
      },
    };
  }

  /** Geometries are being replaced: the GPU memory of those before is kept for a while for others of the same size. */
  expectReplacements(): void {
    this.textures.expectReplacements();
    this.buffers.expectReplacements();
  }

  /** While true, vertices that are uploaded wait for the GPU memory of those that they replace. */
  set isReplacing(isReplacing: boolean) {
    this.textures.isReplacing = isReplacing;
    this.buffers.isReplacing = isReplacing;
  }

  /** Frees GPU memory that is kept for others. */
  freeSpares(): void {
    this.textures.freeSpares();
    this.buffers.freeSpares();
  }
}
