// Draws a scene into a canvas, whenever something has changed.

import { LinearSRGBColorSpace, LinearToneMapping, NoToneMapping, WebGLRenderer } from "three";
import { FrameRequests } from "./frames/frameRequests.ts";
import { ViewCamera } from "./frames/viewCamera.ts";
import { ControllerQueries } from "./picking/controllerQueries.ts";
import { ScreenPicker } from "./picking/screenPicker.ts";
import { RenderedScene } from "./renderedScene.ts";
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

export interface SceneRendererListener {
  /** A frame has been drawn, or is shown elsewhere. */
  onFrame(): void;
  /**
   * Whether the picture that the next requested frame would have is visible without it. Such a frame does all but
   * drawing.
   */
  isShownElsewhere(): boolean;
}

export class SceneRenderer {
  readonly uploads: SceneUploads;
  readonly frames: FrameRequests;
  readonly camera: ViewCamera;
  readonly scene: RenderedScene;
  readonly picker: ScreenPicker;
  readonly #renderer: WebGLRenderer;
  readonly #listener: SceneRendererListener;
  readonly #queries: ControllerQueries;
  #frameCount = 0;
  #drawCalls = 0;

  constructor(
    canvas: HTMLCanvasElement,
    context: WebGL2RenderingContext,
    cameraController: CameraController,
    listener: SceneRendererListener,
  ) {
    this.#listener = listener;
    this.#renderer = new WebGLRenderer({ canvas, context, antialias: true, alpha: true });
    // three.js counts the textures of vertex and fragment shaders together; fragment shaders alone have fewer units
    // (document/pictureLimit.ts).
    this.#renderer.capabilities.maxTextures = context.getParameter(context.MAX_COMBINED_TEXTURE_IMAGE_UNITS) as number;
    // Colours are not converted: see materials/x3dMaterials.ts.
    this.#renderer.outputColorSpace = LinearSRGBColorSpace;
    this.#renderer.toneMapping = NoToneMapping;
    this.frames = new FrameRequests(context, {
      onRequest: () => {
        this.picker.forget();
      },
      draw: () => {
        this.#frame();
      },
    });
    this.uploads = new SceneUploads(this.#renderer, context, () => {
      this.frames.request();
    });
    this.camera = new ViewCamera(cameraController);
    this.scene = new RenderedScene(this.#renderer, this.camera, this.uploads, this.frames);
    this.picker = new ScreenPicker(this.#renderer, this.camera, this.scene.shapes);
    this.#queries = new ControllerQueries(this.#renderer, cameraController, this);
  }

  get statistics(): RenderStatistics {
    const { memory, programs } = this.#renderer.info;
    return {
      frames: this.#frameCount,
      drawCalls: this.#drawCalls,
      isFrameDue: this.frames.isPacedFramePending,
      textures: memory.textures,
      geometries: memory.geometries,
      programs: programs?.length ?? 0,
      textureBytes: this.uploads.textures.bytes,
      bufferBytes: this.uploads.buffers.bytes,
    };
  }

  /** Whether no shape displays anything yet. */
  get isEmpty(): boolean {
    return this.scene.shapes.isEmpty;
  }

  /** Whether the WebGL context is lost: until the browser restores it, nothing is drawn and nothing is on the GPU. */
  get isContextLost(): boolean {
    return this.#renderer.getContext().isContextLost();
  }

  /** The camera's view of the scene; undefined while the canvas has no area. */
  get view(): View | undefined {
    return this.camera.viewOf(this.scene.sphere);
  }

  /**
   * Sets the size in device pixels, and the number of device pixels per CSS pixel. The canvas is empty until the next
   * frame.
   */
  setSize(width: number, height: number, pixelRatio: number): void {
    this.camera.setSize(width, height, pixelRatio);
    if (this.camera.hasArea) this.#renderer.setSize(width, height, false);
  }

  /** Sets the size and draws a frame at once, before the browser can show the empty canvas. */
  resize(width: number, height: number, pixelRatio: number): void {
    this.setSize(width, height, pixelRatio);
    this.#frame();
  }

  /** A factor on the light that reaches the eye; 1 keeps the document's colours. */
  setExposure(exposure: number): void {
    this.#renderer.toneMapping = exposure === 1 ? NoToneMapping : LinearToneMapping;
    this.#renderer.toneMappingExposure = exposure;
    this.frames.request();
  }

  /** Draws a frame at once, so that the caller can read the canvas before it returns to the event loop. */
  draw(): void {
    this.#frame(true);
  }

  /** Frees all GPU resources and the WebGL context. No method may be called afterwards. */
  dispose(): void {
    this.frames.cancel();
    this.scene.dispose();
    this.picker.dispose();
    this.#queries.dispose();
    this.uploads.freeSpares();
    this.#renderer.dispose();
    this.#renderer.forceContextLoss();
  }

  /** `isForced`: draws even if the picture is shown elsewhere. */
  #frame(isForced = false): void {
    const { frames, camera, scene } = this;
    frames.begin();
    this.picker.forget();
    if (!camera.hasArea || this.isContextLost) return;
    const begunAt = performance.now();
    camera.advance(begunAt, scene.sphere);
    const isDrawn = isForced || !this.#listener.isShownElsewhere();
    if (isDrawn) scene.drawCubeMaps(this.#renderer);
    scene.cull();
    if (isDrawn) this.#draw();
    frames.end(begunAt);
    camera.keep();
    this.#listener.onFrame();
    this.#queries.onFrame();
    if (camera.isMoving) frames.request();
  }

  #draw(): void {
    this.scene.draw(this.#renderer);
    this.#drawCalls = this.#renderer.info.render.calls;
    this.#frameCount += 1;
  }
}
