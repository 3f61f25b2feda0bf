// Reads an <X3D> element into a SceneDescription, incrementally while the document changes.
//
// The reader keeps the fragment of every element instance and reads only those anew that may have changed. Descriptions
// are immutable, and an unchanged description is the same object as before, so that users of a scene find changes by
// comparing objects from the root on.

import type { SceneDescription } from "./description.ts";
import type { SceneElement } from "./element.ts";
import { attributeOf, emptyElement, lowerNameOf } from "./element.ts";
import { ElementTree } from "./elementTree.ts";
import { GeometryCache } from "./geometryCache.ts";
import type { OperatorReader } from "./operatorReader.ts";
import type { InlineGeometryReader } from "./inlineGeometry.ts";
import type { Refusals } from "./refused.ts";
import type { Warning } from "./nodes.ts";
import { nodeFields, readFields } from "./nodes.ts";
import { ElementInstance } from "./elementInstance.ts";
import { MovingValues } from "./movingValues.ts";
import type { InlinedDocument } from "./readNode.ts";
import type { DeformationReader } from "./deformationReader.ts";
import { isReadAsWhole, readNode } from "./readNode.ts";
import type { ReadChildren, Inherited, SceneFragment, FragmentReader } from "./sceneFragment.ts";
import { joinDeclarations, warningsOnly } from "./sceneFragment.ts";
import type { NeedPart } from "./parts.ts";
import type { TextReader } from "./textReader.ts";

/** What reading needs besides the document. When a result for an element changes, call `touch` with the element. */
export interface SceneReaderOptions {
  /** The absolute URL of the document, so that it does not inline itself; undefined: unknown. */
  readonly url?: string;
  /** The document of an Inline; undefined while it is not loaded. */
  readonly inlined?: (inline: SceneElement) => InlinedDocument | undefined;
  /** The visible level of a LOD; undefined while its distance is unknown. */
  readonly levelOf?: (lod: SceneElement) => number | undefined;
  /** Reads geometry whose numbers are in the document; without it such geometry is not drawn. */
  readonly inlineGeometry?: InlineGeometryReader | undefined;
  /** Default: operators are not applied. */
  readonly operators?: OperatorReader | undefined;
  /** Default: vertices stay where they were modelled. */
  readonly deformation?: DeformationReader | undefined;
  /** Warns of nodes and fields that are not read; without it they are ignored without a word. */
  readonly refusals?: Refusals;
  /** Reads Text nodes; without it they are not drawn. */
  readonly text?: TextReader | undefined;
  /** Is told of the parts of the runtime that nodes need. */
  readonly need?: NeedPart;
}

/** Inlined documents nested deeper than this are refused. */
const maxInlineDepth = 16;

/** Nested USEs and Inlines multiply instances exponentially: instances beyond this number are left out. */
const defaultMaxInstances = 500_000;

const rootState: Inherited = { visible: true, contributesToBounds: true, priority: 1 };

/** Unknown elements are ignored, as browsers ignore unknown tags; their children are read. */
export class SceneReader {
  readonly #x3d: SceneElement;
  readonly #options: SceneReaderOptions;
  readonly #maxInstances: number;
  readonly #page: ElementTree;
  readonly #geometries = new GeometryCache();
  readonly #moving = new MovingValues();
  readonly #inlinedTrees = new WeakMap<SceneElement, ElementTree>();
  /** By element: the instances that were read from it. */
  readonly #dependents = new Map<SceneElement, Set<ElementInstance>>();
  /** By name: the instances that have looked it up. */
  readonly #nameUsers = new Map<string, Set<ElementInstance>>();
  readonly #root: ElementInstance;
  /** With whether more than the operators of a geometry may have changed. */
  readonly #touched = new Map<SceneElement, boolean>();
  readonly #rearranged = new Set<SceneElement>();
  #instanceCount = 0;
  /** The instances of which some children are left out. */
  readonly #truncated = new Set<ElementInstance>();
  #scene: SceneDescription | undefined;

  constructor(x3d: SceneElement, options: SceneReaderOptions = {}, maxInstances = defaultMaxInstances) {
    this.#x3d = x3d;
    this.#options = options;
    this.#maxInstances = maxInstances;
    this.#page = new ElementTree(x3d);
    this.#root = new ElementInstance(x3d, undefined, { tree: this.#page, host: undefined, inlinedBy: [] });
  }

  /** Call where attributes of the element, or what the options return for it, may have changed. */
  touch(element: SceneElement): void {
    this.#touched.set(element, true);
  }

