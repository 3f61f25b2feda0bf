// What reading animation needs of a document's elements. DOM elements have it.

export interface AnimatedElement {
  /** The tag's name, in any case. */
  readonly localName: string;
  readonly children: ArrayLike<AnimatedElement>;
  readonly parentElement: AnimatedElement | null;
  getAttribute(name: string): string | null;
  getAttributeNames(): string[];
  setAttribute(name: string, value: string): void;
}

/** The name under which the element has this attribute, whose case is not regarded; undefined where it has none. */
export function attributeNameIn(element: AnimatedElement, name: string): string | undefined {
  if (element.getAttribute(name) !== null) return name;
  const lower = name.toLowerCase();
  return element.getAttributeNames().find((candidate) => candidate.toLowerCase() === lower);
}

/** An attribute by name, whose case is not regarded; undefined where it is absent. */
export function attributeIn(element: AnimatedElement, name: string): string | undefined {
  const found = attributeNameIn(element, name);
  return found === undefined ? undefined : (element.getAttribute(found) ?? undefined);
}

/** `<PositionInterpolator DEF="move">`, for messages. */
export function labelOf(element: AnimatedElement, typeName?: string): string {
  const name = attributeIn(element, "DEF");
  return `<${typeName ?? element.localName}${name === undefined ? "" : ` DEF="${name}"`}>`;
}
