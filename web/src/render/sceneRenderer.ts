// Draws the scene of a SceneDescription into a canvas, whenever something has changed.

import type { Object3D, Sphere } from "three";
import {
  DirectionalLight,
  Group,
  LinearSRGBColorSpace,
  LinearToneMapping,
  Matrix4,
  NoToneMapping,
  PerspectiveCamera,
  Scene,
  Vector2,
  Vector3,
  Vector4,
  WebGLRenderer,
} from "three";
import type { DecodedImage } from "../stage/decodedImage.ts";
import type { Stage } from "../stage/stage.ts";
import type {
  AnchorDescription,
  CubeMapRole,
  GeometryDescription,
  PanoramaSide,
  SceneDescription,
  ShapeDescription,
  TextureRole,
} from "../document/description.ts";
import type { SceneElement } from "../document/element.ts";
import type { BackgroundInstance } from "../scene/instances.ts";
import type { PoseChange } from "../scene/instanceTree.ts";
import type { NodeInstance } from "../scene/nodeInstance.ts";
import { applyPose } from "../navigation/cameraPose.ts";
import { SceneBackground } from "./frames/sceneBackground.ts";
import { LateBatches } from "./batches/lateBatches.ts";
import type { SceneUniforms } from "./materials/materialFactory.ts";
import { Backdrop } from "./materials/extendedMaterials.ts";
import { x3dMaterials } from "./materials/x3dMaterials.ts";
import { FramePacer } from "./frames/framePacing.ts";
import type { Hit } from "./picking/picker.ts";
import { makeClipPlaneUniforms } from "./environment/clipPlanes.ts";
import { makeEnvironmentUniforms, makeFogUniforms } from "./environment/effectUniforms.ts";
import { lateEnvironment } from "./environment/lateEnvironment.ts";
import type { EnvironmentPicture, EnvironmentRole } from "./environment/sceneEnvironment.ts";
import type { SceneSurroundings } from "./environment/sceneSurroundings.ts";
import { makeLightUniforms } from "./lights/sceneLights.ts";
import type { BuiltScene, ChangedScene } from "./shapes/sceneShapes.ts";
import { SceneShapes } from "./shapes/sceneShapes.ts";
import { ScreenPicker } from "./picking/screenPicker.ts";
import { ControllerQueries } from "./picking/controllerQueries.ts";
import { GeometryPool } from "./stages/geometryPool.ts";
import { defaultPointSize } from "./stages/stageUniforms.ts";
import { warmUpObjects } from "./shapes/programWarmUp.ts";
import { SceneUploads } from "./uploads/sceneUploads.ts";
import type { CameraController, View } from "./view.ts";

/** What has been drawn, and what is on the GPU. */
export interface RenderStatistics {
  readonly frames: number;
  /** Draw calls of the last frame. */
  readonly drawCalls: number;
  readonly textures: number;
  readonly geometries: number;
  readonly programs: number;
  /** Whether a change waits for its first frame, or for a part of the runtime. */
  readonly isFrameDue: boolean;
  /** GPU memory of images: vertex data and textures of appearances. */
  readonly textureBytes: number;
  /** Memory of vertex data in buffers. */
  readonly bufferBytes: number;
}

const noPictures: readonly EnvironmentPicture[] = [];

/** A texture image on the GPU. */
export interface TextureImage {
  readonly image: DecodedImage;
  readonly hasAlpha: boolean;
}

