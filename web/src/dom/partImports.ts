// The modules of the runtime's parts, each beside this one. The page's module imports them, so that no other names them.

import { minBatchedInstances } from "../document/parts.ts";
import type { LoadFirstGroups } from "../preview/previewFiles.ts";
import type { PageImports } from "./register.ts";

/** The part "levels" imports what this module contains: both are requested at once. */
export const loadFirstGroups: LoadFirstGroups = () => import("../preview/firstGroups.ts");

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
  values: () => import("../viewer/parts/values.ts"),
  overlays: () => import("./overlays.ts"),
  animation: () => import("./animatedPage.ts"),
  alphaImages: () => import("../decode/alphaImage.ts"),
};

/** Whether a shape of the page has no geometry node of files. */
function hasDocumentGeometry(page: ParentNode): boolean {
  const shapes = Array.from(page.querySelectorAll("x3d shape:not([use], [patch])"));
  return shapes.some((shape) => shape.querySelector("imagegeometry, binarygeometry") === null);
}

/** Nodes that need the part "environment"; not all of backgrounds and lights do. */
const environmentNodes =
  "background[skyangle], background[fronturl], texturebackground, clipplane, fog, localfog, environmentlight," +
  " imagecubemaptexture, composedcubemaptexture, generatedcubemaptexture," +
  " scene > * :is(directionallight, pointlight[global=false], spotlight[global=false])";

/**
 * Whether elements of a page need a part, or a selector of one that does: hints, which may be wrong without harm.
 */
const partHints: Partial<Record<keyof PageImports, string | ((page: ParentNode) => boolean)>> = {
  levels: "imagegeometry[levels]",
  operators: "[operators]",
  batches: (page) => page.querySelectorAll("x3d shape").length >= minBatchedInstances,
  environment: environmentNodes,
  walking: (page) => /^[\s"]*(walk|game)/i.test(page.querySelector("x3d navigationinfo")?.getAttribute("type") ?? ""),
  deformation: '[name^="skin."], [name^="displacer."]',
  values: "shape[colorby]",
  animation: "x3d route, x3d movietexture",
  overlays: '[slot^="hotspot"], anchor, viewpoint[description] ~ viewpoint[description]',
  documentGeometry: hasDocumentGeometry,
  files: (page) =>
    hasDocumentGeometry(page) ||
    page.querySelector('x3d binarygeometry, x3d imagegeometry:not([data], [profile="compact" i])') !== null,
};

/** Begins to load the parts that scenes of the page will need, as far as its elements tell. */
export function loadHintedParts(page: ParentNode): void {
  for (const [name, hint] of Object.entries(partHints)) {
    const isNeeded = typeof hint === "string" ? page.querySelector(hint) !== null : hint(page);
    if (isNeeded) partImports[name as keyof PageImports]().catch(() => undefined); // imported again where it is needed
  }
}
