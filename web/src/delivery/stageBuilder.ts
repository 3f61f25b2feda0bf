// The interface of stage builders. A builder takes the files of a patch in any order, checks each against the document,
// and builds the best stage from those that are available.

import type { ByVertexRole } from "../stage/attributeRows.ts";
import { attributeRows, vertexRoles } from "../stage/attributeRows.ts";
import type { RunJob } from "../decode/jobs.ts";
import type { Stage, StageName, StatedDrawRange } from "../stage/stage.ts";
import type { PatchDescription } from "../document/description.ts";
import type { StoreBytes } from "./arrayUploads.ts";
import type { PatchFile } from "./patchFiles.ts";
import type { Content } from "./content.ts";

export interface StageBuilder {
  /**
   * Throws, or rejects with, DecodeError where the content contradicts the document, or the signal's reason; the file
   * then counts as absent.
   */
  accept(file: PatchFile, content: Content, signal: AbortSignal): void | Promise<void>;
  /** The best stage now; undefined while nothing can be drawn. */
  stage(): Stage | undefined;
  /** Whether files can be dropped one by one; otherwise only all of them, with `clear`. */
  readonly isDivisible: boolean;
  /** Bytes of the stored arrays. Images are not counted: their resource handles own them. */
  readonly storedBytes: number;
  /** The file counts as absent from now on; only where `isDivisible`. */
  drop(file: PatchFile): void;
  /** All files count as absent. */
  clear(): void;
  /** Frees what only earlier stages used; they must no longer be drawn. */
  sweep(): void;
}

/** Functions with which builders decode and upload. */
export interface BuilderTools {
  readonly runJob: RunJob;
  readonly storeBytes: StoreBytes;
}

/** The patch's draws, each with its first index. */
export function drawRangesOf(patch: PatchDescription): StatedDrawRange[] {
  let first = 0;
  return patch.draws.map(({ primitive, count }) => {
    const range = { primitive, first, count };
    first += count;
    return range;
  });
}

/** The attributes of a patch that are available. */
export interface AvailableAttributes {
  readonly index: unknown;
  readonly coord: readonly unknown[];
  readonly attributes: ByVertexRole<unknown>;
  /** The byte planes, or a single array. */
  readonly value: readonly unknown[];
}

/** The name of the stage that these attributes make. */
export function attainedStageName(patch: PatchDescription, available: AvailableAttributes): StageName {
  if (patch.index !== undefined && available.index === undefined) return "points";
  const missing = vertexRoles.filter((role) => patch[role] !== undefined && available.attributes[role] === undefined);
  const [name] = missing.flatMap((role) => attributeRows[role].stageWithout ?? []);
  const isWhole = available.coord.length === patch.coord.length && available.value.length === patch.value.length;
  return name ?? (isWhole ? "full" : "shaded");
}
