// One shape of a scene while it loads: the deliveries of its geometry and of its
// textures. A derived class for each host displays them. When the geometry changes, its last
// stages stay displayed until all files of the new one have arrived, so that no frame is empty.

import { DeliveryError } from "../delivery/deliveryError.ts";
import type { LiveFrame } from "../delivery/geometryDelivery.ts";
import type { JoinedDelivery } from "../delivery/geometryDeliveries.ts";
import type { Transfer } from "../delivery/progress.ts";
import type { SceneDeliveries } from "../delivery/requestWithinBudget.ts";
import type { TextureImage } from "../delivery/resourcePool.ts";
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
export interface DisplayedFrame extends LiveFrame {
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

export abstract class LoadingShape {
  readonly element: SceneElement;
  readonly #deliveries: SceneDeliveries;
  readonly #textures: RoleTextures<TextureRole | CubeMapRole>;
  /** The described geometry. */
  #source: GeometrySource | undefined;
  /** The geometry before, which is displayed until the described one is whole. */
  #replaced: GeometrySource | undefined;
  #describedTextures: readonly LoadedPicture[] = [];
  #isVisible: boolean;
  #playback: Playback = allFrames;
  /** The frame that was displayed last, and the address of its stream. */
  #lastFrame: { readonly stream: string | undefined; readonly number: number } | undefined;
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
    this.#describedTextures = this.picturesOf(appearance);
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
    const source = this.#source;
    if (source !== undefined)
      source.joined ??= this.#deliveries.geometries.join(source.geometry, {
        onStage: (patch, stage, drawn = source.geometry) => {
          this.#receiveStage(source, patch, stage, drawn);
        },
        onFrame: (frame) => {
          if (source === (this.#replaced ?? this.#source)) this.#displayFrame(source, frame);
          else source.frame = frame;
        },
        onError: (error) => {
          if (source === this.#source) this.onError(error);
        },
        onSettled: () => {
          if (source !== this.#source) return;
          this.displayWhole();
          this.onSettled();
        },
      });
    source?.joined?.setPlayback(this.#playback);
    this.#textures.follow(this.#describedTextures);
  }

  /**
   * Displays the described geometry in place of the one before, if it has something to display and no file of it is
   * being loaded. If none of its files could be used, the one before stays.
   */
  displayWhole(): void {
    if (this.#replaced !== undefined && this.#source?.stages.size !== 0 && this.isGeometrySettled) this.#swap();
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
    this.#replaced = undefined;
  }

  /** Returns the geometry whose delivery is no longer needed; undefined: the one before is still displayed. */
  #replaceGeometry(geometry: GeometryDescription | undefined, problem: string): GeometrySource | undefined {
    const before = this.#source;
    this.#source = sourceOf(geometry);
    this.#problem = problem;
    this.onGeometryReplaced();
    if (this.#replaced === undefined && geometry !== undefined && before !== undefined && before.stages.size > 0) {
      this.#replaced = before;
      return undefined;
    }
    if (geometry !== undefined) return before;
    const displayed = this.#replaced ?? before;
    this.#replaced = undefined;
    if (displayed !== undefined) this.#clear(displayed, displayed.stages.keys());
    if (displayed !== before) displayed?.joined?.cancel();
    return before;
  }

  #receiveStage(source: GeometrySource, patch: number, stage: Stage | undefined, drawn: GeometryDescription): void {
    if (stage === undefined) source.stages.delete(patch);
    else source.stages.set(patch, [stage, drawn]);
    if (source === (this.#replaced ?? this.#source)) this.onStage({ geometry: source.geometry, patch, stage, drawn });
    if (source === this.#replaced && source.stages.size === 0) this.#swap(); // all of it has been evicted
  }

  /** Replaces the displayed stages at once: no frame is drawn in between. */
  #swap(): void {
    const [before, after] = [this.#replaced, this.#source];
    this.#replaced = undefined;
    if (before === undefined || after === undefined) return;
    this.#clear(
      before,
      Array.from(before.stages.keys()).filter((patch) => !after.stages.has(patch)),
    );
    for (const [patch, [stage, drawn]] of after.stages) this.onStage({ geometry: after.geometry, patch, stage, drawn });
    if (after.frame !== undefined) this.#displayFrame(after, after.frame);
    before.joined?.cancel();
  }

  /**
   * Frames are numbered consecutively, so that none is missed in the count, whichever delivery of a stream they come
   * from: another form of the same stream has another delivery.
   */
  #displayFrame({ geometry }: GeometrySource, frame: LiveFrame): void {
    const stream = geometry.patches[0]?.coord[0]?.url;
    const last = this.#lastFrame?.stream === stream ? this.#lastFrame?.number : undefined;
    if (frame.number === last) return;
    this.#lastFrame = { stream, number: frame.number };
    this.onFrame({ ...frame, skipped: last === undefined ? 0 : Math.max(0, frame.number - last - 1) });
  }

  #clear({ geometry, stages }: GeometrySource, patches: Iterable<number>): void {
    for (const patch of patches) {
      const [, drawn = geometry] = stages.get(patch) ?? [];
      this.onStage({ geometry, patch, stage: undefined, drawn });
    }
  }
}

function sourceOf(geometry: GeometryDescription | undefined): GeometrySource | undefined {
  return geometry && { geometry, stages: new Map(), joined: undefined, frame: undefined };
}
