// The label of a scene, for screen readers and pictures that are saved.

/** `alt`: the attribute of that name. `inlinedTitle`: the title of a document that the scene inlines. */
export function sceneLabelOf(
  x3d: Pick<Element, "getAttribute" | "querySelector">,
  alt: string,
  inlinedTitle: string | undefined,
): string {
  const labels = [
    alt,
    ...["aria-label", "title"].map((name) => x3d.getAttribute(name)),
    x3d.querySelector("worldinfo")?.getAttribute("title"),
    inlinedTitle,
  ];
  return labels.find((label) => label) ?? "3D scene";
}
