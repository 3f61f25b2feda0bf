// A scene as an Object3D, to which objects are added and refined while files arrive.

import type { Box3, Camera, Object3DEventMap, PerspectiveCamera, WebGLRenderer } from "three";
import { Group, Sphere } from "three";
import type { AnimatedElement } from "../animation/elements.ts";
import type { RunJob } from "../decode/jobs.ts";
import type { DeliveryError } from "../delivery/deliveryError.ts";
import type { Progress, Transfer } from "../delivery/progress.ts";
import { noProgress } from "../delivery/progress.ts";
import { ResourcePool } from "../delivery/resourcePool.ts";
import type { SceneDescription } from "../document/description.ts";
import type { SceneElement } from "../document/element.ts";
import { interpolatorIdOf } from "../document/sequence.ts";
import { defaultPointSize } from "../render/stages/stageUniforms.ts";
import { defaultDownloadOptions } from "../scheduler/download.ts";
import type { Scheduler } from "../scheduler/scheduler.ts";
import { Throttle } from "../viewer/throttle.ts";
import { progressIntervalMs } from "../viewer/viewerCore.ts";
import { UploadThrottle } from "./uploadThrottle.ts";
import type { MaterialMaker, SceneShadowOptions } from "./standardMaterials.ts";
import { makeStandardMaterials } from "./standardMaterials.ts";
import { appShapeContext } from "./appShapeContext.ts";
import { ArrayBuffers } from "./arrayBuffers.ts";
import { BitmapTextures, maxTextureSize } from "./bitmapTextures.ts";
import type { SceneClip } from "./sceneClips.ts";
import { SceneClips } from "./sceneClips.ts";
import { SceneContents } from "./sceneContents.ts";
import type { SceneHit } from "./scenePicking.ts";
import { ScenePicker } from "./scenePicking.ts";

export interface ImgeoSceneEventMap extends Object3DEventMap {
  /** The picture has changed: an app that draws on demand draws again. */
  change: object;
  /** `abort` or `dispose` has been called: nothing more is loaded. */
  abort: object;
  /** Bytes have arrived. */
  progress: { readonly progress: Progress };
  /** A file could not be fetched or decoded; the rest of the scene continues to load. */
  error: { readonly url: string; readonly error: Error };
}

/** Where a scene's files come from, and how its shapes are drawn. */
export interface ImgeoSceneOptions {
  /** The document's <X3D>, and its absolute URL. */
  readonly x3d: SceneElement & AnimatedElement;
  readonly url: string;
  /** Makes a URL of the document absolute. */
  readonly urlOf: (url: string) => string;
  /** Maps an absolute URL to the URL to request. */
  readonly resolve: (url: string) => string;
  readonly fetch: typeof fetch;
  /** Orders downloads; shared with other scenes. */
  readonly scheduler: Scheduler;
  /** Whether images are decoded to vertex buffers instead of textures. */
  readonly keepsVertices: boolean;
  /** GPU memory of the scene in bytes, beyond which levels of detail are not refined. */
  readonly budget: number;
  readonly makeMaterial: MaterialMaker;
  /** Runs a job in a worker. */
  readonly runJob: RunJob;
}

export class ImgeoScene extends Group<ImgeoSceneEventMap> {
  readonly #contents: SceneContents;
  readonly #firstImage = Promise.withResolvers<undefined>();
  readonly #complete = Promise.withResolvers<undefined>();
  #progress = noProgress;
  readonly #progressEvents = new Throttle(progressIntervalMs, () => {
    this.#progress = this.#contents.progressSince(this.#progress);
    this.dispatchEvent({ type: "progress", progress: this.#progress });
  });
  readonly #clips: SceneClips;
  readonly #picker = new ScenePicker();
  #error: Error | undefined;

  constructor({
    x3d,
    url,
    urlOf,
    resolve,
    fetch,
    scheduler,
    keepsVertices,
    budget,
    makeMaterial,
    runJob,
  }: ImgeoSceneOptions) {
    super();
    // An app need not use the promises: their rejections must not be reported as unhandled.
    for (const { promise } of [this.#firstImage, this.#complete]) promise.catch(() => undefined);
    const uploadThrottle = new UploadThrottle();
    const textures = new BitmapTextures(uploadThrottle, runJob);
    const buffers = new ArrayBuffers();
    const pool = new ResourcePool({
      scheduler,
      makeImage: (png, signal) => textures.makeImage(png, signal),
      readsTextures: () => Promise.resolve(!keepsVertices),
      maxTextureSize,
      runJob,
      makeTextureImage: (file, sampling, signal) => textures.makeTextureImage(file, sampling, signal),
      makeWritableImage: (width, height) => textures.makeWritableImage(width, height),
      makeWritableArray: (array) => buffers.makeWritable(array),
      storeBytes: async (array, _, signal) => {
        await uploadThrottle.waitForFrame(array.byteLength, signal);
        return buffers.store(array);
      },
      download: { ...defaultDownloadOptions, fetch },
      resolve: (url) => resolve(urlOf(url)),
      onTransfer: () => {
        this.#progressEvents.request();
      },
    });
    this.#contents = new SceneContents(
      { x3d, url, urlOf, pool, budget },
      appShapeContext(makeStandardMaterials(makeMaterial, shadowOptionsOf(this)), buffers, textures),
      {
        onChange: () => {
          this.dispatchEvent({ type: "change" });
        },
        onError: (error) => {
          this.#fail(error);
        },
        onAdvance: () => {
          this.#advance();
        },
        onDocuments: () => {
          this.#addClips(this.#clips.read());
        },
      },
    );
    this.add(this.#contents.root);
    this.#clips = new SceneClips({
      documents: this.#contents.documents,
      display: (changes) => {
        this.#contents.displayChanges(changes);
      },
      showFraction: (element, fraction) => {
        this.#contents.geometries.setFraction(interpolatorIdOf(element), fraction);
      },
      sequenceDurationOf: (element) => this.#contents.geometries.sequenceDurationOf(interpolatorIdOf(element)),
      warn: (message) => {
        console.warn("imgeo:", message);
      },
    });
    this.#addClips(this.#clips.read());
    passOnShadows(this);
    this.#contents.start();
    this.#advance();
  }

