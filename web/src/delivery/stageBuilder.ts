// From the files of a patch to its stages. A builder takes a patch's parts in
// whatever order they come, checks each against the document, and says what can
// be shown with those that are here. A part that never comes is merely absent.

import type { RunJob } from "../decode/jobs.ts";
import type { DrawRange, Stage, StageName } from "../stage/stage.ts";
import type { PatchDescription } from "../document/description.ts";
import type { StoreBytes } from "./arrayUploads.ts";
import type { PatchFile } from "./patchFiles.ts";
import type { Content } from "./resourcePool.ts";

export interface StageBuilder {
  /**
   * Throws, or rejects with, DecodeError where the content does not hold what the
   * document says, or the signal's reason; the part then counts as absent.
   */
  accept(part: PatchFile, content: Content, signal: AbortSignal): void | Promise<void>;
  /** Undefined while nothing can be shown. */
  stage(): Stage | undefined;
  /** Whether parts can be given up one by one; otherwise only all of them, with `clear`. */
  readonly isDivisible: boolean;
  /** Of stored arrays; images belong to whoever leases them. */
  readonly storedBytes: number;
  /** The part counts as absent from now on; where parts can be given up one by one. */
  drop(part: PatchFile): void;
  /** All parts count as absent. */
  clear(): void;
  /** Gives back what earlier stages used and the next one does not; they must no longer be drawn. */
  sweep(): void;
}

/** What builders work with. */
export interface BuilderTools {
  readonly runJob: RunJob;
  readonly storeBytes: StoreBytes;
}

/** The patch's draws with the running number that each begins at. */
export function drawRangesOf(patch: PatchDescription): DrawRange[] {
  let first = 0;
  return patch.draws.map(({ primitive, count }) => {
    const range = { primitive, first, count };
    first += count;
    return range;
  });
}

/** What is here of a patch, for its stage's name. */
export interface AvailableAttributes {
  readonly index: unknown;
  readonly coord: readonly unknown[];
  readonly normal: unknown;
  readonly color: unknown;
  /** Planes, or its only array. */
  readonly value: readonly unknown[];
}

export function attainedStageName(patch: PatchDescription, here: AvailableAttributes): StageName {
  const lacks = (part: "index" | "normal" | "color") => patch[part] !== undefined && here[part] === undefined;
  if (lacks("index")) return "points";
  if (lacks("normal")) return "surface";
  const isWhole = here.coord.length === patch.coord.length && here.value.length === patch.value.length;
  return lacks("color") || !isWhole ? "shaded" : "full";
}
