// The warm-up of a preview: draws a mesh without area while the bases are being
// downloaded, so that programs and canvas memory are ready for them.

import type { PatchBuffers } from "../decode/compact/patchBuffers.ts";

/**
 * A triangle without area, in the element types that most bases have. For bases with other types, the warm-up may be
 * incomplete.
 */
export const warmUpBuffers: PatchBuffers = {
  topology: "triangles",
  positionBits: 16,
  vertexCount: 1,
  index: new Uint16Array(3),
  coord: { array: new Uint16Array(4), components: 3, stride: 4, offset: 0 },
  attributes: { normal: { array: new Int8Array(4), components: 3, stride: 4, offset: 0 } },
  others: [],
};

/**
 * Has the GPU resolve the canvas' samples to pixels, without waiting for it. The driver
 * allocates the memory of the samples and prepares the resolve at the first use.
 */
export function resolveOffScreen(gl: WebGL2RenderingContext): void {
  const buffer = gl.createBuffer();
  gl.bindBuffer(gl.PIXEL_PACK_BUFFER, buffer);
  gl.bufferData(gl.PIXEL_PACK_BUFFER, 4, gl.STREAM_READ);
  gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, 0);
  gl.bindBuffer(gl.PIXEL_PACK_BUFFER, null);
  gl.deleteBuffer(buffer);
  gl.flush(); // begin now, not with the next frame
}
