// The elements of a document as they were when they were last looked at: what stands
// in what, and what names mean. A live document says only that something of an
// element is another; compared with this, it is known what has come and gone.

import type { SceneElement } from "./element.ts";
import { attributeOf, childrenOf } from "./element.ts";

interface Known {
  readonly parent: SceneElement | undefined;
  children: readonly SceneElement[];
  /** Its DEF. */
  name: string | undefined;
}

export class ElementTree {
  readonly #root: SceneElement;
  readonly #known = new Map<SceneElement, Known>();
  /** Who has a name, in no order. */
  readonly #named = new Map<string, Set<SceneElement>>();
  /** Names that several have, with the first of these once somebody has asked. */
  readonly #ambiguous = new Map<string, SceneElement | undefined>();
  /** Names whose meaning may have changed since the last time somebody asked. */
  #renamed = new Set<string>();

  constructor(root: SceneElement) {
    this.#root = root;
    this.#enter(root, undefined);
    this.#renamed.clear();
  }

  /** Of an element that has left, or never was here: none. */
  childrenOf(element: SceneElement): readonly SceneElement[] {
    return this.#known.get(element)?.children ?? [];
  }

  parentOf(element: SceneElement): SceneElement | undefined {
    return this.#known.get(element)?.parent;
  }

  /** The first element in the document of that DEF. */
  definedAs(name: string): SceneElement | undefined {
    const named = this.#named.get(name);
    if (!this.#ambiguous.has(name)) return named?.values().next().value;
    const first = this.#ambiguous.get(name) ?? this.#firstOf(this.#root, named ?? new Set());
    this.#ambiguous.set(name, first);
    return first;
  }

  /** Looks again at what the element says of itself. */
  updateName(element: SceneElement): void {
    const known = this.#known.get(element);
    const name = attributeOf(element, "DEF");
    if (known === undefined || known.name === name) return;
    this.#unname(element, known);
    this.#name(element, known, name);
  }

  /** Looks again at what stands in the element. */
  updateChildren(element: SceneElement): void {
    const known = this.#known.get(element);
    if (known === undefined) return;
    const before = known.children;
    known.children = childrenOf(element);
    const now = new Set(known.children);
    for (const child of before) if (!now.has(child)) this.#leave(child, element);
    for (const child of known.children) if (this.parentOf(child) !== element) this.#enter(child, element);
    // Which one is the first may have changed.
    for (const name of this.#ambiguous.keys()) this.#change(name);
  }

  /** Names whose meaning may have changed since this was last called. */
  takeChangedNames(): ReadonlySet<string> {
    const renamed = this.#renamed;
    if (renamed.size > 0) this.#renamed = new Set();
    return renamed;
  }

  #enter(element: SceneElement, parent: SceneElement | undefined): void {
    const before = this.#known.get(element);
    if (before !== undefined) this.#leave(element, before.parent); // it has come here before it has been missed there
    const known: Known = { parent, children: childrenOf(element), name: undefined };
    this.#known.set(element, known);
    this.#name(element, known, attributeOf(element, "DEF"));
    for (const child of known.children) this.#enter(child, element);
  }

  /** Unless it stands elsewhere by now. */
  #leave(element: SceneElement, parent: SceneElement | undefined): void {
    const known = this.#known.get(element);
    if (known === undefined || known.parent !== parent) return;
    this.#known.delete(element);
    this.#unname(element, known);
    for (const child of known.children) this.#leave(child, element);
  }

  #name(element: SceneElement, known: Known, name: string | undefined): void {
    known.name = name;
    if (name === undefined) return;
    const named = this.#named.get(name) ?? new Set();
    this.#named.set(name, named.add(element));
    this.#change(name);
  }

  #unname(element: SceneElement, { name }: Known): void {
    if (name === undefined) return;
    const named = this.#named.get(name);
    named?.delete(element);
    if (named?.size === 0) this.#named.delete(name);
    this.#change(name);
  }

  #change(name: string): void {
    this.#renamed.add(name);
    if ((this.#named.get(name)?.size ?? 0) > 1) this.#ambiguous.set(name, undefined);
    else this.#ambiguous.delete(name);
  }

  #firstOf(element: SceneElement, wanted: ReadonlySet<SceneElement>): SceneElement | undefined {
    if (wanted.has(element)) return element;
    for (const child of this.childrenOf(element)) {
      const first = this.#firstOf(child, wanted);
      if (first !== undefined) return first;
    }
    return undefined;
  }
}
