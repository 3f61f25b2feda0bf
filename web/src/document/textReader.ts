// How the scene reader reads Text nodes: an interface, because measuring and drawing glyphs needs a browser.

import type { AppearanceDescription, GeometryDescription, Warning } from "./description.ts";
import type { Resolve, SceneElement } from "./element.ts";

export interface TextReader {
  /** The geometry of a <Text> element: a rectangle for each run of glyphs; undefined where there is nothing to draw. */
  readonly geometryOf: (text: SceneElement, resolve: Resolve, warnings: Warning[]) => GeometryDescription | undefined;
  /** The shape's appearance with its glyph atlas, a URL, as the color texture. */
  readonly appearanceOf: (
    appearance: AppearanceDescription,
    glyphAtlas: string,
    element: SceneElement,
    warnings: Warning[],
  ) => AppearanceDescription;
}
