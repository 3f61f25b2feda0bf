// The event graph of a document and those that it inlines: their nodes that send events, and their ROUTEs. Read again
// where a document changes; a node keeps its state as long as its element is in the document.

import { fieldsInCircles } from "./circles.ts";
import type { AnimatedDocuments, NamedNode, StatedRoute } from "./documents.ts";
import { DocumentNames } from "./documents.ts";
import type { AnimatedElement } from "./elements.ts";
import { attributeIn, attributeNameIn, labelOf } from "./elements.ts";
import type { EventGraph } from "./eventGraph.ts";
import type { Behaviour, FieldSpecification } from "./eventNode.ts";
import { EventNode } from "./eventNode.ts";
import type { FieldType, Value } from "./fieldTypes.ts";
import { fieldTypeOf, mayRoute } from "./fieldTypes.ts";
import { nodeTypeOf } from "./nodeTypes.ts";
import { listTypeOf } from "./sceneFields.ts";

/** The value that a field of a drawn node has received. */
export interface FieldChange {
  readonly element: AnimatedElement;
  /** X3D's name. */
  readonly field: string;
  /** The name of the element's attribute. */
  readonly attribute: string;
  readonly type: FieldType;
  /** Whether it is displayed without reading the document: a field of a transform, or the weight of a displacer. */
  readonly isOfPose: boolean;
  value: Value;
  /** Whether the value has not been handed on since it arrived. */
  isPending: boolean;
  /** Whether the attribute has another value, and is written later. */
  isLate: boolean;
}

export type DrawnFieldOf = (
  element: AnimatedElement,
  field: string,
) => { readonly name: string; readonly type: string; readonly isOfPose: boolean } | undefined;

export interface DocumentGraphOptions {
  /** A field of a node that is drawn, by a name in any case; undefined where the runtime does not read it. */
  readonly drawnFieldOf: DrawnFieldOf;
  /** A field of a drawn node has received a value for the first time since the last frame. */
  readonly onChange: (change: FieldChange) => void;
  readonly warn: (message: string) => void;
}

/** A behaviour that depends on time. */
export type TimedBehaviour = Behaviour & Required<Pick<Behaviour, "tick" | "nextTick">>;

function isTimed(behaviour: Behaviour): behaviour is TimedBehaviour {
  return behaviour.tick !== undefined && behaviour.nextTick !== undefined;
}

const drawn: Behaviour = { receive: () => undefined };

export class DocumentGraph {
  readonly #documents: AnimatedDocuments;
  readonly #graph: EventGraph;
  readonly #options: DocumentGraphOptions;
  /** Nodes with behaviour, in document order. */
  #nodes: ReadonlyMap<AnimatedElement, EventNode> = new Map();
  /** Nodes without behaviour at which routes end or begin. */
  readonly #drawnNodes = new Map<AnimatedElement, EventNode>();
  #timed: readonly TimedBehaviour[] = [];

  constructor(documents: AnimatedDocuments, graph: EventGraph, options: DocumentGraphOptions) {
    this.#documents = documents;
    this.#graph = graph;
    this.#options = options;
  }

  /** Nodes with behaviour by their elements, in document order. */
  get nodes(): ReadonlyMap<AnimatedElement, EventNode> {
    return this.#nodes;
  }

