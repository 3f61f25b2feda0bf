// The delivery of frames that have one layout and one lattice: that of the document's static files, to which the frames
// are one more file. Each frame that is displayed changes the vertices of the delivered stage.

import type { FrameDescription } from "../../decode/frame/frameDescription.ts";
import type { GeometryDescription } from "../../document/description.ts";
import type { Stage } from "../../stage/stage.ts";
import type { Delivery, DeliveryListener, FilePool, LiveFrame } from "../geometryDelivery.ts";
import { deliverGeometry } from "../geometryDelivery.ts";
import type { Transfer } from "../progress.ts";
import type { Content } from "../content.ts";
import type { ResourceRequest } from "../resource.ts";
import type { ResourceHandle, ResourcePool } from "../resourcePool.ts";
import type { DecodedFrame } from "./frameTarget.ts";
import { ArrayTarget } from "./liveArrays.ts";
import { ImageTarget } from "./liveImages.ts";
import { gridNormalsOf, withStreamState } from "./streamGeometry.ts";

export interface FrameDeliveryOptions {
  /** As the document states it; its coordinates are the frames. */
  readonly geometry: GeometryDescription;
  readonly description: FrameDescription;
  /** Whether shaders read images exactly. */
  readonly readsTextures: boolean;
  readonly pool: ResourcePool;
  /** That of the frames. */
  readonly transfer: Readonly<Transfer>;
  /** Decodes and displays the displayed frame again; undefined: its bytes suffice. */
  readonly decodeAgain?: () => Promise<void>;
}

export interface FrameDeliveryListener extends Pick<DeliveryListener, "onError"> {
  /** `stage` has changed. */
  onStage(): void;
  onSettled(): void;
}

export class FrameDelivery {
  readonly geometry: GeometryDescription;
  /** What all its frames have in common. */
  readonly description: FrameDescription;
  readonly delivery: Delivery;
  readonly target: ImageTarget | ArrayTarget;
  stage: Stage | undefined;
  /** The newest frame, while the listener does not know that it is displayed. */
  frame: LiveFrame | undefined;
  /** Resolves with the vertices of the first frame. */
  readonly #content = Promise.withResolvers<Content>();

  constructor(options: FrameDeliveryOptions, listener: FrameDeliveryListener) {
    const { geometry, description, readsTextures, pool, transfer, decodeAgain } = options;
    const { maxTextureSize } = pool;
    this.description = description;
    this.geometry = withStreamState(geometry, description, { readsTextures, maxTextureSize });
    this.#content.promise.catch(() => undefined); // there may be nobody who waits for it
    this.target =
      this.geometry.decode === "gpu"
        ? new ImageTarget(pool)
        : new ArrayTarget(pool, gridNormalsOf(this.geometry, description), decodeAgain);
    this.delivery = deliverGeometry(this.geometry, poolWith(pool, transfer, this.#content.promise), {
      onStage: (_, stage) => {
        this.stage = stage;
        listener.onStage();
      },
      onError: (error) => {
        listener.onError(error);
      },
      onSettled: () => {
        listener.onSettled();
      },
    });
  }

  /** Replaces all vertices before the page's next frame. */
  display(frame: DecodedFrame): void {
    const { number, time, epoch } = frame.header;
    frame.display();
    const { vertices } = this.target;
    if (vertices !== undefined) this.#content.resolve({ kind: "live", vertices });
    this.frame = { number, time, epoch };
  }

  close(): void {
    this.delivery.cancel();
    this.target.close();
  }
}

/** The pool, with the frames as the content of the stream. */
function poolWith(pool: ResourcePool, transfer: Readonly<Transfer>, content: Promise<Content>): FilePool {
  return {
    runJob: pool.runJob,
    storeBytes: pool.storeBytes,
    maxTextureSize: pool.maxTextureSize,
    acquire: (request: ResourceRequest): ResourceHandle =>
      request.kind !== "live"
        ? pool.acquire(request)
        : {
            transfer,
            content,
            setPriority: () => undefined,
            fail: () => undefined,
            finish: () => undefined,
            release: () => undefined,
          },
  };
}
