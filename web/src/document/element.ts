// The little that reading a scene needs of an element, so that a live DOM, a
// parsed XML file and a test's own tree serve alike.

export interface SceneElement {
  /** The tag's name, in any case. */
  readonly localName: string;
  readonly children: ArrayLike<SceneElement>;
  getAttribute(name: string): string | null;
  getAttributeNames(): string[];
}

/** The tag's name as the node table writes it: names are matched without regard to case. */
export function lowerNameOf(element: SceneElement): string {
  return element.localName.toLowerCase();
}

/**
 * An attribute by name without regard to case; undefined where it is absent.
 * HTML lower-cases attributes when it parses them, XML keeps what was written.
 */
export function attributeOf(element: SceneElement, name: string): string | undefined {
  const exact = element.getAttribute(name);
  if (exact !== null) return exact;
  const wanted = name.toLowerCase();
  const found = element.getAttributeNames().find((candidate) => candidate.toLowerCase() === wanted);
  return found === undefined ? undefined : (element.getAttribute(found) ?? undefined);
}

/** What `user` USEs, in its place: of what the two say of that, `user` counts. */
export function inPlaceOf(user: SceneElement, used: SceneElement): SceneElement {
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

/** The same for many names of one element, which is asked once for all it has. */
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
  // The iterator of a live collection takes several times as long as its indices.
  return Array.from({ length: children.length }, (_, place) => children[place]).filter((child) => child !== undefined);
}