export class SceneRenderer {
  readonly uploads: SceneUploads;
  readonly #renderer: WebGLRenderer;
  readonly #scene = new Scene();
  readonly #camera = new PerspectiveCamera();
  /** The camera of the last frame. */
  readonly #drawnCamera = new PerspectiveCamera();
  readonly #headlight = new DirectionalLight();
  readonly #shared: SceneUniforms = {
    pixelRatio: { value: 1 },
    viewport: { value: new Vector4() },
    depthRange: { value: new Vector2() },
    backdrop: new Backdrop(),
    ...makeLightUniforms(),
    ...makeClipPlaneUniforms(),
    ...makeFogUniforms(),
    ...makeEnvironmentUniforms(),
  };
  readonly #shapes: SceneShapes;
  readonly #cameraController: CameraController;
  readonly #onFrame: () => void;
  readonly #isShownElsewhere: () => boolean;
  readonly #picker: ScreenPicker;
  readonly #queries: ControllerQueries;
  readonly #framePacer: FramePacer;
  /** Undefined before the first scene that needs it. */
  #surroundings: SceneSurroundings | undefined;
  readonly #background = new SceneBackground(this.#scene);
  #size = { width: 0, height: 0 };
  #frames = 0;
  /** Whether `#drawnCamera` is that of a frame. */
  #hasDrawnCamera = false;
  #drawCalls = 0;
  #frameRequest = 0;
  /** Materials of these objects keep programs alive. */
  readonly #compiled = new Map<string, Object3D>();

  /**
   * `onFrame` is called after each frame. `isShownElsewhere`: whether the picture that the next requested frame would
   * have is visible without it. Such a frame does all but drawing.
   */
  constructor(
    canvas: HTMLCanvasElement,
    context: WebGL2RenderingContext,
    cameraController: CameraController,
    onFrame: () => void,
    isShownElsewhere: () => boolean,
  ) {
    this.#cameraController = cameraController;
    this.#onFrame = onFrame;
    this.#isShownElsewhere = isShownElsewhere;
    this.#renderer = new WebGLRenderer({ canvas, context, antialias: true, alpha: true });
    // three.js counts the textures of vertex and fragment shaders together; fragment shaders alone have fewer units
    // (document/pictureLimit.ts).
    this.#renderer.capabilities.maxTextures = context.getParameter(context.MAX_COMBINED_TEXTURE_IMAGE_UNITS) as number;
    this.uploads = new SceneUploads(this.#renderer, context, () => {
      this.requestFrame();
    });
    const { buffers, textures } = this.uploads;
    const geometries = new GeometryPool(buffers);
    this.#shapes = new SceneShapes(this.#scene, {
      materialFactory: x3dMaterials,
      geometries,
      buffers,
      textures,
      surroundings: () => this.#surroundings,
      shared: this.#shared,
      batches: new LateBatches(x3dMaterials, geometries, buffers),
      drawing: { asPoints: false },
    });
    this.#framePacer = new FramePacer(context);
    this.#picker = new ScreenPicker(this.#renderer, this.#drawnCamera, () => this.#shapes.pickCandidates());
    this.#queries = new ControllerQueries(this.#renderer, cameraController, {
      camera: this.#drawnCamera,
      size: () => this.#size,
      sphere: () => this.sphere,
      pick: (x, y) => this.pickAsync(x, y),
      candidates: () => this.#shapes.candidatesIgnoringCulling(),
      requestFrame: () => {
        this.requestFrame();
      },
    });
    // Colours are not converted: see materials/x3dMaterials.ts.
    this.#renderer.outputColorSpace = LinearSRGBColorSpace;
    this.#renderer.toneMapping = NoToneMapping;
    // The headlight is a child of the camera and shines along its -z.
    this.#headlight.position.set(0, 0, 0);
    this.#headlight.target.position.set(0, 0, -1);
    this.#camera.add(this.#headlight, this.#headlight.target);
    this.#scene.add(this.#camera);
    this.#scene.matrixAutoUpdate = false; // otherwise three.js updates all world matrices in every frame
  }

  get statistics(): RenderStatistics {
    const { memory, programs } = this.#renderer.info;
    return {
      frames: this.#frames,
      drawCalls: this.#drawCalls,
      isFrameDue: this.#framePacer.isFramePending,
      textures: memory.textures,
      geometries: memory.geometries,
      programs: programs?.length ?? 0,
      textureBytes: this.uploads.textures.bytes,
      bufferBytes: this.uploads.buffers.bytes,
    };
  }

  /** Whether no shape displays anything yet. */
  get isEmpty(): boolean {
    return this.#shapes.isEmpty;
  }

  /** Whether the WebGL context is lost: until the browser restores it, nothing is drawn and nothing is on the GPU. */
  get isContextLost(): boolean {
    return this.#renderer.getContext().isContextLost();
  }

  /** The camera's view of the scene; undefined while the canvas has no area. */
  get view(): View | undefined {
    if (!this.#hasArea) return undefined;
    const camera = this.#camera;
    applyPose(camera, this.#cameraController.pose, this.#aspect, this.sphere, this.#cameraController.clearance);
    camera.updateMatrixWorld();
    return {
      position: camera.position.toArray(),
      clipFromScene: new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse).elements,
      pixelsPerUnit: (camera.projectionMatrix.elements[5] * this.#size.height) / 2,
      near: camera.near,
    };
  }

  /** The ray from the last frame's camera through a point of the canvas, -1 … 1 from the left and from the bottom. */
  rayAt(x: number, y: number): { origin: [number, number, number]; direction: [number, number, number] } {
    const camera = this.#drawnCamera;
    const origin = new Vector3().setFromMatrixPosition(camera.matrixWorld);
    const direction = new Vector3(x, y, 0.5).unproject(camera).sub(origin).normalize();
    return { origin: origin.toArray(), direction: direction.toArray() };
  }

  /** Replaces the scene. GPU resources of shapes that it no longer has are freed. */
  setScene(description: SceneDescription): ChangedScene {
    this.#surroundings ??= lateEnvironment.added?.surroundings(this.#shared);
    const built = this.#shapes.setScene(description);
    this.#headlight.visible = description.navigation.headlight;
    this.#background.follow(built.backgrounds);
    this.#surroundings?.environment.follow(built.environmentLights);
    this.#compileAhead(built.changes.shapes.values());
    this.requestFrame();
    return built;
  }

  /**
   * Gives Transforms and displacers of the scene other values, without a description of the whole scene. The next
   * description must have these values.
   */
  move(changes: Iterable<PoseChange>): BuiltScene {
    const built = this.#shapes.move(changes);
    this.#background.follow(built.backgrounds);
    this.#surroundings?.environment.follow(built.environmentLights);
    this.requestFrame();
    return built;
  }

  /** The instances of shapes that `move` has moved since the last call. */
  takeMoved(): readonly NodeInstance[] {
    return this.#shapes.takeMoved();
  }

  /** Transforms the coordinates of a Transform's children to the scene's; undefined if it is not in the scene. */
  sceneFromTransform(element: SceneElement): Matrix4 | undefined {
    return this.#shapes.sceneFromTransform(element);
  }

  /** The bound background; undefined where the scene has none. */
  get background(): BackgroundInstance | undefined {
    return this.#background.bound;
  }

  /** Binds or unbinds a background, as X3D's set_bind does. Returns false if the element is none of the scene's. */
  bindBackground(element: SceneElement, isBound: boolean): boolean {
    if (!this.#background.bind(element, isBound)) return false;
    this.requestFrame();
    return true;
  }

  /** Binds or unbinds a Fog, as X3D's set_bind does. Returns false if the element is none of the scene's. */
  bindFog(element: SceneElement, isBound: boolean): boolean {
    if (!this.#shapes.bindFog(element, isBound)) return false;
    this.requestFrame();
    return true;
  }

  /** Sets a picture of the bound background; `undefined` removes it. */
  setBackgroundPicture(side: PanoramaSide, image: TextureImage | undefined): void {
    this.#background.setPicture(side, image && this.uploads.textures.textureOf(image.image));
    this.requestPacedFrame();
  }

  /** The pictures of the scene's EnvironmentLight; the same list while they stay the same. */
  get environmentPictures(): readonly EnvironmentPicture[] {
    return this.#surroundings?.environment.pictures ?? noPictures;
  }

  /** The EnvironmentLight; undefined where the scene has none. */
  get environmentElement(): SceneElement | undefined {
    return this.#surroundings?.environment.element;
  }

  /** Sets a picture of the EnvironmentLight; `undefined` removes it. */
  setEnvironmentPicture(role: EnvironmentRole, image: TextureImage | undefined): void {
    this.#surroundings?.environment.setPicture(role, image && this.uploads.textures.textureOf(image.image));
    this.requestPacedFrame();
  }

  /** Replaces the stage of a patch of a shape of the current scene. */
  setStage(element: SceneElement, geometry: GeometryDescription, patch: number, stage: Stage | undefined): void {
    this.#shapes.setStage(element, geometry, patch, stage);
    this.requestPacedFrame();
  }

  /** The bounding sphere of all visible shapes, in scene coordinates. Grows when vertices arrive outside it. */
  get sphere(): Sphere {
    return this.#shapes.sphere;
  }

  /** Sets a texture of a shape; `undefined` removes it. */
  setTextureImage(element: SceneElement, role: TextureRole | CubeMapRole, image: TextureImage | undefined): void {
    this.#shapes.setTexture(
      element,
      role,
      image && { texture: this.uploads.textures.textureOf(image.image), hasAlpha: image.hasAlpha },
    );
    this.requestPacedFrame();
  }

  /** Removes everything that a shape displays. */
  clearShape(element: SceneElement): void {
    this.#shapes.clearShape(element);
    this.requestFrame();
  }

  /**
   * Sets the size in device pixels, and the number of device pixels per CSS pixel. The canvas is empty until the next
   * frame.
   */
  setSize(width: number, height: number, pixelRatio: number): void {
    this.#size = { width, height };
    if (!this.#hasArea) return;
    this.#shared.pixelRatio.value = pixelRatio;
    this.#renderer.setSize(width, height, false);
  }

  /** Sets the size and draws a frame at once, before the browser can show the empty canvas. */
  resize(width: number, height: number, pixelRatio: number): void {
    this.setSize(width, height, pixelRatio);
    this.#frame();
  }

  /** Picks in the last frame, at a pixel in device pixels from the top left. Blocks until the GPU is done. */
  pick(x: number, y: number): Hit | undefined {
    if (!this.#hasDrawnCamera) return undefined;
    return this.#picker.pick({ ...this.#size, x, y }, this.#pickSlack);
  }

  /** Picks without blocking or delaying a frame. */
  async pickAsync(x: number, y: number): Promise<Hit | undefined> {
    if (!this.#hasDrawnCamera) return undefined;
    return this.#picker.pickAsync(() => ({ ...this.#size, x, y }), this.#pickSlack);
  }

  /** The innermost Anchor around the hit. */
  anchorOf({ group }: Hit): AnchorDescription | undefined {
    return this.#shapes.anchorAround(group);
  }

  /** A factor on the light that reaches the eye; 1 keeps the document's colours. */
  setExposure(exposure: number): void {
    this.#renderer.toneMapping = exposure === 1 ? NoToneMapping : LinearToneMapping;
    this.#renderer.toneMappingExposure = exposure;
    this.requestFrame();
  }

  /** Whether to draw vertices as points in place of surfaces. */
  drawAsPoints(asPoints: boolean): void {
    this.#shapes.drawAsPoints(asPoints);
    this.requestFrame();
  }

  /** Draws a frame at once, so that the caller can read the canvas before it returns to the event loop. */
  draw(): void {
    this.#frame(true);
  }

  requestFrame(): void {
    this.#picker.forget();
    if (this.#frameRequest === 0)
      this.#frameRequest = requestAnimationFrame(() => {
        this.#frame();
      });
  }

  /**
   * Requests a frame that only refines the picture, with frame pacing: while a scene loads, such frames would
   * otherwise keep the GPU busy all the time.
   */
  requestPacedFrame(): void {
    this.#surroundings?.generatedCubeMaps.invalidate();
    this.#framePacer.request(() => {
      this.requestFrame();
    });
  }

  /** Frees all GPU resources and the WebGL context. No method may be called afterwards. */
  dispose(): void {
    cancelAnimationFrame(this.#frameRequest);
    this.#shapes.dispose();
    this.#picker.dispose();
    this.#queries.dispose();
    this.#surroundings?.dispose();
    this.#background.dispose();
    this.uploads.freeSpares();
    this.#renderer.dispose();
    this.#renderer.forceContextLoss();
  }

  /** Starts compiling programs for the given shapes, without waiting for them. */
  #compileAhead(shapes: Iterable<ShapeDescription>): void {
    if (this.isContextLost) return;
    const newObjects = new Group();
    for (const [key, object] of warmUpObjects(shapes, this.#shapes.plan, x3dMaterials, this.#shared)) {
      if (this.#compiled.has(key)) continue;
      this.#compiled.set(key, object);
      newObjects.add(object);
    }
    if (newObjects.children.length > 0) this.#renderer.compile(newObjects, this.#camera, this.#scene);
  }

  get #aspect(): number {
    return this.#size.width / this.#size.height;
  }

  get #hasArea(): boolean {
    return this.#size.width > 0 && this.#size.height > 0;
  }

  /** How far, in device pixels, a vertex may be from the pixels that it covers. */
  get #pickSlack(): number {
    const largest = Math.max(this.#shapes.maxWidth, defaultPointSize);
    return 1 + Math.ceil((largest * this.#shared.pixelRatio.value) / 2);
  }

  /** `isForced`: draws even if the picture is shown elsewhere. */
  #frame(isForced = false): void {
    cancelAnimationFrame(this.#frameRequest);
    this.#frameRequest = 0;
    this.#picker.forget();
    this.#framePacer.begin();
    if (!this.#hasArea || this.isContextLost) return;
    const begunAt = performance.now();
    applyPose(
      this.#camera,
      this.#cameraController.advance(begunAt),
      this.#aspect,
      this.sphere,
      this.#cameraController.clearance,
    );
    this.#shared.depthRange.value.set(this.#camera.near, this.#camera.far);
    const { pixelRatio } = this.#shared;
    const isDrawn = isForced || !this.#isShownElsewhere();
    if (isDrawn) this.#updateCubeMaps();
    this.#camera.updateMatrixWorld();
    this.#shapes.cull(this.#camera, [this.#size.width / pixelRatio.value, this.#size.height / pixelRatio.value]);
    if (isDrawn) this.#draw();
    this.#framePacer.end(begunAt);
    this.#drawnCamera.copy(this.#camera, false);
    this.#hasDrawnCamera = true;
    this.#onFrame();
    this.#queries.onFrame();
    if (this.#cameraController.isMoving) this.requestFrame();
  }

  #updateCubeMaps(): void {
    this.#surroundings?.update(this.#renderer, this.#scene, this.sphere, (camera, size) => {
      this.#shapes.cull(camera, [size, size]);
    });
  }

  #draw(): void {
    this.#renderer.render(this.#scene, this.#camera);
    this.#drawCalls = this.#renderer.info.render.calls;
    this.#frames += 1;
  }
}
