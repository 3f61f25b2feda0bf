// What a page loads first: it draws what can be drawn without the runtime, and
// brings the runtime, which takes the picture over.

import { stylePage, viewTag } from "./faceStyle.ts";
import type { FirstLook } from "./firstLook.ts";
import { beginFirstLooks } from "./firstLooks.ts";

async function start(): Promise<void> {
  const runtime = import("./register.ts");
  stylePage(document);
  const looks = looksOrNone();
  const { registerViews } = await runtime;
  // Bases that are here are drawn before the runtime begins to work, which takes longer.
  await Promise.all(looks.filter(({ isDue }) => isDue).map(({ settled }) => settled));
  registerViews();
  for (const look of looks) if (!look.canvas.isConnected) look.end(); // the page has taken it away
}

/** Whatever goes wrong with them, the runtime comes. */
function looksOrNone(): readonly FirstLook[] {
  try {
    return beginFirstLooks();
  } catch (error) {
    console.error("imgeo: the scene could not be drawn before the runtime:", error);
    return [];
  }
}

if (customElements.get(viewTag) === undefined) {
  start().catch((error: unknown) => { console.error("imgeo: the runtime could not be loaded:", error); });
}
