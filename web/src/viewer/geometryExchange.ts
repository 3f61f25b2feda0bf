// The geometry of a shape while it loads. When it changes, its last stages stay displayed until all files of the new
// one have arrived, so that no frame is empty. A script may change it faster than files load: then one that has begun
// to load is displayed, too, and those described in between are never requested.

import type { DeliveryError } from "../delivery/deliveryError.ts";
import type { GeometryDeliveries, JoinedDelivery } from "../delivery/geometryDeliveries.ts";
import type { LiveFrame } from "../delivery/geometryDelivery.ts";
import type { Transfer } from "../delivery/progress.ts";
import type { GeometryDescription, Playback } from "../document/description.ts";
import type { Stage } from "../stage/stage.ts";
import type { DisplayedFrame } from "./displayedFrames.ts";
import { DisplayedFrames } from "./displayedFrames.ts";

export interface GeometryExchangeListener {
  onStage(change: StageChange): void;
  /** The displayed vertices of a live stream have changed. */
  onFrame(frame: DisplayedFrame): void;
  /** Another geometry is described. The stages of the one before are still displayed. */
  onGeometryReplaced(): void;
  /** From now on another geometry than the described one is displayed, or no longer. */
  onReplacing(isReplacing: boolean): void;
  /** The delivery of the displayed geometry ends; before the next frame another one's stages replace its stages. */
  onSwap(): void;
  /** A file of the described geometry cannot be used. */
  onError(error: DeliveryError): void;
  /** All files that were requested of the described geometry have loaded or failed. */
  onSettled(): void;
}

/** A patch displays another stage. */
export interface StageChange {
  /** The described geometry, or one before. */
  readonly geometry: GeometryDescription;
  readonly patch: number;
  /** Undefined: none. */
  readonly stage: Stage | undefined;
  /** As in DeliveryListener. */
  readonly drawn: GeometryDescription;
}

/** A geometry, its delivery and the stages that the delivery has reported last. */
interface GeometrySource {
  readonly geometry: GeometryDescription;
  /** With the geometry that each is drawn with. */
  readonly stages: Map<number, readonly [stage: Stage, drawn: GeometryDescription]>;
  joined: JoinedDelivery | undefined;
  /** The newest frame of a live stream that is not displayed yet. */
  frame: LiveFrame | undefined;
}

/** While an earlier geometry loads, files are requested this long after a script's last change, in milliseconds. */
const pauseMs = 100;

export const allFrames: Playback = { paused: false, rate: 0 };

/** Joins no delivery before `join`. */
export class GeometryExchange {
  /** How a live stream is followed from the next `join` on. */
  playback = allFrames;
  readonly #deliveries: Pick<GeometryDeliveries, "join">;
  readonly #listener: GeometryExchangeListener;
  /** The described geometry. */
  #source: GeometrySource | undefined;
  /** The geometry before, which is displayed until the described one is whole. */
  #replaced: GeometrySource | undefined;
  /** One described between those two that had begun to load: it is displayed if it is whole first. */
  #superseded: GeometrySource | undefined;
  /** Runs while the described geometry waits for further changes. */
  #pause: ReturnType<typeof setTimeout> | undefined;
  readonly #frames = new DisplayedFrames();

  constructor(
    deliveries: Pick<GeometryDeliveries, "join">,
    geometry: GeometryDescription | undefined,
    listener: GeometryExchangeListener,
  ) {
    this.#deliveries = deliveries;
    this.#source = sourceOf(geometry);
    this.#listener = listener;
  }

  /** The described geometry. */
  get geometry(): GeometryDescription | undefined {
    return this.#source?.geometry;
  }

  /** Whether the described geometry's delivery is joined. */
  get isJoined(): boolean {
    return this.#source?.joined !== undefined;
  }

  /** Whether no file of the described geometry is being loaded. */
  get isSettled(): boolean {
    return this.#source === undefined || this.#source.joined?.isSettled === true;
  }

  /** The files of the described geometry that have been requested. */
  get transfers(): readonly Readonly<Transfer>[] {
    return this.#source?.joined?.transfers ?? [];
  }

