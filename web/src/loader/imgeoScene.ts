// A scene as an Object3D that fills and refines itself while its files come.

import type { Box3, Object3DEventMap, PerspectiveCamera, WebGLRenderer } from "three";
import { Group, Sphere, Vector2, Vector4 } from "three";
import type { RunJob } from "../decode/jobs.ts";
import type { DeliveryError } from "../delivery/deliveryError.ts";
import type { Progress, Transfer } from "../delivery/progress.ts";
import { noProgress, progressOf } from "../delivery/progress.ts";
import { ResourcePool } from "../delivery/resourcePool.ts";
import type { SceneDescription } from "../document/description.ts";
import type { SceneElement } from "../document/element.ts";
import { makeLightUniforms } from "../render/lights/sceneLights.ts";
import { defaultPointSize } from "../render/stages/stageUniforms.ts";
import { GeometryPool } from "../render/stages/geometryPool.ts";
import { defaultDownloadOptions } from "../scheduler/download.ts";
import type { Scheduler } from "../scheduler/scheduler.ts";
import { Throttle } from "../viewer/throttle.ts";
import { progressIntervalMs } from "../viewer/viewerCore.ts";
import { UploadThrottle } from "./uploadThrottle.ts";
import type { MaterialMaker, SceneShadowOptions } from "./standardMaterials.ts";
import { makeStandardMaterials } from "./standardMaterials.ts";
import { ArrayBuffers } from "./arrayBuffers.ts";
import { BitmapTextures, maxTextureSize } from "./bitmapTextures.ts";
import { SceneContents } from "./sceneContents.ts";
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
  /** Its document's <X3D>, and where that is. */
  readonly x3d: SceneElement;
  readonly url: string;
  /** The absolute URL of one that the document writes. */
  readonly urlOf: (url: string) => string;
  /** The URL to ask for instead of an absolute one. */
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

export class ImgeoScene extends Group<ImgeoSceneEventMap> {
  readonly #contents: SceneContents;
  readonly #firstImage = Promise.withResolvers<undefined>();
  readonly #complete = Promise.withResolvers<undefined>();
  #progress = noProgress;
  readonly #progressEvents = new Throttle(progressIntervalMs, () => {
    this.#progress = progressOf(this.transfers, this.#progress);
    this.dispatchEvent({ type: "progress", progress: this.#progress });
  });
  readonly #picker = new ScenePicker();
  #error: Error | undefined;

  constructor({ x3d, url, urlOf, resolve, fetch, scheduler, keepsVertices, makeMaterial, runJob }: SceneSources) {
    super();
    for (const { promise } of [this.#firstImage, this.#complete]) promise.catch(() => undefined); // nobody has to listen
    const admission = new UploadThrottle();
    const textures = new BitmapTextures(admission);
    const buffers = new ArrayBuffers();
    const pool = new ResourcePool({
      scheduler,
      makeImage: (png, signal) => textures.makeImage(png, signal),
      readsTextures: () => Promise.resolve(!keepsVertices),
      maxTextureSize,
      runJob,
      makePicture: (bytes, sampling, signal) => textures.makePicture(bytes, sampling, signal),
      storeBytes: async (array, _, signal) => {
        await admission.waitForFrame(array.byteLength, signal);
        return buffers.store(array);
      },
      download: { ...defaultDownloadOptions, fetch },
      resolve: (named) => resolve(urlOf(named)),
      onTransfer: () => {
        this.#progressEvents.request();
      },
    });
    this.#contents = new SceneContents(
      { x3d, url, urlOf, pool },
      {
        materialFactory: makeStandardMaterials(makeMaterial, surroundingsOf(this)),
        geometries: new GeometryPool(buffers),
        buffers,
        textures,
        batches: undefined,
        drawing: { asPoints: false },
        shared: {
          pixelRatio: { value: 1 },
          viewport: { value: new Vector4() },
          depthRange: { value: new Vector2() },
          ...makeLightUniforms(),
        },
      },
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
      },
    );
    this.add(this.#contents.root);
    passOnShadows(this);
    this.#contents.start();
    this.#advance();
  }

  /** What the documents say that are here, lights and viewpoints included, which are the app's business. */
  get description(): SceneDescription {
    return this.#contents.description;
  }

  /** Of all shapes that are seen, in any level, as the documents tell it that are here, in this object's coordinates. */
  get box(): Box3 {
    return this.#contents.box;
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
    return this.#contents.transfers;
  }

  /**
   * What of it an app's picture shows at a place, in CSS pixels from the top left
   * of the canvas; objects of the app are looked through. Waits for the GPU. The
   * camera is the one that the picture was drawn with, over the whole canvas.
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

  /** Ends its requests; what it shows stays. */
  abort(): void {
    this.#contents.stop();
    const reason = new DOMException("the loading of the scene was aborted", "AbortError");
    this.#firstImage.reject(reason);
    this.#complete.reject(reason);
    this.#progressEvents.cancel();
    this.dispatchEvent({ type: "abort" });
  }

  /** Ends its requests, frees what it holds on the GPU, and takes it out of the app's scene. */
  override dispose(): void {
    this.abort();
    this.#contents.dispose();
    this.#picker.dispose();
    this.removeFromParent();
    this.clear();
    super.dispose();
  }

  /** Not possible: what a scene shows changes while it loads. Load it again; its files are in the browser's cache. */
  override clone(): this {
    throw new Error("an ImgeoScene cannot be cloned; load it again");
  }

  #fail(error: DeliveryError): void {
    this.#error ??= error;
    this.dispatchEvent({ type: "error", url: error.url, error });
  }

  /** Keeps the promises that can be kept. */
  #advance(): void {
    if (!this.#contents.isDisplayed) return;
    if (this.#error !== undefined && !this.#contents.shapes.hasPicture) this.#firstImage.reject(this.#error);
    else this.#firstImage.resolve(undefined);
    if (!this.#contents.isSettled) return;
    this.#progressEvents.callNow();
    this.#complete.resolve(undefined);
  }
}

function surroundingsOf(scene: ImgeoScene): SceneShadowOptions {
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

/** What an app says of the scene holds for all that is in it, now and later: objects come and go with each stage. */
function passOnShadows(scene: ImgeoScene): void {
  for (const name of ["castShadow", "receiveShadow"] as const) {
    let flag = false;
    Object.defineProperty(scene, name, {
      configurable: true,
      enumerable: true,
      get: () => flag,
      set: (wanted: boolean) => {
        flag = wanted;
        scene.traverse((object) => {
          if (object !== scene) object[name] = wanted;
        });
      },
    });
  }
}
