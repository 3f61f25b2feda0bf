// The scopes (scene/effectScope.ts) that an effect reaches, as shaders test them.

import { Vector2 } from "three";
import type { EffectScope } from "../../scene/effectScope.ts";

/** The shader compares scope numbers as floats, which are exact up to here. */
const maxScopeNumber = 2 ** 24;

/** The first and the last number of a scope and the scopes inside it. */
export function scopeRangeOf({ value, last }: EffectScope): Vector2 {
  return new Vector2(value, Math.min(last, maxScopeNumber));
}