  /**
   * Gives a list of numbers of a geometry node, or of its Coordinate and the like, other values than its attribute has.
   * Returns whether that is all: the vertices of the geometry have moved. If not, call `touch`: the geometry that is read
   * then moves with such values. They count until `touchAttribute`.
   */
  moveVertices(element: SceneElement, field: string, numbers: readonly number[]): boolean {
    return this.#moving.set(element, field, numbers);
  }

  /** Call where an attribute has changed: as `touch`. Operators change in every frame: geometry is not read again. */
  touchAttribute(element: SceneElement, name: string | null): void {
    if (name?.toLowerCase() === "operators") {
      this.#touched.set(element, this.#touched.get(element) ?? false);
      return;
    }
    this.#moving.forget(element);
    this.touch(element);
  }

  /** Call where fonts may have changed. */
  touchTexts(): void {
    for (const element of this.#dependents.keys()) if (lowerNameOf(element) === "text") this.touch(element);
  }

  /** Call where children of the element may have been added, removed or reordered. */
  rearrange(element: SceneElement): void {
    this.#rearranged.add(element);
    this.touch(element);
  }

  /** The current scene; the same object as before where nothing has been touched. */
  read(): SceneDescription {
    this.#invalidateTouched();
    if (this.#scene !== undefined && this.#root.fragment !== undefined) return this.#scene;
    this.#geometries.begin();
    this.#fragmentOf(this.#root, rootState);
    // Other instances have been removed: instances that were left out may now fit.
    if (this.#instanceCount < this.#maxInstances) for (const instance of this.#truncated) instance.invalidate();
    const { nodes, declarations } = this.#fragmentOf(this.#root, rootState);
    const warnings: Warning[] = [...declarations.warnings];
    if (this.#truncated.size > 0) {
      warnings.push({
        element: this.#x3d,
        message: `has more than ${this.#maxInstances} instances of nodes: the rest is left out`,
      });
    }
    const { chunkPriority } = readFields(this.#x3d, nodeFields.X3D, warnings);
    this.#scene = {
      root: { kind: "group", visible: true, box: undefined, transform: undefined, children: nodes },
      navigation: declarations.navigation ?? declarations.inlinedNavigation ?? defaultNavigation,
      background: declarations.background?.background,
      chunkPriority,
      inlines: declarations.inlines,
      warnings,
    };
    return this.#scene;
  }

  #invalidateTouched(): void {
    const page = this.#page;
    for (const [touched, isGeometryTouched] of this.#touched) {
      for (let element: SceneElement | undefined = touched; element !== undefined; element = page.parentOf(element)) {
        if (isGeometryTouched) this.#geometries.touch(element);
        for (const instance of this.#dependents.get(element) ?? [])
          if (element === touched || instance.dependsOnDescendants) instance.invalidateReader();
      }
      page.updateName(touched);
    }
    for (const element of this.#rearranged) page.updateChildren(element);
    for (const name of page.takeChangedNames()) {
      for (const instance of this.#nameUsers.get(name) ?? []) instance.invalidateReader();
    }
    this.#touched.clear();
    this.#rearranged.clear();
  }

  /** The instance's fragment for this inherited state, read where it is not known. */
  #fragmentOf(instance: ElementInstance, inherited: Inherited): SceneFragment {
    const known = instance.fragmentFor(inherited);
    if (known !== undefined) return known;
    const reader = (instance.reader ??= this.#read(instance));
    const [previous, children] = [instance.takeChildren(), [] as ElementInstance[]];
    this.#truncated.delete(instance);
    const readChildren: ReadChildren = (elements, inheritedByElements) => {
      const fragments: SceneFragment[] = [];
      for (const element of elements) {
        const child = previous.take(element) ?? this.#newInstance(element, instance);
        if (child === undefined) break;
        children.push(child);
        fragments.push(this.#fragmentOf(child, inheritedByElements));
      }
      return {
        nodes: fragments.flatMap(({ nodes }) => nodes),
        declarations: joinDeclarations(fragments.map(({ declarations }) => declarations)),
      };
    };
    const fragment = reader(inherited, readChildren);
    for (const child of previous.rest()) this.#remove(child);
    instance.setFragment(inherited, fragment, children);
    return fragment;
  }

  /** Undefined where the limit is reached. */
  #newInstance(element: SceneElement, parent: ElementInstance): ElementInstance | undefined {
    if (this.#instanceCount >= this.#maxInstances) {
      this.#truncated.add(parent);
      return undefined;
    }
    this.#instanceCount += 1;
    return new ElementInstance(element, parent, parent.contextOf(element));
  }

  #read(instance: ElementInstance): FragmentReader {
    this.#removeDependencies(instance);
    const {
      element,
      context: { tree, host, inlinedBy },
    } = instance;
    const warnings: Warning[] = [];
    this.#addSource(instance, element);
    const lookup = (name: string) => {
      const used = tree.definedAs(name);
      this.#addNameUser(instance, name);
      if (used !== undefined) this.#addSource(instance, used);
      return used;
    };
    const name = attributeOf(element, "USE");
    const node = name === undefined ? element : lookup(name);
    if (node === undefined || instance.isBelowUseOf(node)) {
      warnings.push({ element, message: `USE="${name ?? ""}" names ${node ? "itself" : "no DEF of this scene"}` });
      return () => ({ nodes: [], declarations: warningsOnly(warnings) });
    }
    instance.node = node;
    instance.dependsOnDescendants = isReadAsWhole(node);
    return readNode(element, node, {
      warnings,
      lookup,
      geometries: this.#geometries,
      inlineGeometry: this.#options.inlineGeometry,
      moving: this.#moving,
      operators: this.#options.operators,
      deformation: this.#options.deformation,
      refusals: this.#options.refusals,
      text: this.#options.text,
      need: this.#options.need,
      host: host ?? element,
      inlineDepth: inlinedBy.length,
      childrenOf: (parent) => tree.childrenOf(parent),
      listen: (source) => {
        this.#addSource(instance, source);
      },
      levelOf: (lod) => this.#options.levelOf?.(lod),
      inlined: (inline) => this.#inlinedAt(instance, inline, warnings),
    });
  }

  #inlinedAt(instance: ElementInstance, inline: SceneElement, warnings: Warning[]): SceneElement | undefined {
    const found = this.#options.inlined?.(inline);
    if (found === undefined) return undefined;
    const { inlinedBy, host } = instance.context;
    const problem = problemWith(found, inlinedBy, this.#options.url);
    if (problem !== undefined) {
      warnings.push({ element: instance.element, message: problem });
      return undefined;
    }
    const tree = this.#inlinedTrees.get(found.x3d) ?? new ElementTree(found.x3d);
    this.#inlinedTrees.set(found.x3d, tree);
    instance.setInlined(found.x3d, { tree, host: host ?? instance.element, inlinedBy: [...inlinedBy, found] });
    return found.x3d;
  }

  #addSource(instance: ElementInstance, element: SceneElement): void {
    instance.sources.add(element);
    const dependents = this.#dependents.get(element);
    if (dependents === undefined) this.#dependents.set(element, new Set([instance]));
    else dependents.add(instance);
  }

  /** Names of inlined documents are not recorded: those documents do not change. */
  #addNameUser(instance: ElementInstance, name: string): void {
    if (instance.context.tree !== this.#page) return;
    instance.names.add(name);
    const users = this.#nameUsers.get(name);
    if (users === undefined) this.#nameUsers.set(name, new Set([instance]));
    else users.add(instance);
  }

  #removeDependencies(instance: ElementInstance): void {
    for (const element of instance.sources) removeFromSet(this.#dependents, element, instance);
    for (const name of instance.names) removeFromSet(this.#nameUsers, name, instance);
    instance.sources.clear();
    instance.names.clear();
  }

  #remove(instance: ElementInstance): void {
    this.#instanceCount -= 1;
    this.#truncated.delete(instance);
    this.#removeDependencies(instance);
    for (const child of instance.children) this.#remove(child);
  }
}

const defaultNavigation = readFields(emptyElement, nodeFields.NavigationInfo, []);

function problemWith(
  { url }: InlinedDocument,
  inlinedBy: readonly InlinedDocument[],
  ownUrl: string | undefined,
): string | undefined {
  if (url === ownUrl || inlinedBy.some((outer) => outer.url === url)) return `names ${url}, which contains it`;
  return inlinedBy.length >= maxInlineDepth ? `names ${url}, more than ${maxInlineDepth} documents deep` : undefined;
}

function removeFromSet<Key>(sets: Map<Key, Set<ElementInstance>>, key: Key, instance: ElementInstance): void {
  const set = sets.get(key);
  set?.delete(instance);
  if (set?.size === 0) sets.delete(key);
}
