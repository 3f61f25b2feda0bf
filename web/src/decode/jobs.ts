// The jobs that workers run, by name: pure functions from plain data and bytes to plain data and arrays.

import {
  classicColors,
  classicCoords,
  classicIndex,
  classicNormals,
  classicTexCoords,
  classicValues,
  classicWords,
} from "./classic/classicArrays.ts";
import { classicGrid, gridIndex } from "./classic/classicGrid.ts";
import { compactBases, compactGroup, compactPatches } from "./compact/jobs.ts";
import { frameArrays } from "./frame/frameArrays.ts";
import { frameImages } from "./frame/frameImages.ts";
import { imageTexels } from "./imageTexels.ts";
import { sequenceFrames } from "./sequence/sequenceFrames.ts";
import { videoFrame } from "./video/videoFrame.ts";

export const jobs = {
  classicCoords,
  classicIndex,
  classicNormals,
  classicColors,
  classicTexCoords,
  classicValues,
  classicWords,
  classicGrid,
  compactPatches,
  compactBases,
  compactGroup,
  frameImages,
  frameArrays,
  sequenceFrames,
  videoFrame,
  gridIndex,
  imageTexels,
} as const;

export type JobName = keyof typeof jobs;
export type InputOf<Name extends JobName> = Parameters<(typeof jobs)[Name]>[0];
export type OutputOf<Name extends JobName> = Awaited<ReturnType<(typeof jobs)[Name]>>;

/** Runs a job. Rejects with the error of the job, a DecodeError where bytes are wrong, or with the signal's reason. */
export type RunJob = <Name extends JobName>(
  name: Name,
  input: InputOf<Name>,
  signal: AbortSignal,
) => Promise<OutputOf<Name>>;
