// Relative urls of a document that will be read as part of another: made absolute
// where they stand.

import type { SceneElement } from "./element.ts";
import { childrenOf, lowerNameOf } from "./element.ts";

export interface WritableElement extends SceneElement {
  setAttribute(name: string, value: string): void;
}

/** Fields that are urls, by element; of geometry nodes every reference. */
const references = ["index", "coord", "normal", "texcoord", "color", "data", "base", "attrib"];
const urlFields: Readonly<Record<string, readonly string[]>> = {
  imagegeometry: references,
  binarygeometry: references,
  geometrypatch: references,
  imagetexture: ["url", "preview"],
  inline: ["url"],
  anchor: ["url"],
  movietexture: ["url"],
  audioclip: ["url"],
};

export function absoluteUrls(element: WritableElement, base: string): void {
  const fields = urlFields[lowerNameOf(element)] ?? [];
  for (const name of element.getAttributeNames()) {
    if (!fields.includes(name.toLowerCase())) continue;
    element.setAttribute(name, withAbsoluteUrls(element.getAttribute(name) ?? "", base));
  }
  for (const child of childrenOf(element)) absoluteUrls(child as WritableElement, base);
}

/** Of one bare url, or of strings in quotes. What is no url stays as it is. */
export function withAbsoluteUrls(text: string, base: string): string {
  if (!text.includes('"')) return text.trim() === "" ? text : absolute(text.trim(), base);
  return text.replace(/"((?:[^"\\]|\\.)*)"/g, (_, quoted: string) => `"${absolute(quoted, base)}"`);
}

function absolute(url: string, base: string): string {
  return url !== "" && URL.canParse(url, base) ? new URL(url, base).href : url;
}
