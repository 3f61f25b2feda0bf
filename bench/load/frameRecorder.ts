// Runs in a page before its scripts and records what the screen shows after each frame. It works for every page
// because it intercepts WebGL calls. It takes times when the GPU has finished (the picture is read back), so that
// software renderers count equally for all pages.

export interface Recording {
  /** Milliseconds from navigation until all of the model had been drawn; 0 until then. */
  complete: number;
  /**
   * For each drawn frame: the time at which the GPU had finished it, and every second pixel of every second row, RGBA.
   */
  frames: { at: number; pixels: Uint8Array }[];
  /** Width of the recorded pictures in pixels. */
  columns: number;
}

export interface RecordOptions {
  /**
   * The page sends an event when all of the model has been drawn: `load` of <x3d>, or
   * `model-complete` of the document. Other pages are complete with their first draw of
   * at least minModelVertices vertices.
   */
  announcesCompletion: boolean;
  minModelVertices: number;
  /** If false, no pictures are taken, and times are those at which commands have been sent to the GPU. */
  takesPictures: boolean;
  completeMessage: string;
}

declare global {
  interface Window {
    recording: Recording;
  }
}

/** Console message of a page whose model is complete. Polling the page would take its processor time. */
export const completeMessage = "bench: complete";

type Context = WebGLRenderingContext | WebGL2RenderingContext;

/** Self-contained: its text is sent to the browser. */
export function recordFrames(options: RecordOptions): void {
  const recording: Recording = { complete: 0, frames: [], columns: 0 };
  window.recording = recording;
  const pixelStep = 2;
  const scheduled = new Set<Context>();
  let hasModel = false;

  const complete = (): void => {
    recording.complete = performance.now();
    console.debug(options.completeMessage);
  };
  const takePicture = (gl: Context): void => {
    const { drawingBufferWidth: width, drawingBufferHeight: height } = gl;
    const bound = gl.getParameter(gl.FRAMEBUFFER_BINDING) as WebGLFramebuffer | null;
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    const all = new Uint32Array(width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(all.buffer));
    gl.bindFramebuffer(gl.FRAMEBUFFER, bound);
    const at = performance.now();
    const [columns, rows] = [Math.floor(width / pixelStep), Math.floor(height / pixelStep)];
    const pixels = new Uint32Array(columns * rows);
    for (let i = 0; i < pixels.length; ++i)
      pixels[i] = all[Math.floor(i / columns) * pixelStep * width + (i % columns) * pixelStep]!;
    recording.columns = columns;
    recording.frames.push({ at, pixels: new Uint8Array(pixels.buffer) });
  };
  /** False for a canvas that the page draws into but displays later. */
  const isVisible = ({ canvas }: Context): boolean =>
    canvas instanceof HTMLCanvasElement && canvas.checkVisibility({ opacityProperty: true, visibilityProperty: true });
  const onDraw = (gl: Context, count: number): void => {
    if (gl.getParameter(gl.FRAMEBUFFER_BINDING) !== null) return; // offscreen
    hasModel ||= count >= options.minModelVertices;
    if (scheduled.has(gl)) return;
    scheduled.add(gl);
    // After all draws of the frame have been issued, and before the browser presents it.
    queueMicrotask(() => {
      scheduled.delete(gl);
      if (options.takesPictures && isVisible(gl)) takePicture(gl);
      if (hasModel && !options.announcesCompletion && recording.complete === 0) complete();
    });
  };

  for (const prototype of [WebGLRenderingContext.prototype, WebGL2RenderingContext.prototype]) {
    const calls = prototype as unknown as Record<string, (this: Context, ...args: unknown[]) => unknown>;
    for (const [name, countArgument] of [
      ["drawArrays", 2],
      ["drawElements", 1],
      ["drawArraysInstanced", 2],
      ["drawElementsInstanced", 1],
    ] as const) {
      const draw = calls[name];
      if (draw)
        calls[name] = function (...args) {
          onDraw(this, Number(args[countArgument]));
          return draw.apply(this, args);
        };
    }
  }
  document.addEventListener("model-complete", complete);
  document.addEventListener(
    "load",
    ({ target }) => {
      if (options.announcesCompletion && target instanceof Element && target.localName.toLowerCase() === "x3d")
        complete();
    },
    true,
  );
}

/** Times at which a page's picture had reached certain states, in milliseconds from navigation. */
export interface Times {
  /** 95 % of the pixels of the model's silhouette are covered, or a neighbouring pixel is. */
  first: number;
  /** Nine tenths of the way from nothing to the final picture, in the sum of all channels' differences. */
  nearlyFinal: number;
  /** The final picture, except for invisible differences. */
  final: number;
}

/**
 * Runs in the page after it is complete. `backgroundColor`: three bytes; without it, the colour of the last picture's
 * first pixel.
 */
export function timesOf(backgroundColor?: readonly number[]): Times {
  const { frames, columns } = window.recording;
  const last = frames.at(-1);
  if (last === undefined) throw new Error("nothing was drawn");
  const final = last.pixels;
  const background = backgroundColor ?? final.slice(0, 3); // the models do not reach the corner
  const differenceToBackground = (pixels: Uint8Array, i: number, channel: number): number =>
    Math.abs(pixels[i + channel]! - background[channel]!);
  const isForeground = (pixels: Uint8Array, i: number): boolean =>
    Math.max(
      differenceToBackground(pixels, i, 0),
      differenceToBackground(pixels, i, 1),
      differenceToBackground(pixels, i, 2),
    ) > 8;
  // One pixel of tolerance: simplification moves the outline slightly, which would miss much of a thin leg.
  const isCovered = (pixels: Uint8Array, i: number): boolean =>
    [0, -4, 4, -4 * columns, 4 * columns].some(
      (away) => i + away >= 0 && i + away < pixels.length && isForeground(pixels, i + away),
    );
  let [foregroundCount, whole] = [0, 0];
  for (let i = 0; i < final.length; i += 4) {
    if (isForeground(final, i)) foregroundCount += 1;
    for (let channel = 0; channel < 3; ++channel) whole += differenceToBackground(final, i, channel);
  }
  const measured = frames.map(({ at, pixels }) => {
    let [coveredCount, missing] = [0, 0];
    for (let i = 0; i < final.length; i += 4) {
      if (isForeground(final, i) && isCovered(pixels, i)) coveredCount += 1;
      for (let channel = 0; channel < 3; ++channel) missing += Math.abs(pixels[i + channel]! - final[i + channel]!);
    }
    return { at, coverage: coveredCount / foregroundCount, similarity: 1 - missing / whole };
  });
  // The time from which the condition holds for all further frames.
  const since = (holds: (frame: (typeof measured)[number]) => boolean): number =>
    measured[measured.findLastIndex((frame) => !holds(frame)) + 1]!.at;
  return {
    first: since(({ coverage }) => coverage >= 0.95),
    nearlyFinal: since(({ similarity }) => similarity >= 0.9),
    final: since(({ similarity }) => similarity >= 0.998),
  };
}
