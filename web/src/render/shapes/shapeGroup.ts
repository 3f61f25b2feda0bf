// The three.js group that holds one instance of a shape.

import type { Group } from "three";
import type { EffectScope } from "../../scene/effectScope.ts";

export interface ShapeGroup extends Group {
  /** The innermost effect scope around the instance; undefined: that of the whole scene. */
  effectScope?: EffectScope;
}
