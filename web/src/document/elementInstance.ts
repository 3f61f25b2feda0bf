// An element in one of the places where it stands: several where a group around it
// is USEd, or its document is shown twice. Keeps what the element said there.

import type { SceneElement } from "./element.ts";
import type { ElementTree } from "./elementTree.ts";
import type { InlinedDocument } from "./readNode.ts";
import type { Inherited, SceneFragment, FragmentReader } from "./sceneFragment.ts";

/** The document that a place is in. */
export interface DocumentContext {
  readonly tree: ElementTree;
  /** The page's element that stands for all of it; undefined in the page itself. */
  readonly host: SceneElement | undefined;
  /** The documents that it is inlined by, outermost first. */
  readonly inlinedBy: readonly InlinedDocument[];
}

export class ElementInstance {
  readonly element: SceneElement;
  readonly context: DocumentContext;
  /** What describes it: the same but for USE. */
  node: SceneElement;
  /** It is made of all that is in its sources, not of these alone. */
  dependsOnDescendants = false;
  /** Undefined where the element is to be read (again). */
  reader: FragmentReader | undefined;
  /** Elements that it was read from, those below it apart. */
  readonly sources = new Set<SceneElement>();
  /** Names that it has asked for. */
  readonly names = new Set<string>();
  readonly #parent: ElementInstance | undefined;
  #children: readonly ElementInstance[] = [];
  #said: SceneFragment | undefined;
  #inherited: Inherited | undefined;
  #inlined: { readonly x3d: SceneElement; readonly surroundings: DocumentContext } | undefined;

  constructor(element: SceneElement, parent: ElementInstance | undefined, surroundings: DocumentContext) {
    this.element = element;
    this.node = element;
    this.#parent = parent;
    this.context = surroundings;
  }

  /** What it says; undefined where something of that, or below it, is to be asked for again. */
  get fragment(): SceneFragment | undefined {
    return this.#said;
  }

  get children(): readonly ElementInstance[] {
    return this.#children;
  }

  /** What it has said where this was handed down. */
  fragmentFor(inherited: Inherited): SceneFragment | undefined {
    const before = this.#inherited;
    return before?.visible === inherited.visible &&
      before.contributesToBounds === inherited.contributesToBounds &&
      before.priority === inherited.priority
      ? this.#said
      : undefined;
  }

  setFragment(inherited: Inherited, said: SceneFragment, children: readonly ElementInstance[]): void {
    this.#inherited = inherited;
    this.#said = said;
    this.#children = children;
  }

  /** The element is to be read again. */
  invalidateReader(): void {
    this.reader = undefined;
    this.#inlined = undefined;
    this.invalidate();
  }

  /** Something of what it said is another now. Where that is known, it is known up to the root. */
  invalidate(): void {
    if (this.#said === undefined) return;
    this.#said = undefined;
    this.#parent?.invalidate();
  }

  /** Whether the node is USEd by something that this stands in. */
  isBelowUseOf(node: SceneElement): boolean {
    for (let place = this.#parent; place !== undefined; place = place.#parent) {
      if (place.node === node && place.element !== node) return true;
    }
    return false;
  }

  /** From now on a document's element stands in it. */
  setInlined(x3d: SceneElement, surroundings: DocumentContext): void {
    this.#inlined = { x3d, surroundings };
  }

  /** Of something that stands in it. */
  contextOf(element: SceneElement): DocumentContext {
    return this.#inlined?.x3d === element ? this.#inlined.surroundings : this.context;
  }

  /** Its children, to be taken one by one. */
  takeChildren(): ReusableChildren {
    return new ReusableChildren(this.#children);
  }
}

/** Places that find themselves again by their elements, fast where the order has stayed. */
class ReusableChildren {
  readonly #places: readonly ElementInstance[];
  readonly #gone: ElementInstance[] = [];
  #next = 0;
  #others: Map<SceneElement, ElementInstance> | undefined;

  constructor(places: readonly ElementInstance[]) {
    this.#places = places;
  }

  /** Each once. */
  take(element: SceneElement): ElementInstance | undefined {
    if (this.#others === undefined) {
      const [next, second] = [this.#places[this.#next], this.#places[this.#next + 1]];
      if (next !== undefined && second?.element === element && next.element !== element) {
        this.#gone.push(next);
        this.#next += 1;
      }
      const place = this.#places[this.#next];
      if (place?.element === element) {
        this.#next += 1;
        return place;
      }
    }
    this.#others ??= new Map(this.#places.slice(this.#next).map((place) => [place.element, place]));
    const found = this.#others.get(element);
    this.#others.delete(element);
    return found;
  }

  /** Those that nobody has taken. */
  rest(): readonly ElementInstance[] {
    return [...this.#gone, ...(this.#others?.values() ?? this.#places.slice(this.#next))];
  }
}
