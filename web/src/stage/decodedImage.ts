/** An image of vertex data or of a texture: an ImageBitmap once it is decoded, a texture once it is on the GPU. */
export interface DecodedImage {
  readonly width: number;
  readonly height: number;
  /** Frees its memory. */
  close(): void;
}
