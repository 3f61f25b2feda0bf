// The contribution of elements to a scene: nodes, and declarations for the scene as a whole.

import type {
  BackgroundNodeDescription,
  InlineDescription,
  NavigationDescription,
  NodeDescription,
  SkinDescription,
} from "./description.ts";
import type { SceneElement } from "./element.ts";
import type { Warning } from "./nodes.ts";

export interface SceneFragment {
  /** In document order. */
  readonly nodes: readonly NodeDescription[];
  readonly declarations: SceneDeclarations;
}

/** Declarations for the scene as a whole. Lists are in document order. */
export interface SceneDeclarations {
  readonly warnings: readonly Warning[];
  readonly inlines: readonly InlineDescription[];
  /** The bound NavigationInfo among those of these elements. */
  readonly navigation: NavigationDescription | undefined;
  /** That of inlined documents, for scenes that have none of their own. */
  readonly inlinedNavigation: NavigationDescription | undefined;
  /** The background that is bound at the start. */
  readonly background: BackgroundNodeDescription | undefined;
}

/** The only object for empty declarations, so that they are compared by identity. */
export const noDeclarations: SceneDeclarations = {
  warnings: [],
  inlines: [],
  navigation: undefined,
  inlinedNavigation: undefined,
  background: undefined,
};

/** State that groups pass down to their descendants. */
export interface Inherited {
  readonly visible: boolean;
  /** Like `visible`, but counts every level of a LOD as visible. */
  readonly contributesToBounds: boolean;
  readonly priority: number;
  /** That of the HAnimHumanoid around. */
  readonly skin?: SkinDescription | undefined;
}

/** Reads these elements with the state that they inherit. */
export type ReadChildren = (elements: readonly SceneElement[], inherited: Inherited) => SceneFragment;

/** Gives an element's fragment for the state that it inherits. The element's own fields have been read already. */
export type FragmentReader = (inherited: Inherited, readChildren: ReadChildren) => SceneFragment;

export function declarationsOf(declarations: Partial<SceneDeclarations>): SceneDeclarations {
  return { ...noDeclarations, ...declarations };
}

export function warningsOnly(warnings: readonly Warning[]): SceneDeclarations {
  return warnings.length === 0 ? noDeclarations : declarationsOf({ warnings });
}

/** Merges declarations of elements in document order. */
export function joinDeclarations(all: readonly SceneDeclarations[]): SceneDeclarations {
  const nonEmpty = all.filter((declarations) => declarations !== noDeclarations);
  const [only = noDeclarations] = nonEmpty;
  if (nonEmpty.length < 2) return only;
  return {
    warnings: nonEmpty.flatMap(({ warnings }) => warnings),
    inlines: nonEmpty.flatMap(({ inlines }) => inlines),
    navigation: nonEmpty.map(({ navigation }) => navigation).reduce(boundOf),
    inlinedNavigation: nonEmpty.map(({ inlinedNavigation }) => inlinedNavigation).reduce(boundOf),
    background: nonEmpty.map(({ background }) => background).reduce(boundBackgroundOf),
  };
}

/** As for NavigationInfo; backgrounds of inlined documents come after those of the documents around these. */
function boundBackgroundOf(
  first: BackgroundNodeDescription | undefined,
  second: BackgroundNodeDescription | undefined,
): BackgroundNodeDescription | undefined {
  if (first === undefined || second === undefined) return first ?? second;
  if (first.inlineDepth !== second.inlineDepth) return first.inlineDepth < second.inlineDepth ? first : second;
  return second.isBindRequested ? second : first;
}

/** The first of two NavigationInfos in document order is bound, unless the second asks to be. */
function boundOf(
  first: NavigationDescription | undefined,
  second: NavigationDescription | undefined,
): NavigationDescription | undefined {
  if (first === undefined || second === undefined) return first ?? second;
  return second.set_bind || second.bind ? second : first;
}
