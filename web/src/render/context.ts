/** The WebGL2 context of a canvas; null if the browser has none. */
export function contextOf(canvas: HTMLCanvasElement): WebGL2RenderingContext | null {
  return canvas.getContext("webgl2", { alpha: true, antialias: true, powerPreference: "high-performance" });
}
