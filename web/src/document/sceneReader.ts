// An <X3D> element -> SceneDescription, again and again while the document changes.
//
// What elements say is kept for each of the places where they stand, and only what
// may have changed is asked for again. A description is never changed: what says the
// same as before is the same object, so that whoever follows a scene finds what has
// changed by comparing objects, from the root on.

import type { SceneDescription } from "./description.ts";
import type { SceneElement } from "./element.ts";
import { attributeOf, lowerNameOf } from "./element.ts";
import { ElementTree } from "./elementTree.ts";
import { GeometryMemory } from "./geometryMemory.ts";
import type { InlineGeometryReader } from "./inlineGeometry.ts";
import type { Warning } from "./nodes.ts";
import { nodeFields, readFields } from "./nodes.ts";
import { Place } from "./place.ts";
import type { InlinedDocument } from "./readNode.ts";
import { isReadAsWhole, readNode } from "./readNode.ts";
import type { Below, Inherited, Said, Saying } from "./said.ts";
import { joined, warned } from "./said.ts";
import type { TextReading } from "./textGeometry.ts";

/** What a scene shows beyond what its own elements say. Who says something else of an element than before touches it. */
export interface Supplements {
  /** The absolute url of the document, which it cannot inline; undefined: nobody knows. */
  readonly url?: string;
  /** Undefined while it is not here. */
  readonly inlined?: (inline: SceneElement) => InlinedDocument | undefined;
  /** The level of a LOD; undefined while nobody knows how far it is. */
  readonly levelOf?: (lod: SceneElement) => number | undefined;
  /** How geometry is read that stands in the document; without it nothing is seen of it. */
  readonly inlineGeometry?: InlineGeometryReader;
  /** How texts are read; without it nothing is seen of them. */
  readonly text?: TextReading;
}

/** Documents that inline one another deeper than this are no scene. */
const mostInlineDepth = 16;

/** Groups of groups that are USEd, and documents that inline documents, grow without measure: the rest is left out. */
const usualMostPlaces = 500_000;

const everything: Inherited = { visible: true, reaches: true, priority: 1 };

/** Unknown nodes are passed over, as a browser passes over unknown tags; what they hold still counts. */
export class SceneReader {
  readonly #x3d: SceneElement;
  readonly #supplements: Supplements;
  readonly #mostPlaces: number;
  readonly #page: ElementTree;
  readonly #geometries = new GeometryMemory();
  readonly #inlinedTrees = new WeakMap<SceneElement, ElementTree>();
  /** Who has read an element, and who has asked for a name. */
  readonly #readers = new Map<SceneElement, Set<Place>>();
  readonly #askers = new Map<string, Set<Place>>();
  readonly #root: Place;
  readonly #touched = new Set<SceneElement>();
  readonly #rearranged = new Set<SceneElement>();
  /** How many there are, and those of which some children are left out. */
  #placeCount = 0;
  readonly #cutPlaces = new Set<Place>();
  #scene: SceneDescription | undefined;

  constructor(x3d: SceneElement, supplements: Supplements = {}, mostPlaces = usualMostPlaces) {
    this.#x3d = x3d;
    this.#supplements = supplements;
    this.#mostPlaces = mostPlaces;
    this.#page = new ElementTree(x3d);
    this.#root = new Place(x3d, undefined, { tree: this.#page, host: undefined, inlinedBy: [] });
  }

  /** Says that attributes of the element may have changed, or what supplements say of it. */
  touch(element: SceneElement): void {
    this.#touched.add(element);
  }

