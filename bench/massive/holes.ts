// Runs in a page before its scripts and looks at each frame for pixels of a magenta backdrop inside of the silhouette.

export interface HoleCount {
  frames: number;
  /** Sums over frames: pixels of the silhouette, and pixels inside of it that have a part of the backdrop's colour. */
  covered: number;
  holes: number;
}

/**
 * Self-contained: its text is sent to the browser. A pixel that a crack covers in part is tinted; those of the outline
 * are, too, but have a tinted neighbour, and so on up to the border of the picture.
 */
export function countHoles(): void {
  const count: HoleCount = { frames: 0, covered: 0, holes: 0 };
  (window as unknown as { holes: HoleCount }).holes = count;
  const minTint = 24;
  let isScheduled = false;

  const look = (gl: WebGL2RenderingContext): void => {
    const { drawingBufferWidth: width, drawingBufferHeight: height } = gl;
    const pixels = new Uint8Array(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    const tinted = new Uint8Array(width * height);
    for (let i = 0; i < tinted.length; ++i)
      tinted[i] = Math.min(pixels[4 * i]!, pixels[4 * i + 2]!) - pixels[4 * i + 1]! > minTint ? 1 : 0;
    const open: number[] = [];
    const visit = (x: number, y: number): void => {
      if (x < 0 || y < 0 || x >= width || y >= height || tinted[y * width + x] !== 1) return;
      tinted[y * width + x] = 2;
      open.push(y * width + x);
    };
    for (let x = 0; x < width; ++x) for (const y of [0, height - 1]) visit(x, y);
    for (let y = 0; y < height; ++y) for (const x of [0, width - 1]) visit(x, y);
    for (let pixel = open.pop(); pixel !== undefined; pixel = open.pop()) {
      const [x, y] = [pixel % width, Math.floor(pixel / width)];
      for (let dy = -1; dy <= 1; ++dy) for (let dx = -1; dx <= 1; ++dx) visit(x + dx, y + dy);
    }
    count.frames += 1;
    for (const state of tinted) {
      if (state === 0) count.covered += 1;
      if (state === 1) count.holes += 1;
    }
  };

  const prototype = WebGL2RenderingContext.prototype;
  const calls = prototype as unknown as Record<string, (this: WebGL2RenderingContext, ...args: unknown[]) => unknown>;
  for (const name of ["drawArrays", "drawElements", "drawElementsInstanced"]) {
    const draw = calls[name]!;
    calls[name] = function (...args) {
      if (!isScheduled && this.getParameter(this.FRAMEBUFFER_BINDING) === null) {
        isScheduled = true;
        queueMicrotask(() => {
          isScheduled = false;
          look(this);
        });
      }
      return draw.apply(this, args);
    };
  }
}
