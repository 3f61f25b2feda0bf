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
import { GeometryCache } from "./geometryCache.ts";
import type { InlineGeometryReader } from "./inlineGeometry.ts";
import type { Warning } from "./nodes.ts";
import { nodeFields, readFields } from "./nodes.ts";
import { ElementInstance } from "./elementInstance.ts";
import type { InlinedDocument } from "./readNode.ts";
import { isReadAsWhole, readNode } from "./readNode.ts";
import type { ReadChildren, Inherited, SceneFragment, FragmentReader } from "./sceneFragment.ts";
import { joinDeclarations, warningsOnly } from "./sceneFragment.ts";
import type { TextReader } from "./textReader.ts";

/** What a scene shows beyond what its own elements say. Who says something else of an element than before touches it. */
export interface SceneReaderOptions {
  /** The absolute url of the document, which it cannot inline; undefined: nobody knows. */
  readonly url?: string;
  /** Undefined while it is not here. */
  readonly inlined?: (inline: SceneElement) => InlinedDocument | undefined;
  /** The level of a LOD; undefined while nobody knows how far it is. */
  readonly levelOf?: (lod: SceneElement) => number | undefined;
  /** How geometry is read that stands in the document; without it nothing is seen of it. */
  readonly inlineGeometry?: InlineGeometryReader;
  /** How texts are read; without it nothing is seen of them. */
  readonly text?: TextReader;
}

/** Documents that inline one another deeper than this are no scene. */
const maxInlineDepth = 16;

/** Groups of groups that are USEd, and documents that inline documents, grow without measure: the rest is left out. */
const defaultMaxInstances = 500_000;

const everything: Inherited = { visible: true, contributesToBounds: true, priority: 1 };

/** Unknown nodes are passed over, as a browser passes over unknown tags; what they hold still counts. */
export class SceneReader {
  readonly #x3d: SceneElement;
  readonly #supplements: SceneReaderOptions;
  readonly #mostPlaces: number;
  readonly #page: ElementTree;
  readonly #geometries = new GeometryCache();
  readonly #inlinedTrees = new WeakMap<SceneElement, ElementTree>();
  /** Who has read an element, and who has asked for a name. */
  readonly #readers = new Map<SceneElement, Set<ElementInstance>>();
  readonly #askers = new Map<string, Set<ElementInstance>>();
  readonly #root: ElementInstance;
  readonly #touched = new Set<SceneElement>();
  readonly #rearranged = new Set<SceneElement>();
  /** How many there are, and those of which some children are left out. */
  #placeCount = 0;
  readonly #cutPlaces = new Set<ElementInstance>();
  #scene: SceneDescription | undefined;

