// What lights reach (ISO/IEC 19775-1, 17.2.1.2): one that is not global shines on
// what stands in its group, at any depth, and on nothing else.
//
// A group with such lights is a scope. Scopes are numbered in document order, each
// before those in it, so that a scope and all in it are an interval of numbers: of
// what is drawn the innermost scope's number is enough, of a light the interval's
// two ends, however many scopes there are.

export class LightScope {
  /** Undefined of the whole scene. */
  readonly parent: LightScope | undefined;
  /** Its number, as a uniform has it; of the whole scene 0. */
  value = 0;
  /** The number of the last scope in it; its own where there is none. */
  last = 0;

  constructor(around: LightScope | undefined) {
    this.parent = around;
  }

  /** Whether it is the other one or has it in it. */
  contains(other: LightScope): boolean {
    for (let scope: LightScope | undefined = other; scope !== undefined; scope = scope.parent)
      if (scope === this) return true;
    return false;
  }
}

/** That of global lights, and of what stands in no scope. */
export const sceneScope = new LightScope(undefined);
sceneScope.last = Infinity;

/** Numbers all scopes of a scene but `everywhere`, which come in document order; whether one has another number than before. */
export function numberLightScopes(scopes: readonly LightScope[]): boolean {
  let isOther = false;
  const lasts = new Map<LightScope, number>();
  for (const [i, scope] of Array.from(scopes.entries()).reverse()) {
    const number = i + 1;
    const last = lasts.get(scope) ?? number;
    if (scope.parent !== undefined) lasts.set(scope.parent, Math.max(lasts.get(scope.parent) ?? 0, last));
    isOther ||= scope.value !== number || scope.last !== last;
    scope.value = number;
    scope.last = last;
  }
  return isOther;
}
