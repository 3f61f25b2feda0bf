// One shape of a scene while it loads: the deliveries of its geometry and of its
// textures. A derived class for each host displays them. When the geometry changes, its last
// stages stay displayed until all files of the new one have arrived, so that no frame is empty.
// A script may change it faster than files load: then one that has begun to load is displayed,
// too, and those described in between are never requested.

import { DeliveryError } from "../delivery/deliveryError.ts";
import type { LiveFrame } from "../delivery/geometryDelivery.ts";
import type { JoinedDelivery } from "../delivery/geometryDeliveries.ts";
import type { Transfer } from "../delivery/progress.ts";
import type { SceneDeliveries } from "../delivery/requestWithinBudget.ts";
import type { TextureImage } from "../delivery/content.ts";
import { RoleTextures } from "../delivery/roleTextures.ts";
import type {
  AppearanceDescription,
  CubeMapPicture,
  CubeMapRole,
  GeometryDescription,
  Playback,
  ShapeDescription,
  TextureDescription,
  TextureRole,
} from "../document/description.ts";
import type { SceneElement } from "../document/element.ts";
import type { Stage } from "../stage/stage.ts";

/** A texture, or a picture of the cube map. */
type LoadedPicture = TextureDescription | CubeMapPicture;

/** A geometry, its delivery and the stages that the delivery has reported last. */
interface GeometrySource {
  readonly geometry: GeometryDescription;
  /** With the geometry that each is drawn with. */
  readonly stages: Map<number, readonly [stage: Stage, drawn: GeometryDescription]>;
  joined: JoinedDelivery | undefined;
  /** The newest frame of a live stream that is not displayed yet. */
  frame: LiveFrame | undefined;
}

/** A frame of a live stream that the shape displays. */
export interface DisplayedFrame extends Omit<LiveFrame, "epoch"> {
  /** Number of frames between this one and the one before, of the same stream. */
  readonly skipped: number;
}

/** A patch displays another stage. */
export interface StageChange {
  /** The shape's geometry, or the one before. */
  readonly geometry: GeometryDescription;
  readonly patch: number;
  /** Undefined: none. */
  readonly stage: Stage | undefined;
  /** As in DeliveryListener. */
  readonly drawn: GeometryDescription;
}

const allFrames: Playback = { paused: false, rate: 0 };

/** While an earlier geometry loads, files are requested this long after a script's last change, in milliseconds. */
const pauseMs = 100;

export abstract class LoadingShape {
  readonly element: SceneElement;
  readonly #deliveries: SceneDeliveries;
  readonly #textures: RoleTextures<TextureRole | CubeMapRole>;
  /** The described geometry. */
  #source: GeometrySource | undefined;
  /** The geometry before, which is displayed until the described one is whole. */
  #replaced: GeometrySource | undefined;
  /** One described between those two that had begun to load: it is displayed if it is whole first. */
  #superseded: GeometrySource | undefined;
  /** Runs while the described geometry waits for further changes. */
  #pause: ReturnType<typeof setTimeout> | undefined;
  #describedTextures: readonly LoadedPicture[] = [];
  #isVisible: boolean;
  #playback: Playback = allFrames;
  /** The frame that was displayed last, and the address of its stream. */
  #lastFrame: (Pick<LiveFrame, "number" | "epoch"> & { readonly stream: string | undefined }) | undefined;
  /** Why the geometry is not drawn, until this has been reported; empty: nothing to report. */
  #problem: string;

