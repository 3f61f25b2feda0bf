/** An image of vertex data or of a texture: an ImageBitmap once it is decoded, a texture once it is on the GPU. */
export interface DecodedImage {
  readonly width: number;
  readonly height: number;
  /** Frees its memory. */
  close(): void;
}

/** An image of vertex data whose texels change. */
export interface WritableImage {
  readonly image: DecodedImage;
  /** Replaces all texels, four bytes each, before the next frame. */
  write(texels: Uint8Array<ArrayBuffer>): void;
}
