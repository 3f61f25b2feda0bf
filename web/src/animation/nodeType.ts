// How the table of nodes states a kind of node: its fields, and what it does with events.

import type { Value } from "./fieldTypes.ts";
import { fieldType } from "./fieldTypes.ts";
import type { Access, Behaviour, EventNode, FieldSpecification } from "./eventNode.ts";

export interface NodeType {
  readonly fields: ReadonlyMap<string, FieldSpecification>;
  readonly makeBehaviour: (node: EventNode) => Behaviour;
}

function specification(access: Access) {
  return (type: string, defaultValue?: Value): FieldSpecification => ({ type: fieldType(type), access, defaultValue });
}

export const inputOnly = specification("inputOnly");
export const outputOnly = specification("outputOnly");
export const inputOutput = specification("inputOutput");
export const initializeOnly = specification("initializeOnly");

export function nodeType(
  fields: Readonly<Record<string, FieldSpecification>>,
  makeBehaviour: (node: EventNode) => Behaviour,
): NodeType {
  return { fields: new Map(Object.entries(fields)), makeBehaviour };
}
