// Lines wider than a pixel, in the module of classic and BG (document/parts.ts): scenes without LineProperties have
// none.

import type { InstancedBufferGeometry } from "three";
import { LateModule } from "../../document/lateModule.ts";
import type { BufferStage, DrawRange, Stage } from "../../stage/stage.ts";
import type { BufferProvider } from "../uploads/bufferProvider.ts";
import type { LineRecords } from "./wideLineGeometry.ts";

/** What the module adds. */
export interface WideLines {
  /** Included in vertex shaders of materials with WIDE_LINES: `lineEnd` (where vertices are in buffers). */
  readonly endChunk: string;
  /** Included in them: `readVertex` and `widenLine`. */
  readonly vertexChunk: string;
  /** Included in their fragment shaders: `isBetweenDashes`. */
  readonly dashChunk: string;
  readonly geometryOf: (stage: Stage, range: DrawRange, buffers: BufferProvider) => InstancedBufferGeometry;
  /** As those of wideLineGeometry.ts. */
  readonly outlineGeometry: (lineCount: number) => InstancedBufferGeometry;
  readonly repeatedLines: (lines: InstancedBufferGeometry, times: number) => InstancedBufferGeometry;
  readonly recordsFor: (stage: BufferStage) => LineRecords;
}

export const lateWideLines = new LateModule<WideLines>("wide lines");