  /** Says that letters may look otherwise than before. */
  touchTexts(): void {
    for (const element of this.#readers.keys()) if (lowerNameOf(element) === "text") this.touch(element);
  }

  /** Says that children of the element may have come or gone. */
  rearrange(element: SceneElement): void {
    this.#rearranged.add(element);
    this.#touched.add(element);
  }

  /** The scene now; the same object as before where nothing has been touched. */
  read(): SceneDescription {
    this.#forgetTouched();
    if (this.#scene !== undefined && this.#root.said !== undefined) return this.#scene;
    this.#geometries.begin();
    this.#ask(this.#root, everything);
    if (this.#placeCount < this.#mostPlaces) for (const place of this.#cutPlaces) place.askAgain(); // others have left
    const { nodes, asides } = this.#ask(this.#root, everything);
    const warnings: Warning[] = [...asides.warnings];
    if (this.#cutPlaces.size > 0) {
      warnings.push({
        element: this.#x3d,
        message: `has more than ${this.#mostPlaces} nodes in all their places: the rest is left out`,
      });
    }
    const { chunkPriority } = readFields(this.#x3d, nodeFields.X3D, warnings);
    this.#scene = {
      root: { kind: "group", visible: true, box: undefined, transform: undefined, children: nodes },
      navigation: asides.navigation ?? usualNavigation,
      background: asides.background,
      chunkPriority,
      inlines: asides.inlines,
      warnings,
    };
    return this.#scene;
  }

  #forgetTouched(): void {
    const page = this.#page;
    for (const touched of this.#touched) {
      for (let element: SceneElement | undefined = touched; element !== undefined; element = page.parentOf(element)) {
        this.#geometries.touch(element);
        for (const place of this.#readers.get(element) ?? [])
          if (element === touched || place.readsAllBelow) place.forget();
      }
      page.lookAtName(touched);
    }
    for (const element of this.#rearranged) page.lookAtChildren(element);
    for (const name of page.takeRenamed()) {
      for (const place of this.#askers.get(name) ?? []) place.forget();
    }
    this.#touched.clear();
    this.#rearranged.clear();
  }

  /** What the place's element says there. */
  #ask(place: Place, inherited: Inherited): Said {
    const known = place.saidTo(inherited);
    if (known !== undefined) return known;
    const saying = (place.saying ??= this.#read(place));
    const [before, now] = [place.takeChildren(), [] as Place[]];
    this.#cutPlaces.delete(place);
    const below: Below = (elements, inner) => {
      const said: Said[] = [];
      for (const element of elements) {
        const child = before.take(element) ?? this.#newPlace(element, place);
        if (child === undefined) break;
        now.push(child);
        said.push(this.#ask(child, inner));
      }
      return { nodes: said.flatMap(({ nodes }) => nodes), asides: joined(said.map(({ asides }) => asides)) };
    };
    const said = saying(inherited, below);
    for (const child of before.rest()) this.#leave(child);
    place.remember(inherited, said, now);
    return said;
  }

  /** Undefined where there are too many. */
  #newPlace(element: SceneElement, parent: Place): Place | undefined {
    if (this.#placeCount >= this.#mostPlaces) {
      this.#cutPlaces.add(parent);
      return undefined;
    }
    this.#placeCount += 1;
    return new Place(element, parent, parent.surroundingsOf(element));
  }

  #read(place: Place): Saying {
    this.#stopListening(place);
    const {
      element,
      surroundings: { tree, host },
    } = place;
    const warnings: Warning[] = [];
    this.#listen(place, element);
    const lookup = (name: string) => {
      const used = tree.definedAs(name);
      this.#listenToName(place, name);
      if (used !== undefined) this.#listen(place, used);
      return used;
    };
    const name = attributeOf(element, "USE");
    const node = name === undefined ? element : lookup(name);
    if (node === undefined || place.isBelowUseOf(node)) {
      warnings.push({ element, message: `USE="${name ?? ""}" names ${node ? "itself" : "no DEF of this scene"}` });
      return () => ({ nodes: [], asides: warned(warnings) });
    }
    place.node = node;
    place.readsAllBelow = isReadAsWhole(node);
    return readNode(element, node, {
      warnings,
      lookup,
      geometries: this.#geometries,
      inlineGeometry: this.#supplements.inlineGeometry,
      text: this.#supplements.text,
      host: host ?? element,
      childrenOf: (of) => tree.childrenOf(of),
      listen: (part) => {
        this.#listen(place, part);
      },
      levelOf: (lod) => this.#supplements.levelOf?.(lod),
      inlined: (inline) => this.#inlinedAt(place, inline, warnings),
    });
  }

  #inlinedAt(place: Place, inline: SceneElement, warnings: Warning[]): SceneElement | undefined {
    const found = this.#supplements.inlined?.(inline);
    if (found === undefined) return undefined;
    const { inlinedBy, host } = place.surroundings;
    const problem = problemWith(found, inlinedBy, this.#supplements.url);
    if (problem !== undefined) {
      warnings.push({ element: place.element, message: problem });
      return undefined;
    }
    const tree = this.#inlinedTrees.get(found.x3d) ?? new ElementTree(found.x3d);
    this.#inlinedTrees.set(found.x3d, tree);
    place.inlines(found.x3d, { tree, host: host ?? place.element, inlinedBy: [...inlinedBy, found] });
    return found.x3d;
  }

  #listen(place: Place, element: SceneElement): void {
    place.sources.add(element);
    const readers = this.#readers.get(element);
    if (readers === undefined) this.#readers.set(element, new Set([place]));
    else readers.add(place);
  }

  /** Documents that are inlined do not change: their names are not listened to. */
  #listenToName(place: Place, name: string): void {
    if (place.surroundings.tree !== this.#page) return;
    place.names.add(name);
    const askers = this.#askers.get(name);
    if (askers === undefined) this.#askers.set(name, new Set([place]));
    else askers.add(place);
  }

  #stopListening(place: Place): void {
    for (const element of place.sources) leaveSet(this.#readers, element, place);
    for (const name of place.names) leaveSet(this.#askers, name, place);
    place.sources.clear();
    place.names.clear();
  }

  #leave(place: Place): void {
    this.#placeCount -= 1;
    this.#cutPlaces.delete(place);
    this.#stopListening(place);
    for (const child of place.children) this.#leave(child);
  }
}

const withoutAttributes: SceneElement = {
  localName: "",
  children: [],
  getAttribute: () => null,
  getAttributeNames: () => [],
};
const usualNavigation = readFields(withoutAttributes, nodeFields.NavigationInfo, []);

function problemWith(
  { url }: InlinedDocument,
  inlinedBy: readonly InlinedDocument[],
  ownUrl: string | undefined,
): string | undefined {
  if (url === ownUrl || inlinedBy.some((outer) => outer.url === url)) return `names ${url}, which it stands in itself`;
  return inlinedBy.length >= mostInlineDepth ? `names ${url}, more than ${mostInlineDepth} documents deep` : undefined;
}

function leaveSet<Key>(sets: Map<Key, Set<Place>>, key: Key, place: Place): void {
  const set = sets.get(key);
  set?.delete(place);
  if (set?.size === 0) sets.delete(key);
}
