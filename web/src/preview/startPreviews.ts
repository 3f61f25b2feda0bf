// The first looks of a page, for as long as the runtime is not here.

import { PrefetchedBases } from "./prefetchedBases.ts";
import { viewStyle, viewTag } from "../element/viewStyle.ts";
import { Preview } from "./preview.ts";
import { registerPrefetchedBases, registerPreview } from "./previewRegistry.ts";
import { ensureView } from "../element/sceneNodes.ts";
import { isNear } from "../element/visibility.ts";

/** Each has a WebGL context, of which a page gets 16 or, on phones, 8; and the runtime's come beside them. */
const maxPreviews = 3;

/** Of scenes that are in the window and have bases. */
export function startPreviews(): Preview[] {
  if (document.hidden) return [];
  const early = new PrefetchedBases((input, init) => fetch(input, init));
  registerPrefetchedBases(early);
  const begun: Preview[] = [];
  for (const x3d of document.querySelectorAll("x3d")) {
    if (begun.length === maxPreviews) break;
    const look = isNear(x3d.getBoundingClientRect(), 0) ? startPreviewIn(x3d, early) : undefined;
    if (look !== undefined) begun.push(look);
  }
  return begun;
}

function startPreviewIn(x3d: Element, early: PrefetchedBases): Preview | undefined {
  const isTaken = Array.from(x3d.children).some(({ localName }) => localName === viewTag);
  if (isTaken) return undefined;
  const look = Preview.create(x3d, early, (canvas) => {
    const root = ensureView(x3d).attachShadow({ mode: "open" });
    root.adoptedStyleSheets = [viewStyle];
    root.append(canvas);
  });
  if (look !== undefined) registerPreview(ensureView(x3d), look);
  return look;
}
