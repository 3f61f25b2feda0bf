// Reads the pixels of a decoded image exactly. A 2D canvas would multiply them by alpha, so that they go through a
// texture of WebGL.

import { DecodeError } from "./decodeError.ts";

/** Made at the first call. */
let context: WebGL2RenderingContext | undefined;

/** What the browser does with an element's image; an ImageBitmap stays as it is. */
export interface ReadOptions {
  readonly isBottomUp: boolean;
  readonly convertsColors: boolean;
}

/**
 * The pixels of an image without premultiplication by alpha, four bytes each: row by row from the top, unless `options`
 * say otherwise. For the page's thread. Throws DecodeError where the browser has no WebGL, or no texture of this size.
 */
export function readBitmap(bitmap: ImageBitmap | HTMLImageElement, options?: ReadOptions): Uint8Array<ArrayBuffer> {
  const gl = glContext();
  const { width, height } = bitmap;
  const maxEdge = gl.getParameter(gl.MAX_TEXTURE_SIZE) as number;
  if (Math.max(width, height) > maxEdge)
    throw new DecodeError("unsupported", `is ${width} x ${height} texels large, textures up to ${maxEdge}`);
  const texture = gl.createTexture();
  const framebuffer = gl.createFramebuffer();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.pixelStorei(gl.UNPACK_PREMULTIPLY_ALPHA_WEBGL, false);
  gl.pixelStorei(gl.UNPACK_FLIP_Y_WEBGL, options?.isBottomUp === true);
  gl.pixelStorei(
    gl.UNPACK_COLORSPACE_CONVERSION_WEBGL,
    options?.convertsColors === true ? gl.BROWSER_DEFAULT_WEBGL : gl.NONE,
  );
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE, bitmap);
  gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
  const data = new Uint8Array(width * height * 4);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, data);
  const isRead = gl.getError() === gl.NO_ERROR;
  gl.deleteFramebuffer(framebuffer);
  gl.deleteTexture(texture);
  if (!isRead) throw new DecodeError("unsupported", "cannot be read back from the GPU");
  return data;
}

function glContext(): WebGL2RenderingContext {
  if (context?.isContextLost() === true) context = undefined;
  context ??= document.createElement("canvas").getContext("webgl2") ?? undefined;
  if (context === undefined) throw new DecodeError("unsupported", "cannot be read without WebGL 2");
  return context;
}
