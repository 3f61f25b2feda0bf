// One occurrence of an element in the scene, with the fragment last read from it. An element has several instances
// where a group around it is USEd or its document is inlined twice.

import type { SceneElement } from "./element.ts";
import type { ElementTree } from "./elementTree.ts";
import type { InlinedDocument } from "./readNode.ts";
import type { Inherited, SceneFragment, FragmentReader } from "./sceneFragment.ts";

/** The document that an instance is in. */
export interface DocumentContext {
  readonly tree: ElementTree;
  /** The page's Inline element for the document; undefined in the page's own document. */
  readonly host: SceneElement | undefined;
  /** The documents around it, outermost first. */
  readonly inlinedBy: readonly InlinedDocument[];
}

export class ElementInstance {
  readonly element: SceneElement;
  readonly context: DocumentContext;
  /** The element with the node's fields: the one that `element` USEs, or `element` itself. */
  node: SceneElement;
  /** The fragment depends on all descendants of `sources`. */
  dependsOnDescendants = false;
  /** Undefined where the element must be read (again). */
  reader: FragmentReader | undefined;
  /** The elements that this instance was read from, without those of its child instances. */
  readonly sources = new Set<SceneElement>();
  /** The DEF names that this instance has looked up. */
  readonly names = new Set<string>();
  readonly #parent: ElementInstance | undefined;
  #children: readonly ElementInstance[] = [];
  #fragment: SceneFragment | undefined;
  #inherited: Inherited | undefined;
  #inlined: { readonly x3d: SceneElement; readonly context: DocumentContext } | undefined;

  constructor(element: SceneElement, parent: ElementInstance | undefined, context: DocumentContext) {
    this.element = element;
    this.node = element;
    this.#parent = parent;
    this.context = context;
  }

  /** Undefined where this instance, or one below it, must be read again. */
  get fragment(): SceneFragment | undefined {
    return this.#fragment;
  }

  get children(): readonly ElementInstance[] {
    return this.#children;
  }

  /** The fragment, if it was read with this inherited state. */
  fragmentFor(inherited: Inherited): SceneFragment | undefined {
    const previous = this.#inherited;
    return previous?.visible === inherited.visible &&
      previous.contributesToBounds === inherited.contributesToBounds &&
      previous.priority === inherited.priority &&
      previous.skin === inherited.skin
      ? this.#fragment
      : undefined;
  }

  setFragment(inherited: Inherited, fragment: SceneFragment, children: readonly ElementInstance[]): void {
    this.#inherited = inherited;
    this.#fragment = fragment;
    this.#children = children;
  }

  /** Marks the element to be read again. */
  invalidateReader(): void {
    this.reader = undefined;
    this.#inlined = undefined;
    this.invalidate();
  }

  /**
   * Marks the fragment as outdated, up to the root; an instance with an outdated fragment has outdated ancestors
   * already.
   */
  invalidate(): void {
    if (this.#fragment === undefined) return;
    this.#fragment = undefined;
    this.#parent?.invalidate();
  }

  /** Whether an ancestor USEs the node. */
  isBelowUseOf(node: SceneElement): boolean {
    for (let ancestor = this.#parent; ancestor !== undefined; ancestor = ancestor.#parent) {
      if (ancestor.node === node && ancestor.element !== node) return true;
    }
    return false;
  }

  /** Sets the root element of the document that replaces this Inline. */
  setInlined(x3d: SceneElement, context: DocumentContext): void {
    this.#inlined = { x3d, context };
  }

  /** The context of a child element. */
  contextOf(element: SceneElement): DocumentContext {
    return this.#inlined?.x3d === element ? this.#inlined.context : this.context;
  }

  /** The child instances, to be reused one by one. */
  takeChildren(): ReusableChildren {
    return new ReusableChildren(this.#children);
  }
}

/** Finds instances by their elements, in constant time where the order is the same as before. */
class ReusableChildren {
  readonly #instances: readonly ElementInstance[];
  readonly #skipped: ElementInstance[] = [];
  #next = 0;
  #others: Map<SceneElement, ElementInstance> | undefined;

  constructor(instances: readonly ElementInstance[]) {
    this.#instances = instances;
  }

  /** The instance of the element; each can be taken once. */
  take(element: SceneElement): ElementInstance | undefined {
    if (this.#others === undefined) {
      const [next, second] = [this.#instances[this.#next], this.#instances[this.#next + 1]];
      if (next !== undefined && second?.element === element && next.element !== element) {
        this.#skipped.push(next);
        this.#next += 1;
      }
      const instance = this.#instances[this.#next];
      if (instance?.element === element) {
        this.#next += 1;
        return instance;
      }
    }
    this.#others ??= new Map(this.#instances.slice(this.#next).map((instance) => [instance.element, instance]));
    const found = this.#others.get(element);
    this.#others.delete(element);
    return found;
  }

  /** The instances that have not been taken. */
  rest(): readonly ElementInstance[] {
    return [...this.#skipped, ...(this.#others?.values() ?? this.#instances.slice(this.#next))];
  }
}
