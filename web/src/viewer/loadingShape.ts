// One shape of a scene while it loads: the deliveries of its geometry and of its
// textures. A derived class for each host displays them.

import { DeliveryError } from "../delivery/deliveryError.ts";
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
  ShapeDescription,
  TextureDescription,
  TextureRole,
} from "../document/description.ts";
import type { SceneElement } from "../document/element.ts";
import type { Stage } from "../stage/stage.ts";

/** A texture, or a picture of the cube map. */
type LoadedPicture = TextureDescription | CubeMapPicture;

export abstract class LoadingShape {
  readonly element: SceneElement;
  readonly geometry: GeometryDescription | undefined;
  readonly #deliveries: SceneDeliveries;
  readonly #textures: RoleTextures<TextureRole | CubeMapRole>;
  #delivery: JoinedDelivery | undefined;
  #describedTextures: readonly LoadedPicture[] = [];
  #isVisible: boolean;
  /** Why the geometry is not drawn, until this has been reported; empty: nothing to report. */
  #problem: string;

  /** Joins no delivery before `join`. */
  constructor(deliveries: SceneDeliveries, { element, geometry, visible, unreadableGeometry = "" }: ShapeDescription) {
    this.element = element;
    this.geometry = geometry;
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

  /** A patch has another stage; undefined: none. */
  protected abstract onStage(patch: number, stage: Stage | undefined): void;
  /** A texture has another image; undefined: none. The image before is not used after this call. */
  protected abstract onTextureImage(role: TextureRole | CubeMapRole, image: TextureImage | undefined): void;
  protected abstract onError(error: DeliveryError): void;
  /** All files that were requested of the geometry, or of a texture, have loaded or failed. */
  protected abstract onSettled(): void;
  /**
   * The scene no longer has the shape, or the shape has another geometry. Stages and images of its deliveries must no
   * longer be displayed.
   */
  abstract onRemoved(): void;

  /** The pictures of an appearance that the host displays. */
  protected picturesOf({ textures }: AppearanceDescription): readonly LoadedPicture[] {
    return textures;
  }

  /** The first URL of the picture described last in a role; empty: there is none. */
  protected urlOf(role: TextureRole | CubeMapRole): string {
    return this.#describedTextures.find((picture) => picture.role === role)?.urls[0] ?? "";
  }

  /** Whether any instance of the shape is visible. */
  get isVisible(): boolean {
    return this.#isVisible;
  }

  /** Whether the geometry's delivery is joined. */
  get isJoined(): boolean {
    return this.#delivery !== undefined;
  }

  /** Whether no file of the geometry is being loaded. */
  get isGeometrySettled(): boolean {
    return this.geometry === undefined || this.#delivery?.isSettled === true;
  }

  /** Whether no file of the shape, its textures included, is being loaded. */
  get isSettled(): boolean {
    return this.isGeometrySettled && this.#textures.isSettled;
  }

  /** The files that have been requested. */
  get transfers(): readonly Readonly<Transfer>[] {
    return [...(this.#delivery?.transfers ?? []), ...this.#textures.transfers];
  }

  /** Follows a changed description of the same geometry; joins deliveries unless `isSuspended`. */
  follow({ visible, appearance }: ShapeDescription, isSuspended: boolean): void {
    this.#isVisible = visible;
    this.#describedTextures = this.picturesOf(appearance);
    if (!isSuspended) this.join();
  }

  /** Joins the deliveries of the geometry and of the textures described last. */
  join(): void {
    const { geometry } = this;
    if (this.#problem !== "") {
      const problem = this.#problem;
      this.#problem = ""; // reported once
      this.onError(new DeliveryError("unsupported", "", problem));
    }
    if (geometry !== undefined)
      this.#delivery ??= this.#deliveries.geometries.join(geometry, {
        onStage: (patch, stage) => {
          this.onStage(patch, stage);
        },
        onError: (error) => {
          this.onError(error);
        },
        onSettled: () => {
          this.onSettled();
        },
      });
    this.#textures.follow(this.#describedTextures);
  }

  /** Leaves all deliveries and reports that textures have no images any more; `join` joins them again. */
  suspend(): void {
    this.#delivery?.cancel();
    this.#delivery = undefined;
    this.#textures.follow([]);
  }

  /** Leaves all deliveries. The shape must not be used again. */
  cancel(): void {
    this.#delivery?.cancel();
    this.#textures.cancel();
  }
}
