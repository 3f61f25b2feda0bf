// The parts of the runtime that displaying a scene needs, besides those that reading it does.

import type { SceneDescription } from "../document/description.ts";
import type { PartName } from "../document/parts.ts";
import { minBatchedInstances } from "../document/parts.ts";
import { hasEnvironment } from "../scene/environmentIn.ts";
import { shapeInstancesIn } from "../scene/shapeInstances.ts";
import { beginsWithWalk } from "./walkingPart.ts";

export function partsToDisplay({ root, navigation }: SceneDescription): readonly PartName[] {
  const parts: PartName[] = shapeInstancesIn(root) < minBatchedInstances ? [] : ["batches"];
  if (hasEnvironment(root)) parts.push("environment");
  if (beginsWithWalk(navigation)) parts.push("walking");
  return parts;
}
