// The syntax tree of a module, for what the bundle leaves out.

import { parseAst } from "rolldown/parseAst";

export type Node = { readonly type: string; readonly start: number; readonly end: number } & Readonly<
  Record<string, unknown>
>;

export function parse(module: string): Node {
  return parseAst(module) as unknown as Node;
}

export function parseTypeScript(module: string): Node {
  return parseAst(module, { lang: "ts" }) as unknown as Node;
}

export function* childrenOf(node: Node): Iterable<Node> {
  for (const value of Object.values(node))
    for (const child of Array.isArray(value) ? (value as unknown[]) : [value])
      if (typeof child === "object" && child !== null && "type" in child) yield child as Node;
}

/** A name that a node mentions: of a member, of a property, or in a text, by which code may look up a member. */
export function mentionedIn(node: Node): unknown {
  switch (node.type) {
    case "MemberExpression":
      return node.computed === true ? undefined : (node.property as Node).name;
    case "Property":
      return node.computed === true ? undefined : ((node.key as Node).name ?? (node.key as Node).value);
    case "Literal":
      return node.value;
    case "TemplateElement":
      return (node.value as { cooked?: unknown }).cooked;
    default:
      return undefined;
  }
}
