// The fields of drawn nodes that animation may set, and those of them that are displayed without reading the document.

import type { DrawnFieldOf, FieldChange } from "../animation/documentGraph.ts";
import type { TransformDescription } from "../document/description.ts";
import type { Field } from "../document/fieldTypes.ts";
import { nodeFields } from "../document/nodes.ts";
import type { PoseChange } from "../scene/instanceTree.ts";

const transforms: ReadonlySet<string> = new Set(["transform", "hanimjoint", "hanimsite", "hanimhumanoid"]);
const fieldsOfTransform: ReadonlySet<string> = new Set<keyof TransformDescription>([
  "translation",
  "rotation",
  "scale",
  "center",
  "scaleOrientation",
]);

const tables = new Map(
  Object.entries<Readonly<Record<string, Field<unknown>>>>(nodeFields).map(([node, fields]) => [
    node.toLowerCase(),
    new Map(Object.entries(fields).map(([name, { type }]) => [name.toLowerCase(), { name, type: type.name }])),
  ]),
);

/** A field of the runtime's table. */
export const drawnFieldOf: DrawnFieldOf = ({ localName }, field) => {
  const node = localName.toLowerCase();
  const found = tables.get(node)?.get(field.toLowerCase());
  if (found === undefined) return undefined;
  const isOfTransform = transforms.has(node) && fieldsOfTransform.has(found.name);
  return { ...found, isOfPose: isOfTransform || (node === "hanimdisplacer" && found.name === "weight") };
};

export function isOfPose(change: FieldChange): change is FieldChange & PoseChange {
  return change.isOfPose;
}
