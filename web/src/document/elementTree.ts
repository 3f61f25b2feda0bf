// A snapshot of a document's tree and DEF names. A live document reports only that an element has changed; comparing it
// with the snapshot tells which elements and names have been added or removed.

import type { SceneElement } from "./element.ts";
import { attributeOf, childrenOf } from "./element.ts";

interface Entry {
  readonly parent: SceneElement | undefined;
  children: readonly SceneElement[];
  /** The element's DEF. */
  name: string | undefined;
}

export class ElementTree {
  readonly #root: SceneElement;
  readonly #entries = new Map<SceneElement, Entry>();
  /** The elements of each DEF name, unordered. */
  readonly #named = new Map<string, Set<SceneElement>>();
  /** Names that several elements have; the value is the first of these elements, once it has been looked up. */
  readonly #ambiguous = new Map<string, SceneElement | undefined>();
  /** Names whose first element may have changed since `takeChangedNames`. */
  #changedNames = new Set<string>();

  constructor(root: SceneElement) {
    this.#root = root;
    this.#add(root, undefined);
    this.#changedNames.clear();
  }

  /** Empty for an element that is not in the document. */
  childrenOf(element: SceneElement): readonly SceneElement[] {
    return this.#entries.get(element)?.children ?? [];
  }

  parentOf(element: SceneElement): SceneElement | undefined {
    return this.#entries.get(element)?.parent;
  }

  /** The first element in the document with this DEF. */
  definedAs(name: string): SceneElement | undefined {
    const named = this.#named.get(name);
    if (!this.#ambiguous.has(name)) return named?.values().next().value;
    const first = this.#ambiguous.get(name) ?? this.#firstOf(this.#root, named ?? new Set());
    this.#ambiguous.set(name, first);
    return first;
  }

  /** Reads the element's DEF again. */
  updateName(element: SceneElement): void {
    const entry = this.#entries.get(element);
    const name = attributeOf(element, "DEF");
    if (entry === undefined || entry.name === name) return;
    this.#removeName(element, entry);
    this.#addName(element, entry, name);
  }

  /** Reads the element's children again. */
  updateChildren(element: SceneElement): void {
    const entry = this.#entries.get(element);
    if (entry === undefined) return;
    const before = entry.children;
    entry.children = childrenOf(element);
    const now = new Set(entry.children);
    for (const child of before) if (!now.has(child)) this.#remove(child, element);
    for (const child of entry.children) if (this.parentOf(child) !== element) this.#add(child, element);
    // The order may have changed, and with it the first element of a name.
    for (const name of this.#ambiguous.keys()) this.#markChanged(name);
  }

  /** The names whose first element may have changed since the last call. */
  takeChangedNames(): ReadonlySet<string> {
    const names = this.#changedNames;
    if (names.size > 0) this.#changedNames = new Set();
    return names;
  }

  #add(element: SceneElement, parent: SceneElement | undefined): void {
    const before = this.#entries.get(element);
    if (before !== undefined) this.#remove(element, before.parent); // it has moved; its old parent is updated later
    const entry: Entry = { parent, children: childrenOf(element), name: undefined };
    this.#entries.set(element, entry);
    this.#addName(element, entry, attributeOf(element, "DEF"));
    for (const child of entry.children) this.#add(child, element);
  }

  /** Does nothing for an element that has moved to another parent. */
  #remove(element: SceneElement, parent: SceneElement | undefined): void {
    const entry = this.#entries.get(element);
    if (entry === undefined || entry.parent !== parent) return;
    this.#entries.delete(element);
    this.#removeName(element, entry);
    for (const child of entry.children) this.#remove(child, element);
  }

  #addName(element: SceneElement, entry: Entry, name: string | undefined): void {
    entry.name = name;
    if (name === undefined) return;
    const named = this.#named.get(name) ?? new Set();
    this.#named.set(name, named.add(element));
    this.#markChanged(name);
  }

  #removeName(element: SceneElement, { name }: Entry): void {
    if (name === undefined) return;
    const named = this.#named.get(name);
    named?.delete(element);
    if (named?.size === 0) this.#named.delete(name);
    this.#markChanged(name);
  }

  #markChanged(name: string): void {
    this.#changedNames.add(name);
    if ((this.#named.get(name)?.size ?? 0) > 1) this.#ambiguous.set(name, undefined);
    else this.#ambiguous.delete(name);
  }

  #firstOf(element: SceneElement, candidates: ReadonlySet<SceneElement>): SceneElement | undefined {
    if (candidates.has(element)) return element;
    for (const child of this.childrenOf(element)) {
      const first = this.#firstOf(child, candidates);
      if (first !== undefined) return first;
    }
    return undefined;
  }
}
