// The nodes on which a light that is not global, a ClipPlane or a LocalFog has an effect: the descendants of its group
// (of lights: ISO/IEC 19775-1, 17.2.1.2).
//
// A group with such nodes is a scope. Scopes are numbered in document order, each before the scopes inside it, so that
// a scope and its descendants form an interval of numbers. A drawn object needs the number of its innermost scope only,
// and a light the two ends of its interval, however many scopes there are.

export class EffectScope {
  /** Undefined for the scope of the whole scene. */
  readonly parent: EffectScope | undefined;
  /** Its number, 0 for the whole scene; named `value` because shaders take the object as their uniform. */
  value = 0;
  /** The number of the last scope inside it; its own number if there is none. */
  last = 0;

  constructor(parent: EffectScope | undefined) {
    this.parent = parent;
  }

  /** Whether `other` is this scope or a descendant of it. */
  contains(other: EffectScope): boolean {
    for (let scope: EffectScope | undefined = other; scope !== undefined; scope = scope.parent)
      if (scope === this) return true;
    return false;
  }
}

/** The scope of what has an effect on the whole scene, and of objects that are in no other scope. */
export const sceneScope = new EffectScope(undefined);
sceneScope.last = Infinity;

/** Numbers all scopes of a scene except `sceneScope`, given in document order; returns whether a number has changed. */
export function numberEffectScopes(scopes: readonly EffectScope[]): boolean {
  let hasChanged = false;
  const lastOf = new Map<EffectScope, number>();
  for (const [i, scope] of Array.from(scopes.entries()).reverse()) {
    const number = i + 1;
    const last = lastOf.get(scope) ?? number;
    if (scope.parent !== undefined) lastOf.set(scope.parent, Math.max(lastOf.get(scope.parent) ?? 0, last));
    hasChanged ||= scope.value !== number || scope.last !== last;
    scope.value = number;
    scope.last = last;
  }
  return hasChanged;
}