  /**
   * The document with all Inlines loaded so far. Its lights and viewpoints are not in the three.js scene; the app may
   * use them.
   */
  get description(): SceneDescription {
    return this.#contents.description;
  }

  /** Bounds of all visible shapes in all levels of the documents loaded so far, in this object's coordinates. */
  get box(): Box3 {
    return this.#contents.box;
  }

  /**
   * Resolves when every visible patch displays something; rejects with the first error if nothing could be displayed.
   */
  get firstImage(): Promise<undefined> {
    return this.#firstImage.promise;
  }

  /**
   * Resolves when every file has loaded or failed. `abort` and `dispose` reject both promises with an AbortError,
   * unless they have resolved.
   */
  get complete(): Promise<undefined> {
    return this.#complete.promise;
  }

  /** The state of all requested files. */
  get transfers(): readonly Readonly<Transfer>[] {
    return this.#contents.transfers;
  }

  /**
   * Picks what an app displays of this scene at a position, in CSS pixels from the top
   * left of the canvas. Objects of the app do not hide it. `camera` must be the one that
   * the canvas was drawn with, over its whole area. Waits for the GPU.
   */
  pick(renderer: WebGLRenderer, camera: PerspectiveCamera, x: number, y: number): SceneHit | undefined {
    const { shapes } = this.#contents;
    return this.#picker.pick(
      renderer,
      camera,
      { x, y },
      Math.max(defaultPointSize, shapes.maxWidth),
      shapes.pickCandidates(),
    );
  }

  /**
   * Refines meshes with levels of detail to what this camera sees, to a pixel of the renderer's canvas. Call it before
   * each frame, once for each camera that draws the scene; cameras of one task count together. In an XR session the
   * cameras are those of the session. Before the first call such a mesh displays its roots. Without effect on anything
   * else, and after `abort` and `dispose`.
   */
  update(camera: Camera, renderer: WebGLRenderer): void {
    this.#contents.followCamera(camera, renderer, this);
  }

  /**
   * Makes all sequences display the frame at this time, in seconds from their beginning. Undefined, as before the first
   * call: they follow the clips of the scene, and are at their first frame while none plays.
   */
  setSequenceTime(seconds: number | undefined): void {
    this.#contents.geometries.setSequenceTime(seconds);
  }

  /** The duration of the longest sequence whose index has been loaded, in seconds; 0 where there is none. */
  get sequenceDuration(): number {
    return this.#contents.geometries.sequenceDuration;
  }

  /** Ends all requests. What is displayed stays. */
  abort(): void {
    this.#contents.stop();
    const reason = new DOMException("the loading of the scene was aborted", "AbortError");
    this.#firstImage.reject(reason);
    this.#complete.reject(reason);
    this.#progressEvents.cancel();
    this.dispatchEvent({ type: "abort" });
  }

  /** Ends all requests, frees GPU memory, and removes the scene from its parent. */
  override dispose(): void {
    this.abort();
    this.#contents.dispose();
    this.#picker.dispose();
    this.removeFromParent();
    this.clear();
    super.dispose();
  }

  /** Throws: a scene's objects change while it loads. Load it again; its files are in the browser's cache. */
  override clone(): this {
    throw new Error("an ImgeoScene cannot be cloned; load it again");
  }

  #fail(error: DeliveryError): void {
    this.#error ??= error;
    this.dispatchEvent({ type: "error", url: error.url, error });
  }

  #addClips(clips: readonly SceneClip[]): void {
    for (const { clip, target } of clips) {
      this.animations.push(clip);
      this.add(target);
    }
  }

  /** Settles the promises whose condition holds now. */
  #advance(): void {
    this.#addClips(this.#clips.takeNew());
    if (!this.#contents.isDisplayed) return;
    if (this.#error !== undefined && !this.#contents.shapes.hasPicture) this.#firstImage.reject(this.#error);
    else this.#firstImage.resolve(undefined);
    if (!this.#contents.isSettled) return;
    this.#progressEvents.callNow();
    this.#complete.resolve(undefined);
  }
}

function shadowOptionsOf(scene: ImgeoScene): SceneShadowOptions {
  return {
    get castShadow() {
      return scene.castShadow;
    },
    get receiveShadow() {
      return scene.receiveShadow;
    },
    get sphere() {
      return scene.box.getBoundingSphere(new Sphere()).applyMatrix4(scene.matrixWorld);
    },
  };
}

/**
 * Passes `castShadow` and `receiveShadow` of a scene on to its present objects. Objects of later stages read the values
 * when they are made.
 */
function passOnShadows(scene: ImgeoScene): void {
  for (const name of ["castShadow", "receiveShadow"] as const) {
    let flag = false;
    Object.defineProperty(scene, name, {
      configurable: true,
      enumerable: true,
      get: () => flag,
      set: (value: boolean) => {
        flag = value;
        scene.traverse((object) => {
          if (object !== scene) object[name] = value;
        });
      },
    });
  }
}
