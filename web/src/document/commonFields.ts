// Fields that nodes of several kinds have.

import { Priority, SFVec3f } from "./fieldTypes.ts";

/** Download priority, multiplied down the tree. */
export const prioritized = { priority: Priority(1) };

export const boundedObject = {
  bboxCenter: SFVec3f([0, 0, 0]),
  bboxSize: SFVec3f([-1, -1, -1]),
};
