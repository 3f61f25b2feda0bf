// The names of properties that objects of browsers and of the language have, from TypeScript's declarations.

import { readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";

const declarations = join(import.meta.dirname, "../../node_modules/typescript/lib");

let names: ReadonlySet<string> | undefined;

/** All words of the declarations: more than the names of properties, and so none too few. */
export function platformNames(): ReadonlySet<string> {
  if (names) return names;
  const files = readdirSync(declarations).filter((file) => /^lib\..*\.d\.ts$/.test(file));
  const words = files.flatMap(
    (file) => readFileSync(join(declarations, file), "utf8").match(/[A-Za-z_$][\w$]*/g) ?? [],
  );
  return (names = new Set(words));
}
