// A scene as an Object3D that fills and refines itself while its files come.

import type { Box3, Object3D, Object3DEventMap, PerspectiveCamera, WebGLRenderer } from "three";
import { Group, Sphere, Vector2, Vector4 } from "three";
import type { RunJob } from "../decode/jobs.ts";
import type { DeliveryListener } from "../delivery/deliver.ts";
import type { PlacedGeometry } from "../delivery/demand.ts";
import { demandFor, placeGeometry, textureDemandFor } from "../delivery/demand.ts";
import type { DeliveryError } from "../delivery/deliveryError.ts";
import type { Progress, Transfer } from "../delivery/progress.ts";
import { noProgress, progressOf } from "../delivery/progress.ts";
import { ResourcePool } from "../delivery/resources.ts";
import type { JoinedDelivery } from "../delivery/sharedDeliveries.ts";
import { SharedDeliveries } from "../delivery/sharedDeliveries.ts";
import { ShapeTextures } from "../delivery/shapeTextures.ts";
import { pictureKeyOf, TextureDeliveries } from "../delivery/textureDeliveries.ts";
import type { GeometryDescription, GroupDescription, SceneDescription, ShapeDescription } from "../document/description.ts";
import { shapesOf } from "../document/description.ts";
import type { SceneElement } from "../document/element.ts";
import { attributeOf } from "../document/element.ts";
import type { PickCandidate } from "../render/picking.ts";
import { makeLightUniforms } from "../render/sceneLights.ts";
import { SceneGraph } from "../render/sceneGraph.ts";
import type { ShapeSetting } from "../render/shapeObject.ts";
import { ShapeObject } from "../render/shapeObject.ts";
import { usualPointSize } from "../render/stageDraws.ts";
import { GeometryPool } from "../render/stageGeometries.ts";
import { defaultDownloadOptions } from "../scheduler/download.ts";
import { chunkWeightsOf } from "../scheduler/priority.ts";
import type { Scheduler } from "../scheduler/scheduler.ts";
import { Admission } from "./admission.ts";
import type { MaterialMaker, Surroundings } from "./appLook.ts";
import { appLook } from "./appLook.ts";
import { ArrayBuffers } from "./arrayBuffers.ts";
import { BitmapTextures, largestTexture } from "./bitmapTextures.ts";
import type { SceneHit } from "./scenePicking.ts";
import { ScenePicker } from "./scenePicking.ts";

export interface ImgeoSceneEventMap extends Object3DEventMap {
  /** It looks different now: draw again, if you draw only when something has changed. */
  change: object;
  /** `abort` or `dispose` has been called: no file follows. */
  abort: object;
  /** Bytes have come. */
  progress: { readonly progress: Progress };
  /** A file is of no use; the rest of the scene lives. */
  error: { readonly url: string; readonly error: Error };
}

/** Where its files come from, and what its shapes are made of. */
export interface SceneSources {
  /** The URL to ask for, of one that the document writes. */
  readonly resolve: (url: string) => string;
  readonly fetch: typeof fetch;
  /** Orders the downloads, of other scenes too. */
  readonly scheduler: Scheduler;
  /** Images become vertex buffers, not textures. */
  readonly keepsVertices: boolean;
  readonly makeMaterial: MaterialMaker;
  /** Does what would hold up the page. */
  readonly runJob: RunJob;
}

interface LoadedShape {
  readonly object: ShapeObject;
  readonly delivery: JoinedDelivery | undefined;
  readonly textures: ShapeTextures;
  /** Patches of which nothing is shown yet. */
  readonly missing: Set<number>;
}

/** Without a camera to measure by, only the order of what files hold counts. */
const nowhere = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

/** A bar moves no more often than people can see. */
const progressIntervalMs = 50;

export class ImgeoScene extends Group<ImgeoSceneEventMap> {
  /** What the document says, lights and viewpoints included, which are the app's business. */
  readonly description: SceneDescription;
  /** Of all shapes that are seen, as the document tells it, in this object's coordinates. */
  readonly box: Box3;
  readonly #deliveries: SharedDeliveries;
  readonly #pictures: TextureDeliveries;
  readonly #textures: BitmapTextures;
  readonly #shapes = new Map<SceneElement, LoadedShape>();
  readonly #firstImage = Promise.withResolvers<undefined>();
  readonly #complete = Promise.withResolvers<undefined>();
  #progress = noProgress;
  #progressTimer: ReturnType<typeof setTimeout> | undefined;
  readonly #picker = new ScenePicker();
  #hasPicture = false;
  #error: Error | undefined;

