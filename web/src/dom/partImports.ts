// The modules of the runtime's parts, each beside this one. The page's module imports them, so that no other names them.

import type { PartImports } from "../viewer/parts/parts.ts";

export const partImports: PartImports = {
  documentGeometry: () => import("../viewer/parts/documentGeometry.ts"),
  files: () => import("../viewer/parts/files.ts"),
  extensions: () => import("../viewer/parts/extensions.ts"),
  streams: () => import("../viewer/parts/streams.ts"),
};

/** Shapes without a geometry node of files. */
const withDocumentGeometry = "x3d shape:not([use], [patch], :has(imagegeometry, binarygeometry))";

/** Selectors of elements of a page that need a part: hints, which name most such elements and few others. */
const partHints: Partial<Record<keyof PartImports, string>> = {
  documentGeometry: withDocumentGeometry,
  files: `${withDocumentGeometry}, x3d binarygeometry, x3d imagegeometry:not([data], [profile="compact" i])`,
};

/** Begins to load the parts that scenes of the page will need, as far as its elements tell. */
export function loadHintedParts(page: ParentNode): void {
  for (const [name, selector] of Object.entries(partHints) as [keyof PartImports, string][]) {
    if (page.querySelector(selector) === null) continue;
    partImports[name]().catch(() => undefined); // imported again where it is needed
  }
}
