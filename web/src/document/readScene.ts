import type { SceneDescription } from "./description.ts";
import type { SceneElement } from "./element.ts";
import { readInlineGeometry } from "./inlineGeometry.ts";
import type { SceneReaderOptions } from "./sceneReader.ts";
import { SceneReader } from "./sceneReader.ts";

export type { InlinedDocument } from "./readNode.ts";
export type { SceneReaderOptions } from "./sceneReader.ts";

/** An <X3D> element -> SceneDescription, once, with what stands in it. Who follows a document that changes keeps a SceneReader. */
export function readScene(x3d: SceneElement, supplements: SceneReaderOptions = {}): SceneDescription {
  return new SceneReader(x3d, { inlineGeometry: readInlineGeometry, ...supplements }).read();
}
