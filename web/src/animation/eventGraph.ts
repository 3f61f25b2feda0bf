// X3D's event model (ISO/IEC 19775-1, 4.4.8): an event from outside starts a cascade, in which events follow the
// routes, all with the time of the first.

import type { Value } from "./fieldTypes.ts";
import type { EventNode, EventSink, Field } from "./eventNode.ts";

export interface EventGraphListener {
  /** A node has sent an event. Values of lists are not copied. */
  onEvent(field: Field, value: Value): void;
  onWarning(node: EventNode, message: string): void;
}

export class EventGraph implements EventSink {
  readonly #listener: EventGraphListener;
  /**
   * The inputs at which events of the present cascade arrive, and their values: two lists, without objects, as long as
   * in the longest cascade so far.
   */
  readonly #inputs: (Field | undefined)[] = [];
  readonly #values: (Value | undefined)[] = [];
  #count = 0;
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
      for (let at = 0; at < this.#count; ++at) {
        const input = this.#inputs[at];
        const value = this.#values[at];
        if (input !== undefined && value !== undefined) input.node.receiveAt(input, value, time);
      }
    } finally {
      this.#inputs.fill(undefined, 0, this.#count);
      this.#values.fill(undefined, 0, this.#count);
      this.#count = 0;
      this.#isRunning = false;
    }
  }

  sent(field: Field, value: Value): void {
    for (const input of field.routes) {
      this.#inputs[this.#count] = input;
      this.#values[this.#count] = value;
      this.#count += 1;
    }
    this.#listener.onEvent(field, value);
  }

  warn(node: EventNode, message: string): void {
    this.#listener.onWarning(node, message);
  }
}
