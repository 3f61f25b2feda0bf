// The scene of a SceneDescription as three.js draws it: shapes, lights and what is around them. Each change requests a
// frame.

import type { Sphere, WebGLRenderer } from "three";
import { Scene, Vector4 } from "three";
import type { CubeMapRole, GeometryDescription, SceneDescription, TextureRole } from "../document/description.ts";
import type { SceneElement } from "../document/element.ts";
import type { PoseChange } from "../scene/instanceTree.ts";
import type { DecodedImage } from "../stage/decodedImage.ts";
import type { Stage } from "../stage/stage.ts";
import { LateBatches } from "./batches/lateBatches.ts";
import { DrawnSurroundings } from "./environment/drawnSurroundings.ts";
import { makeSceneEffectUniforms } from "./environment/sceneEffects.ts";
import type { FrameRequests } from "./frames/frameRequests.ts";
import type { ViewCamera } from "./frames/viewCamera.ts";
import { Backdrop } from "./materials/extendedMaterials.ts";
import type { SceneUniforms } from "./materials/materialFactory.ts";
import { x3dMaterials } from "./materials/x3dMaterials.ts";
import { ProgramWarmUp } from "./shapes/programWarmUp.ts";
import type { BuiltScene, ChangedScene } from "./shapes/sceneShapes.ts";
import { SceneShapes } from "./shapes/sceneShapes.ts";
import { GeometryPool } from "./stages/geometryPool.ts";
import type { TextureProvider } from "./uploads/textureProvider.ts";
import type { SceneUploads } from "./uploads/sceneUploads.ts";

/** A texture image on the GPU. */
export interface TextureImage {
  readonly image: DecodedImage;
  readonly hasAlpha: boolean;
}

/** What does not change the picture. */
export type QueriedShapes = Pick<
  SceneShapes,
  | "isEmpty"
  | "sphere"
  | "maxWidth"
  | "takeMoved"
  | "sceneFromTransform"
  | "anchorAround"
  | "pickCandidates"
  | "candidatesIgnoringCulling"
>;

export class RenderedScene {
  readonly surroundings: DrawnSurroundings;
  readonly #root = new Scene();
  readonly #camera: ViewCamera;
  readonly #frames: FrameRequests;
  readonly #textures: TextureProvider;
  readonly #shared: SceneUniforms;
  readonly #shapes: SceneShapes;
  readonly #warmUp: ProgramWarmUp;

  constructor(renderer: WebGLRenderer, camera: ViewCamera, uploads: SceneUploads, frames: FrameRequests) {
    const { buffers, textures } = uploads;
    const { pixelRatio, depthRange } = camera;
    this.#camera = camera;
    this.#frames = frames;
    this.#textures = textures;
    this.#shared = {
      pixelRatio,
      depthRange,
      viewport: { value: new Vector4() },
      backdrop: new Backdrop(),
      ...makeSceneEffectUniforms(),
    };
    this.surroundings = new DrawnSurroundings(this.#root, textures, frames);
    const geometries = new GeometryPool(buffers);
    this.#shapes = new SceneShapes(this.#root, {
      materialFactory: x3dMaterials,
      geometries,
      buffers,
      textures,
      surroundings: () => this.surroundings.late,
      shared: this.#shared,
      batches: new LateBatches(x3dMaterials, geometries, buffers),
      drawing: { asPoints: false },
    });
    this.#root.add(camera.current);
    this.#root.matrixAutoUpdate = false; // otherwise three.js updates all world matrices in every frame
    this.#warmUp = new ProgramWarmUp(renderer, camera.current, this.#root);
  }

  get shapes(): QueriedShapes {
    return this.#shapes;
  }

  /** The bounding sphere of all visible shapes, in scene coordinates. Grows when vertices arrive outside it. */
  get sphere(): Sphere {
    return this.#shapes.sphere;
  }

  /** Replaces the scene. GPU resources of shapes that it no longer has are freed. */
  set(description: SceneDescription): ChangedScene {
    this.surroundings.addLate(this.#shared);
    const built = this.#shapes.setScene(description);
    this.#camera.headlight.visible = description.navigation.headlight;
    this.surroundings.follow(built);
    this.#warmUp.compile(built.changes.shapes.values(), this.#shapes.plan, x3dMaterials, this.#shared);
    return built;
  }

  /**
   * Gives Transforms and displacers of the scene other values, without a description of the whole scene. The next
   * description must have these values.
   */
  move(changes: Iterable<PoseChange>): BuiltScene {
    const built = this.#shapes.move(changes);
    this.surroundings.follow(built);
    return built;
  }

  /** Binds or unbinds a Fog, as X3D's set_bind does. Returns false if the element is none of the scene's. */
  bindFog(element: SceneElement, isBound: boolean): boolean {
    if (!this.#shapes.bindFog(element, isBound)) return false;
    this.#frames.request();
    return true;
  }

  /** Replaces the stage of a patch of a shape of the current scene. */
  setStage(element: SceneElement, geometry: GeometryDescription, patch: number, stage: Stage | undefined): void {
    this.#shapes.setStage(element, geometry, patch, stage);
    this.surroundings.drawLoaded();
  }

  /** Sets a texture of a shape; `undefined` removes it. */
  setTextureImage(element: SceneElement, role: TextureRole | CubeMapRole, image: TextureImage | undefined): void {
    this.#shapes.setTexture(
      element,
      role,
      image && { texture: this.#textures.textureOf(image.image), hasAlpha: image.hasAlpha },
    );
    this.surroundings.drawLoaded();
  }

  /** Removes everything that a shape displays. */
  clearShape(element: SceneElement): void {
    this.#shapes.clearShape(element);
    this.#frames.request();
  }

  /** `asPoints`: draws the vertices of surfaces as points, and no triangles. */
  drawAsPoints(asPoints: boolean): void {
    this.#shapes.drawAsPoints(asPoints);
    this.#frames.request();
  }

  /** Call before a frame: hides what the camera does not see. */
  cull(): void {
    const { current, size, pixelRatio } = this.#camera;
    this.#shapes.cull(current, [size.width / pixelRatio.value, size.height / pixelRatio.value]);
  }

  /** Draws the scene into cube maps whose pictures have changed. Call `cull` afterwards. */
  drawCubeMaps(renderer: WebGLRenderer): void {
    this.surroundings.late?.update(renderer, this.#root, this.sphere, (camera, size) => {
      this.#shapes.cull(camera, [size, size]);
    });
  }

  draw(renderer: WebGLRenderer): void {
    renderer.render(this.#root, this.#camera.current);
  }

  dispose(): void {
    this.#shapes.dispose();
    this.surroundings.dispose();
  }
}
