// Draws a described scene into a canvas, and only when something changed.

import type { Object3D, Sphere } from "three";
import {
  Box3, Color, DirectionalLight, Frustum, Group, LinearSRGBColorSpace, LinearToneMapping, Matrix4, NoToneMapping, PerspectiveCamera, Scene, Vector2, Vector3,
  WebGLRenderer,
} from "three";
import type { DecodedImage } from "../decode/image.ts";
import type { ArrayUse, Bounds, ElementArray, Stage } from "../decode/stage.ts";
import type { GeometryDescription, SamplingDescription, SceneDescription, ShapeDescription } from "../document/description.ts";
import { shapesOf } from "../document/description.ts";
import type { SceneElement } from "../document/element.ts";
import type { PlacedViewpoint, Pose } from "../navigation/camera.ts";
import { applyPose, sphereAround } from "../navigation/camera.ts";
import type { BufferUpload } from "./buffers.ts";
import { BufferStore } from "./buffers.ts";
import type { SceneUniforms } from "./look.ts";
import { setColor, x3dLook } from "./materials.ts";
import { usualPointSize } from "./patchDraws.ts";
import type { Hit, PickCandidate, Place } from "./picking.ts";
import { Picker } from "./picking.ts";
import { Pace } from "./pace.ts";
import type { BoundedGroup } from "./sceneGraph.ts";
import { buildGraph } from "./sceneGraph.ts";
import type { ShapeSetting } from "./shapeObject.ts";
import { ShapeObject } from "./shapeObject.ts";
import { objectsToCome } from "./stagesToCome.ts";
import { GeometryPool } from "./stageGeometries.ts";
import type { TextureUpload } from "./textures.ts";
import { TextureStore } from "./textures.ts";
import { readsTextures } from "./textureTest.ts";
import { vertexSamplers } from "./vertexChunk.ts";

/** What has been drawn and what the GPU holds. */
export interface RenderStatistics {
  readonly frames: number;
  readonly textures: number;
  readonly geometries: number;
  readonly programs: number;
  /** More has come than the last frame shows. */
  readonly isFrameDue: boolean;
  /** That vertex data take: images and buffers. */
  readonly textureBytes: number;
  readonly bufferBytes: number;
}

/** Where the camera is and what it sees, as plain numbers. */
export interface View {
  readonly position: readonly [number, number, number];
  /** 16 numbers, column by column. */
  readonly clipFromScene: readonly number[];
  /** Device pixels that something of length 1 covers at a distance of 1, in the middle of the view. */
  readonly pixelsPerUnit: number;
  readonly near: number;
}

/** Where the camera is. */
export interface CameraMan {
  readonly pose: Pose;
  /** What is nearer need not be seen. */
  readonly clearance: number;
  /** At this moment, in milliseconds as of `performance.now()`. */
  advance(nowMs: number): Pose;
  /** Another frame is due after this one. */
  readonly isMoving: boolean;
}

/** What the scene has in it, in the scene's coordinates. */
export interface BuiltScene {
  /** Around all that is seen. */
  readonly sphere: Sphere;
  /** In document order. */
  readonly viewpoints: readonly PlacedViewpoint[];
}

/** An image on the GPU that is looked at. */
export interface Picture {
  readonly image: DecodedImage;
  readonly hasAlpha: boolean;
}

/** The canvas' WebGL2 context; null where the browser has none to give. */
export function contextOf(canvas: HTMLCanvasElement): WebGL2RenderingContext | null {
  return canvas.getContext("webgl2", { alpha: true, antialias: true, powerPreference: "high-performance" });
}

export class SceneRenderer {
  readonly #renderer: WebGLRenderer;
  readonly #scene = new Scene();
  readonly #camera = new PerspectiveCamera();
  /** As it stood for the last frame. */
  readonly #drawnCamera = new PerspectiveCamera();
  readonly #headlight = new DirectionalLight();
  readonly #shared: SceneUniforms = { pixelRatio: { value: 1 }, depthRange: { value: new Vector2() } };
  readonly #textures = new TextureStore();
  readonly #buffers: BufferStore;
  readonly #setting: ShapeSetting;
  readonly #shapes = new Map<SceneElement, ShapeObject>();
  readonly #cameraMan: CameraMan;
  readonly #onFrame: () => void;
  readonly #picker: Picker;
  readonly #pace: Pace;
  #root = new Group();
  #sphere = sphereAround(new Box3());
  #box = new Box3();
  #bounded: readonly BoundedGroup[] = [];
  #size = { width: 0, height: 0 };
  #frames = 0;
  /** What `pick` has found since the scene last changed. */
  #picked: { readonly x: number; readonly y: number; readonly hit: Hit | undefined } | undefined;
  #frameRequest = 0;
  #readsTextures: Promise<boolean> | undefined;
  /** They keep their programs alive. */
  readonly #compiled = new Map<string, Object3D>();