  /** Joins no delivery before `join`. */
  constructor(deliveries: SceneDeliveries, { element, geometry, visible, unreadableGeometry = "" }: ShapeDescription) {
    this.element = element;
    this.#source = sourceOf(geometry);
    this.#isVisible = visible;
    this.#problem = unreadableGeometry;
    this.#deliveries = deliveries;
    this.#textures = new RoleTextures(deliveries.textures, {
      onTextureImage: (role, image) => {
        this.onTextureImage(role, image);
      },
      onError: (error) => {
        this.onError(error);
      },
      onSettled: () => {
        this.onSettled();
      },
    });
  }

  protected abstract onStage(change: StageChange): void;
  /** The displayed vertices of a live stream have changed. */
  protected abstract onFrame(frame: DisplayedFrame): void;
  /** The shape has another geometry. The stages of the one before are still displayed. */
  protected abstract onGeometryReplaced(): void;
  /** The shape begins or ends to display a geometry in place of the described one. */
  protected abstract onReplacing(isReplacing: boolean): void;
  /** The delivery of the displayed geometry ends; before the next frame another one's stages replace its stages. */
  protected abstract onSwap(): void;
  /** A texture has another image; undefined: none. The image before is not used after this call. */
  protected abstract onTextureImage(role: TextureRole | CubeMapRole, image: TextureImage | undefined): void;
  protected abstract onError(error: DeliveryError): void;
  /** All files that were requested of the geometry, or of a texture, have loaded or failed. */
  protected abstract onSettled(): void;
  /** The scene no longer has the shape. Stages and images of its deliveries must no longer be displayed. */
  abstract onRemoved(): void;

  /** The pictures of an appearance that the host displays. */
  protected picturesOf({ textures }: AppearanceDescription): readonly LoadedPicture[] {
    return textures;
  }

  /** The first URL of the picture described last in a role; empty: there is none. */
  protected urlOf(role: TextureRole | CubeMapRole): string {
    return this.#describedTextures.find((picture) => picture.role === role)?.urls[0] ?? "";
  }

  get geometry(): GeometryDescription | undefined {
    return this.#source?.geometry;
  }

  /** Whether any instance of the shape is visible. */
  get isVisible(): boolean {
    return this.#isVisible;
  }

  /** Whether the geometry's delivery is joined. */
  get isJoined(): boolean {
    return this.#source?.joined !== undefined;
  }

  /** Whether no file of the geometry is being loaded. */
  get isGeometrySettled(): boolean {
    return this.#source === undefined || this.#source.joined?.isSettled === true;
  }

  /** Whether no file of the shape, its textures included, is being loaded. */
  get isSettled(): boolean {
    return this.isGeometrySettled && this.#textures.isSettled;
  }

  /** The files that have been requested. */
  get transfers(): readonly Readonly<Transfer>[] {
    return [...(this.#source?.joined?.transfers ?? []), ...this.#textures.transfers];
  }

  /**
   * Follows a changed description; joins deliveries unless `isSuspended`. Returns a function that ends the deliveries
   * that are no longer needed: call it after the files of new shapes have been requested.
   */
  follow(described: ShapeDescription, isSuspended: boolean): () => void {
    const { visible, appearance, geometry, unreadableGeometry = "", playback = allFrames } = described;
    this.#playback = playback;
    this.#isVisible = visible;
    const hasChips = geometry?.levels?.chips !== undefined; // whose groups have images in place of the color texture
    this.#describedTextures = this.picturesOf(appearance).filter(({ role }) => !hasChips || role !== "color");
    const left = geometry === this.geometry ? undefined : this.#replaceGeometry(geometry, unreadableGeometry);
    if (!isSuspended) this.join();
    return () => left?.joined?.cancel();
  }

  /** Joins the deliveries of the geometry and of the textures described last. */
  join(): void {
    if (this.#problem !== "") {
      const problem = this.#problem;
      this.#problem = ""; // reported once
      this.onError(new DeliveryError("unsupported", "", problem));
    }
    if (this.#source !== undefined && this.#pause === undefined) this.#joinDelivery(this.#source);
    this.#source?.joined?.setPlayback(this.#playback);
    this.#textures.follow(this.#describedTextures);
  }

  #joinDelivery(source: GeometrySource): void {
    source.joined ??= this.#deliveries.geometries.join(source.geometry, {
      onStage: (patch, stage, drawn = source.geometry) => {
        this.#receiveStage(source, patch, stage, drawn);
      },
      onSwap: () => {
        this.onSwap();
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
        if (source === this.#source) this.onError(error);
      },
      onSettled: () => {
        this.#displayNewest();
        if (source === this.#source) this.onSettled();
      },
    });
  }

  /** The source whose stages are displayed as they arrive. */
  get #displayed(): GeometrySource | undefined {
    return this.#replaced ?? this.#source;
  }

  /**
   * Displays the described geometry in place of the one before, if it has something to display and no file of it is
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
    if (stages.size === 0 || joined?.isSettled !== true) return false;
    const last = this.#lastFrame;
    const isSameEpoch = last?.stream === streamOf(geometry) && last?.epoch === frame?.epoch;
    return !isSameEpoch || last === undefined || frame === undefined || frame.number >= last.number;
  }

  /** Leaves all deliveries and reports that textures have no images any more; `join` joins them again. */
  suspend(): void {
    this.#leaveGeometries();
    this.#source = sourceOf(this.geometry);
    this.#textures.follow([]);
  }

  /** Leaves all deliveries. The shape must not be used again. */
  cancel(): void {
    this.#leaveGeometries();
    this.#textures.cancel();
  }

  #leaveGeometries(): void {
    for (const source of [this.#source, this.#replaced]) source?.joined?.cancel();
    this.#setReplaced(undefined);
    this.#dropSuperseded();
    this.#stopPause();
  }

  /** Returns the geometry whose delivery is no longer needed; undefined: it is still displayed, or goes on to load. */
  #replaceGeometry(geometry: GeometryDescription | undefined, problem: string): GeometrySource | undefined {
    const before = this.#source;
    this.#source = sourceOf(geometry);
    this.#problem = problem;
    this.onGeometryReplaced();
    if (geometry === undefined) return this.#clearGeometry(before);
    if (before === undefined) return undefined;
    if (this.#replaced === undefined && before.stages.size > 0) {
      this.#setReplaced(before);
      return undefined;
    }
    const goesOn = this.#superseded === undefined && before.joined?.isSettled === false;
    if (goesOn) this.#superseded = before;
    this.#superseded?.joined?.leadTo(geometry);
    if (this.#superseded !== undefined && this.#replaced !== undefined) this.#restartPause();
    return goesOn ? undefined : before;
  }

  /** The shape has no geometry. Returns the source whose delivery is no longer needed. */
  #clearGeometry(before: GeometrySource | undefined): GeometrySource | undefined {
    const displayed = this.#replaced ?? before;
    this.#setReplaced(undefined);
    this.#dropSuperseded();
    this.#stopPause();
    if (displayed !== undefined) this.#clear(displayed, displayed.stages.keys());
    if (displayed !== before) displayed?.joined?.cancel();
    return before;
  }

  #setReplaced(source: GeometrySource | undefined): void {
    const wasReplacing = this.#replaced !== undefined;
    this.#replaced = source;
    if (wasReplacing !== (source !== undefined)) this.onReplacing(!wasReplacing);
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
    if (source === this.#displayed) this.onStage({ geometry: source.geometry, patch, stage, drawn });
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
    this.onSwap();
    before?.joined?.cancel();
    for (const [patch, [stage, drawn]] of after.stages) this.onStage({ geometry: after.geometry, patch, stage, drawn });
    if (after.frame !== undefined) this.#displayFrame(after, after.frame);
  }

  /**
   * Frames are numbered consecutively, so that none is missed in the count, whichever delivery of a stream they come
   * from: another form of the same stream has another delivery.
   */
  #displayFrame({ geometry }: GeometrySource, { number, epoch, time }: LiveFrame): void {
    const stream = streamOf(geometry);
    const last = this.#lastFrame?.stream === stream ? this.#lastFrame?.number : undefined;
    if (number === last) return;
    this.#lastFrame = { stream, number, epoch };
    this.onFrame({ number, time, skipped: last === undefined ? 0 : Math.max(0, number - last - 1) });
  }

  #clear({ geometry, stages }: GeometrySource, patches: Iterable<number>): void {
    for (const patch of patches) {
      const [, drawn = geometry] = stages.get(patch) ?? [];
      this.onStage({ geometry, patch, stage: undefined, drawn });
    }
  }
}

/** The address of a live stream; for other geometry without meaning. */
function streamOf({ patches: [patch] }: GeometryDescription): string | undefined {
  return patch?.coord[0]?.url;
}

function sourceOf(geometry: GeometryDescription | undefined): GeometrySource | undefined {
  return geometry && { geometry, stages: new Map(), joined: undefined, frame: undefined };
}
