// What a picture is drawn of and into before its bases are here, so that the GPU is
// ready for them.

import type { PatchBuffers } from "../decode/compact/patchBuffers.ts";

/** A triangle without an area, in the numbers that most bases have; others may find less made ready. */
export const warmUpBuffers: PatchBuffers = {
  topology: "triangles",
  positionBits: 16,
  vertexCount: 1,
  index: new Uint16Array(3),
  coord: { array: new Uint16Array(4), components: 3, stride: 4, offset: 0 },
  normal: { array: new Int8Array(4), components: 3, stride: 4, offset: 0 },
  color: undefined,
  texCoord: undefined,
  others: [],
};

/**
 * Has the GPU do what a screen would need of the picture, and waits for nothing: memory for
 * its samples is there when it has been written, and what makes pixels of samples is ready.
 */
export function resolveOffScreen(gl: WebGL2RenderingContext): void {
  const buffer = gl.createBuffer();
  gl.bindBuffer(gl.PIXEL_PACK_BUFFER, buffer);
  gl.bufferData(gl.PIXEL_PACK_BUFFER, 4, gl.STREAM_READ);
  gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, 0);
  gl.bindBuffer(gl.PIXEL_PACK_BUFFER, null);
  gl.deleteBuffer(buffer);
  gl.flush(); // now, not when there is a frame
}
