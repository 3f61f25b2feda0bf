// The first looks of a page, for as long as the runtime is not here.

import { EarlyBases } from "../first/earlyBases.ts";
import { viewStyle, viewTag } from "./faceStyle.ts";
import { FirstLook } from "./firstLook.ts";
import { leaveBases, leaveLook } from "./lookRegistry.ts";
import { viewIn } from "./ownNodes.ts";
import { isNear } from "./visibility.ts";

/** Each has a WebGL context, of which a page gets 16 or, on phones, 8; and the runtime's come beside them. */
const mostLooks = 3;

/** Of scenes that are in the window and have bases. */
export function beginFirstLooks(): FirstLook[] {
  if (document.hidden) return [];
  const early = new EarlyBases((input, init) => fetch(input, init));
  leaveBases(early);
  const begun: FirstLook[] = [];
  for (const x3d of document.querySelectorAll("x3d")) {
    if (begun.length === mostLooks) break;
    const look = isNear(x3d.getBoundingClientRect(), 0) ? lookInto(x3d, early) : undefined;
    if (look !== undefined) begun.push(look);
  }
  return begun;
}

function lookInto(x3d: Element, early: EarlyBases): FirstLook | undefined {
  const isTaken = Array.from(x3d.children).some(({ localName }) => localName === viewTag);
  if (isTaken) return undefined;
  const look = FirstLook.of(x3d, early, (canvas) => {
    const root = viewIn(x3d).attachShadow({ mode: "open" });
    root.adoptedStyleSheets = [viewStyle];
    root.append(canvas);
  });
  if (look !== undefined) leaveLook(viewIn(x3d), look);
  return look;
}
