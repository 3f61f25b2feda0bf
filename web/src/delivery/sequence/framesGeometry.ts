// How the frames of a sequence replace the files of the document's geometry.

import type { FrameDescription } from "../../decode/frame/frameDescription.ts";
import type { SequenceIndex } from "../../decode/sequence/sequenceIndex.ts";
import type { GeometryDescription } from "../../document/description.ts";

/** The document's geometry with frames as its coordinates. `url`: of the sequence's index. */
export function framesGeometryOf(geometry: GeometryDescription, url: string): GeometryDescription {
  const patches = geometry.patches.map((patch) => ({ ...patch, coord: [{ url, firstTexel: 0 }], normal: undefined }));
  return { ...geometry, encoding: "live", patches };
}

/**
 * What the frames have in common. Without values where the shape is coloured by another attribute, which does not
 * change.
 */
export function frameDescriptionOf({ value }: GeometryDescription, index: SequenceIndex): FrameDescription {
  return value === undefined || value.name === index.valueName ? index : { ...index, valueComponents: 0 };
}
