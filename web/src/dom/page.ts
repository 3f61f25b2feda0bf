// The module that a page loads first: it draws previews, which need no runtime, and
// loads the runtime, which takes them over.

import { defineViewer } from "../element/imgeoViewer.ts";
import { adoptPageStyle } from "../element/viewStyle.ts";
import { isNearViewport } from "../element/visibility.ts";
import type { Preview } from "../preview/preview.ts";
import { loadFirstGroups, loadHintedParts, partImports } from "./partImports.ts";
import { startPreviews } from "../preview/startPreviews.ts";

/** The bundle of `register.ts` and of all its imports, beside this file. */
const runtimeUrl = new URL("imgeo-scene.js", import.meta.url);

/** The runtime waits this long for the bases of previews. */
const maxWaitMs = 3000;

async function start(): Promise<void> {
  adoptPageStyle(document);
  preloadInlined();
  const previews = await startPreviewsIfPossible();
  if (previews.length > 0) await waitForPreviews(previews);
  const runtime = import("./register.ts");
  loadHintedParts(document);
  const { registerViews } = await runtime;
  // Previews whose bases have loaded meanwhile are drawn before the runtime starts, which takes longer.
  await Promise.all(previews.filter(({ isDue }) => isDue).map(({ settled }) => settled));
  registerViews(partImports);
  for (const preview of previews) if (!preview.canvas.isConnected) preview.end(); // the page has removed it
}

/**
 * Requests the documents of Inlines in the viewport, which the runtime needs first, while the runtime is being loaded.
 */
function preloadInlined(): void {
  for (const inline of document.querySelectorAll("x3d inline[url]")) {
    const [url = ""] = /^[^"]+$|(?<=")[^"]+(?=")/.exec(inline.getAttribute("url") ?? "") ?? [];
    const x3d = inline.closest("x3d");
    if (url === "" || x3d === null || !isNearViewport(x3d.getBoundingClientRect(), 0)) continue;
    const link = document.createElement("link");
    Object.assign(link, { rel: "preload", as: "fetch", crossOrigin: "anonymous", href: url.trim() });
    document.head.append(link);
  }
}

/**
 * Loads what previews need, then requests the runtime and the first patches, so that each answer begins when the one
 * before it ends. Resolves when the previews are drawn, at the latest after `maxWaitMs`.
 */
async function waitForPreviews(previews: readonly Preview[]): Promise<void> {
  const timeout = new Promise((resolve) => setTimeout(resolve, maxWaitMs));
  const withTimeout = (promises: readonly Promise<unknown>[]) => Promise.race([Promise.all(promises), timeout]);
  await withTimeout(
    previews.map(({ isNear, isChosen, settled }) => Promise.all([isChosen, Promise.race([isNear, settled])])),
  );
  const quick = previews.filter(({ canDrawPatches }) => canDrawPatches);
  const loads = quick.map((preview) => preview.drawPatches());
  await withTimeout(loads.map(({ isNear }) => isNear));
  preloadRuntime(() => {
    for (const preview of previews) preview.requestPatches();
  });
  // Starting the runtime would keep the page from drawing for longer than the patches take.
  await withTimeout([...previews.map(({ settled }) => settled), ...loads.map(({ isSettled }) => isSettled)]);
}

/** Requests the runtime; calls back when it has arrived, or has failed. */
function preloadRuntime(onArrival: () => void): void {
  const link = document.createElement("link");
  link.rel = "modulepreload";
  link.href = runtimeUrl.href;
  for (const name of ["load", "error"]) link.addEventListener(name, onArrival, { once: true });
  document.head.append(link);
}

/** An error in a preview does not keep the runtime from being loaded. */
async function startPreviewsIfPossible(): Promise<readonly Preview[]> {
  try {
    return await startPreviews(loadFirstGroups);
  } catch (error) {
    console.error("imgeo: the scene could not be drawn before the runtime:", error);
    return [];
  }
}

// A page with scenes of several sites names the module of each; the first one displays all of them.
if (defineViewer()) {
  start().catch((error: unknown) => {
    console.error("imgeo: the runtime could not be loaded:", error);
  });
}
