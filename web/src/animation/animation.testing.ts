// A scene with animation for tests without a browser: elements that can be changed, and a clock that tests set.

import type { DrawnFieldOf, FieldChange } from "./documentGraph.ts";
import type { AnimatedElement } from "./elements.ts";
import { AnimationPlayer } from "./player.ts";
import type { Value } from "./fieldTypes.ts";

export class TestElement implements AnimatedElement {
  readonly localName: string;
  readonly children: TestElement[] = [];
  readonly parentElement: TestElement | null;
  readonly #attributes = new Map<string, string>();

  constructor(localName: string, parent: TestElement | null) {
    this.localName = localName;
    this.parentElement = parent;
    parent?.children.push(this);
  }

  getAttribute(name: string): string | null {
    return this.#attributes.get(name) ?? null;
  }

  getAttributeNames(): string[] {
    return Array.from(this.#attributes.keys());
  }

  setAttribute(name: string, value: string): void {
    this.#attributes.set(name, value);
  }

  /** The element below with this DEF. */
  named(name: string): TestElement {
    const found = this.find(name);
    if (found === undefined) throw new Error(`there is no ${name}`);
    return found;
  }

  private find(name: string): TestElement | undefined {
    if (this.getAttribute("DEF") === name) return this;
    for (const child of this.children) {
      const found = child.find(name);
      if (found) return found;
    }
    return undefined;
  }
}

/** Reads tags and attributes; every tag is `<name …>`, `<name …/>` or `</name>`. */
export function sceneOf(markup: string): TestElement {
  const root = new TestElement("Scene", null);
  let parent = root;
  for (const [, slash, name = "", attributes = "", selfClosing] of markup.matchAll(
    /<(\/)?(\w+)((?:\s+\w+="[^"]*")*)\s*(\/)?>/g,
  )) {
    if (slash !== undefined) {
      parent = parent.parentElement ?? root;
      continue;
    }
    const element = new TestElement(name, parent);
    for (const [, key = "", value = ""] of attributes.matchAll(/(\w+)="([^"]*)"/g)) element.setAttribute(key, value);
    if (selfClosing === undefined) parent = element;
  }
  return root;
}

/** ROUTEs of "from.field to.field" each. */
export function routes(...texts: readonly string[]): string {
  return texts
    .map((text) => text.split(/[. ]/))
    .map(
      ([fromNode = "", fromField = "", toNode = "", toField = ""]) =>
        `<ROUTE fromNode="${fromNode}" fromField="${fromField}" toNode="${toNode}" toField="${toField}"/>`,
    )
    .join("");
}

/** Types of fields that tests use. */
const drawnFields: Readonly<Record<string, Readonly<Record<string, string>>>> = {
  transform: { translation: "SFVec3f", rotation: "SFRotation", scale: "SFVec3f" },
  material: { diffuseColor: "SFColor", transparency: "SFFloat" },
  switch: { whichChoice: "SFInt32" },
  pointlight: { on: "SFBool", intensity: "SFFloat" },
  coordinate: { point: "MFFloat" },
};

export const startOfTests = 1_000_000;

export interface TestScene {
  readonly root: TestElement;
  readonly player: AnimationPlayer;
  /** All events of nodes with behaviour, as "DEF.field value". */
  readonly events: string[];
  readonly warnings: string[];
  /** How often values have been handed on. */
  readonly frames: number;
  /** The value of a drawn node's field that was handed on last. */
  drawn(name: string, field: string): Value | undefined;
  /** Goes to a time, in seconds after the start, and draws a frame there if one is due. */
  frameAt(seconds: number): void;
  /** Goes to a time without a frame. */
  at(seconds: number): void;
  /** Seconds until the next frame; undefined while none is planned. */
  readonly delay: number | undefined;
  /** Sets an attribute as a script does. */
  set(name: string, attribute: string, value: string): void;
}

/** The fields of the few nodes that tests draw. */
export const drawnFieldOf: DrawnFieldOf = (element, field) => {
  const fields = drawnFields[element.localName.toLowerCase()] ?? {};
  const name = Object.keys(fields).find((candidate) => candidate.toLowerCase() === field.toLowerCase());
  return name === undefined ? undefined : { name, type: fields[name] ?? "", isOfPose: false };
};

/** `inlined`: the documents that have loaded, by the DEF of their Inline. */
export function play(
  markup: string,
  mayStartByItself = true,
  inlined: Readonly<Record<string, string>> = {},
): TestScene {
  const root = sceneOf(markup);
  const documents = new Map(Object.entries(inlined).map(([name, text]) => [name, sceneOf(text)]));
  const events: string[] = [];
  const warnings: string[] = [];
  const drawn = new Map<string, Value>();
  let now = startOfTests;
  let frames = 0;
  let scheduled: { callback: () => void; delay: number; at: number } | undefined;
  const nameOf = (element: AnimatedElement): string => element.getAttribute("DEF") ?? element.localName;
  const player = new AnimationPlayer(
    {
      roots: [root, ...documents.values()],
      documentOf: (inline) => documents.get(inline.getAttribute("DEF") ?? ""),
    },
    {
      now: () => now,
      schedule(callback, delay) {
        scheduled = { callback, delay, at: now + delay };
        return () => (scheduled = undefined);
      },
    },
    {
      drawnFieldOf,
      apply(changes: readonly FieldChange[]) {
        frames += 1;
        for (const { element, field, value } of changes) drawn.set(`${nameOf(element)}.${field}`, value);
      },
      writeAttribute(element, field, text) {
        element.setAttribute(field, text);
      },
      onEvent(element, field, _, value) {
        events.push(`${nameOf(element)}.${field} ${String(value)}`);
      },
      warn: (message) => warnings.push(message),
    },
    mayStartByItself,
  );
  player.read();
  return {
    root,
    player,
    events,
    warnings,
    get frames() {
      return frames;
    },
    drawn: (name, field) => drawn.get(`${name}.${field}`),
    at(seconds) {
      now = startOfTests + seconds;
    },
    frameAt(seconds) {
      now = startOfTests + seconds;
      if (scheduled === undefined || scheduled.at > now + 1e-9) return;
      const { callback } = scheduled;
      scheduled = undefined;
      callback();
    },
    get delay() {
      return scheduled?.delay;
    },
    set(name, attribute, value) {
      const element = root.named(name);
      element.setAttribute(attribute, value);
      player.attributeChanged(element, attribute);
    },
  };
}
