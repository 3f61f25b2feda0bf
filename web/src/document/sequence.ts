// Sequences: a CoordinateInterpolator with a url, or a MovieTexture with a video and an index, in the coord field of an
// ImageGeometry, has the frames of its vertices (docs/formats/sequence.md).

import type { Resolve, SceneElement } from "./element.ts";
import { attributeOf, childrenOf, lowerNameOf, substitutedFor } from "./element.ts";
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
    const name = lowerNameOf(child);
    if (name !== "coordinateinterpolator" && name !== "movietexture") continue;
    const used = resolve(child);
    if (used === undefined) continue;
    const element = substitutedFor(child, used);
    if (name === "movietexture") {
      const movie = movieOf(element);
      if (movie !== undefined) return { ...movie, interpolator: interpolatorIdOf(used) };
      continue; // an image of the geometry, or none
    }
    const [url] = readFields(element, { url: MFString([]) }, warnings).url;
    if (url !== undefined) return { url, interpolator: interpolatorIdOf(used) };
    warnings.push({ element: child, message: "an interpolator without url has no part in an ImageGeometry" });
  }
  return undefined;
}

/**
 * The addresses in a MovieTexture with the coordinates of an ImageGeometry: a lossless video, and the index of the same
 * frames as a sequence. Undefined where it lacks one of them. src/documents/animation_element.h does the same.
 */
export function movieOf(element: SceneElement): Pick<SequenceDescription, "url" | "video"> | undefined {
  if (attributeOf(element, "containerField")?.toLowerCase() !== "coord") return undefined;
  const urls = readFields(element, { url: MFString([]) }, []).url;
  const isIndex = (url: string) => /^[^?]*\.json(\?|$)/.test(url);
  const [url, video] = [urls.find(isIndex), urls.find((each) => !isIndex(each))];
  return url === undefined || video === undefined ? undefined : { url, video };
}
