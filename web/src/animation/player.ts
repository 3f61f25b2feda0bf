// Plays a document's animation: once for each frame it advances the clocks, sends their events and those of the pointer
// and the camera along the routes, and applies the changed fields to the scene.

import type { AnimatedDocuments } from "./documents.ts";
import type { DrawnFieldOf, FieldChange } from "./documentGraph.ts";
import { DocumentGraph, fieldNamed } from "./documentGraph.ts";
import type { AnimatedElement } from "./elements.ts";
import { EventGraph } from "./eventGraph.ts";
import type { EventNode, Field } from "./eventNode.ts";
import type { FieldType, Value } from "./fieldTypes.ts";
import { isOfType } from "./fieldTypes.ts";
import { TimeSensor } from "./timeSensor.ts";

/** Where the player gets its time from. */
export interface Clock {
  /** Seconds since 1970, as X3D's SFTime. */
  now(): number;
  /** Calls back once before the next frame, or after `delay` seconds. Returns a function that cancels the call. */
  schedule(callback: () => void, delay: number): () => void;
}

export interface PlayerHost {
  readonly drawnFieldOf: DrawnFieldOf;
  /** Fields of drawn nodes have received values: one entry for each field. */
  apply(changes: readonly FieldChange[]): void;
  /** A field of a node with behaviour has received a value from an event; its attribute follows. */
  writeAttribute(element: AnimatedElement, field: string, text: string): void;
  /** A node with behaviour has sent an event. */
  onEvent(element: AnimatedElement, field: string, type: FieldType, value: Value): void;
  /** One sentence. */
  warn(message: string): void;
}

/** A longer wait is one of several shorter ones, since timers count milliseconds in 32 bits. */
const maxDelay = 1e6;

export class AnimationPlayer {
  readonly #clock: Clock;
  readonly #host: PlayerHost;
  readonly #graph: EventGraph;
  readonly #document: DocumentGraph;
  readonly #pending: FieldChange[] = [];
  /** How much the scene's time is behind the clock's, in seconds: the time for which it has been paused. */
  #lag = 0;
  #pausedAt: number | undefined;
  #mayStartByItself: boolean;
  #cancelTick: (() => void) | undefined;
  /** Fields of nodes with behaviour whose attributes are out of date. */
  readonly #outdated = new Map<EventNode, Set<string>>();
  #isDisposed = false;

