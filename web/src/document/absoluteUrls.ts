// Makes the relative URLs of a document absolute before the document is inlined into another one.

import { vertexRoles } from "../stage/attributeRows.ts";
import type { SceneElement } from "./element.ts";
import { childrenOf, lowerNameOf } from "./element.ts";
import { entryOf } from "./tables.ts";

export interface WritableElement extends SceneElement {
  setAttribute(name: string, value: string): void;
}

/** Our fields that hold URLs, by element. X3D's own end in "url": url, frontUrl, backUrl … */
const referenceFields = [
  "index",
  "coord",
  ...vertexRoles.map((role) => role.toLowerCase()),
  "data",
  "base",
  "levels",
  "attrib",
];
const ownUrlFields: Readonly<Record<string, readonly string[]>> = {
  imagegeometry: referenceFields,
  binarygeometry: referenceFields,
  geometrypatch: referenceFields,
  imagetexture: ["preview"],
  img: ["src"],
  imagecubemaptexture: ["preview"],
};

export function absoluteUrls(element: WritableElement, base: string): void {
  const ownFields = entryOf(ownUrlFields, lowerNameOf(element)) ?? [];
  for (const name of element.getAttributeNames()) {
    const field = name.toLowerCase();
    if (!field.endsWith("url") && !ownFields.includes(field)) continue;
    element.setAttribute(name, withAbsoluteUrls(element.getAttribute(name) ?? "", base));
  }
  for (const child of childrenOf(element)) absoluteUrls(child as WritableElement, base);
}

/**
 * Resolves one bare URL, or each of several quoted ones. Text that is no URL stays unchanged, and so does a fragment,
 * with which an Anchor names a viewpoint of its own document.
 */
export function withAbsoluteUrls(text: string, base: string): string {
  if (!text.includes('"')) return text.trim() === "" ? text : absolute(text.trim(), base);
  return text.replace(/"((?:[^"\\]|\\.)*)"/g, (_, quoted: string) => `"${absolute(quoted, base)}"`);
}

function absolute(url: string, base: string): string {
  return url !== "" && !url.startsWith("#") && URL.canParse(url, base) ? new URL(url, base).href : url;
}
