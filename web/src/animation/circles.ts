// Routes in circles: X3D lets them end, since a field sends one event in a cascade at most, but authors rarely mean them.

import type { EventNode, Field } from "./eventNode.ts";

/** The fields that may send an event, at once, when one arrives at this field. */
function answersTo(field: Field): Iterable<Field> {
  return field.specification.access === "inputOnly" ? field.node.outputs() : [field];
}

/** A field at which a walk along the routes is, and where it goes next. */
interface Step {
  readonly field: Field;
  readonly next: Iterator<Field, void>;
}

function* fieldsAfter({ routes }: Field): Generator<Field, void> {
  for (const input of routes) yield* answersTo(input);
}

/** For each circle of routes a field whose events come back to it. Takes a time proportional to the routes. */
export function fieldsInCircles(nodes: Iterable<EventNode>): readonly Field[] {
  const closing: Field[] = [];
  /** True while the walk is at the field or behind it. */
  const isOpen = new Map<Field, boolean>();
  for (const node of nodes)
    for (const start of node.outputs()) {
      const walk: Step[] = [];
      const enter = (field: Field): void => {
        if (isOpen.get(field) === true) closing.push(field);
        if (isOpen.has(field) || field.routes.length === 0) return;
        isOpen.set(field, true);
        walk.push({ field, next: fieldsAfter(field) });
      };
      enter(start);
      for (let step = walk.at(-1); step !== undefined; step = walk.at(-1)) {
        const after = step.next.next();
        if (after.done !== true) enter(after.value);
        else {
          isOpen.set(step.field, false);
          walk.pop();
        }
      }
    }
  return Array.from(new Set(closing));
}
