// Reads the fields of a node, with the numbers that animation has given them.

import type { Warning } from "./description.ts";
import type { SceneElement } from "./element.ts";
import type { MovingValues } from "./movingValues.ts";
import type { Values } from "./nodes.ts";
import { readFields } from "./nodes.ts";

export function readMovingFields<NodeFields extends Parameters<typeof readFields>[1]>(
  element: SceneElement,
  fields: NodeFields,
  warnings: Warning[],
  moving: MovingValues | undefined,
): Values<NodeFields> {
  return { ...readFields(element, fields, warnings), ...moving?.fieldsOf(element) };
}
