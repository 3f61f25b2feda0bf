// What a page's first looks leave to the runtime. No code of theirs is in here, so
// that the runtime can come without it.

import type { EarlyBases } from "../first/earlyBases.ts";
import type { FirstLook } from "./firstLook.ts";

const looks = new WeakMap<Element, FirstLook>();

/** The look stands in this view. */
export function leaveLook(view: Element, look: FirstLook): void {
  looks.set(view, look);
}

/** The one that stands in a view; it is the caller's from now on. */
export function takeLook(view: Element): FirstLook | undefined {
  const look = looks.get(view);
  looks.delete(view);
  return look;
}

let bases: Pick<EarlyBases, "take"> | undefined;

export function leaveBases(early: Pick<EarlyBases, "take">): void {
  bases = early;
}

/** The content of a file that a look has asked for, which is the caller's from now on. */
export function takeBases(url: string): ReturnType<EarlyBases["take"]> {
  return bases?.take(url);
}
