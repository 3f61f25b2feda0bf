// Starts the previews of a page while the runtime is being loaded.

import { PrefetchedBases } from "./prefetchedBases.ts";
import { viewStyle, viewTag } from "../element/viewStyle.ts";
import type { LoadFirstGroups } from "./previewFiles.ts";
import { Preview } from "./preview.ts";
import { registerPrefetchedBases, registerPreview } from "./previewRegistry.ts";
import { ensureViewIn } from "../element/sceneNodes.ts";
import { isNearViewport } from "../element/visibility.ts";

/** Each preview needs a WebGL context beside the runtime's. Browsers grant a page 16 contexts, on phones 8. */
const maxPreviews = 3;

/**
 * Starts previews of scenes that are in the viewport and have bases. `loadFirstGroups` loads the module for meshes with
 * levels of detail.
 */
export async function startPreviews(loadFirstGroups: LoadFirstGroups): Promise<Preview[]> {
  if (document.hidden) return [];
  const bases = new PrefetchedBases((input, init) => fetch(input, init));
  registerPrefetchedBases(bases);
  const previews: Preview[] = [];
  for (const x3d of document.querySelectorAll("x3d")) {
    if (previews.length === maxPreviews) break;
    const isNear = isNearViewport(x3d.getBoundingClientRect(), 0);
    const preview = isNear ? await startPreviewIn(x3d, bases, loadFirstGroups) : undefined;
    if (preview !== undefined) previews.push(preview);
  }
  return previews;
}

async function startPreviewIn(
  x3d: Element,
  bases: PrefetchedBases,
  loadFirstGroups: LoadFirstGroups,
): Promise<Preview | undefined> {
  const hasView = Array.from(x3d.children).some(({ localName }) => localName === viewTag);
  if (hasView) return undefined;
  const insert = (canvas: HTMLCanvasElement): void => {
    const root = ensureViewIn(x3d).attachShadow({ mode: "open" });
    root.adoptedStyleSheets = [viewStyle];
    root.append(canvas);
  };
  const preview = await Preview.create(x3d, bases, loadFirstGroups, insert);
  if (preview !== undefined) registerPreview(ensureViewIn(x3d), preview);
  return preview;
}
