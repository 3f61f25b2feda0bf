// Parses well-formed markup into a tree of elements, for tests without a DOM.

import type { SceneElement } from "./element.ts";

export interface TestElement extends SceneElement {
  readonly children: TestElement[];
  readonly attributes: Map<string, string>;
  readonly parentElement: TestElement | null;
  setAttribute(name: string, value: string): void;
}

/** Reads start tags, end tags and attributes; names keep their case as in XML. The first element is the root. */
export function elementsOf(markup: string): TestElement {
  const container = createElement("");
  const openElements = [container];
  for (const [, slash, name, attributes = "", selfClosing] of markup.matchAll(
    /<(\/)?(\w+)((?:\s+\w+=(?:"[^"]*"|'[^']*'))*)\s*(\/)?>/g,
  )) {
    if (slash !== undefined) {
      openElements.pop();
      continue;
    }
    const element = createElement(name ?? "");
    for (const [, key = "", doubleQuoted, singleQuoted] of attributes.matchAll(/(\w+)=(?:"([^"]*)"|'([^']*)')/g)) {
      element.attributes.set(key, doubleQuoted ?? singleQuoted ?? "");
    }
    const parent = openElements.at(-1);
    parent?.children.push(element);
    setParent(element, parent ?? null);
    if (selfClosing === undefined) openElements.push(element);
  }
  const root = container.children[0];
  if (root === undefined) throw new Error("no element");
  setParent(root, null);
  return root;
}

/** As in a DOM, that is no property of the element's own: texts and comparisons of elements leave it out. */
function setParent(element: TestElement, parent: TestElement | null): void {
  Object.defineProperty(element, "parentElement", { value: parent, configurable: true, enumerable: false });
}

function createElement(localName: string): TestElement {
  const attributes = new Map<string, string>();
  return {
    localName,
    attributes,
    children: [],
    parentElement: null,
    setAttribute: (name, value) => {
      attributes.set(name, value);
    },
    getAttribute: (name) => attributes.get(name) ?? null,
    getAttributeNames: () => Array.from(attributes.keys()),
  };
}