  /** `onFrame` is called after each frame that has been drawn. */
  constructor(canvas: HTMLCanvasElement, context: WebGL2RenderingContext, cameraMan: CameraMan, onFrame: () => void) {
    this.#cameraMan = cameraMan;
    this.#onFrame = onFrame;
    this.#renderer = new WebGLRenderer({ canvas, context, antialias: true, alpha: true });
    this.#buffers = new BufferStore(context);
    this.#setting = {
      look: x3dLook, geometries: new GeometryPool(this.#buffers), buffers: this.#buffers, textures: this.#textures, shared: this.#shared,
    };
    this.#pace = new Pace(context);
    this.#picker = new Picker(this.#renderer);
    // The numbers of the document are the numbers of the screen: see materials.ts.
    this.#renderer.outputColorSpace = LinearSRGBColorSpace;
    this.#renderer.toneMapping = NoToneMapping;
    // The headlight stands in the camera's own frame and shines along its -z.
    this.#headlight.position.set(0, 0, 0);
    this.#headlight.target.position.set(0, 0, -1);
    this.#camera.add(this.#headlight, this.#headlight.target);
    this.#scene.add(this.#camera, this.#root);
  }

  get statistics(): RenderStatistics {
    const { memory, programs } = this.#renderer.info;
    return {
      frames: this.#frames, isFrameDue: this.#pace.isAsked,
      textures: memory.textures, geometries: memory.geometries, programs: programs?.length ?? 0,
      textureBytes: this.#textures.bytes, bufferBytes: this.#buffers.bytes,
    };
  }

