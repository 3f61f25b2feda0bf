// Which patches the vertex shader can draw from their images.

import type { DrawRange, StatedDrawRange } from "../stage/stage.ts";
import type { GeometryDescription, PatchDescription } from "./description.ts";

/**
 * Whether the vertex shader may draw a patch from its images; otherwise workers convert it to buffers, as they do where
 * joints or displacers move the vertices.
 */
export function isDrawnFromImages(
  { decode, ccw, deformation }: Pick<GeometryDescription, "decode" | "ccw" | "deformation">,
  { draws, lowBytes }: Pick<PatchDescription, "draws" | "lowBytes">,
): boolean {
  return (
    decode !== "cpu" &&
    ccw &&
    deformation === undefined &&
    Object.keys(lowBytes).length === 0 &&
    draws.every(hasShaderPrimitive)
  );
}

/** Whether the vertex shader draws this primitive. */
export function hasShaderPrimitive<Draw extends Pick<StatedDrawRange, "primitive">>(
  draw: Draw,
): draw is Draw & Pick<DrawRange, "primitive"> {
  return draw.primitive !== "lineLoop" && draw.primitive !== "triangleFan";
}
