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

export interface SceneFragment {
  /** In document order. */
  readonly nodes: readonly NodeDescription[];
  readonly declarations: SceneDeclarations;
}

/** Lists are in document order. */
export interface SceneDeclarations {
  readonly warnings: readonly Warning[];
  readonly inlines: readonly InlineDescription[];
  /** The one that counts of these. */
  readonly navigation: NavigationDescription | undefined;
  /** The first. */
  readonly background: BackgroundDescription | undefined;
}

export const noDeclarations: SceneDeclarations = {
  warnings: [],
  inlines: [],
  navigation: undefined,
  background: undefined,
};

/** What groups hand down to what stands in them. */
export interface Inherited {
  readonly visible: boolean;
  /** The same, but that every level of a LOD is seen. */
  readonly contributesToBounds: boolean;
  readonly priority: number;
}

/** What these elements say where groups around them hand this down. */
export type ReadChildren = (elements: readonly SceneElement[], inherited: Inherited) => SceneFragment;

/** What an element says, as far as itself and what it USEs tell; the rest is told by who asks. */
export type FragmentReader = (inherited: Inherited, below: ReadChildren) => SceneFragment;

export function declarationsOf(asides: Partial<SceneDeclarations>): SceneDeclarations {
  return { ...noDeclarations, ...asides };
}

export function warningsOnly(warnings: readonly Warning[]): SceneDeclarations {
  return warnings.length === 0 ? noDeclarations : declarationsOf({ warnings });
}

/** Asides one after the other. */
export function joinDeclarations(all: readonly SceneDeclarations[]): SceneDeclarations {
  const some = all.filter((asides) => asides !== noDeclarations);
  const [only = noDeclarations] = some;
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
