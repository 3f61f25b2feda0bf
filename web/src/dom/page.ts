// What a page loads first: it draws what can be drawn without the runtime, and
// brings the runtime, which takes the picture over.

import { adoptPageStyle, viewTag } from "../element/viewStyle.ts";
import type { Preview } from "../preview/preview.ts";
import { startPreviews } from "../preview/startPreviews.ts";

/** The file of `register.ts` and of all that it takes, beside this one. */
const runtimeUrl = new URL("imgeo-scene.js", import.meta.url);

/** A base that has not come by then is not waited for. */
const patienceMs = 3000;

async function start(): Promise<void> {
  adoptPageStyle(document);
  const looks = looksOrNone();
  if (looks.length > 0) await leaveTheWayTo(looks);
  const { registerViews } = await import("./register.ts");
  // Bases that have come meanwhile are drawn before the runtime begins to work, which takes longer.
  await Promise.all(looks.filter(({ isDue }) => isDue).map(({ settled }) => settled));
  registerViews();
  for (const look of looks) if (!look.canvas.isConnected) look.end(); // the page has taken it away
}

/** The line is theirs until their files are here, and the processor until they are drawn; the runtime comes in between. */
async function leaveTheWayTo(looks: readonly Preview[]): Promise<void> {
  const patience = new Promise((resolve) => setTimeout(resolve, patienceMs));
  await Promise.race([Promise.all(looks.map(({ downloaded: arrived, settled }) => Promise.race([arrived, settled]))), patience]);
  const link = document.createElement("link");
  link.rel = "modulepreload";
  link.href = runtimeUrl.href;
  document.head.append(link);
  await Promise.race([Promise.all(looks.map(({ settled }) => settled)), patience]);
}

/** Whatever goes wrong with them, the runtime comes. */
function looksOrNone(): readonly Preview[] {
  try {
    return startPreviews();
  } catch (error) {
    console.error("imgeo: the scene could not be drawn before the runtime:", error);
    return [];
  }
}

if (customElements.get(viewTag) === undefined) {
  start().catch((error: unknown) => {
    console.error("imgeo: the runtime could not be loaded:", error);
  });
}
