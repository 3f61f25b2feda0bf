// The modules of the runtime's parts, each beside this one. The page's module imports them, so that no other names them.

import { minBatchedInstances } from "../document/parts.ts";
import type { PageImports } from "./register.ts";

export const partImports: PageImports = {
  documentGeometry: () => import("../viewer/parts/documentGeometry.ts"),
  files: () => import("../viewer/parts/files.ts"),
  extensions: () => import("../viewer/parts/extensions.ts"),
  levels: () => import("../viewer/parts/levels.ts"),
  batches: () => import("../viewer/parts/batches.ts"),
  operators: () => import("../viewer/parts/operators.ts"),
  streams: () => import("../viewer/parts/streams.ts"),
  environment: () => import("../viewer/parts/environment.ts"),
  walking: () => import("../viewer/parts/walking.ts"),
  deformation: () => import("../viewer/parts/deformation.ts"),
  overlays: () => import("./overlays.ts"),
};

/** Whether a shape of the page has no geometry node of files. */
function hasDocumentGeometry(page: ParentNode): boolean {
  const shapes = Array.from(page.querySelectorAll("x3d shape:not([use], [patch])"));
  return shapes.some((shape) => shape.querySelector("imagegeometry, binarygeometry") === null);
}

/** Nodes that need the part "environment"; not all of backgrounds and lights do. */
const environmentNodes =
  "x3d :is(background[skyangle], background[fronturl], texturebackground, clipplane, fog, localfog, environmentlight," +
  " imagecubemaptexture, composedcubemaptexture, generatedcubemaptexture)," +
  " x3d scene > * :is(directionallight, pointlight[global=false], spotlight[global=false])";

/** Whether elements of a page need a part: hints, which may be wrong without harm. */
const partHints: Partial<Record<keyof PageImports, (page: ParentNode) => boolean>> = {
  levels: (page) => page.querySelector("x3d imagegeometry[levels]") !== null,
  operators: (page) => page.querySelector("x3d [operators]") !== null,
  batches: (page) => page.querySelectorAll("x3d shape").length >= minBatchedInstances,
  environment: (page) => page.querySelector(environmentNodes) !== null,
  walking: (page) => /^[\s"]*(walk|game)/i.test(page.querySelector("x3d navigationinfo")?.getAttribute("type") ?? ""),
  deformation: (page) => page.querySelector('x3d :is([name^="skin."], [name^="displacer."])') !== null,
  overlays: (page) =>
    page.querySelector('[slot^="hotspot"], x3d anchor, x3d viewpoint[description] ~ viewpoint[description]') !== null,
  documentGeometry: hasDocumentGeometry,
  files: (page) =>
    hasDocumentGeometry(page) ||
    page.querySelector('x3d binarygeometry, x3d imagegeometry:not([data], [profile="compact" i])') !== null,
};

/** Begins to load the parts that scenes of the page will need, as far as its elements tell. */
export function loadHintedParts(page: ParentNode): void {
  for (const name of Object.keys(partHints) as (keyof PageImports)[])
    if (partHints[name]?.(page) === true) partImports[name]().catch(() => undefined); // imported again where it is needed
}
