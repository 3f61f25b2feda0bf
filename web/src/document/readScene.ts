import type { SceneDescription } from "./description.ts";
import type { SceneElement } from "./element.ts";
import { readInlineGeometry } from "./inlineGeometry.ts";
import type { Supplements } from "./sceneReader.ts";
import { SceneReader } from "./sceneReader.ts";

export type { InlinedDocument } from "./readNode.ts";
export type { Supplements } from "./sceneReader.ts";

/** An <X3D> element -> SceneDescription, once, with what stands in it. Who follows a document that changes keeps a SceneReader. */
export function readScene(x3d: SceneElement, supplements: Supplements = {}): SceneDescription {
  return new SceneReader(x3d, { inlineGeometry: readInlineGeometry, ...supplements }).read();
}
