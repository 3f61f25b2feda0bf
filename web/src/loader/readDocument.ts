/** The <X3D> element of a `scene.x3d` or of a page. Throws an Error that names `url` where there is none. */
export function readDocument(text: string, url: string): Element {
  const isXml = /^\s*(<\?xml|<!DOCTYPE X3D|<X3D)/.test(text);
  const parsed = new DOMParser().parseFromString(text, isXml ? "text/xml" : "text/html");
  const mistake = isXml ? parsed.querySelector("parsererror") : null;
  if (mistake !== null)
    throw new Error(`${url} is not well-formed: ${mistake.textContent.trim().split("\n")[0] ?? ""}`);
  // In XML names keep their case, in HTML they have lost it.
  const x3d = parsed.querySelector("X3D, x3d");
  if (x3d === null) throw new Error(`${url} has no X3D element`);
  return x3d;
}
