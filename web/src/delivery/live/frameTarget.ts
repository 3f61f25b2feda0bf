// Where the frames of one epoch go: into images that shaders read vertices from (liveImages.ts), or into buffers
// (liveArrays.ts). Each frame takes the memory of the one before.

import type { FrameHeader } from "../../decode/frame/frameHeader.ts";
import type { LiveVertices } from "../content.ts";
import type { ResourcePool } from "../resourcePool.ts";

/** A frame that a worker has decoded. */
export interface DecodedFrame {
  readonly header: FrameHeader;
  /** Replaces all vertices of the target, which are allocated with the first frame, before the page's next frame. */
  display(): void;
}

export interface FrameTarget {
  /** Decodes a frame in a worker. Rejects with DecodeError, or with the signal's reason. */
  decode(bytes: Uint8Array<ArrayBuffer>, signal: AbortSignal): Promise<DecodedFrame>;
  /** Undefined until a frame has been displayed. */
  readonly vertices: LiveVertices | undefined;
  /** Frees the memory. */
  close(): void;
}

/** What targets need of the pool. */
export type TargetTools = Pick<ResourcePool, "runJob" | "makeWritableImage" | "makeWritableArray">;