  /** `mayStartByItself`: whether clocks run that no event has started. */
  constructor(documents: AnimatedDocuments, clock: Clock, host: PlayerHost, mayStartByItself = true) {
    this.#clock = clock;
    this.#host = host;
    this.#mayStartByItself = mayStartByItself;
    this.#graph = new EventGraph({
      onEvent: (field, value) => {
        this.#onEvent(field, value);
      },
      onWarning: (node, message) => {
        host.warn(`${node.name} ${message}`);
      },
    });
    this.#document = new DocumentGraph(documents, this.#graph, {
      drawnFieldOf: host.drawnFieldOf,
      onChange: (change) => {
        this.#pending.push(change);
      },
      warn: (message) => {
        host.warn(message);
      },
    });
  }

  /** Seconds since 1970, without the time for which the scene has been paused. */
  get time(): number {
    return (this.#pausedAt ?? this.#clock.now()) - this.#lag;
  }

  /** The nodes with behaviour by their elements, in document order. */
  get nodes(): ReadonlyMap<AnimatedElement, EventNode> {
    return this.#document.nodes;
  }

  /** Whether a clock runs, so that the next frame may differ. */
  get isMoving(): boolean {
    return this.#cancelTick !== undefined && this.#pausedAt === undefined;
  }

  /** Reads nodes and routes, for the first time or again. */
  read(): void {
    this.#document.read();
    this.#applyMotionRule();
    this.#tickSoon();
  }

  set isPaused(isPaused: boolean) {
    if (isPaused === (this.#pausedAt !== undefined)) return;
    if (isPaused) {
      this.#pausedAt = this.#clock.now();
      this.#cancelTick?.();
      this.#cancelTick = undefined;
      return;
    }
    this.#lag += this.#clock.now() - (this.#pausedAt ?? 0);
    this.#pausedAt = undefined;
    this.#tickSoon();
  }

  set mayStartByItself(mayStart: boolean) {
    if (mayStart === this.#mayStartByItself) return;
    this.#mayStartByItself = mayStart;
    this.#applyMotionRule();
    this.#tickSoon();
  }

  /** A script has set or removed an attribute. Returns whether a node has taken it as an event. */
  attributeChanged(element: AnimatedElement, attribute: string): boolean {
    const isEvent = this.#document.attributeChanged(element, attribute, this.time, this.#lag);
    if (isEvent) this.flush();
    return isEvent;
  }

  /** Sends events from outside, such as a sensor's, with the present time. What they change is handed on at once. */
  run(begin: (time: number) => void): void {
    const { time } = this;
    this.#graph.run(time, () => {
      begin(time);
    });
    this.flush();
  }

  /** All elements with behaviour or with routes. */
  get elements(): Iterable<AnimatedElement> {
    return this.#document.elements;
  }

  /**
   * A field by a name as scripts write it, with its value or that of its last event; undefined where there is no such
   * field.
   */
  fieldOf(
    element: AnimatedElement,
    name: string,
  ): { readonly field: string; readonly type: FieldType; readonly value: Value | undefined } | undefined {
    const node = this.#document.nodeOf(element);
    const field = node && fieldNamed(node, name);
    const type = field === undefined ? undefined : node?.specificationOf(field)?.type;
    return field !== undefined && type ? { field, type, value: node?.valueOf(field) } : undefined;
  }

  /** Sends a value to a field, as an event. Returns false if there is no such field, or the value has another type. */
  setValue(element: AnimatedElement, field: string, value: unknown): boolean {
    const node = this.#document.nodeOf(element);
    const specification = node?.specificationOf(field);
    if (!node || !specification || specification.access === "outputOnly" || !isOfType(value, specification.type))
      return false;
    this.run((time) => {
      node.receive(field, value, time);
    });
    return true;
  }

  /** Hands on what has changed, and plans the next frame. */
  flush(): void {
    for (const [node, fields] of this.#outdated) {
      const { element } = node;
      for (const field of fields) {
        const value = node.valueOf(field);
        const type = node.specificationOf(field)?.type;
        if (element && type && value !== undefined) this.#host.writeAttribute(element, field, type.format(value));
      }
    }
    this.#outdated.clear();
    if (this.#pending.length > 0) {
      const changes = this.#pending.splice(0);
      for (const change of changes) change.isPending = false;
      this.#host.apply(changes);
    }
    this.#tickSoon();
  }

  dispose(): void {
    this.#isDisposed = true;
    this.#cancelTick?.();
  }

  #onEvent({ node, name, specification: { type, access } }: Field, value: Value): void {
    const { element } = node;
    if (element === undefined) return;
    this.#host.onEvent(element, name, type, value);
    if (access !== "inputOutput") return;
    const fields = this.#outdated.get(node);
    if (fields) fields.add(name);
    else this.#outdated.set(node, new Set([name]));
  }

  #applyMotionRule(): void {
    const { time } = this;
    for (const behaviour of this.#document.timed)
      if (behaviour instanceof TimeSensor) behaviour.setMayStartByItself(this.#mayStartByItself, time);
  }

  /** Plans the next tick for the time at which a node needs it. */
  #tickSoon(): void {
    this.#cancelTick?.();
    this.#cancelTick = undefined;
    if (this.#isDisposed || this.#pausedAt !== undefined) return;
    const { time } = this;
    let next = Infinity;
    for (const behaviour of this.#document.timed) next = Math.min(next, behaviour.nextTick(time) ?? Infinity);
    if (next < Infinity)
      this.#cancelTick = this.#clock.schedule(
        () => {
          this.#tick();
        },
        Math.min(maxDelay, Math.max(0, next - time)),
      );
  }

  #tick(): void {
    this.#cancelTick = undefined;
    const { time } = this;
    for (const behaviour of this.#document.timed)
      this.#graph.run(time, () => {
        behaviour.tick(time);
      });
    this.flush();
  }
}
