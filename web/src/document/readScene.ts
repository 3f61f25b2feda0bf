import type { SceneDescription } from "./description.ts";
import type { SceneElement } from "./element.ts";
import { deformationReader } from "./deformationReader.ts";
import { operatorReader } from "./operatorReader.ts";
import { inlineGeometryReader } from "./inlineGeometry.ts";
import { refusals } from "./refused.ts";
import type { SceneReaderOptions } from "./sceneReader.ts";
import { SceneReader } from "./sceneReader.ts";

export type { InlinedDocument } from "./readNode.ts";
export type { SceneReaderOptions } from "./sceneReader.ts";

/** Reads an <X3D> element once, its inline geometry included. For a document that changes, keep a SceneReader. */
export function readScene(x3d: SceneElement, options: SceneReaderOptions = {}): SceneDescription {
  return new SceneReader(x3d, {
    inlineGeometry: inlineGeometryReader,
    operators: operatorReader,
    deformation: deformationReader,
    refusals,
    ...options,
  }).read();
}
