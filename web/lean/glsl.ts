// Removes from GLSL what its compiler does not need: comments, indentation and empty lines.

import { childrenOf, parseTypeScript, type Node } from "./syntax.ts";

/** `isWhole`: whether the text ends where the last line ends; otherwise more of that line follows, with its comment. */
export function withoutComments(shader: string, isWhole = true): string {
  const lastLine = isWhole ? shader.length : shader.lastIndexOf("\n") + 1;
  return (
    shader
      .slice(0, lastLine)
      .replaceAll(/\/\*.*?\*\//gs, "")
      .replaceAll(/[ \t]*\/\/.*$/gm, "") + shader.slice(lastLine)
  )
    .replaceAll(/\n[ \t]+/g, "\n")
    .replaceAll(/\n{2,}/g, "\n");
}

const marker = "/* glsl */ ";

/** A module with GLSL in template literals after a comment that says so, without what the GLSL does not need. */
export function withLeanTemplates(module: string): string {
  if (!module.includes(marker)) return module;
  let [text, end] = ["", 0];
  for (const literal of literalsIn(parseTypeScript(module))) {
    if (!module.slice(0, literal.start).endsWith(marker)) continue;
    for (const [index, [from, to]] of partsOf(literal, module).entries()) {
      const isLast = index === (literal.expressions as unknown[]).length;
      text += module.slice(end, from) + withoutComments(module.slice(from, to), isLast);
      end = to;
    }
  }
  return text + module.slice(end);
}

/** Template literals, without those in the expressions of others. */
function* literalsIn(node: Node): Iterable<Node> {
  if (node.type === "TemplateLiteral") yield node;
  else for (const child of childrenOf(node)) yield* literalsIn(child);
}

/** Where the parts of a template literal between its expressions begin and end. */
function partsOf({ start, end, expressions }: Node, module: string): (readonly [from: number, to: number])[] {
  const starts = [start + 1];
  const ends: number[] = [];
  for (const expression of expressions as Node[]) {
    ends.push(module.lastIndexOf("${", expression.start));
    starts.push(module.indexOf("}", expression.end) + 1);
  }
  return [...ends, end - 1].map((to, index) => [starts[index] ?? to, to]);
}