  /** No shape shows anything yet. */
  get isEmpty(): boolean {
    return Array.from(this.#shapes.values()).every(({ isEmpty }) => isEmpty);
  }

  /** Nothing is drawn, and nothing is on the GPU, until the browser gives the context back. */
  get isContextLost(): boolean {
    return this.#renderer.getContext().isContextLost();
  }

  /** Undefined while the picture has no area. */
  get view(): View | undefined {
    if (!this.#hasArea) return undefined;
    const camera = this.#camera;
    applyPose(camera, this.#cameraMan.pose, this.#aspect, this.#sphere, this.#cameraMan.clearance);
    camera.updateMatrixWorld();
    return {
      position: camera.position.toArray(),
      clipFromScene: new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse).elements,
      pixelsPerUnit: (camera.projectionMatrix.elements[5] * this.#size.height) / 2,
      near: camera.near,
    };
  }

  /** What puts a shape of the current scene into its place number `place`: 16 numbers, column by column. */
  sceneFromShape(element: SceneElement, place: number): readonly number[] | undefined {
    return this.#shapes.get(element)?.groupAt(place).matrixWorld.elements;
  }

  /** Shows this scene from now on. Shapes that are gone give back what they hold on the GPU. */
  setScene(description: SceneDescription): BuiltScene {
    const shapes = new Map(shapesOf(description.root).map((shape) => [shape.element, shape]));
    for (const [element, object] of this.#shapes) {
      if (shapes.has(element)) continue;
      object.dispose();
      this.#shapes.delete(element);
    }
    const places = new Map<SceneElement, number>();
    const { root, box, bounded, viewpoints } = buildGraph(description, (shape) => {
      const place = places.get(shape.element) ?? 0;
      places.set(shape.element, place + 1);
      return this.#objectOf(shape).groupAt(place);
    });
    for (const [element, shape] of shapes) {
      const object = this.#objectOf(shape);
      object.keepPlaces(places.get(element) ?? 0);
      object.setShape(shape);
    }
    this.#root.removeFromParent();
    this.#root = root;
    this.#scene.add(root);
    root.updateMatrixWorld();
    this.#headlight.visible = description.navigation.headlight;
    const { skyColor } = description;
    // Of the scene, not the renderer's clear colour: that one is lost with the context.
    this.#scene.background = null;
    if (skyColor !== undefined) {
      this.#scene.background = new Color();
      setColor(this.#scene.background, skyColor);
    }
    this.#box = box;
    this.#bounded = bounded;
    this.#sphere = sphereAround(box);
    for (const object of this.#shapes.values()) for (const bounds of object.bounds()) this.#grow(object, bounds);
    this.#compileAhead(description);
    this.requestFrame();
    return { sphere: this.#sphere, viewpoints };
  }

  /** Texels of the longest edge that a texture may have. */
  get largestTexture(): number {
    return this.#renderer.capabilities.maxTextureSize;
  }

  /** Whether shaders of vertices have textures enough. */
  get mayReadTextures(): boolean {
    return this.#renderer.capabilities.maxVertexTextures >= vertexSamplers;
  }

  /** Whether vertices are read from textures as they should be; tried out once. */
  readsTextures(): Promise<boolean> {
    this.#readsTextures ??= readsTextures(this.#renderer, this.#textures);
    return this.#readsTextures;
  }

  /** Begins to bring an image to the GPU; stages may use it when all steps have been taken. */
  beginUpload(bitmap: ImageBitmap, sampling?: SamplingDescription): TextureUpload {
    return this.#textures.begin(bitmap, this.#renderer, sampling);
  }

  /** The same of an array. */
  beginStoring(array: ElementArray, use: ArrayUse): BufferUpload {
    return this.#buffers.begin(array, use);
  }

  /** Replaces what a patch of a shape of the current scene shows. */
  setStage(element: SceneElement, geometry: GeometryDescription, patch: number, stage: Stage | undefined): void {
    const object = this.#shapes.get(element);
    object?.setStage(geometry, patch, stage);
    this.#pace.ask(() => { this.requestFrame(); });
    if (object !== undefined && stage?.kind === "buffers" && stage.bounds !== undefined) this.#grow(object, stage.bounds);
  }

  /** Around all that is seen, in the scene's coordinates. Grows when vertices tell of a box that the document does not. */
  get sphere(): Sphere {
    return this.#sphere;
  }

  #grow(object: ShapeObject, { min, max }: Bounds): void {
    for (const group of object.groups) {
      const box = new Box3(new Vector3(...min), new Vector3(...max)).applyMatrix4(group.matrixWorld);
      if (!this.#box.containsBox(box)) this.#sphere = sphereAround(this.#box.union(box));
    }
  }

  /** Lays a picture over a shape; undefined: none. */
  setPicture(element: SceneElement, picture: Picture | undefined): void {
    const shown = picture && { texture: this.#textures.textureOf(picture.image), hasAlpha: picture.hasAlpha };
    this.#shapes.get(element)?.setPicture(shown);
    this.requestFrame();
  }

  /** Takes away what a shape shows, for when its geometry has become another. */
  clearShape(element: SceneElement): void {
    this.#shapes.get(element)?.clear();
    this.requestFrame();
  }

  /** In device pixels, with the number of them in a CSS pixel. The canvas is empty until a frame is drawn. */
  setSize(width: number, height: number, pixelRatio: number): void {
    this.#size = { width, height };
    if (!this.#hasArea) return;
    this.#shared.pixelRatio.value = pixelRatio;
    this.#renderer.setSize(width, height, false);
  }

  /** The same, and draws before the browser shows the empty canvas. */
  resize(width: number, height: number, pixelRatio: number): void {
    this.setSize(width, height, pixelRatio);
    this.#drawNow();
  }

  /** What the last frame shows at a pixel, counted in whole device pixels from the top left. Waits for the GPU. */
  pick(x: number, y: number): Hit | undefined {
    if (this.#frames === 0 || !this.#isInside(x, y)) return undefined;
    if (this.#picked?.x !== x || this.#picked.y !== y) {
      this.#picked = { x, y, hit: this.#picker.pick(this.#drawnCamera, this.#placeOf(x, y), this.#pickSlack, this.#pickCandidates()) };
    }
    return this.#picked.hit;
  }

  /** The same without waiting; no frame comes late for it. */
  async pickSoon(x: number, y: number): Promise<Hit | undefined> {
    while (this.#frames > 0 && this.#isInside(x, y)) {
      const hit = await this.#picker.pickSoon(this.#drawnCamera, this.#placeOf(x, y), this.#pickSlack, this.#pickCandidates());
      if (hit !== "stale") return hit;
    }
    return undefined;
  }

  /** Multiplies the light that reaches the eye; 1 leaves the document's numbers as they are. */
  setExposure(exposure: number): void {
    this.#renderer.toneMapping = exposure === 1 ? NoToneMapping : LinearToneMapping;
    this.#renderer.toneMappingExposure = exposure;
    this.requestFrame();
  }

  /** Draws now, for whoever reads the canvas in this turn of the event loop. */
  draw(): void {
    this.#drawNow();
  }

  requestFrame(): void {
    this.#picked = undefined;
    if (this.#frameRequest === 0) this.#frameRequest = requestAnimationFrame(() => { this.#drawNow(); });
  }

  /** Frees the GPU; nothing may be called after. */
  dispose(): void {
    cancelAnimationFrame(this.#frameRequest);
    for (const object of this.#shapes.values()) object.dispose();
    this.#shapes.clear();
    this.#picker.dispose();
    this.#renderer.dispose();
    this.#renderer.forceContextLoss();
  }

  /** Programs for what is to come, without waiting for them. */
  #compileAhead(description: SceneDescription): void {
    if (this.isContextLost) return;
    const fresh = new Group();
    for (const [key, object] of objectsToCome(description, x3dLook, this.#shared)) {
      if (this.#compiled.has(key)) continue;
      this.#compiled.set(key, object);
      fresh.add(object);
    }
    if (fresh.children.length > 0) void this.#renderer.compileAsync(fresh, this.#camera, this.#scene);
  }

  get #aspect(): number {
    return this.#size.width / this.#size.height;
  }

  get #hasArea(): boolean {
    return this.#size.width > 0 && this.#size.height > 0;
  }

  #isInside(x: number, y: number): boolean {
    return x >= 0 && y >= 0 && x < this.#size.width && y < this.#size.height;
  }

  #placeOf(x: number, y: number): Place {
    return { ...this.#size, x, y };
  }

  /** How far, in device pixels, a vertex may be from what it covers. */
  get #pickSlack(): number {
    const largest = Array.from(this.#shapes.values()).reduce((most, { largestPoint }) => Math.max(most, largestPoint), usualPointSize);
    return 1 + Math.ceil((largest * this.#shared.pixelRatio.value) / 2);
  }

  *#pickCandidates(): Generator<PickCandidate> {
    for (const [element, object] of this.#shapes) {
      if (!object.isPickable) continue;
      for (const placed of object.placedDraws()) if (isShown(placed.object)) yield { ...placed, element };
    }
  }

  #drawNow(): void {
    cancelAnimationFrame(this.#frameRequest);
    this.#frameRequest = 0;
    this.#picked = undefined;
    this.#pace.begin();
    if (!this.#hasArea || this.isContextLost) return;
    const begunAt = performance.now();
    applyPose(this.#camera, this.#cameraMan.advance(begunAt), this.#aspect, this.#sphere, this.#cameraMan.clearance);
    this.#shared.depthRange.value.set(this.#camera.near, this.#camera.far);
    this.#passOver();
    this.#renderer.render(this.#scene, this.#camera);
    this.#pace.end(begunAt);
    this.#drawnCamera.copy(this.#camera, false);
    this.#frames += 1;
    this.#onFrame();
    if (this.#cameraMan.isMoving) this.requestFrame();
  }

  /** Groups that tell where they end are not looked into when they are out of the view. */
  #passOver(): void {
    if (this.#bounded.length === 0) return;
    this.#camera.updateMatrixWorld();
    const frustum = new Frustum().setFromProjectionMatrix(new Matrix4().multiplyMatrices(this.#camera.projectionMatrix, this.#camera.matrixWorldInverse));
    for (const { group, box } of this.#bounded) group.visible = frustum.intersectsBox(box);
  }

  #objectOf(shape: ShapeDescription): ShapeObject {
    const object = this.#shapes.get(shape.element) ?? new ShapeObject(this.#setting, shape);
    this.#shapes.set(shape.element, object);
    return object;
  }
}

function isShown(object: Object3D | null): boolean {
  return object === null || (object.visible && isShown(object.parent));
}
