// Matches the children of a node instance with a new description of them.

import type { NodeDescription } from "../document/description.ts";
import { NodeInstance } from "./nodeInstance.ts";

/**
 * Finds for each description the child that had it before: one with the same description object, else a shape of the
 * same element or another node of the same kind, else a new one.
 */
export function matchChildren(
  parent: NodeInstance,
  descriptions: readonly NodeDescription[],
): { kept: NodeInstance[]; removed: readonly NodeInstance[] } {
  const { children } = parent;
  let begin = 0;
  while (begin < children.length && children[begin]?.description === descriptions[begin]) begin += 1;
  let end = 0;
  const maxEnd = Math.min(children.length, descriptions.length) - begin;
  while (end < maxEnd && children.at(-1 - end)?.description === descriptions.at(-1 - end)) end += 1;
  const unmatched = new UnmatchedChildren(children.slice(begin, children.length - end));
  const middle = descriptions.slice(begin, descriptions.length - end);
  const same = middle.map((description) => unmatched.takeSame(description));
  const between = middle.map(
    (description, index) => same[index] ?? unmatched.takeSimilar(description) ?? new NodeInstance(description, parent),
  );
  return {
    kept: [...children.slice(0, begin), ...between, ...children.slice(children.length - end)],
    removed: unmatched.rest,
  };
}

/** Children for which no new description has been found yet. */
class UnmatchedChildren {
  readonly #remaining: Set<NodeInstance>;
  readonly #byDescription: ReadonlyMap<NodeDescription, NodeInstance>;
  readonly #byIdentity = new Map<unknown, NodeInstance[]>();

  constructor(nodes: readonly NodeInstance[]) {
    this.#remaining = new Set(nodes);
    this.#byDescription = new Map(nodes.map((node) => [node.description, node]));
    for (const node of nodes.toReversed()) {
      const identity = identityOf(node.description);
      const known = this.#byIdentity.get(identity);
      if (known === undefined) this.#byIdentity.set(identity, [node]);
      else known.push(node);
    }
  }

  get rest(): readonly NodeInstance[] {
    return Array.from(this.#remaining);
  }

  takeSame(description: NodeDescription): NodeInstance | undefined {
    const node = this.#byDescription.get(description);
    return node !== undefined && this.#remaining.delete(node) ? node : undefined;
  }

  takeSimilar(description: NodeDescription): NodeInstance | undefined {
    const similar = this.#byIdentity.get(identityOf(description));
    for (let node = similar?.pop(); node !== undefined; node = similar?.pop())
      if (this.#remaining.delete(node)) return node;
    return undefined;
  }
}

/** Equal for nodes whose instances may be reused for one another. */
function identityOf(description: NodeDescription): unknown {
  return description.kind === "shape" ? description.element : description.kind;
}
