// Scopes of lights (ISO/IEC 19775-1, 17.2.1.2): a light that is not global lights its group's descendants only. A
// ClipPlane and a LocalFog have an effect on the same nodes, so that they share the scopes.
//
// A group with such nodes is a scope. Scopes are numbered in document order, each before the scopes inside it, so that
// a scope and its descendants form an interval of numbers. A drawn object needs the number of its innermost scope only,
// and a light the two ends of its interval, however many scopes there are.

export class LightScope {
  /** Undefined for the scope of the whole scene. */
  readonly parent: LightScope | undefined;
  /** Its number, 0 for the whole scene; named `value` because shaders take the object as their uniform. */
  value = 0;
  /** The number of the last scope inside it; its own number if there is none. */
  last = 0;

  constructor(parent: LightScope | undefined) {
    this.parent = parent;
  }

  /** Whether `other` is this scope or a descendant of it. */
  contains(other: LightScope): boolean {
    for (let scope: LightScope | undefined = other; scope !== undefined; scope = scope.parent)
      if (scope === this) return true;
    return false;
  }
}

/** The scope of global lights, and of objects that are in no other scope. */
export const sceneScope = new LightScope(undefined);
sceneScope.last = Infinity;

/** Numbers all scopes of a scene except `sceneScope`, given in document order; returns whether a number has changed. */
export function numberLightScopes(scopes: readonly LightScope[]): boolean {
  let hasChanged = false;
  const lastOf = new Map<LightScope, number>();
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
