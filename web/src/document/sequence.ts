// Sequences: a CoordinateInterpolator with a url, in the coord field of an ImageGeometry, has the frames of its
// vertices (docs/formats/sequence.md).

import type { Resolve, SceneElement } from "./element.ts";
import { childrenOf, lowerNameOf, substitutedFor } from "./element.ts";
import { MFString } from "./fieldTypes.ts";
import type { SequenceDescription } from "./geometryDescription.ts";
import type { Warning } from "./nodes.ts";
import { readFields } from "./nodes.ts";

const ids = new WeakMap<SceneElement, number>();
let lastId = 0;

/** A number for the element of an interpolator, the same as long as the page has it. */
export function interpolatorIdOf(element: SceneElement): number {
  const known = ids.get(element);
  if (known !== undefined) return known;
  lastId += 1;
  ids.set(element, lastId);
  return lastId;
}

/** The sequence of a geometry, if any. */
export function readSequence(
  geometry: SceneElement,
  resolve: Resolve,
  warnings: Warning[],
): SequenceDescription | undefined {
  for (const child of childrenOf(geometry)) {
    if (lowerNameOf(child) !== "coordinateinterpolator") continue;
    const used = resolve(child);
    if (used === undefined) continue;
    const [url] = readFields(substitutedFor(child, used), { url: MFString([]) }, warnings).url;
    if (url !== undefined) return { url, interpolator: interpolatorIdOf(used) };
    warnings.push({ element: child, message: "an interpolator without url has no part in an ImageGeometry" });
  }
  return undefined;
}
