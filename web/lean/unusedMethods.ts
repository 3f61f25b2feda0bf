// Finds methods that no code of a program calls, by their names. Bundlers remove unused functions, but no methods: they
// cannot tell whose method `object.name()` is. A name that no code mentions which can run is nobody's, though.

import { childrenOf, mentionedIn, parse, type Node } from "./syntax.ts";

/** Names that the language itself calls. */
const implicitNames = ["constructor", "next", "return", "then", "toString", "valueOf"];

interface Method {
  readonly name: string;
  /** The method's function. */
  readonly body: Node;
}

/** A method of a class, or a function that is assigned to a member of `this`; otherwise undefined. */
function methodOf(node: Node): Method | undefined {
  if (node.type === "MethodDefinition") {
    const { key, computed, value } = node as Node & { key: Node; value: Node };
    return computed === true || key.type !== "Identifier" ? undefined : { name: key.name as string, body: value };
  }
  const assignment = node.type === "ExpressionStatement" ? (node.expression as Node) : undefined;
  if (assignment?.type !== "AssignmentExpression" || assignment.operator !== "=") return undefined;
  const { left, right } = assignment as Node & { left: Node; right: Node };
  const isOfThis = left.type === "MemberExpression" && (left.object as Node).type === "ThisExpression";
  if (!isOfThis || left.computed === true || right.type !== "FunctionExpression") return undefined;
  const { name, type } = left.property as Node;
  return type === "Identifier" ? { name: name as string, body: right } : undefined;
}

/**
 * The names of methods in a program that no code mentions which can run: code outside of methods, and methods whose
 * names such code mentions. Counts names in texts, but not names that code composes. `modules`: the program's modules.
 */
export function unusedMethodsOf(modules: readonly string[]): ReadonlySet<string> {
  const methods = new Map<string, Node[]>();
  const used = new Set<string>();
  const waiting: Node[] = modules.map(parse);
  const use = (name: string): void => {
    if (used.has(name)) return;
    used.add(name);
    waiting.push(...(methods.get(name) ?? []));
    methods.delete(name);
  };
  implicitNames.forEach(use);
  for (let node = waiting.pop(); node !== undefined; node = waiting.pop()) {
    const method = methodOf(node);
    if (method === undefined) {
      const name = mentionedIn(node);
      if (typeof name === "string") use(name);
      waiting.push(...childrenOf(node));
    } else if (used.has(method.name)) waiting.push(method.body);
    else methods.set(method.name, [...(methods.get(method.name) ?? []), method.body]);
  }
  return new Set(methods.keys());
}

/** Removes the methods with these names from a module. */
export function withoutMethods(module: string, names: ReadonlySet<string>): string {
  let [text, end] = ["", 0];
  const visit = (node: Node): void => {
    const method = methodOf(node);
    if (method !== undefined && names.has(method.name)) {
      text += module.slice(end, node.start);
      end = node.end;
    } else for (const child of childrenOf(node)) visit(child);
  };
  if (names.size > 0) visit(parse(module));
  return text + module.slice(end);
}
