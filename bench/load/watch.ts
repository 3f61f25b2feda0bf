// Runs in a page before its scripts and notes when the model is on the screen.
// The same for every page: calls to WebGL are what they have in common. A time
// is taken when the GPU has done its work (a pixel is read back), so that a
// renderer in software counts for everybody alike.

export interface Watched {
  /** Milliseconds from navigation to the first frame with all of the model, in whatever precision; 0 until then. */
  firstImage: number;
  /** The page says that everything is there. */
  complete: number;
}

/** What makes a draw a part of the model, and how many of them make all of it. */
export interface Wanted {
  vertices: number;
  draws: number;
  /** Otherwise times are those at which the GPU has been told. */
  waitForGpu: boolean;
}

declare global {
  interface Window {
    watched: Watched;
  }
}

type Context = WebGLRenderingContext | WebGL2RenderingContext;

/** Self-contained: its text is sent to the browser. */
export function watch(wanted: Wanted): void {
  const watched: Watched = { firstImage: 0, complete: 0 };
  window.watched = watched;
  let drawsOfFrame = 0;
  let latest: Context | undefined;

  const timeWhenDrawn = (gl: Context): number => {
    if (!wanted.waitForGpu) return performance.now();
    const bound = gl.getParameter(gl.FRAMEBUFFER_BINDING) as WebGLFramebuffer | null;
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    gl.bindFramebuffer(gl.FRAMEBUFFER, bound);
    return performance.now();
  };
  const note = (gl: Context, count: unknown): void => {
    if (watched.firstImage > 0 || Number(count) < wanted.vertices) return;
    drawsOfFrame += 1;
    latest = gl;
    // When the frame's draws have all been given, and before the browser takes them.
    if (drawsOfFrame === 1) {
      queueMicrotask(() => {
        if (drawsOfFrame >= wanted.draws) watched.firstImage = timeWhenDrawn(gl);
        drawsOfFrame = 0;
      });
    }
  };

  for (const prototype of [WebGLRenderingContext.prototype, WebGL2RenderingContext.prototype]) {
    const calls = prototype as unknown as Record<string, (this: Context, ...args: unknown[]) => unknown>;
    for (const [name, place] of [["drawArrays", 2], ["drawElements", 1], ["drawArraysInstanced", 2], ["drawElementsInstanced", 1]] as const) {
      const draw = calls[name];
      if (draw) calls[name] = function (...args) {
        note(this, args[place]);
        return draw.apply(this, args);
      };
    }
  }
  document.addEventListener("load", ({ target }) => {
    const isScene = target instanceof Element && target.localName.toLowerCase() === "x3d";
    if (isScene && latest !== undefined) watched.complete = timeWhenDrawn(latest);
  }, true);
}
