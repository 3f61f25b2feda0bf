// Removes branches of GLSL's preprocessor that no program compiles, such as those for skins, where nothing defines
// USE_SKINNING.

/** Whether a name is never defined, or only as 0. */
export type IsUndefined = (name: string) => boolean;

/** A line `#if`, `#elif` or `#else`, and what is below it. */
interface Branch {
  readonly line: string;
  readonly condition: string;
  /** Undefined if it depends on the program. */
  readonly value: boolean | undefined;
  readonly content: Content;
}

/** One `#if` with its branches. */
type Conditional = Branch[];

/** Lines, and what is between `#if` and `#endif`. */
type Content = (string | Conditional)[];

/** GLSL with one directive a line, without the branches that are never compiled. */
export function withoutUnusedBranches(shader: string, isUndefined: IsUndefined): string {
  return linesOf(parse(shader, isUndefined)).join("\n");
}

function parse(shader: string, isUndefined: IsUndefined): Content {
  const top: Content = [];
  const open: { conditional: Conditional; around: Content }[] = [];
  let content = top;
  for (const line of shader.split("\n")) {
    const [, directive, rest = ""] = /^\s*#\s*(ifdef|ifndef|if|elif|else|endif)\b(.*)$/.exec(line) ?? [];
    if (directive === undefined) {
      content.push(line);
      continue;
    }
    if (directive === "endif") {
      content = open.pop()?.around ?? top;
      continue;
    }
    if (directive.startsWith("if")) {
      const conditional: Conditional = [];
      content.push(conditional);
      open.push({ conditional, around: content });
    }
    const condition = conditionOf(directive, rest.trim());
    content = [];
    open.at(-1)?.conditional.push({ line: line.trim(), condition, value: valueOf(condition, isUndefined), content });
  }
  return top;
}

function conditionOf(directive: string, rest: string): string {
  if (directive === "else") return "1";
  if (directive === "ifdef") return `defined( ${rest} )`;
  return directive === "ifndef" ? `! defined( ${rest} )` : rest;
}

function linesOf(content: Content): string[] {
  return content.flatMap((part) => (typeof part === "string" ? [part] : linesOfConditional(part)));
}

function linesOfConditional(branches: Conditional): string[] {
  const always = branches.findIndex(({ value }) => value === true);
  const possible = branches.slice(0, always + 1 || undefined).filter(({ value }) => value !== false);
  const [first] = possible;
  if (first === undefined) return [];
  if (first.value === true) return linesOf(first.content);
  const lines = possible.map(({ content }) => linesOf(content));
  if (lines.flat().every((line) => line.trim() === "")) return [];
  return [
    ...possible.flatMap((branch, n) => [n > 0 ? laterLine(branch) : firstLine(branch, branches), ...(lines[n] ?? [])]),
    "#endif",
  ];
}

/** The line of the first branch that is left. */
function firstLine(branch: Branch, branches: Conditional): string {
  return branch === branches[0] ? branch.line : `#if ${branch.condition}`;
}

function laterLine({ line, value }: Branch): string {
  return value === true ? "#else" : line;
}

/** The value of a condition, undefined where it depends on the program. */
function valueOf(condition: string, isUndefined: IsUndefined): boolean | undefined {
  const tokens =
    condition.match(/defined\s*\(\s*\w+\s*\)|defined\s+\w+|\w+\s*(?:[<>=!]=?)\s*\w+|\w+|&&|\|\||[!()]|\S/g) ?? [];
  let at = 0;
  /** Values of `next` that `operator` joins: one that is `decisive` is that of all. */
  const joined = (operator: string, next: () => boolean | undefined, decisive: boolean): boolean | undefined => {
    const values = [next()];
    for (; tokens[at] === operator; values.push(next())) at += 1;
    if (values.includes(decisive)) return decisive;
    return values.includes(undefined) ? undefined : !decisive;
  };
  const either = (): boolean | undefined => joined("||", () => joined("&&", one, false), true);
  const one = (): boolean | undefined => {
    const token = tokens[at++] ?? "";
    if (token === "!") {
      const value = one();
      return value === undefined ? undefined : !value;
    }
    if (token === "(") {
      const value = either();
      at += 1;
      return value;
    }
    const [, tested] = /^defined[\s(]+(\w+)/.exec(token) ?? [];
    if (tested !== undefined) return isUndefined(tested) ? false : undefined;
    const [, counted] = /^(\w+)\s*>\s*0$/.exec(token) ?? [];
    if (counted !== undefined) return isUndefined(counted) ? false : undefined;
    return token === "1" ? true : undefined;
  };
  const value = either();
  return at === tokens.length ? value : undefined; // of operators that are not among these nothing is known
}
