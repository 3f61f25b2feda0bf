// Parses the bytes of an X3D document to its elements. A document that DOMParser makes has no window, so that nothing
// in it runs or loads.

import { DecodeError } from "../decode/decodeError.ts";
import { absoluteUrls } from "../document/absoluteUrls.ts";
import { parseDocument } from "../policy/trustedTypes.ts";

/** Throws DecodeError for a URL of another scheme than http and https. */
export function requireHttp(url: string): void {
  if (!/^https?:/i.test(url)) throw new DecodeError("unsupported", "an Inline is read over http alone");
}

/**
 * Parses a document to its X3D element; relative URLs become absolute. Throws DecodeError for anything but X3D in XML,
 * and for document types that define entities.
 */
export function parseInlined(bytes: Uint8Array, url: string): Element {
  const text = new TextDecoder().decode(bytes);
  if (/^#(VRML|X3D) V/.test(text))
    throw new DecodeError("unsupported", "is in VRML encoding; pages read X3D in XML, which imgeo convert makes of it");
  // XML bombs consist of entities.
  if (/<!DOCTYPE[^>[]*\[/.test(text)) throw new DecodeError("unsupported", "its document type defines entities");
  const parsed = parseDocument(text, "application/xml");
  const problem = parsed.querySelector("parsererror")?.textContent.trim().split("\n")[0];
  if (problem !== undefined) throw new DecodeError("malformed", `not well-formed: ${problem}`);
  const x3d = parsed.documentElement;
  if (x3d.localName.toLowerCase() !== "x3d")
    throw new DecodeError("malformed", `is XML, but its element is ${x3d.localName} and no X3D`);
  absoluteUrls(x3d, url);
  return x3d;
}
