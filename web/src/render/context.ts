/** The canvas' WebGL2 context; null where the browser has none to give. */
export function contextOf(canvas: HTMLCanvasElement): WebGL2RenderingContext | null {
  return canvas.getContext("webgl2", { alpha: true, antialias: true, powerPreference: "high-performance" });
}
