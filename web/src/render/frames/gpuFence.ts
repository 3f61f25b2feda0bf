// Waiting for a WebGL fence without blocking the main thread.

const pollMs = 2;

/** Resolves when the GPU has executed all commands before the fence, or when the context is lost. */
export function fencePassed(gl: WebGL2RenderingContext, fence: WebGLSync | null): Promise<void> {
  return new Promise((resolve) => {
    const poll = () => {
      if (fence === null || gl.isContextLost() || gl.clientWaitSync(fence, 0, 0) !== gl.TIMEOUT_EXPIRED) resolve();
      else setTimeout(poll, pollMs);
    };
    setTimeout(poll);
  });
}
