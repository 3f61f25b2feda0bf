const pollMs = 2;
/** Of a lost context every fence has passed. */
export function fencePassed(gl: WebGL2RenderingContext, fence: WebGLSync | null): Promise<void> {
  return new Promise((resolve) => {
    const look = () => {
      if (fence === null || gl.isContextLost() || gl.clientWaitSync(fence, 0, 0) !== gl.TIMEOUT_EXPIRED) resolve();
      else setTimeout(look, pollMs);
    };
    setTimeout(look);
  });
}
