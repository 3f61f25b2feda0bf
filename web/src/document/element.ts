// The subset of DOM Element that reading a scene needs: a live DOM, a parsed XML file and a test's own tree provide it.

export interface SceneElement {
  /** The tag's name, in any case. */
  readonly localName: string;
  readonly children: ArrayLike<SceneElement>;
  getAttribute(name: string): string | null;
  getAttributeNames(): string[];
}

/** The element that a USE names, or the element itself; undefined where the name is unknown. */
export type Resolve = (element: SceneElement) => SceneElement | undefined;

/** An element without attributes, whose fields all have their defaults. */
export const emptyElement: SceneElement = {
  localName: "",
  children: [],
  getAttribute: () => null,
  getAttributeNames: () => [],
};

/** The tag's name in lower case: names are matched case-insensitively. */
export function lowerNameOf(element: SceneElement): string {
  return element.localName.toLowerCase();
}

/**
 * An attribute by case-insensitive name; undefined where it is absent.
 * HTML lower-cases attributes when it parses them, XML keeps what was written.
 */
export function attributeOf(element: SceneElement, name: string): string | undefined {
  const exact = element.getAttribute(name);
  if (exact !== null) return exact;
  const lowerName = name.toLowerCase();
  const found = element.getAttributeNames().find((candidate) => candidate.toLowerCase() === lowerName);
  return found === undefined ? undefined : (element.getAttribute(found) ?? undefined);
}

/** The sentence about a USE whose element is nowhere. */
export function unknownUse(name = ""): string {
  return `USE="${name}" names no DEF of this scene`;
}

/** The element that `user` USEs, with the containerField of `user`. */
export function substitutedFor(user: SceneElement, used: SceneElement): SceneElement {
  if (user === used) return used;
  const field = attributeOf(user, "containerField") ?? null;
  return {
    localName: used.localName,
    children: used.children,
    getAttribute: (name) => (name === "containerField" ? field : used.getAttribute(name)),
    getAttributeNames: () => [
      ...used.getAttributeNames().filter((name) => name.toLowerCase() !== "containerfield"),
      ...(field === null ? [] : ["containerField"]),
    ],
  };
}

/** Like `attributeOf`, for many names of one element: reads the element's attributes once. */
export function attributesOf(element: SceneElement): (name: string) => string | undefined {
  const names = element.getAttributeNames();
  if (names.length === 0) return () => undefined;
  const values = new Map<string, string>();
  for (const name of names) {
    const value = element.getAttribute(name) ?? "";
    const lower = name.toLowerCase();
    if (!values.has(lower)) values.set(lower, value);
    values.set(name, value);
  }
  return (name) => values.get(name) ?? values.get(name.toLowerCase());
}

export function childrenOf({ children }: SceneElement): SceneElement[] {
  // Iterating a live collection takes several times as long as indexing it.
  return Array.from({ length: children.length }, (_, index) => children[index]).filter((child) => child !== undefined);
}
