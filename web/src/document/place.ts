// An element in one of the places where it stands: several where a group around it
// is USEd, or its document is shown twice. Keeps what the element said there.

import type { SceneElement } from "./element.ts";
import type { ElementTree } from "./elementTree.ts";
import type { InlinedDocument } from "./readNode.ts";
import type { Inherited, Said, Saying } from "./said.ts";

/** The document that a place is in. */
export interface Surroundings {
  readonly tree: ElementTree;
  /** The page's element that stands for all of it; undefined in the page itself. */
  readonly host: SceneElement | undefined;
  /** The documents that it is inlined by, outermost first. */
  readonly inlinedBy: readonly InlinedDocument[];
}

export class Place {
  readonly element: SceneElement;
  readonly surroundings: Surroundings;
  /** What describes it: the same but for USE. */
  node: SceneElement;
  /** It is made of all that is in its sources, not of these alone. */
  readsAllBelow = false;
  /** Undefined where the element is to be read (again). */
  saying: Saying | undefined;
  /** Elements that it was read from, those below it apart. */
  readonly sources = new Set<SceneElement>();
  /** Names that it has asked for. */
  readonly names = new Set<string>();
  readonly #parent: Place | undefined;
  #children: readonly Place[] = [];
  #said: Said | undefined;
  #inherited: Inherited | undefined;
  #inlined: { readonly x3d: SceneElement; readonly surroundings: Surroundings } | undefined;

  constructor(element: SceneElement, parent: Place | undefined, surroundings: Surroundings) {
    this.element = element;
    this.node = element;
    this.#parent = parent;
    this.surroundings = surroundings;
  }

  /** What it says; undefined where something of that, or below it, is to be asked for again. */
  get said(): Said | undefined {
    return this.#said;
  }

  get children(): readonly Place[] {
    return this.#children;
  }

  /** What it has said where this was handed down. */
  saidTo(inherited: Inherited): Said | undefined {
    const before = this.#inherited;
    return before?.visible === inherited.visible &&
      before.reaches === inherited.reaches &&
      before.priority === inherited.priority
      ? this.#said
      : undefined;
  }

  remember(inherited: Inherited, said: Said, children: readonly Place[]): void {
    this.#inherited = inherited;
    this.#said = said;
    this.#children = children;
  }

  /** The element is to be read again. */
  forget(): void {
    this.saying = undefined;
    this.#inlined = undefined;
    this.askAgain();
  }

  /** Something of what it said is another now. Where that is known, it is known up to the root. */
  askAgain(): void {
    if (this.#said === undefined) return;
    this.#said = undefined;
    this.#parent?.askAgain();
  }

  /** Whether the node is USEd by something that this stands in. */
  isBelowUseOf(node: SceneElement): boolean {
    for (let place = this.#parent; place !== undefined; place = place.#parent) {
      if (place.node === node && place.element !== node) return true;
    }
    return false;
  }

  /** From now on a document's element stands in it. */
  inlines(x3d: SceneElement, surroundings: Surroundings): void {
    this.#inlined = { x3d, surroundings };
  }

  /** Of something that stands in it. */
  surroundingsOf(element: SceneElement): Surroundings {
    return this.#inlined?.x3d === element ? this.#inlined.surroundings : this.surroundings;
  }

  /** Its children, to be taken one by one. */
  takeChildren(): TakenPlaces {
    return new TakenPlaces(this.#children);
  }
}

/** Places that find themselves again by their elements, fast where the order has stayed. */
class TakenPlaces {
  readonly #places: readonly Place[];
  readonly #gone: Place[] = [];
  #next = 0;
  #others: Map<SceneElement, Place> | undefined;

  constructor(places: readonly Place[]) {
    this.#places = places;
  }

  /** Each once. */
  take(element: SceneElement): Place | undefined {
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
  rest(): readonly Place[] {
    return [...this.#gone, ...(this.#others?.values() ?? this.#places.slice(this.#next))];
  }
}