  constructor(description: SceneDescription, { resolve, fetch, scheduler, keepsVertices, makeMaterial, runJob }: SceneSources) {
    super();
    this.description = description;
    for (const { promise } of [this.#firstImage, this.#complete]) promise.catch(() => undefined); // nobody has to listen
    const admission = new Admission();
    const textures = new BitmapTextures(admission);
    const buffers = new ArrayBuffers();
    const pool = new ResourcePool({
      scheduler,
      makeImage: (png, signal) => textures.makeImage(png, signal),
      readsTextures: () => Promise.resolve(!keepsVertices),
      largestTexture,
      runJob,
      makePicture: (bytes, sampling, signal) => textures.makePicture(bytes, sampling, signal),
      storeBytes: async (array, _, signal) => {
        await admission.admit(array.byteLength, signal);
        return buffers.store(array);
      },
      download: { ...defaultDownloadOptions, fetch },
      resolve,
      onTransfer: () => { this.#progressTimer ??= setTimeout(() => { this.#tellProgress(); }, progressIntervalMs); },
    });
    this.#deliveries = new SharedDeliveries(pool);
    this.#pictures = new TextureDeliveries(pool);
    this.#textures = textures;
    const { root, box } = this.#build({
      look: appLook(makeMaterial, surroundingsOf(this)), geometries: new GeometryPool(buffers), buffers, textures, batches: undefined, drawing: { asPoints: false },
      shared: {
        pixelRatio: { value: 1 }, viewport: { value: new Vector4() }, depthRange: { value: new Vector2() }, ...makeLightUniforms(),
      },
    });
    this.box = box;
    this.add(root);
    passOnShadows(this);
    for (const { element, message } of description.warnings) console.warn(`imgeo: <${element.localName}> ${message}`);
    this.#demand();
    this.#advance();
  }

  /** Resolves when every patch that is seen shows something; rejects with the first error where none ever will. */
  get firstImage(): Promise<undefined> {
    return this.#firstImage.promise;
  }

  /** Resolves when every file has come or failed. Both reject with an AbortError after `abort` and `dispose`, where they have not resolved before. */
  get complete(): Promise<undefined> {
    return this.#complete.promise;
  }

  /** Its files, as far as they are. */
  get transfers(): readonly Readonly<Transfer>[] {
    return [...this.#deliveries.transfers(), ...this.#pictures.transfers()];
  }

  /**
   * What of it an app's picture shows at a place, in CSS pixels from the top left
   * of the canvas; objects of the app are looked through. Waits for the GPU. The
   * camera is the one that the picture was drawn with, over the whole canvas.
   */
  pick(renderer: WebGLRenderer, camera: PerspectiveCamera, x: number, y: number): SceneHit | undefined {
    let largest = usualPointSize;
    for (const { object: { largestWidth } } of this.#shapes.values()) largest = Math.max(largest, largestWidth);
    return this.#picker.pick(renderer, camera, { x, y }, largest, this.#pickCandidates());
  }

  /** Ends its requests; what it shows stays. */
  abort(): void {
    this.#deliveries.demand(() => () => undefined);
    this.#pictures.demand(() => undefined);
    const reason = new DOMException("the loading of the scene was aborted", "AbortError");
    this.#firstImage.reject(reason);
    this.#complete.reject(reason);
    clearTimeout(this.#progressTimer);
    this.dispatchEvent({ type: "abort" });
  }

  /** Ends its requests, frees what it holds on the GPU, and takes it out of the app's scene. */
  override dispose(): void {
    this.abort();
    // Textures leave the draws before their images close.
    for (const { object } of this.#shapes.values()) object.dispose();
    for (const { delivery, textures } of this.#shapes.values()) {
      delivery?.cancel();
      textures.cancel();
    }
    this.#shapes.clear();
    this.#picker.dispose();
    this.removeFromParent();
    this.clear();
    super.dispose();
  }

  /** Not possible: what a scene shows changes while it loads. Load it again; its files are in the browser's cache. */
  override clone(): this {
    throw new Error("an ImgeoScene cannot be cloned; load it again");
  }

  *#pickCandidates(): Generator<PickCandidate> {
    for (const { object } of this.#shapes.values()) {
      if (!object.isPickable) continue;
      for (const drawn of object.placedDraws()) if (isShown(drawn.group)) yield drawn;
    }
  }

  /** Groups for all that the document has, and a delivery for each geometry that is seen. */
  #build(setting: ShapeSetting): SceneGraph {
    const graph = new SceneGraph({
      onEnter: (shape, _, group) => {
        const { element } = shape;
        const loaded = this.#shapes.get(element) ?? this.#begin(shape, new ShapeObject(setting, shape));
        this.#shapes.set(element, loaded);
        group.name = attributeOf(element, "DEF") ?? "";
        loaded.object.enter(group, shape.host);
      },
      onChange: () => undefined, onLeave: () => undefined, // the document is read once
    });
    graph.follow(withoutLights(this.description.root));
    return graph;
  }

  #begin(shape: ShapeDescription, object: ShapeObject): LoadedShape {
    const { geometry, appearance } = shape;
    const textures = new ShapeTextures(this.#pictures, {
      onPicture: (role, picture) => {
        object.setPicture(role, picture && { texture: this.#textures.textureOf(picture.image), hasAlpha: picture.hasAlpha });
        this.dispatchEvent({ type: "change" });
      },
      onError: (error) => { this.#fail(error); },
      onSettled: () => { this.#advance(); },
    });
    if (geometry === undefined || !shape.visible) return { object, delivery: undefined, textures, missing: new Set() };
    const missing = new Set(geometry.patches.keys());
    const listener: DeliveryListener = {
      onStage: (patch, stage) => {
        object.setStage(geometry, patch, stage);
        missing.delete(patch);
        this.#hasPicture = true;
        this.dispatchEvent({ type: "change" });
        this.#advance();
      },
      onError: (error) => { this.#fail(error); },
      onSettled: () => {
        missing.clear();
        this.#advance();
      },
    };
    textures.follow(appearance.textures);
    return { object, delivery: this.#deliveries.join(geometry, listener), textures, missing };
  }

  #fail(error: DeliveryError): void {
    this.#error ??= error;
    this.dispatchEvent({ type: "error", url: error.url, error });
  }

  /** Everything that is seen, coarse before fine. */
  #demand(): void {
    const geometries = new Map<GeometryDescription, PlacedGeometry[]>();
    const pictures = new Map<string, PlacedGeometry[]>();
    for (const { geometry, visible, priority, appearance: { textures } } of shapesOf(this.description.root)) {
      if (geometry === undefined || !visible) continue;
      const placed = placeGeometry(geometry, nowhere, priority, textures.length > 0);
      geometries.set(geometry, [...(geometries.get(geometry) ?? []), placed]);
      for (const texture of textures) pictures.set(pictureKeyOf(texture), [...(pictures.get(pictureKeyOf(texture)) ?? []), placed]);
    }
    const weights = chunkWeightsOf(this.description.chunkPriority, (problem) => { console.warn(`imgeo: chunkPriority: ${problem}`); });
    const viewing = { camera: undefined, weights };
    this.#deliveries.demand((geometry) => demandFor(geometries.get(geometry) ?? [], viewing));
    this.#pictures.demand((key, chunk) => textureDemandFor(pictures.get(key) ?? [], chunk, viewing));
  }

  /** Keeps the promises that can be kept. */
  #advance(): void {
    const shapes = Array.from(this.#shapes.values());
    if (shapes.some(({ missing }) => missing.size > 0)) return;
    if (this.#error !== undefined && !this.#hasPicture) this.#firstImage.reject(this.#error);
    else this.#firstImage.resolve(undefined);
    if (shapes.some(({ delivery, textures }) => delivery?.isSettled === false || !textures.isSettled)) return;
    this.#tellProgress();
    this.#complete.resolve(undefined);
  }

  #tellProgress(): void {
    clearTimeout(this.#progressTimer);
    this.#progressTimer = undefined;
    this.#progress = progressOf(this.transfers, this.#progress);
    this.dispatchEvent({ type: "progress", progress: this.#progress });
  }
}

function isShown(object: Object3D | null): boolean {
  return object === null || (object.visible && isShown(object.parent));
}

/** The app has lights of its own. */
function withoutLights(group: GroupDescription): GroupDescription {
  const children = group.children.filter(({ kind }) => kind !== "light");
  return { ...group, children: children.map((child) => (child.kind === "group" ? withoutLights(child) : child)) };
}

function surroundingsOf(scene: ImgeoScene): Surroundings {
  return {
    get castShadow() { return scene.castShadow; },
    get receiveShadow() { return scene.receiveShadow; },
    get sphere() { return scene.box.getBoundingSphere(new Sphere()).applyMatrix4(scene.matrixWorld); },
  };
}

/** What an app says of the scene holds for all that is in it, now and later: objects come and go with each stage. */
function passOnShadows(scene: ImgeoScene): void {
  for (const name of ["castShadow", "receiveShadow"] as const) {
    let flag = false;
    Object.defineProperty(scene, name, {
      configurable: true, enumerable: true,
      get: () => flag,
      set: (wanted: boolean) => {
        flag = wanted;
        scene.traverse((object) => { if (object !== scene) object[name] = wanted; });
      },
    });
  }
}