  /** Joins the delivery of the described geometry, unless that waits for further changes. */
  join(): void {
    if (this.#source !== undefined && this.#pause === undefined) this.#joinDelivery(this.#source);
    this.#source?.joined?.setPlayback(this.playback);
  }

  /**
   * Another geometry is described. Returns the delivery that is no longer needed; undefined: that of the one before is
   * displayed, or goes on to load.
   */
  replace(geometry: GeometryDescription | undefined): JoinedDelivery | undefined {
    const before = this.#source;
    this.#source = sourceOf(geometry);
    this.#listener.onGeometryReplaced();
    if (geometry === undefined) {
      this.#clearAll(before);
      return before?.joined;
    }
    if (before === undefined) return undefined;
    if (this.#replaced === undefined && before.stages.size > 0) {
      this.#setReplaced(before);
      return undefined;
    }
    const goesOn = this.#superseded === undefined && before.joined?.isSettled === false;
    if (goesOn) this.#superseded = before;
    this.#superseded?.joined?.leadTo(geometry);
    if (this.#superseded !== undefined && this.#replaced !== undefined) this.#restartPause();
    return goesOn ? undefined : before.joined;
  }

  /**
   * Displays the described geometry instead of the one before, if it has something to display and no file of it is
   * being loaded. If none of its files could be used, the one before stays.
   */
  displayWhole(): void {
    const source = this.#source;
    if (this.#replaced === undefined || source === undefined || !this.#isDisplayable(source)) return;
    const before = this.#replaced;
    this.#setReplaced(undefined);
    this.#dropSuperseded();
    this.#swap(before, source);
  }

  /** Leaves all deliveries; `join` joins that of the described geometry again. */
  suspend(): void {
    this.cancel();
    this.#source = sourceOf(this.geometry);
  }

  /** Leaves all deliveries. */
  cancel(): void {
    for (const source of [this.#source, this.#replaced]) source?.joined?.cancel();
    this.#setReplaced(undefined);
    this.#dropSuperseded();
    this.#stopPause();
  }

  #joinDelivery(source: GeometrySource): void {
    source.joined ??= this.#deliveries.join(source.geometry, {
      onStage: (patch, stage, drawn = source.geometry) => {
        this.#receiveStage(source, patch, stage, drawn);
      },
      onSwap: () => {
        this.#listener.onSwap();
      },
      onFrame: (frame) => {
        if (source === this.#displayed) {
          this.#displayFrame(source, frame);
          return;
        }
        source.frame = frame;
        this.#displayNewest();
      },
      onError: (error) => {
        if (source === this.#source) this.#listener.onError(error);
      },
      onSettled: () => {
        this.#displayNewest();
        if (source === this.#source) this.#listener.onSettled();
      },
    });
  }

  /** The source whose stages are displayed as they arrive. */
  get #displayed(): GeometrySource | undefined {
    return this.#replaced ?? this.#source;
  }

  /** Displays the described geometry if it is whole, otherwise the superseded one if that is whole. */
  #displayNewest(): void {
    this.displayWhole();
    const source = this.#superseded;
    if (source?.joined?.isSettled !== true) return;
    if (this.#isDisplayable(source)) {
      const before = this.#replaced;
      this.#superseded = undefined;
      this.#setReplaced(source);
      this.#swap(before, source);
    } else if (source.stages.size === 0) {
      this.#dropSuperseded(); // none of its files could be used
    } else {
      return; // its next frame is newer
    }
    this.#endPause();
  }

  /** Whether its files have arrived, and it does not take a stream back to an earlier frame. */
  #isDisplayable({ geometry, stages, joined, frame }: GeometrySource): boolean {
    return stages.size > 0 && joined?.isSettled === true && !this.#frames.isEarlier(geometry, frame);
  }

  /** Nothing is displayed any more. `before`: the geometry that was described until now. */
  #clearAll(before: GeometrySource | undefined): void {
    const displayed = this.#replaced ?? before;
    this.#setReplaced(undefined);
    this.#dropSuperseded();
    this.#stopPause();
    if (displayed !== undefined) this.#clear(displayed, displayed.stages.keys());
    if (displayed !== before) displayed?.joined?.cancel();
  }

  #setReplaced(source: GeometrySource | undefined): void {
    const wasReplacing = this.#replaced !== undefined;
    this.#replaced = source;
    if (wasReplacing !== (source !== undefined)) this.#listener.onReplacing(!wasReplacing);
  }

  #dropSuperseded(): void {
    this.#superseded?.joined?.cancel();
    this.#superseded = undefined;
  }

  #stopPause(): void {
    clearTimeout(this.#pause);
    this.#pause = undefined;
  }

  #restartPause(): void {
    this.#stopPause();
    this.#pause = setTimeout(() => {
      this.#endPause();
    }, pauseMs);
  }

  /** Requests the files of the described geometry, if that has waited. */
  #endPause(): void {
    if (this.#pause === undefined) return;
    this.#stopPause();
    this.join();
    this.#source?.joined?.request();
  }

  #receiveStage(source: GeometrySource, patch: number, stage: Stage | undefined, drawn: GeometryDescription): void {
    if (stage === undefined) source.stages.delete(patch);
    else source.stages.set(patch, [stage, drawn]);
    if (source === this.#source && this.#replaced === undefined) this.#dropSuperseded(); // something is displayed now
    if (source === this.#displayed) this.#listener.onStage({ geometry: source.geometry, patch, stage, drawn });
    if (source !== this.#replaced || source.stages.size > 0) return;
    this.#setReplaced(undefined); // all of it has been evicted
    if (this.#source) this.#swap(source, this.#source);
  }

  /** Replaces the displayed stages at once: no frame is drawn in between. */
  #swap(before: GeometrySource | undefined, after: GeometrySource): void {
    const patches = Array.from(before?.stages.keys() ?? []);
    if (before)
      this.#clear(
        before,
        patches.filter((patch) => !after.stages.has(patch)),
      );
    // Its memory becomes that of the stages which replace it.
    this.#listener.onSwap();
    before?.joined?.cancel();
    const { geometry, stages, frame } = after;
    for (const [patch, [stage, drawn]] of stages) this.#listener.onStage({ geometry, patch, stage, drawn });
    if (frame !== undefined) this.#displayFrame(after, frame);
  }

  #displayFrame({ geometry }: GeometrySource, frame: LiveFrame): void {
    const displayed = this.#frames.display(geometry, frame);
    if (displayed !== undefined) this.#listener.onFrame(displayed);
  }

  #clear({ geometry, stages }: GeometrySource, patches: Iterable<number>): void {
    for (const patch of patches) {
      const [, drawn = geometry] = stages.get(patch) ?? [];
      this.#listener.onStage({ geometry, patch, stage: undefined, drawn });
    }
  }
}

function sourceOf(geometry: GeometryDescription | undefined): GeometrySource | undefined {
  return geometry && { geometry, stages: new Map(), joined: undefined, frame: undefined };
}
