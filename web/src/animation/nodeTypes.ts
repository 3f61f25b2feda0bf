// The table of nodes that send events.

import { eventUtilities } from "./eventUtilities.ts";
import { interpolators } from "./interpolators.ts";
import { movieTexture } from "./movieTexture.ts";
import type { NodeType } from "./nodeType.ts";
import { pointingSensors } from "./pointingSensors.ts";
import { timeSensor } from "./timeSensor.ts";
import { viewSensors } from "./viewSensors.ts";

export const nodeTypes: Readonly<Record<string, NodeType>> = {
  TimeSensor: timeSensor,
  MovieTexture: movieTexture,
  ...interpolators,
  ...eventUtilities,
  ...pointingSensors,
  ...viewSensors,
};

const byLowerName = new Map(Object.entries(nodeTypes).map(([name, type]) => [name.toLowerCase(), { name, type }]));

/** By the name of an element, in any case. */
export function nodeTypeOf(localName: string): { readonly name: string; readonly type: NodeType } | undefined {
  return byLowerName.get(localName.toLowerCase());
}
