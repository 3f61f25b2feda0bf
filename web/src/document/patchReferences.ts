// Reads the references of patches to the files of their indices and vertices. src/documents/patch_references.cpp does
// the same.

import type { ContainerImages } from "./containerImages.ts";
import type { Encoding, PatchDescription, Reference, Warning } from "./description.ts";
import type { SceneElement } from "./element.ts";
import { encodingFormats } from "./encodings.ts";
import type { nodeFields, Values } from "./nodes.ts";
import { UnreadableGeometry } from "./unreadableGeometry.ts";
import type { VertexRole } from "../stage/attributeRows.ts";
import { byVertexRole, vertexRoles } from "../stage/attributeRows.ts";

type PatchValues = Values<typeof nodeFields.GeometryPatch>;

/**
 * A URL with its fragment: `#N` for images (a texel's, or in compact a patch's index), `#O+S` or `#O` for typed arrays.
 * Throws UnreadableGeometry for another fragment.
 */
export function referenceOf(text: string, encoding: Encoding): Reference {
  const [url = "", fragment, ...others] = text.trim().split("#");
  if (url === "") throw new UnreadableGeometry("a reference has no url");
  if (others.length > 0) throw new UnreadableGeometry("a reference has two fragments");
  return encodingFormats[encoding].referenceOf(url, fragment);
}

/** The references of a patch: those of `images`, and of the patch's own fields for what is not in them. */
export function readPatchReferences(
  element: SceneElement,
  values: PatchValues,
  images: ContainerImages,
  encoding: Encoding,
  warnings: Warning[],
): Pick<PatchDescription, "index" | "coord" | "lowBytes" | "data" | "attributes" | VertexRole> {
  const format = encodingFormats[encoding];
  /** The URLs of each file that a field names: arrays have one file, images one for each byte of a number. */
  const filesOf = (urls: readonly string[]) =>
    format.storage === "bytePlanes" ? urls.map((url) => [url]) : urls.length > 0 ? [urls] : [];
  const read = (field: "coord" | VertexRole, limit: number): readonly Reference[] => {
    const files = images[field] ?? filesOf(values[field]);
    if (files.length > limit)
      warnings.push({ element, message: `only the first ${limit} of ${files.length} ${field} images are used` });
    return files.slice(0, limit).map((urls) => fileReference(element, urls, encoding, warnings));
  };
  const attributes = byVertexRole((role) => read(role, format.maxAttributeFileCount(role)));
  const [index = values.index] = images.index ?? [];
  return {
    index: index.length > 0 ? fileReference(element, index, encoding, warnings) : undefined,
    coord: read("coord", format.maxCoordFileCount),
    ...byVertexRole((role) => attributes[role][0]),
    lowBytes: Object.fromEntries(
      vertexRoles.flatMap((role) => (attributes[role].length > 1 ? [[role, attributes[role].slice(1)]] : [])),
    ),
    data: values.data === "" ? undefined : referenceOf(values.data, encoding),
    attributes: values.attrib.map((url) => referenceOf(url, encoding)),
  };
}

/** The reference to a file that has several URLs, at least one. The first says where in the file the data begins. */
function fileReference(
  element: SceneElement,
  urls: readonly string[],
  encoding: Encoding,
  warnings: Warning[],
): Reference {
  const [first = "", ...further] = urls;
  const reference = referenceOf(first, encoding);
  const others = further.map((url) => referenceOf(url, encoding));
  const locationOf = (reference: Reference) => JSON.stringify({ ...reference, url: "" });
  const alike = others.filter((other) => locationOf(other) === locationOf(reference));
  if (alike.length < others.length)
    warnings.push({
      element,
      message: "the URLs of a file have different fragments; only those like the first are used",
    });
  return alike.length > 0 ? { ...reference, furtherUrls: alike.map(({ url }) => url) } : reference;
}
