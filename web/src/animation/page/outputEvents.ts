// Tells scripts of events: `outputchange` as X3DOM sends it, at the element of the node.

import type { AnimatedElement } from "../elements.ts";
import type { FieldType, Value } from "../fieldTypes.ts";
import { scriptValueOf } from "./scriptValues.ts";

class OutputChange extends Event {
  /** Whether a listener has read the value, and may have kept the event. */
  wasRead = false;
  #name = "";
  #type: FieldType | undefined;
  #value: Value = 0;

  constructor() {
    super("outputchange");
  }

  set(name: string, type: FieldType, value: Value): this {
    this.#name = name;
    this.#type = type;
    this.#value = value;
    return this;
  }

  /** The name of the output. */
  get fieldName(): string {
    this.wasRead = true;
    return this.#name;
  }

  get value(): unknown {
    this.wasRead = true;
    return this.#type && scriptValueOf(this.#type, this.#value);
  }
}

interface WithHandler {
  onoutputchange?: unknown;
}

/** The functions that scripts have set as `onoutputchange`. */
const handlers = new WeakMap<EventTarget, (event: Event) => void>();

function callHandler(this: Element, event: Event): void {
  handlers.get(this)?.call(this, event);
}

/** What the elements of nodes get: a property that is not asked for with each event. */
const handlerProperty: PropertyDescriptor & ThisType<Element> = {
  configurable: true,
  enumerable: true,
  get() {
    return handlers.get(this) ?? null;
  },
  set(handler: unknown) {
    this.removeEventListener("outputchange", callHandler);
    if (typeof handler !== "function") {
      handlers.delete(this);
      return;
    }
    handlers.set(this, handler as (event: Event) => void);
    this.addEventListener("outputchange", callHandler);
  },
};

/** Gives an element the property `onoutputchange`, as the elements of X3DOM have it. A function that it has stays. */
export function addOutputHandler(element: AnimatedElement): void {
  const target = element as unknown as Element & WithHandler;
  const { onoutputchange } = target;
  Object.defineProperty(target, "onoutputchange", handlerProperty);
  target.onoutputchange = onoutputchange;
}

export class OutputEvents {
  /** An event that no listener has read is sent again: a scene may send thousands in a frame that nobody listens to. */
  #unread: OutputChange | undefined;

  send(element: AnimatedElement, field: string, type: FieldType, value: Value): void {
    const event = (this.#unread ?? new OutputChange()).set(field, type, value);
    this.#unread = undefined; // while it is sent, a listener may cause others
    (element as unknown as Element).dispatchEvent(event);
    if (!event.wasRead) this.#unread = event;
  }
}
