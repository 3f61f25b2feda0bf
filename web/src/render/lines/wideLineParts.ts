// What the module of wide lines adds.

import { dashChunk, lineEndChunk, wideLineChunk } from "../shaders/wideLineChunk.ts";
import type { WideLines } from "./lateWideLines.ts";
import { LineRecords, outlineGeometry, repeatedLines, wideLineGeometryOf } from "./wideLineGeometry.ts";

export const wideLines: WideLines = {
  endChunk: lineEndChunk,
  vertexChunk: wideLineChunk,
  dashChunk,
  geometryOf: wideLineGeometryOf,
  outlineGeometry,
  repeatedLines,
  recordsFor: (stage) => new LineRecords(stage),
};
