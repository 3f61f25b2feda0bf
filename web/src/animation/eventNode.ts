// A node that receives and sends events: its fields with their values, and the routes that begin at them.

import type { AnimatedElement } from "./elements.ts";
import type { FieldType, Value } from "./fieldTypes.ts";

/** X3D's access types (ISO/IEC 19775-1, 4.4.2.2). An attribute sets the first value of fields that are not outputs. */
export type Access = "inputOnly" | "outputOnly" | "inputOutput" | "initializeOnly";

export interface FieldSpecification {
  readonly type: FieldType;
  readonly access: Access;
  /** Undefined for fields that have no value before their first event. */
  readonly defaultValue: Value | undefined;
}

export type FieldSpecifications = ReadonlyMap<string, FieldSpecification>;

/** A field of a node, and what has happened to it. */
export interface Field {
  readonly node: EventNode;
  readonly name: string;
  readonly specification: FieldSpecification;
  value: Value | undefined;
  /** Where the routes end that begin at it. */
  readonly routes: Field[];
  /** The last cascade in which it has sent an event. */
  cascade: number;
  /** Called with the value of each event that arrives. */
  readonly onValue: ((value: Value) => void) | undefined;
}

/** What a kind of node does with events. */
export interface Behaviour {
  /**
   * An event has arrived, or a script has set the field. The values of inputOutput fields are set, and sent, before.
   * `time`: of the cascade, in seconds.
   */
  receive(field: string, value: Value, time: number): void;
  /** Called in every frame in which clocks run, for behaviours that depend on time alone. */
  tick?(time: number): void;
  /** The earliest time at which `tick` may do something: undefined where it never does without an event. */
  nextTick?(time: number): number | undefined;
}

/** What nodes send their events through. */
export interface EventSink {
  /** The number of the present cascade. */
  readonly cascade: number;
  /** A node has sent an event, which goes along the field's routes. */
  sent(field: Field, value: Value): void;
  /** One sentence without subject: what is wrong with the node. */
  warn(node: EventNode, message: string): void;
}

export class EventNode {
  /** The node's name in messages, such as `PositionInterpolator DEF="move"`. */
  readonly name: string;
  /** That of a node with behaviour, while it is in the document. */
  element: AnimatedElement | undefined;
  readonly #fields = new Map<string, Field>();
  readonly #sink: EventSink;
  readonly behaviour: Behaviour;

  constructor(
    name: string,
    specifications: FieldSpecifications,
    sink: EventSink,
    makeBehaviour: (node: EventNode) => Behaviour,
  ) {
    this.name = name;
    this.#sink = sink;
    for (const [field, specification] of specifications) this.addField(field, specification);
    this.behaviour = makeBehaviour(this);
  }

  /** `onValue` is called with the value of each event that arrives at the field. */
  addField(field: string, specification: FieldSpecification, onValue?: (value: Value) => void): void {
    const value = specification.defaultValue;
    this.#fields.set(field, { node: this, name: field, specification, value, routes: [], cascade: -1, onValue });
  }

  specificationOf(field: string): FieldSpecification | undefined {
    return this.#fields.get(field)?.specification;
  }

  fieldOf(field: string): Field | undefined {
    return this.#fields.get(field);
  }

  get fieldNames(): IterableIterator<string> {
    return this.#fields.keys();
  }

  /** The fields that send events. */
  *outputs(): Generator<Field> {
    for (const field of this.#fields.values()) {
      const { access } = field.specification;
      if (access === "outputOnly" || access === "inputOutput") yield field;
    }
  }

  /** The value of a field, or of its last event. */
  valueOf(field: string): Value | undefined {
    return this.#fields.get(field)?.value;
  }

  numberOf(field: string): number {
    return this.valueOf(field) as number;
  }

  isTrue(field: string): boolean {
    return this.valueOf(field) === true;
  }

  numbersOf(field: string): readonly number[] {
    return this.valueOf(field) as readonly number[];
  }

  /** Sets a value without an event. */
  initialize(field: string, value: Value): void {
    const known = this.#fields.get(field);
    if (known) known.value = value;
  }

  addRoute(field: string, { node, field: input }: { readonly node: EventNode; readonly field: string }): void {
    const destination = node.#fields.get(input);
    if (destination) this.#fields.get(field)?.routes.push(destination);
  }

  /** Removes all routes that begin at the node. */
  clearRoutes(): void {
    for (const { routes } of this.#fields.values()) routes.length = 0;
  }

  /** An event arrives at an input. */
  receive(field: string, value: Value, time: number): void {
    const known = this.#fields.get(field);
    if (known) this.receiveAt(known, value, time);
  }

  /** An event arrives at one of the node's own fields. */
  receiveAt(field: Field, value: Value, time: number): void {
    if (field.specification.access === "inputOutput") this.sendFrom(field, value);
    else field.value = value;
    field.onValue?.(value);
    this.behaviour.receive(field.name, value, time);
  }

  /**
   * Sends an event from an output. A field sends one event in a cascade at most, so that routes in circles end
   * (ISO/IEC 19775-1, 4.4.8.4).
   */
  send(field: string, value: Value): void {
    const known = this.#fields.get(field);
    if (known) this.sendFrom(known, value);
  }

  /** As `send`, from one of the node's own fields. */
  sendFrom(field: Field, value: Value): void {
    const { cascade } = this.#sink;
    if (field.cascade === cascade) return;
    field.cascade = cascade;
    field.value = value;
    this.#sink.sent(field, value);
  }

  warn(message: string): void {
    this.#sink.warn(this, message);
  }
}
