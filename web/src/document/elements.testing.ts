// A tree of elements out of well-formed markup, for tests that have no DOM.

import type { SceneElement } from "./element.ts";

export interface TestElement extends SceneElement {
  readonly children: TestElement[];
  readonly attributes: Map<string, string>;
}

/** Reads start tags, end tags and attributes; names keep their case as in XML. The first element is the root. */
export function elementsOf(markup: string): TestElement {
  const top = elementNamed("");
  const open = [top];
  for (const [, end, name, attributes = "", selfClosing] of markup.matchAll(
    /<(\/)?(\w+)((?:\s+\w+=(?:"[^"]*"|'[^']*'))*)\s*(\/)?>/g,
  )) {
    if (end !== undefined) {
      open.pop();
      continue;
    }
    const element = elementNamed(name ?? "");
    for (const [, key = "", double, single] of attributes.matchAll(/(\w+)=(?:"([^"]*)"|'([^']*)')/g)) {
      element.attributes.set(key, double ?? single ?? "");
    }
    open.at(-1)?.children.push(element);
    if (selfClosing === undefined) open.push(element);
  }
  const root = top.children[0];
  if (root === undefined) throw new Error("no element");
  return root;
}

function elementNamed(localName: string): TestElement {
  const attributes = new Map<string, string>();
  return {
    localName,
    attributes,
    children: [],
    getAttribute: (name) => attributes.get(name) ?? null,
    getAttributeNames: () => Array.from(attributes.keys()),
  };
}
