// What a picture is drawn of and into before its bases are here, so that the GPU is
// ready for them.

import type { PatchBuffers } from "../decode/compact/patchBuffers.ts";

/** A triangle without an area, in the numbers that most bases have; others may find less made ready. */
export const standIn: PatchBuffers = {
  topology: "triangles", positionBits: 16, vertexCount: 1, index: new Uint16Array(3),
  coord: { array: new Uint16Array(4), components: 3, stride: 4, offset: 0 },
  normal: { array: new Int8Array(4), components: 3, stride: 4, offset: 0 },
  color: undefined, texCoord: undefined, others: [],
};

/** Draws into a pixel that nobody sees, of the kind that the context's own are: what is made ready depends on it. */
export function drawUnseen(gl: WebGL2RenderingContext, draw: () => void): void {
  const samples = gl.getParameter(gl.SAMPLES) as number;
  const framebuffer = gl.createFramebuffer();
  gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
  const buffers = ([[gl.COLOR_ATTACHMENT0, gl.RGBA8], [gl.DEPTH_STENCIL_ATTACHMENT, gl.DEPTH24_STENCIL8]] as const).map(([place, format]) => {
    const buffer = gl.createRenderbuffer();
    gl.bindRenderbuffer(gl.RENDERBUFFER, buffer);
    gl.renderbufferStorageMultisample(gl.RENDERBUFFER, samples, format, 1, 1);
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, place, gl.RENDERBUFFER, buffer);
    return buffer;
  });
  draw();
  gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  gl.deleteFramebuffer(framebuffer);
  for (const buffer of buffers) gl.deleteRenderbuffer(buffer);
  gl.flush(); // now, not when there is a frame
}
