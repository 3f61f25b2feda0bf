// The parts of the runtime, which all scenes of a page share.

import type { PartImports, Parts } from "../viewer/parts/parts.ts";
import { partsFrom } from "../viewer/parts/parts.ts";

let parts: Parts | undefined;

export function setPartImports(imports: PartImports): void {
  parts = partsFrom(imports);
}

/** Throws RangeError before `setPartImports`. */
export function pageParts(): Parts {
  if (parts === undefined) throw new RangeError("the page has no modules for parts of the runtime");
  return parts;
}
