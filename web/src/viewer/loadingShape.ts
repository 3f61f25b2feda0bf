// One shape of a scene while it loads: its geometry and its textures. A derived class for each host displays them.

import type { TextureImage } from "../delivery/content.ts";
import { DeliveryError } from "../delivery/deliveryError.ts";
import type { Transfer } from "../delivery/progress.ts";
import type { SceneDeliveries } from "../delivery/requestWithinBudget.ts";
import type { RoleTexturesListener } from "../delivery/roleTextures.ts";
import { RoleTextures } from "../delivery/roleTextures.ts";
import type {
  AppearanceDescription,
  CubeMapPicture,
  CubeMapRole,
  GeometryDescription,
  ShapeDescription,
  TextureDescription,
  TextureRole,
} from "../document/description.ts";
import type { SceneElement } from "../document/element.ts";
import type { DisplayedFrame } from "./displayedFrames.ts";
import type { GeometryExchangeListener, StageChange } from "./geometryExchange.ts";
import { allFrames, GeometryExchange } from "./geometryExchange.ts";

/** A texture, or a picture of the cube map. */
type LoadedPicture = TextureDescription | CubeMapPicture;

export abstract class LoadingShape
  implements GeometryExchangeListener, RoleTexturesListener<TextureRole | CubeMapRole>
{
  readonly element: SceneElement;
  readonly #exchange: GeometryExchange;
  readonly #textures: RoleTextures<TextureRole | CubeMapRole>;
  #describedTextures: readonly LoadedPicture[] = [];
  #isVisible: boolean;
  /** Why the geometry is not drawn, until this has been reported; empty: nothing to report. */
  #problem: string;

  /** Joins no delivery before `join`. */
  constructor(deliveries: SceneDeliveries, { element, geometry, visible, unreadableGeometry = "" }: ShapeDescription) {
    this.element = element;
    this.#isVisible = visible;
    this.#problem = unreadableGeometry;
    this.#exchange = new GeometryExchange(deliveries.geometries, geometry, this);
    this.#textures = new RoleTextures(deliveries.textures, this);
  }

  abstract onStage(change: StageChange): void;
  abstract onFrame(frame: DisplayedFrame): void;
  abstract onGeometryReplaced(): void;
  abstract onReplacing(isReplacing: boolean): void;
  abstract onSwap(): void;
  abstract onTextureImage(role: TextureRole | CubeMapRole, image: TextureImage | undefined): void;
  abstract onError(error: DeliveryError): void;
  /** All files that were requested of the geometry, or of a texture, have loaded or failed. */
  abstract onSettled(): void;
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

  /** The described geometry. */
  get geometry(): GeometryDescription | undefined {
    return this.#exchange.geometry;
  }

  /** Whether any instance of the shape is visible. */
  get isVisible(): boolean {
    return this.#isVisible;
  }

  /** Whether the geometry's delivery is joined. */
  get isJoined(): boolean {
    return this.#exchange.isJoined;
  }

  /** Whether no file of the geometry is being loaded. */
  get isGeometrySettled(): boolean {
    return this.#exchange.isSettled;
  }

  /** Whether no file of the shape, its textures included, is being loaded. */
  get isSettled(): boolean {
    return this.isGeometrySettled && this.#textures.isSettled;
  }

  /** The files that have been requested. */
  get transfers(): readonly Readonly<Transfer>[] {
    return [...this.#exchange.transfers, ...this.#textures.transfers];
  }

  /**
   * Follows a changed description; joins deliveries unless `isSuspended`. Returns a function that ends the deliveries
   * that are no longer needed: call it after the files of new shapes have been requested.
   */
  follow(described: ShapeDescription, isSuspended: boolean): () => void {
    const { visible, appearance, geometry, unreadableGeometry = "", playback = allFrames } = described;
    this.#exchange.playback = playback;
    this.#isVisible = visible;
    const hasChips = geometry?.levels?.chips !== undefined; // whose groups have images instead of the color texture
    this.#describedTextures = this.picturesOf(appearance).filter(({ role }) => !hasChips || role !== "color");
    const isReplaced = geometry !== this.geometry;
    if (isReplaced) this.#problem = unreadableGeometry;
    const left = isReplaced ? this.#exchange.replace(geometry) : undefined;
    if (!isSuspended) this.join();
    return () => left?.cancel();
  }

  /** Joins the deliveries of the geometry and of the textures described last. */
  join(): void {
    if (this.#problem !== "") {
      const problem = this.#problem;
      this.#problem = ""; // reported once
      this.onError(new DeliveryError("unsupported", "", problem));
    }
    this.#exchange.join();
    this.#textures.follow(this.#describedTextures);
  }

  /** Displays the described geometry instead of the one before, if it is whole. */
  displayWhole(): void {
    this.#exchange.displayWhole();
  }

  /** Leaves all deliveries and reports that textures have no images any more; `join` joins them again. */
  suspend(): void {
    this.#exchange.suspend();
    this.#textures.follow([]);
  }

  /** Leaves all deliveries. The shape must not be used again. */
  cancel(): void {
    this.#exchange.cancel();
    this.#textures.cancel();
  }
}
