import { parseDocument } from "../policy/trustedTypes.ts";

/** Parses X3D in XML or in a page, and returns its <X3D> element. Throws an Error that names `url` if there is none. */
export function readDocument(text: string, url: string): Element {
  const isXml = /^\s*(<\?xml|<!DOCTYPE X3D|<X3D)/.test(text);
  const parsed = parseDocument(text, isXml ? "text/xml" : "text/html");
  const parserError = isXml ? parsed.querySelector("parsererror") : null;
  if (parserError !== null)
    throw new Error(`${url} is not well-formed: ${parserError.textContent.trim().split("\n")[0] ?? ""}`);
  // XML keeps the case of names, HTML does not.
  const x3d = parsed.querySelector("X3D, x3d");
  if (x3d === null) throw new Error(`${url} has no X3D element`);
  return x3d;
}