  /** The elements with behaviour or with routes. */
  get elements(): Iterable<AnimatedElement> {
    return [...this.#nodes.keys(), ...this.#drawnNodes.keys()];
  }

  /** The node of an element, with behaviour or with routes; undefined for others. */
  nodeOf(element: AnimatedElement): EventNode | undefined {
    return this.#nodes.get(element) ?? this.#drawnNodes.get(element);
  }

  /** The behaviours that depend on time, in document order. */
  get timed(): readonly TimedBehaviour[] {
    return this.#timed;
  }

  /** Reads nodes and routes again. */
  read(): void {
    const before = this.#nodes;
    const nodes = new Map<AnimatedElement, EventNode>();
    const names = new DocumentNames(this.#documents, (element) => {
      const node = before.get(element) ?? this.#makeNode(element);
      if (node) nodes.set(element, node);
    });
    for (const node of [...nodes.values(), ...this.#drawnNodes.values()]) node.clearRoutes();
    this.#drawnNodes.clear();
    this.#nodes = nodes;
    for (const node of before.values()) node.element = undefined;
    for (const [element, node] of nodes) node.element = element;
    this.#timed = Array.from(nodes.values(), ({ behaviour }) => behaviour).filter(isTimed);
    for (const { label, route, ends } of names.routes()) this.#addRoute(label, route, ends);
    for (const { node, name } of fieldsInCircles([...nodes.values(), ...this.#drawnNodes.values()]))
      this.#options.warn(`${node.name} ${name}: ROUTEs lead back to it; an event goes around this circle once`);
  }

  /**
   * A script has set or removed an attribute. Returns whether a node has taken it as an event. `lag`: how much the
   * scene's time is behind the clock, by which scripts state times.
   */
  attributeChanged(element: AnimatedElement, attribute: string, time: number, lag: number): boolean {
    const node = this.nodeOf(element);
    const field = node && inputOf(node, attribute);
    const specification = field === undefined ? undefined : node?.specificationOf(field);
    if (!node || field === undefined || !specification || specification.access === "outputOnly") return false;
    const text = element.getAttribute(attribute);
    const value = text === null ? specification.defaultValue : specification.type.parse(text);
    if (value === undefined) {
      if (text !== null && text.trim() !== "")
        this.#options.warn(
          `${node.name} ${attribute}="${shortened(text)}" is no ${specification.type.name} and has no effect`,
        );
      return false;
    }
    const inScene = field.endsWith("Time") && typeof value === "number" && value > 0 ? value - lag : value;
    this.#graph.run(time, () => {
      if (this.#drawnNodes.get(element) === node) node.send(field, value);
      else node.receive(field, inScene, time);
    });
    return true;
  }

  #makeNode(element: AnimatedElement): EventNode | undefined {
    const found = nodeTypeOf(element.localName);
    if (!found) return undefined;
    const { name, type } = found;
    const node = new EventNode(labelOf(element, name), type.fields, this.#graph, type.makeBehaviour);
    for (const [field, { type: fieldType, access }] of type.fields) {
      if (access === "outputOnly" || access === "inputOnly") continue;
      const text = attributeIn(element, field);
      if (text === undefined) continue;
      const value = fieldType.parse(text);
      if (value !== undefined) node.initialize(field, value);
      else this.#options.warn(`${node.name} ${field}="${shortened(text)}" is no ${fieldType.name}: its default counts`);
    }
    return node;
  }

  #addRoute(label: string, { fromField, toField }: StatedRoute, [begin, end]: readonly NamedNode[]): void {
    if (begin === undefined || end === undefined) return;
    const { element: source } = begin;
    const { element: target } = end;
    if (source === undefined || target === undefined) {
      this.#options.warn(`${label}: ${begin.fault ?? end.fault ?? ""}; the route has no effect`);
      return;
    }
    const from = this.#portOf(source, fromField, "output");
    const to = this.#portOf(target, toField, "input");
    if (from === undefined || to === undefined) {
      const [element, field, kind] = from === undefined ? [source, fromField, "output"] : [target, toField, "input"];
      this.#options.warn(`${label}: ${labelOf(element)} has no ${kind} ${field}; the route has no effect`);
      return;
    }
    const [given, expected] = [from.specification.type, to.specification.type];
    if (!mayRoute(given, expected)) {
      this.#options.warn(`${label}: ${given.name} is no ${expected.name}; the route has no effect`);
      return;
    }
    from.node.addRoute(from.field, { node: to.node, field: to.field });
  }

  #portOf(
    element: AnimatedElement,
    name: string,
    direction: "input" | "output",
  ): { node: EventNode; field: string; specification: FieldSpecification } | undefined {
    const node = this.#nodes.get(element) ?? this.#drawnNodeWith(element, name);
    const field = node && (direction === "input" ? inputOf(node, name) : outputOf(node, name));
    const specification = field === undefined ? undefined : node?.specificationOf(field);
    return node && field !== undefined && specification ? { node, field, specification } : undefined;
  }

  /** The node of an element that is drawn, with the field that a route names. */
  #drawnNodeWith(element: AnimatedElement, name: string): EventNode | undefined {
    let node = this.#drawnNodes.get(element);
    for (const candidate of namesOf(name)) {
      if (node?.specificationOf(candidate)) return node;
      const read = this.#options.drawnFieldOf(element, candidate);
      const field = read?.name ?? candidate;
      const type = fieldTypeOf(listTypeOf(element.localName, candidate) ?? read?.type ?? "");
      if (!type) continue;
      if (!node) {
        node = new EventNode(labelOf(element), new Map(), this.#graph, () => drawn);
        this.#drawnNodes.set(element, node);
      }
      const attribute = attributeNameIn(element, field) ?? field;
      const isOfPose = read?.isOfPose === true;
      const change: FieldChange = {
        element,
        field,
        attribute,
        type,
        isOfPose,
        value: "",
        isPending: false,
        isLate: false,
      };
      node.addField(candidate, { type, access: "inputOutput", defaultValue: undefined }, (value) => {
        change.value = value;
        if (change.isPending) return;
        change.isPending = true;
        this.#options.onChange(change);
      });
      return node;
    }
    return node;
  }
}

/** A field's name as ROUTEs and scripts write it: `translation`, `set_translation`, `translation_changed`. */
function namesOf(name: string): string[] {
  const stripped = name.replace(/^set_/i, "").replace(/_changed$/i, "");
  return Array.from(new Set([name, stripped]));
}

function fieldIn(node: EventNode, names: readonly string[], excluded: string): string | undefined {
  for (const name of names) {
    const lower = name.toLowerCase();
    for (const field of node.fieldNames)
      if (field.toLowerCase() === lower && node.specificationOf(field)?.access !== excluded) return field;
  }
  return undefined;
}

/** A node's field by a name as ROUTEs and scripts write it. */
export function fieldNamed(node: EventNode, name: string): string | undefined {
  return inputOf(node, name) ?? outputOf(node, name);
}

function inputOf(node: EventNode, name: string): string | undefined {
  return fieldIn(node, [...namesOf(name), `set_${namesOf(name).at(-1) ?? ""}`], "outputOnly");
}

function outputOf(node: EventNode, name: string): string | undefined {
  return fieldIn(node, [...namesOf(name), `${namesOf(name).at(-1) ?? ""}_changed`], "inputOnly");
}

function shortened(text: string): string {
  return text.length > 40 ? `${text.slice(0, 40)}…` : text;
}
