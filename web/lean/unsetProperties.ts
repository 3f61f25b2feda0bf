// Finds properties that no code of a program sets, such as `isSkinnedMesh` where no class SkinnedMesh is in it. A bundler
// leaves out the class, but not the branches for it, since it cannot tell that `object.isSkinnedMesh` is undefined for
// all objects. Replaced by their values, a minifier removes the branches.

import { childrenOf, mentionedIn, parse, type Node } from "./syntax.ts";

/** Undefined if no code sets the property, and false if all code that sets it sets it to what counts as false. */
type Value = "undefined" | "false";

/** What code gets that reads a property, by the property's name. */
export type UnsetProperties = ReadonlyMap<string, Value>;

/**
 * Those properties named in `names` that a program reads and never sets, or only to what counts as false. Counts names
 * in texts, by which code may set a property, but not names that code composes. `modules`: the program's modules;
 * `otherNames`: names of properties that other code may set, such as the browser's.
 */
export function unsetPropertiesOf(
  modules: readonly string[],
  names: ReadonlySet<string>,
  otherNames: ReadonlySet<string>,
): UnsetProperties {
  const read = new Set<string>();
  const values = new Map<string, Value | "other">();
  const waiting: Node[] = modules.map(parse);
  for (let node = waiting.pop(); node !== undefined; node = waiting.pop()) {
    if (node.type === "MemberExpression") read.add(String(mentionedIn(node)));
    else for (const [name, value] of assignmentsIn(node)) values.set(name, laterOf(values.get(name), value));
    waiting.push(...childrenOf(node));
  }
  const unset = new Map<string, Value>();
  for (const name of read) {
    if (!names.has(name)) continue;
    const value = values.get(name) ?? "undefined";
    if (value !== "other" && !otherNames.has(name)) unset.set(name, value);
  }
  return unset;
}

function laterOf(before: Value | "other" | undefined, value: Value | "other"): Value | "other" {
  return before === "other" || value === "undefined" ? (before ?? value) : value;
}

/** The names that a node gives values. A node that mentions a name in another way may give it any value. */
function assignmentsIn(node: Node): (readonly [name: string, value: Value | "other"])[] {
  switch (node.type) {
    case "AssignmentExpression":
      return membersIn(node.left as Node)
        .filter((name) => node.operator !== "=" || !isMember(node.right as Node, name)) // a copy adds no value
        .map((name) => [name, node.operator === "=" ? valueOf(node.right) : "other"]);
    case "UpdateExpression":
      return membersIn(node.argument as Node).map((name) => [name, "other"]);
    case "ForInStatement":
    case "ForOfStatement":
      return membersIn(node.left as Node).map((name) => [name, "other"]);
    case "PropertyDefinition":
      return [[String((node.key as Node).name), valueOf(node.value)]];
    case "MethodDefinition":
      return [[String((node.key as Node).name), "other"]];
    default: {
      const name = mentionedIn(node);
      return typeof name === "string" ? [[name, node.type === "Property" ? valueOf(node.value) : "other"]] : [];
    }
  }
}

/** The names of the members that an assignment's left side assigns. */
function membersIn(target: Node): string[] {
  if (target.type === "MemberExpression") return [String(mentionedIn(target))];
  return Array.from(childrenOf(target)).flatMap(membersIn);
}

function isMember(node: Node, name: string): boolean {
  return node.type === "MemberExpression" && mentionedIn(node) === name;
}

function valueOf(node: unknown): Value | "other" {
  if (node === null || node === undefined) return "undefined";
  const { type, value, name, regex } = node as Node;
  if (type === "Literal" && !value && regex === undefined) return "false";
  return type === "Identifier" && name === "undefined" ? "undefined" : "other";
}

/** Replaces what a module reads of these properties by their values. */
export function withoutProperties(module: string, unset: UnsetProperties): string {
  let [text, end] = ["", 0];
  const visit = (node: Node, parent: Node | undefined): void => {
    const value = isRead(parent, node) ? valueRead(node, unset) : undefined;
    // A property that is only set to false is undefined where it has not been set.
    if (value === undefined || (value === "false" && !asksIfTrue(parent, node))) {
      for (const child of childrenOf(node)) visit(child, node);
      return;
    }
    text += module.slice(end, node.start) + value;
    end = node.end;
  };
  if (unset.size > 0) visit(parse(module), undefined);
  return text + module.slice(end);
}

/** Whether a node's parent does not set or delete it. */
function isRead(parent: Node | undefined, node: Node): boolean {
  if (parent?.type === "AssignmentExpression") return parent.left !== node;
  return parent?.type !== "UnaryExpression" || parent.operator !== "delete";
}

/** The value of a node that is `object.name`, if it is known and `object` calls nothing. */
function valueRead(node: Node, unset: UnsetProperties): Value | undefined {
  if (node.type !== "MemberExpression" || node.computed === true || !callsNothing(node.object as Node))
    return undefined;
  return unset.get((node.property as Node).name as string);
}

function callsNothing(node: Node): boolean {
  if (node.type === "Identifier" || node.type === "ThisExpression") return true;
  return node.type === "MemberExpression" && node.computed !== true && callsNothing(node.object as Node);
}

/** Whether a node's parent only asks whether it is true. */
function asksIfTrue(parent: Node | undefined, node: Node): boolean {
  switch (parent?.type) {
    case "IfStatement":
    case "ConditionalExpression":
      return parent.test === node;
    case "LogicalExpression":
      return parent.operator === "&&" && parent.left === node;
    case "UnaryExpression":
      return parent.operator === "!";
    case "BinaryExpression":
      return (
        parent.operator === "===" && ((parent.right as Node).value === true || (parent.left as Node).value === true)
      );
    default:
      return false;
  }
}
