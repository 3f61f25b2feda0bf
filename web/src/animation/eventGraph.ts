// X3D's event model (ISO/IEC 19775-1, 4.4.8): an event from outside starts a cascade, in which events follow the
// routes, all with the time of the first.

import type { Value } from "./fieldTypes.ts";
import type { Destination, EventNode, EventSink } from "./eventNode.ts";

export interface EventGraphListener {
  /** A node has sent an event. Values of lists are not copied. */
  onEvent(node: EventNode, field: string, value: Value): void;
  onWarning(node: EventNode, message: string): void;
}

interface Delivery {
  readonly destination: Destination;
  readonly value: Value;
}

export class EventGraph implements EventSink {
  readonly #listener: EventGraphListener;
  readonly #queue: Delivery[] = [];
  #cascade = 0;
  #isRunning = false;

  constructor(listener: EventGraphListener) {
    this.#listener = listener;
  }

  get cascade(): number {
    return this.#cascade;
  }

  /** Sends the events of `begin`, and those that follow from them, in the order of their causes. `time` in seconds. */
  run(time: number, begin: () => void): void {
    if (this.#isRunning) {
      begin(); // by a listener: part of the cascade that runs
      return;
    }
    this.#isRunning = true;
    this.#cascade += 1;
    try {
      begin();
      // Events that a node sends are appended while the loop runs.
      for (const { destination, value } of this.#queue) destination.node.receive(destination.field, value, time);
    } finally {
      this.#queue.length = 0;
      this.#isRunning = false;
    }
  }

  sent(node: EventNode, field: string, value: Value, routes: readonly Destination[]): void {
    for (const destination of routes) this.#queue.push({ destination, value });
    this.#listener.onEvent(node, field, value);
  }

  warn(node: EventNode, message: string): void {
    this.#listener.onWarning(node, message);
  }
}