  constructor(x3d: SceneElement, supplements: SceneReaderOptions = {}, mostPlaces = defaultMaxInstances) {
    this.#x3d = x3d;
    this.#supplements = supplements;
    this.#mostPlaces = mostPlaces;
    this.#page = new ElementTree(x3d);
    this.#root = new ElementInstance(x3d, undefined, { tree: this.#page, host: undefined, inlinedBy: [] });
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
    if (this.#scene !== undefined && this.#root.fragment !== undefined) return this.#scene;
    this.#geometries.begin();
    this.#ask(this.#root, everything);
    if (this.#placeCount < this.#mostPlaces) for (const place of this.#cutPlaces) place.invalidate(); // others have left
    const { nodes, declarations: asides } = this.#ask(this.#root, everything);
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
      navigation: asides.navigation ?? defaultNavigation,
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
          if (element === touched || place.dependsOnDescendants) place.invalidateReader();
      }
      page.updateName(touched);
    }
    for (const element of this.#rearranged) page.updateChildren(element);
    for (const name of page.takeChangedNames()) {
      for (const place of this.#askers.get(name) ?? []) place.invalidateReader();
    }
    this.#touched.clear();
    this.#rearranged.clear();
  }

  /** What the place's element says there. */
  #ask(place: ElementInstance, inherited: Inherited): SceneFragment {
    const known = place.fragmentFor(inherited);
    if (known !== undefined) return known;
    const saying = (place.reader ??= this.#read(place));
    const [before, now] = [place.takeChildren(), [] as ElementInstance[]];
    this.#cutPlaces.delete(place);
    const below: ReadChildren = (elements, inner) => {
      const said: SceneFragment[] = [];
      for (const element of elements) {
        const child = before.take(element) ?? this.#newPlace(element, place);
        if (child === undefined) break;
        now.push(child);
        said.push(this.#ask(child, inner));
      }
      return {
        nodes: said.flatMap(({ nodes }) => nodes),
        declarations: joinDeclarations(said.map(({ declarations: asides }) => asides)),
      };
    };
    const said = saying(inherited, below);
    for (const child of before.rest()) this.#leave(child);
    place.setFragment(inherited, said, now);
    return said;
  }

  /** Undefined where there are too many. */
  #newPlace(element: SceneElement, parent: ElementInstance): ElementInstance | undefined {
    if (this.#placeCount >= this.#mostPlaces) {
      this.#cutPlaces.add(parent);
      return undefined;
    }
    this.#placeCount += 1;
    return new ElementInstance(element, parent, parent.contextOf(element));
  }

  #read(place: ElementInstance): FragmentReader {
    this.#stopListening(place);
    const {
      element,
      context: { tree, host },
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
      return () => ({ nodes: [], declarations: warningsOnly(warnings) });
    }
    place.node = node;
    place.dependsOnDescendants = isReadAsWhole(node);
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

  #inlinedAt(place: ElementInstance, inline: SceneElement, warnings: Warning[]): SceneElement | undefined {
    const found = this.#supplements.inlined?.(inline);
    if (found === undefined) return undefined;
    const { inlinedBy, host } = place.context;
    const problem = problemWith(found, inlinedBy, this.#supplements.url);
    if (problem !== undefined) {
      warnings.push({ element: place.element, message: problem });
      return undefined;
    }
    const tree = this.#inlinedTrees.get(found.x3d) ?? new ElementTree(found.x3d);
    this.#inlinedTrees.set(found.x3d, tree);
    place.setInlined(found.x3d, { tree, host: host ?? place.element, inlinedBy: [...inlinedBy, found] });
    return found.x3d;
  }

  #listen(place: ElementInstance, element: SceneElement): void {
    place.sources.add(element);
    const readers = this.#readers.get(element);
    if (readers === undefined) this.#readers.set(element, new Set([place]));
    else readers.add(place);
  }

  /** Documents that are inlined do not change: their names are not listened to. */
  #listenToName(place: ElementInstance, name: string): void {
    if (place.context.tree !== this.#page) return;
    place.names.add(name);
    const askers = this.#askers.get(name);
    if (askers === undefined) this.#askers.set(name, new Set([place]));
    else askers.add(place);
  }

  #stopListening(place: ElementInstance): void {
    for (const element of place.sources) leaveSet(this.#readers, element, place);
    for (const name of place.names) leaveSet(this.#askers, name, place);
    place.sources.clear();
    place.names.clear();
  }

  #leave(place: ElementInstance): void {
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
const defaultNavigation = readFields(withoutAttributes, nodeFields.NavigationInfo, []);

function problemWith(
  { url }: InlinedDocument,
  inlinedBy: readonly InlinedDocument[],
  ownUrl: string | undefined,
): string | undefined {
  if (url === ownUrl || inlinedBy.some((outer) => outer.url === url)) return `names ${url}, which it stands in itself`;
  return inlinedBy.length >= maxInlineDepth ? `names ${url}, more than ${maxInlineDepth} documents deep` : undefined;
}

function leaveSet<Key>(sets: Map<Key, Set<ElementInstance>>, key: Key, place: ElementInstance): void {
  const set = sets.get(key);
  set?.delete(place);
  if (set?.size === 0) sets.delete(key);
}
