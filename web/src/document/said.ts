// What elements say: nodes of the scene where they stand, and things that count for
// the scene as a whole. What has nothing to say says one and the same nothing.

import type {
  BackgroundDescription,
  InlineDescription,
  NavigationDescription,
  NodeDescription,
} from "./description.ts";
import type { SceneElement } from "./element.ts";
import type { Warning } from "./nodes.ts";

export interface Said {
  /** In document order. */
  readonly nodes: readonly NodeDescription[];
  readonly asides: Asides;
}

/** Lists are in document order. */
export interface Asides {
  readonly warnings: readonly Warning[];
  readonly inlines: readonly InlineDescription[];
  /** The one that counts of these. */
  readonly navigation: NavigationDescription | undefined;
  /** The first. */
  readonly background: BackgroundDescription | undefined;
}

export const noAsides: Asides = { warnings: [], inlines: [], navigation: undefined, background: undefined };

/** What groups hand down to what stands in them. */
export interface Inherited {
  readonly visible: boolean;
  /** The same, but that every level of a LOD is seen. */
  readonly reaches: boolean;
  readonly priority: number;
}

/** What these elements say where groups around them hand this down. */
export type Below = (elements: readonly SceneElement[], inherited: Inherited) => Said;

/** What an element says, as far as itself and what it USEs tell; the rest is told by who asks. */
export type Saying = (inherited: Inherited, below: Below) => Said;

export function asidesOf(asides: Partial<Asides>): Asides {
  return { ...noAsides, ...asides };
}

export function warned(warnings: readonly Warning[]): Asides {
  return warnings.length === 0 ? noAsides : asidesOf({ warnings });
}

/** Asides one after the other. */
export function joined(all: readonly Asides[]): Asides {
  const some = all.filter((asides) => asides !== noAsides);
  const [only = noAsides] = some;
  if (some.length < 2) return only;
  return {
    warnings: some.flatMap(({ warnings }) => warnings),
    inlines: some.flatMap(({ inlines }) => inlines),
    navigation: some.map(({ navigation }) => navigation).reduce(laterOf),
    background: some.find(({ background }) => background)?.background,
  };
}

/** Of two NavigationInfos in document order the first counts, unless the second wants to be bound. */
function laterOf(
  first: NavigationDescription | undefined,
  second: NavigationDescription | undefined,
): NavigationDescription | undefined {
  if (first === undefined || second === undefined) return first ?? second;
  return second.set_bind || second.bind ? second : first;
}
