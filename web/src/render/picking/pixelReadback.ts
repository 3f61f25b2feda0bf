// Reads pixels of integers (four 32-bit words each) of the bound framebuffer's attachments: either
// blocking, or asynchronously through a pixel pack buffer and a fence.

import { fencePassed } from "../frames/gpuFence.ts";

const wordsPerPixel = 4;
const bytesPerPixel = 16;

/** Reads pixel (0, 0) of the first `attachments` attachments. Blocks until the GPU is done. */
export function readPixel(gl: WebGL2RenderingContext, attachments: number): Uint32Array {
  const words = new Uint32Array(attachments * wordsPerPixel);
  for (let n = 0; n < attachments; ++n) {
    gl.readBuffer(gl.COLOR_ATTACHMENT0 + n);
    gl.readPixels(0, 0, 1, 1, gl.RGBA_INTEGER, gl.UNSIGNED_INT, words, n * wordsPerPixel);
  }
  return words;
}

/**
 * Reads pixel (0, 0) of the first `attachments` attachments without blocking; all words are zero if the context is lost
 * meanwhile. The framebuffer may be reused when this returns.
 */
export function readPixelAsync(gl: WebGL2RenderingContext, attachments: number): Promise<Uint32Array> {
  return readBlocksAsync(
    gl,
    Array.from({ length: attachments }, (_, attachment) => ({ attachment, x: 0, y: 0, width: 1, height: 1 })),
  );
}

/** A block of pixels of one attachment. */
export interface PixelBlock {
  readonly attachment: number;
  readonly x: number;
  readonly y: number;
  readonly width: number;
  readonly height: number;
}

/**
 * Reads the pixels of several blocks without blocking, one block after the other, each row by row from the bottom. All
 * words are zero if the context is lost meanwhile.
 */
export function readBlocksAsync(gl: WebGL2RenderingContext, blocks: readonly PixelBlock[]): Promise<Uint32Array> {
  const buffer = gl.createBuffer();
  const pixelCount = blocks.reduce((sum, { width, height }) => sum + width * height, 0);
  gl.bindBuffer(gl.PIXEL_PACK_BUFFER, buffer);
  gl.bufferData(gl.PIXEL_PACK_BUFFER, pixelCount * bytesPerPixel, gl.STREAM_READ);
  let offset = 0;
  for (const { attachment, x, y, width, height } of blocks) {
    gl.readBuffer(gl.COLOR_ATTACHMENT0 + attachment);
    gl.readPixels(x, y, width, height, gl.RGBA_INTEGER, gl.UNSIGNED_INT, offset);
    offset += width * height * bytesPerPixel;
  }
  gl.bindBuffer(gl.PIXEL_PACK_BUFFER, null);
  const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
  gl.flush();

  const words = new Uint32Array(pixelCount * wordsPerPixel);
  return fencePassed(gl, fence).then(() => {
    gl.bindBuffer(gl.PIXEL_PACK_BUFFER, buffer);
    gl.getBufferSubData(gl.PIXEL_PACK_BUFFER, 0, words);
    gl.bindBuffer(gl.PIXEL_PACK_BUFFER, null);
    gl.deleteBuffer(buffer);
    gl.deleteSync(fence);
    return words;
  });
}
